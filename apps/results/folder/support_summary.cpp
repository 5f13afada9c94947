#include "apps/results/folder/support_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

struct Row {
  const Bolt* bolt;
  double axial;
  double shear;
  BoltCondition condition;
};

/// Null unless the largest value is positive.
template <class Value>
Json largest(const std::vector<Row>& rows, const Value& value) {
  const auto row = std::max_element(rows.begin(), rows.end(),
                                    [&](const Row& a, const Row& b) { return value(a) < value(b); });
  if (row == rows.end() || !(value(*row) > 0.0)) return nullptr;
  return {{"force", value(*row)}, {"name", row->bolt->name}};
}

}  // namespace

Json support_summary(const Simulation& simulation) {
  constexpr std::size_t most = 1000;
  std::vector<Row> rows;
  std::map<std::string, int> counts;
  for (std::size_t k = 0; k < simulation.bolts().size(); ++k) {
    const Bolt& bolt = simulation.system().bolts()[k];
    const BoltState& state = simulation.bolts()[k];
    const BoltCondition condition = condition_of(bolt, state);
    ++counts[to_string(condition)];
    if (state.installed())
      rows.push_back({&bolt, largest_axial_force(state), largest_shear_force(state), condition});
  }
  Json summary = {{"largest_tension", largest(rows, [](const Row& row) { return row.axial; })},
                  {"largest_compression", largest(rows, [](const Row& row) { return -row.axial; })},
                  {"largest_shear", largest(rows, [](const Row& row) { return row.shear; })},
                  {"states", counts},
                  {"bolts", Json::array()}};
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return std::abs(a.axial) > std::abs(b.axial); });
  for (std::size_t k = 0; k < std::min(rows.size(), most); ++k) {
    summary["bolts"].push_back({{"name", rows[k].bolt->name},
                                {"axial_force", rows[k].axial},
                                {"shear_force", rows[k].shear},
                                {"state", to_string(rows[k].condition)}});
  }
  return summary;
}

}  // namespace ashlar
