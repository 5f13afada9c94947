#include "apps/program/run/contact_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/results/tables/contact_state.hpp"
#include "geometry/index.hpp"
#include "solver/run/contact_explanation.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {
namespace {

std::string short_text_of(const Vector3& vector) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0);
}

/// A place in the user's coordinates; far from their origin six digits would be those of the origin alone.
std::string place_text_of(const Vector3& place, const Vector3& origin) {
  if (origin.isZero(0.0)) return short_text_of(place);
  const Vector3 there = origin + place;
  return fmt::format("({:.12g}, {:.12g}, {:.12g})", there.x(), there.y(), there.z());
}

/// Reason for which a stage removes contacts.
const char* reason_of(ContactStage stage) {
  switch (stage) {
    case ContactStage::search:
      return "outside of the reach";
    case ContactStage::area:
      return "the faces have no area in common beyond rounding";
    case ContactStage::occluded_faces:
      return "the face lies on a third block there, nothing can enter through it";
    case ContactStage::entrance:
      return "these convex blocks meet through another face";
    case ContactStage::internal_edge:
      return "only the penetration of supporting blocks makes it (internal edge)";
  }
  return "";
}

/// Origin of a contact, unless the search found it.
const char* origin_of(ContactStage stage) {
  switch (stage) {
    case ContactStage::occluded_faces:
      return ", found below a face that lies on a third block";
    case ContactStage::entrance:
      return ", from the exact contact of both convex blocks";
    default:
      return "";
  }
}

/// Names of two blocks.
struct Names {
  std::string a;
  std::string b;
};

std::string features_of(const ExplainedContact& contact, const Names& names) {
  const auto& [face_a, face_b] = contact.faces;
  switch (contact.features) {
    case ContactFeatures::faces:
      return fmt::format("face {} of {} on face {} of {}", face_a, names.a, face_b, names.b);
    case ContactFeatures::vertex_and_face:
      return contact.vertex_of_a ? fmt::format("vertex of {} on face {} of {}", names.a, face_b, names.b)
                                 : fmt::format("vertex of {} on face {} of {}", names.b, face_a, names.a);
    case ContactFeatures::edges:
      return fmt::format("edge of {} (face {}) across edge of {} (face {})", names.a, face_a, names.b,
                         face_b);
  }
  return "";
}

/// @param origin Scene::origin
std::string line_of(const ExplainedContact& contact, const Names& names, const Vector3& origin) {
  std::string line = fmt::format("  {} {}: gap {:.4g} m, area {:.4g} m^2, at {}, normal {}{}",
                                 contact.removed ? "left out" : "used    ", features_of(contact, names),
                                 contact.gap, contact.area, place_text_of(contact.place, origin),
                                 short_text_of(contact.normal), origin_of(contact.added));
  if (contact.removed) line += fmt::format("\n           because: {}", reason_of(*contact.removed));
  return line + '\n';
}

/// Reason for the absence of contacts.
std::string without_contacts(const ContactExplanation& explanation) {
  switch (explanation.search) {
    case PairSearch::both_held:
      return "none are searched: neither block moves";
    case PairSearch::absent:
      return "none are searched: one of the blocks is absent in this stage";
    case PairSearch::tied:
      return "none are searched: the blocks are tied";
    case PairSearch::far_apart:
      return "none: the boxes of both blocks are farther apart than they can move in a step";
    case PairSearch::searched:
      break;
  }
  return explanation.clearance
             ? fmt::format("none: the blocks are at least {:.4g} m apart, gaps up to {:.4g} m are searched",
                           *explanation.clearance, explanation.reach)
             : fmt::format("none: no features face each other with a gap up to {:.4g} m", explanation.reach);
}

std::string forces_of(const Simulation& simulation, const PairKey& blocks, const Names& names) {
  const auto& records = simulation.contacts();
  const auto record = std::find_if(records.begin(), records.end(), [&](const PairRecord& one) {
    return one.a == blocks[0] && one.b == blocks[1];
  });
  if (record == records.end()) return "  the last step had no contact points between them\n";
  std::array<int, 3> states = {0, 0, 0};
  for (const ContactState state : shown_states(simulation, *record))
    ++states[static_cast<std::size_t>(state)];
  return fmt::format(
      "  the last step had {} contact points: {} open, {} sticking, {} sliding; force on {}: {} N\n",
      record->points.size(), states[0], states[1], states[2], names.a, short_text_of(force_on_a(*record)));
}

}  // namespace

std::optional<PairKey> pair_by_names(const std::string& names, const Simulation& simulation,
                                     Diagnostics& diagnostics) {
  const auto number_of = [&](const std::string& name) {
    const auto& blocks = simulation.blocks();
    const auto found = std::find_if(blocks.begin(), blocks.end(),
                                    [&](const BlockModel& block) { return block.name() == name; });
    return found == blocks.end() ? -1 : static_cast<int>(found - blocks.begin());
  };
  std::string missing;
  for (std::size_t comma = names.find(','); comma != std::string::npos; comma = names.find(',', comma + 1)) {
    const std::array<std::string, 2> two = {names.substr(0, comma), names.substr(comma + 1)};
    const PairKey pair = {number_of(two[0]), number_of(two[1])};
    if (pair[0] >= 0 && pair[1] >= 0 && pair[0] != pair[1])
      return PairKey{std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};
    if (missing.empty() && pair[0] == pair[1] && pair[0] >= 0) missing = "both names are of the same block";
    for (std::size_t k = 0; k < 2; ++k)
      if (missing.empty() && pair[k] < 0) missing = fmt::format("there is no block '{}'", two[k]);
  }
  if (missing.empty()) missing = "there is no comma";
  diagnostics.error({"--explain-contacts " + names},
                    missing + ", names of two blocks with a comma between them are allowed");
  return std::nullopt;
}

std::string contact_report(const Simulation& simulation, const PairKey& blocks, const Vector3& origin) {
  const ContactExplanation explanation = simulation.explain_contacts(blocks[0], blocks[1]);
  const Names names = {simulation.blocks()[at(blocks[0])].name(), simulation.blocks()[at(blocks[1])].name()};
  std::string text =
      fmt::format("contacts of {} and {} at t = {:.9g} s", names.a, names.b, simulation.time());
  if (explanation.contacts.empty()) return text + ": " + without_contacts(explanation) + '\n';
  text += fmt::format(", gaps up to {:.4g} m", explanation.reach);
  if (explanation.type) text += fmt::format(", type {}", to_string(*explanation.type));
  text += ":\n";
  for (const ExplainedContact& contact : explanation.contacts) text += line_of(contact, names, origin);
  return text + forces_of(simulation, blocks, names);
}

}  // namespace ashlar
