#include "apps/results/folder/verdict_json.hpp"

#include <cmath>

#include "geometry/index.hpp"

namespace ashlar {

nlohmann::ordered_json verdict_json(const MotionVerdict& verdict, const Simulation& simulation) {
  using Json = nlohmann::ordered_json;
  const auto name = [&](int block) { return Json(simulation.blocks()[at(block)].name()); };
  Json json = {{"state", verdict.at_rest() ? "at rest" : "moving"},
               {"moving", verdict.moving},
               {"fastest", verdict.fastest >= 0 ? name(verdict.fastest) : Json(nullptr)},
               {"speed", verdict.speed},
               {"displaced", verdict.displaced},
               {"fallen", Json::array()}};
  for (const MotionVerdict::Fallen& of : verdict.fallen)
    json["fallen"].push_back({{"block", name(of.block)},
                              {"time", of.time},
                              {"drop", of.drop},
                              {"distance", of.distance},
                              {"runout", of.runout},
                              {"below_all_held", of.left}});
  return json;
}

nlohmann::ordered_json peaks_json(const std::vector<MeasurePeak>& peaks) {
  const auto value = [](double number, double time) {
    return std::isnan(number) ? nlohmann::ordered_json(nullptr)
                              : nlohmann::ordered_json{{"value", number}, {"time", time}};
  };
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [column, unit, peak] : peaks)
    json[column] = {{"unit", unit},
                    {"least", value(peak.least, peak.least_time)},
                    {"largest", value(peak.largest, peak.largest_time)}};
  return json;
}

}  // namespace ashlar
