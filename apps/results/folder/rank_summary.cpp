#include "apps/results/folder/rank_summary.hpp"

#include <algorithm>

namespace ashlar {
namespace {

/// Processor time of a rank for its own part of the step: without messages, and without shared systems, whose ranks wait
/// for each other too.
double own_processor(const RankWork& work) {
  return std::max(0.0, work.use.processor - work.traffic.processor - work.shared.processor);
}

nlohmann::ordered_json traffic_json(const RankTraffic& traffic) {
  return {{"collective_calls", traffic.calls},
          {"messages_sent", traffic.messages},
          {"bytes_sent", traffic.bytes},
          {"wall_seconds", traffic.seconds}};
}

}  // namespace

double time_imbalance(const std::vector<RankWork>& ranks) {
  double sum = 0.0, most = 0.0;
  for (const RankWork& rank : ranks) {
    sum += own_processor(rank);
    most = std::max(most, own_processor(rank));
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
  summary["repartitions"] = ranks.empty() ? 0 : ranks.front().repartitions;
  nlohmann::ordered_json& each = summary["ranks"] = nlohmann::ordered_json::array();
  for (const RankWork& rank : ranks) {
    const PhaseSeconds& phases = rank.seconds;
    each.push_back({{"blocks", rank.own},
                    {"ghosts", rank.ghosts},
                    {"ghost_searches", rank.ghost_searches},
                    {"weight", rank.weight},
                    {"pairs", rank.pairs},
                    {"border_pairs", rank.border_pairs},
                    {"unknowns", rank.unknowns},
                    {"contact_points", rank.points},
                    {"wall_seconds",
                     {{"contact_search", phases.contact_search},
                      {"contact_points", phases.contact_points},
                      {"solve", phases.solve},
                      {"motion_check", phases.motion_check},
                      {"depth_audit", phases.depth_audit},
                      {"shared_systems", rank.shared.seconds},
                      {"in_messages", rank.traffic.seconds}}},
                    {"processor_seconds",
                     {{"total", rank.use.processor},
                      {"own_part", own_processor(rank)},
                      {"shared_systems", rank.shared.processor},
                      {"in_messages", rank.traffic.processor}}},
                    {"peak_memory_bytes", rank.use.peak_memory},
                    {"shared_systems",
                     {{"unknowns", rank.shared.own_unknowns},
                      {"factorizations", rank.shared.factorizations},
                      {"solutions", rank.shared.solves},
                      {"conjugate_gradient_iterations", rank.shared.iterations}}},
                    {"collective_calls", rank.traffic.calls},
                    {"messages_sent", rank.traffic.messages},
                    {"bytes_sent", rank.traffic.bytes},
                    {"for_results", traffic_json(rank.for_results)}});
  }
}

}  // namespace ashlar
