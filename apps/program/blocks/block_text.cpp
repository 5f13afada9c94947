#include "apps/program/blocks/block_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "apps/program/blocks/block_histogram.hpp"
#include "apps/results/text/csv_text.hpp"
#include "apps/scene/expand/piece_blocks.hpp"
#include "apps/scene/json/value_json.hpp"
#include "geometry/boxes/box.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> volumes_of(const BlockReport& report) {
  std::vector<double> volumes;
  for (std::size_t k = 0; k < report.blocks().size(); ++k)
    if (report.is_there(k)) volumes.push_back(report.blocks()[k].volume);
  return volumes;
}

std::string sizes_text(const BlockReport& report) {
  std::vector<double> volumes = volumes_of(report);
  std::string text = "volume, m^3             blocks   share of volume\n";
  const double all = report.volume();
  for (const SizeClass& of : size_classes(volumes))
    text += fmt::format("{:>9g} to {:<9g} {:>8}   {:.4f}\n", of.from, of.to, of.blocks, of.volume / all);
  return text;
}

/// Of blocks that leave or slide, in the order of their factors.
std::vector<RemovableBlock> key_blocks(const std::vector<RemovableBlock>& removable) {
  std::vector<RemovableBlock> keys;
  for (const RemovableBlock& of : removable)
    if (of.key.removable && of.key.mode != BlockMode::stable) keys.push_back(of);
  std::stable_sort(keys.begin(), keys.end(), [](const RemovableBlock& a, const RemovableBlock& b) {
    return a.factor_of_safety < b.factor_of_safety;
  });
  return keys;
}

std::string removable_text(const BlockReport& report, const std::vector<RemovableBlock>& removable) {
  const Scene& scene = report.loaded().scene;
  const auto movable = std::count_if(removable.begin(), removable.end(),
                                     [](const RemovableBlock& of) { return of.key.removable; });
  const std::vector<RemovableBlock> keys = key_blocks(removable);
  std::string text = fmt::format("{} blocks with a free face, {} of them removable, {} key blocks\n",
                                 removable.size(), movable, keys.size());
  if (keys.empty()) return text;
  text +=
      "key block                volume, m^3   factor   force, kN   centroid, m                direction\n";
  for (const RemovableBlock& of : keys) {
    const Vector3 at = scene.origin + centroid_of(report.loaded().solids[of.block]);
    const Vector3& direction = of.key.direction;
    text += fmt::format("{:<24} {:>11.4g} {:>8.4g} {:>11.4g}   {:<24} {:<20} {}\n",
                        scene.block[of.block].name, report.blocks()[of.block].volume, of.factor_of_safety,
                        1e-3 * of.needed, fmt::format("{:.4g}, {:.4g}, {:.4g}", at.x(), at.y(), at.z()),
                        fmt::format("{:.2f}, {:.2f}, {:.2f}", direction.x(), direction.y(), direction.z()),
                        to_string(of.key.mode));
  }
  return text;
}

Json key_json(const RemovableBlock& of) {
  const Vector3& direction = of.key.direction;
  return {{"finite", of.key.finite},
          {"removable", of.key.removable},
          {"mode", to_string(of.key.mode)},
          {"direction", direction.isZero(0.0) ? Json() : Json{direction.x(), direction.y(), direction.z()}},
          {"factor_of_safety", of.factor_of_safety},
          {"weight", of.weight},
          {"needed_force", of.needed}};
}

Json neighbours_json(const Scene& scene, const BlockEntry& entry) {
  std::map<std::pair<std::size_t, std::optional<std::size_t>>, double> areas;
  for (const BlockBorder& border : entry.borders) areas[{border.block, border.cut}] += border.area;
  Json neighbours = Json::array();
  for (const auto& [key, area] : areas) {
    const auto& [block, cut] = key;
    neighbours.push_back({{"block", scene.block[block].name},
                          {"area", area},
                          {"cut", cut ? Json(scene.cut[*cut].name) : Json()}});
  }
  return neighbours;
}

}  // namespace

std::string report_text(const BlockReport& report, const std::vector<RemovableBlock>* removable) {
  const Scene& scene = report.loaded().scene;
  std::vector<double> volumes = volumes_of(report);
  std::sort(volumes.begin(), volumes.end());
  std::string text = fmt::format("{} block{}, {:.10g} m^3; least {:.4g}, median {:.4g}, largest {:.4g} m^3\n",
                                 volumes.size(), volumes.size() == 1 ? "" : "s", report.volume(),
                                 volumes.front(), volumes[volumes.size() / 2], volumes.back());
  text += sizes_text(report);
  const std::vector<double> areas = report.areas_by_cut();
  for (std::size_t k = 0; k < areas.size(); ++k) {
    text += fmt::format("cut {}: {:.10g} m^2 between blocks", scene.cut[k].name, areas[k]);
    if (scene.rock->extended[k] > 0)
      text += fmt::format(", {} pieces divided by joints that end inside", scene.rock->extended[k]);
    if (scene.cut[k].min_volume > 0.0)
      text += fmt::format(", {} pieces below {:g} m^3 glued", scene.rock->glued[k], scene.cut[k].min_volume);
    text += '\n';
  }
  if (removable != nullptr) text += removable_text(report, *removable);
  return text;
}

Json report_json(const BlockReport& report, const std::vector<RemovableBlock>* removable) {
  const LoadedScene& loaded = report.loaded();
  Json blocks = Json::array();
  std::vector<std::size_t> place(loaded.solids.size(), 0);  // of a block in the list
  for (std::size_t k = 0; k < loaded.solids.size(); ++k) {
    if (!report.is_there(k)) continue;
    place[k] = blocks.size();
    const SceneBlock& block = loaded.scene.block[k];
    const Box box = box_of(loaded.solids[k].mesh().points);
    blocks.push_back({{"name", block.name},
                      {"names", loaded.scene.rock ? Json(loaded.scene.rock->other_names[k]) : Json::array()},
                      {"volume", report.blocks()[k].volume},
                      {"centroid", to_json(loaded.scene.origin + centroid_of(loaded.solids[k]))},
                      {"box",
                       {{"min", to_json(loaded.scene.origin + box.low)},
                        {"max", to_json(loaded.scene.origin + box.high)}}},
                      {"faces", loaded.solids[k].faces().size()},
                      {"material", block.material.empty() ? Json() : Json(block.material)},
                      {"neighbours", neighbours_json(loaded.scene, report.blocks()[k])}});
  }
  if (removable != nullptr)
    for (const RemovableBlock& of : *removable) blocks[place[of.block]]["key"] = key_json(of);
  return {{"count", blocks.size()}, {"volume", report.volume()}, {"blocks", std::move(blocks)}};
}

std::string removable_csv(const BlockReport& report, const std::vector<RemovableBlock>& removable) {
  const Scene& scene = report.loaded().scene;
  std::string text =
      "block,volume,x,y,z,mode,direction_x,direction_y,direction_z,factor_of_safety,weight,needed_force\n";
  for (const RemovableBlock& of : key_blocks(removable)) {
    text += quote_csv_field(scene.block[of.block].name);
    const Vector3 at = scene.origin + centroid_of(report.loaded().solids[of.block]);
    const Vector3& direction = of.key.direction;
    const auto add = [&text](double value) {
      text += ',';
      append_csv_number(text, value);
    };
    add(report.blocks()[of.block].volume);
    for (const double value : {at.x(), at.y(), at.z()}) add(value);
    text += fmt::format(",{}", to_string(of.key.mode));
    for (const double value :
         {direction.x(), direction.y(), direction.z(), of.factor_of_safety, of.weight, of.needed})
      add(value);
    text += '\n';
  }
  return text;
}

}  // namespace ashlar
