#include "apps/results/folder/rank_summary.hpp"

#include <algorithm>

namespace ashlar {
namespace {

double own_seconds(const RankWork& work) {
  const PhaseSeconds& phases = work.seconds;
  const double all =
      phases.contact_search + phases.contact_points + phases.solve + phases.motion_check + phases.depth_audit;
  return std::max(0.0, all - work.traffic.seconds);
}

}  // namespace

double time_imbalance(const std::vector<RankWork>& ranks) {
  double sum = 0.0, most = 0.0;
  for (const RankWork& rank : ranks) {
    sum += own_seconds(rank);
    most = std::max(most, own_seconds(rank));
  }
  return sum > 0.0 ? most * static_cast<double>(ranks.size()) / sum - 1.0 : 0.0;
}

BrokenJoints broken_joints(const std::vector<RankWork>& ranks) {
  BrokenJoints broken;
  for (const RankWork& rank : ranks) {
    broken.pairs += rank.broken_pairs;
    broken.area += rank.broken_area;
    broken.of_area += rank.bonded_area;
  }
  return broken;
}

void add_ranks(nlohmann::ordered_json& summary, const std::vector<RankWork>& ranks) {
  summary["rank_imbalance"] = time_imbalance(ranks);
  nlohmann::ordered_json& each = summary["ranks"] = nlohmann::ordered_json::array();
  for (const RankWork& rank : ranks) {
    const PhaseSeconds& phases = rank.seconds;
    each.push_back({{"blocks", rank.own},
                    {"ghosts", rank.ghosts},
                    {"pairs", rank.pairs},
                    {"wall_seconds",
                     {{"contact_search", phases.contact_search},
                      {"contact_points", phases.contact_points},
                      {"solve", phases.solve},
                      {"motion_check", phases.motion_check},
                      {"depth_audit", phases.depth_audit},
                      {"in_messages", rank.traffic.seconds}}},
                    {"collective_calls", rank.traffic.calls},
                    {"messages_sent", rank.traffic.messages},
                    {"bytes_sent", rank.traffic.bytes}});
  }
}

}  // namespace ashlar
