#include "solver/run/contact_explanation.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/contact/overlap_outline.hpp"
#include "solver/step/detect/step_contacts.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

/// Identity of a contact in two lists: its features by number.
using FeatureNames = std::tuple<ContactFeatures, bool, std::array<int, 2>, std::array<int, 2>>;

FeatureNames names_of(const CellOverlap& overlap) {
  return {ContactFeatures::faces, false, {overlap.cell_a, -1}, {overlap.cell_b, -1}};
}
FeatureNames names_of(const VertexContact& contact) {
  return {ContactFeatures::vertex_and_face, contact.vertex_of_a, {contact.point, -1}, {contact.cell, -1}};
}
FeatureNames names_of(const EdgeContact& contact) {
  return {ContactFeatures::edges, false, contact.of_a.ends, contact.of_b.ends};
}

int face_of(const PlacedSurface& s, int cell) {
  return s.surface().cells[at(cell)].face;
}

/// Compares the lists of contacts of one pair from stage to stage.
class StageComparison {
 public:
  /// @param a,b surfaces of both blocks; must outlive this
  StageComparison(const PlacedSurface& a, const PlacedSurface& b) : a_(a), b_(b) {}

  /// Compares with the list after the next stage.
  void add(ContactStage stage, const PairContacts& contacts) {
    std::vector<bool> present(names_.size(), false);
    const auto note_one = [&](const auto& contact) {
      const FeatureNames names = names_of(contact);
      const auto known = std::find(names_.begin(), names_.end(), names);
      const auto place = static_cast<std::size_t>(known - names_.begin());
      if (known == names_.end()) {
        names_.push_back(names);
        present.push_back(true);
        contacts_.push_back(explained(contact));
        contacts_.back().added = stage;
        return;
      }
      present[place] = true;
      contacts_[place].removed.reset();
    };
    for (const CellOverlap& overlap : contacts.overlaps) note_one(overlap);
    for (const VertexContact& contact : contacts.vertices) note_one(contact);
    for (const EdgeContact& contact : contacts.edges) note_one(contact);
    for (std::size_t k = 0; k < present.size(); ++k)
      if (!present[k] && !contacts_[k].removed) contacts_[k].removed = stage;
  }

  [[nodiscard]] std::vector<ExplainedContact> result() && { return std::move(contacts_); }

 private:
  [[nodiscard]] ExplainedContact explained(const CellOverlap& overlap) const {
    ExplainedContact one;
    one.faces = {face_of(a_, overlap.cell_a), face_of(b_, overlap.cell_b)};
    const std::vector<Eigen::Vector2d> corners = places_of(overlap);
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner : corners) middle += corner / static_cast<double>(corners.size());
    const ViewFrame& frame = overlap.frame;
    one.place = frame.origin + middle.x() * frame.e1 + middle.y() * frame.e2;
    const Vector3 on_b = b_.corners(overlap.cell_b).front();
    one.place -= frame.w * frame.w.dot(one.place - on_b);
    one.normal = frame.w;
    one.gap = *std::min_element(overlap.gaps.begin(), overlap.gaps.end());
    one.area = area_of(corners);
    return one;
  }
  [[nodiscard]] ExplainedContact explained(const VertexContact& contact) const {
    ExplainedContact one;
    one.features = ContactFeatures::vertex_and_face;
    one.vertex_of_a = contact.vertex_of_a;
    const PlacedSurface& with_vertex = contact.vertex_of_a ? a_ : b_;
    const PlacedSurface& with_cell = contact.vertex_of_a ? b_ : a_;
    const int of_vertex = face_of(with_vertex, contact.own_cell);
    const int of_cell = face_of(with_cell, contact.cell);
    one.faces =
        contact.vertex_of_a ? std::array<int, 2>{of_vertex, of_cell} : std::array<int, 2>{of_cell, of_vertex};
    const Vector3& outward = with_cell.normal(contact.cell);
    one.normal = contact.vertex_of_a ? outward : Vector3(-outward);
    one.place = with_vertex.point(contact.point) - contact.gap * outward;
    one.gap = contact.gap;
    one.area = contact.area;
    return one;
  }
  [[nodiscard]] ExplainedContact explained(const EdgeContact& contact) const {
    ExplainedContact one;
    one.features = ContactFeatures::edges;
    one.faces = {face_of(a_, contact.of_a.cell), face_of(b_, contact.of_b.cell)};
    const auto& [ends, cell, along] = contact.of_b;
    one.place = (1.0 - along) * b_.point(ends[0]) + along * b_.point(ends[1]);
    one.normal = contact.normal;
    one.gap = contact.gap;
    one.area = contact.area;
    return one;
  }

  const PlacedSurface& a_;
  const PlacedSurface& b_;
  std::vector<ExplainedContact> contacts_;
  std::vector<FeatureNames> names_;  ///< of contacts_
};

/// Reason for excluding a pair from the search regardless of positions.
std::optional<PairSearch> left_out(const BlockSystem& system, const PairKey& pair) {
  if (!system.present(pair[0]) || !system.present(pair[1])) return PairSearch::absent;
  if (system.left_out().contains(pair)) return PairSearch::tied;
  if (!system.moving()[at(pair[0])] && !system.moving()[at(pair[1])]) return PairSearch::both_held;
  return std::nullopt;
}

/// State of blocks and contacts without caches of earlier searches.
RunState copy_for_search(const RunState& state) {
  RunState copy;
  copy.clock = state.clock;
  copy.steps = state.steps;
  copy.remembers_statics = state.remembers_statics;
  copy.states = state.states;
  copy.pairs = state.pairs;
  for (auto& [blocks, pair] : copy.pairs) {
    pair.cache.reset();
    pair.clearance.reset();
  }
  return copy;
}

}  // namespace

ContactExplanation explain_contacts(const BlockSystem& system, const RunState& state,
                                    const FinderState& divisions, int a, int b) {
  const PairKey pair = {std::min(a, b), std::max(a, b)};
  if (pair[0] < 0 || pair[1] >= system.count() || pair[0] == pair[1])
    throw std::invalid_argument("two different blocks of the system are needed");
  BlockSystem awake = system;
  awake.let_go();
  ContactExplanation result;
  result.blocks = pair;
  if (const auto reason = left_out(awake, pair)) {
    result.search = *reason;
    return result;
  }
  RunState copy = copy_for_search(state);
  std::vector<std::pair<ContactStage, PairContacts>> stages;
  StepContacts contacts(awake, [&](ContactStage stage, const PairKey& blocks, const PairContacts& list) {
    if (blocks == pair) stages.emplace_back(stage, list);
  });
  ContactFinder& finder = contacts.finder();
  FinderState start = finder.state();
  start.divisions = divisions.divisions;
  finder.restore(start);
  const double step = awake.settings().time_step;
  result.search = PairSearch::far_apart;
  // Supports that move take part in the expected motion, as in detect().
  const std::vector<BlockState> driven = driven_states(awake, copy, step);
  const ExpectedMotion motion = finder.expected_motion(driven.empty() ? copy.states : driven, step);
  for (const NearPair& near : finder.near_pairs(copy.states, motion, copy.pairs)) {
    if (near.blocks != pair) continue;
    result.search = PairSearch::searched;
    result.reach = near.reach;
  }
  (void)contacts.detect(awake, copy, step);
  if (stages.empty()) return result;
  StageComparison comparison(finder.placed(pair[0]), finder.placed(pair[1]));
  for (const auto& [stage, list] : stages) comparison.add(stage, list);
  result.type = stages.back().second.type;
  result.contacts = std::move(comparison).result();
  if (const auto& clearance = history_of(copy.pairs, pair).clearance) result.clearance = clearance->distance;
  return result;
}

}  // namespace ashlar
