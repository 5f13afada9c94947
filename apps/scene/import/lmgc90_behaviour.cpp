#include "apps/scene/import/lmgc90_behaviour.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/scene/import/lmgc90_lines.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

struct Law {
  std::string kind;
  std::optional<double> friction;
};
using Colours = std::pair<std::string, std::string>;

bool is_name(std::string_view word) {
  return !word.empty() && word.front() != '$';
}

/// Laws by their nicknames: a line with the name, then lines with values.
void read_laws(Lmgc90Lines& lines, std::map<std::string, Law>& laws) {
  lines.require_next("a law");
  const std::string name(lines.word(0));
  Law law{std::string(lines.word(1)), std::nullopt};
  do {
    for (const char* key : {"stfr", "sfric", "fric"}) {
      if (law.friction || !lines.has(key)) continue;
      law.friction = lines.number(key);
      if (!(*law.friction >= 0.0))
        lines.fail(lines.text(key), fmt::format("friction ({}), must be >= 0", *law.friction));
    }
  } while (lines.next() && !lines.word(0).starts_with('$'));
  lines.put_back();
  laws[name] = std::move(law);
}

/// Colours that meet by a law, in the order of the names.
void read_pairs(Lmgc90Lines& lines, const std::map<std::string, Law>& laws,
                std::map<Colours, std::string>& pairs) {
  while (lines.next()) {
    if (lines.word(0).starts_with('$')) return lines.put_back();
    if (lines.word(0) == "cdbdy" || lines.words().size() < 7 || lines.word(0) != "RBDY3") continue;
    const std::string law(lines.word(3));
    if (!laws.contains(law))
      lines.fail(lines.word(3), fmt::format("law {} is unknown, one of the file is needed", printable(law)));
    std::string first = plain_name(lines.word(2)), second = plain_name(lines.word(6));
    if (second < first) std::swap(first, second);
    pairs[{first, second}] = law;
  }
}

}  // namespace

void read_lmgc90_bulk(const std::string& file, std::string_view text,
                      const std::map<std::string, std::size_t>& materials, ImportedModel& model) {
  Lmgc90Lines lines(file, text);
  while (lines.next()) {
    if (lines.has("grv1")) {
      model.gravity = Vector3(lines.number("grv1"), lines.number("grv2"), lines.number("grv3"));
      continue;
    }
    if (!is_name(lines.word(0)) || !lines.has("Umas")) continue;
    const auto found = materials.find(std::string(lines.word(0)));
    if (found == materials.end()) continue;
    const double density = lines.number("Umas");
    if (!(density > 0.0)) lines.fail(lines.text("Umas"), fmt::format("density ({}), must be > 0", density));
    model.materials[found->second].density = density;
  }
}

void read_lmgc90_contact(const std::string& file, std::string_view text,
                         const std::map<std::string, int>& colours, ImportedModel& model) {
  std::map<std::string, Law> laws;
  std::map<Colours, std::string> pairs;
  Lmgc90Lines lines(file, text);
  while (lines.next()) {
    if (lines.word(0) == "$behav") read_laws(lines, laws);
    if (lines.word(0) == "$seety") read_pairs(lines, laws, pairs);
  }
  std::vector<std::string> without;
  std::map<std::string, bool> used;
  std::map<Colours, double> friction;
  for (auto first = colours.begin(); first != colours.end(); ++first) {
    for (auto second = first; second != colours.end(); ++second) {
      if (first == second && first->second == 1) continue;
      const auto found = pairs.find({first->first, second->first});
      if (found == pairs.end()) {
        without.push_back(fmt::format("{} and {}", first->first, second->first));
        continue;
      }
      used[found->second] = true;
      friction[{first->first, second->first}] = laws.at(found->second).friction.value_or(0.0);
    }
  }
  for (const auto& [name, is_used] : used) {
    const Law& law = laws.at(name);
    if (!law.friction)
      model.notes.push_back(fmt::format("law {} ({}) has no friction: none", name, law.kind));
    if (law.kind != "IQS_CLB" && law.kind != "GAP_SGR_CLB" && law.kind != "VEL_SGR_CLB")
      model.left_out.push_back(fmt::format("parts of law {} ({}) other than friction", name, law.kind));
  }
  if (!without.empty())
    model.notes.push_back(
        fmt::format("colours without a law of contact touch without friction (in LMGC90 they do not "
                    "touch): {}",
                    fmt::join(without, ", ")));
  const bool one = without.empty() && std::all_of(friction.begin(), friction.end(), [&](const auto& entry) {
                     return entry.second == friction.begin()->second;
                   });
  model.contact.friction_angle = one ? correctly_rounded::degrees_of_atan(friction.begin()->second) : 0.0;
  if (one) return;
  for (const auto& [pair, coefficient] : friction)
    model.joints.push_back({pair.first + "_*",
                            pair.second + "_*",
                            {correctly_rounded::degrees_of_atan(coefficient), {}, {}, {}, {}},
                            false});
}

}  // namespace ashlar
