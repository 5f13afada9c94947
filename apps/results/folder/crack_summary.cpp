#include "apps/results/folder/crack_summary.hpp"

#include <map>
#include <string>

#include "geometry/index.hpp"
#include "solver/fracture/divided_block.hpp"

namespace ashlar {

void add_cracks(nlohmann::ordered_json& summary, const CrackRecord& cracks, const Scene& scene,
                const Simulation& simulation) {
  using Json = nlohmann::ordered_json;
  std::vector<std::string> names;  // of blocks at each crack
  std::vector<std::size_t> originals;
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    names.push_back(scene.block[k].name), originals.push_back(k);
  std::map<std::size_t, int> numbers;
  Json list = Json::array();
  for (const CrackEvent& event : cracks.events) {
    const std::string block = names[at(event.block)];
    const std::size_t original = originals[at(event.block)];
    const int number = ++numbers[original];
    Json parts = Json::array();
    for (std::size_t k = 0; k < event.parts.size(); ++k) {
      const std::string part = name_of_part(block, number, k);
      parts.push_back(part);
      if (k == 0) {
        names[at(event.block)] = part;
      } else {
        names.push_back(part);
        originals.push_back(original);
      }
    }
    const auto array = [](const Vector3& v) { return Json{v.x(), v.y(), v.z()}; };
    Json crack = {{"time", event.time}};
    if (!scene.stage.empty()) crack["stage"] = scene.stage[at(event.stage)].name;
    crack.update({{"block", block},
                  {"parts", parts},
                  {"point", array(event.point + scene.origin)},
                  {"normal", array(event.normal)},
                  {"area", event.area},
                  {"stress", event.stress}});
    list.push_back(std::move(crack));
  }
  summary["cracks"] = std::move(list);
  Json whole = Json::array();
  for (const int block : cracks.left_whole) whole.push_back(simulation.blocks()[at(block)].name());
  summary["cracks_left_whole"] = std::move(whole);
}

}  // namespace ashlar
