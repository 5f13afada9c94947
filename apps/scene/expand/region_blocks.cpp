#include "apps/scene/expand/region_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/expand/piece_blocks.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "geometry/any_solid/closest_point.hpp"

namespace ashlar {
namespace {

/// The solid of a region as that of a block, with the places of its keys.
std::optional<Polyhedron> solid_of(const Scene& scene, const SceneShape& shape, const std::string& path,
                                   Diagnostics& diagnostics) {
  Scene alone;
  alone.file = scene.file;
  alone.block.emplace_back().shape = shape;
  alone.block.back().shape_origin = scene.origin;
  for (const auto& [key, places] : scene.places.all())
    if (key.starts_with(path)) alone.places.record("block.0" + key.substr(path.size()), places);
  return std::move(build_solids(alone, diagnostics).front());
}

class Chooser {
 public:
  Chooser(Scene& scene, Diagnostics& diagnostics, Preparation* preparation)
      : scene_(scene), diagnostics_(diagnostics) {
    for (const std::optional<Polyhedron>& solid : build_solids(scene, diagnostics, nullptr, preparation))
      centroids_.push_back(solid ? centroid_of(*solid)
                                 : Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
  }

  void run() {
    const auto keep = [&](auto& list, const std::string& table) {
      for (std::size_t k = 0; k < list.size(); ++k)
        if (list[k].inside) list[k].inside->blocks = inside(*list[k].inside, fmt::format("{}.{}", table, k));
    };
    for (std::size_t k = 0; k < scene_.assign.size(); ++k)
      if (auto& entry = scene_.assign[k]; entry.inside)
        entry.inside->blocks = named(entry.blocks, *entry.inside, fmt::format("assign.{}", k), {});
    keep(scene_.joint, "joint");
    for (std::size_t k = 0; k < scene_.measure.size(); ++k) choose_measured(scene_.measure[k], k);
    std::vector<bool> absent = held_back(scene_);
    for (std::size_t s = 0; s < scene_.stage.size(); ++s) {
      SceneStage& stage = scene_.stage[s];
      const std::string path = fmt::format("stage.{}", s);
      std::vector<bool> present = absent;
      present.flip();
      use_names(stage.remove, stage.remove_inside, path + ".remove", present);
      use_names(stage.add, stage.add_inside, path + ".add", absent);
      change_presence(scene_, stage, absent);
      const auto fill = [&](auto& list, const char* key) {
        for (std::size_t k = 0; k < list.size(); ++k)
          use_names(list[k].blocks, list[k].inside, fmt::format("{}.{}.{}", path, key, k), {});
      };
      fill(stage.fix, "fix");
      fill(stage.load, "load");
      keep(stage.joint, path + ".joint");
    }
  }

 private:
  /// @param path of the table with the region. @return the blocks inside; none is a fault
  std::vector<std::size_t> inside(const SceneRegion& region, const std::string& path) {
    return chosen(
        region, path, [](std::size_t) { return true; }, "");
  }

  /// @param among if not empty, true for the blocks that may be chosen
  std::vector<std::size_t> named(const std::vector<std::string>& names, const SceneRegion& region,
                                 const std::string& path, const std::vector<bool>& among) {
    const auto wanted = [&](std::size_t k) {
      return (among.empty() || among[k]) && means_block(scene_, names, k);
    };
    return chosen(region, path, wanted,
                  among.empty() ? " of these names" : " of these names that can be chosen");
  }

  template <class Wanted>
  std::vector<std::size_t> chosen(const SceneRegion& region, const std::string& path, Wanted wanted,
                                  const char* words) {
    const RegionTest test(scene_, region, path + ".inside", diagnostics_);
    std::vector<std::size_t> blocks;
    for (std::size_t k = 0; k < centroids_.size(); ++k)
      if (wanted(k) && test.contains(centroids_[k])) blocks.push_back(k);
    if (blocks.empty() && test.good())
      error(path, fmt::format("no block{} has its centroid inside (inside), a region with one is needed; "
                              "`ashlar blocks --json` lists centroids",
                              words));
    return blocks;
  }

  void use_names(std::vector<std::string>& names, std::optional<SceneRegion>& region, const std::string& path,
                 const std::vector<bool>& among) {
    if (!region) return;
    const std::vector<std::size_t> blocks = named(names, *region, path, among);
    region.reset();
    names.clear();
    for (const std::size_t k : blocks) names.push_back(pattern_of(scene_.block[k].name));
  }

  void choose_measured(SceneMeasure& measure, std::size_t index) {
    if (measure.inside) choose_one(measure, index);
    if (measure.drift)
      use_names(measure.drift->blocks, measure.drift->inside, fmt::format("measure.{}.drift", index), {});
  }

  void choose_one(SceneMeasure& measure, std::size_t index) {
    const std::string path = fmt::format("measure.{}", index);
    const std::vector<std::size_t> blocks = inside(*measure.inside, path);
    if (blocks.empty()) return;
    measure.block = scene_.block[blocks.front()].name;
    if (blocks.size() > 1)
      error(path,
            fmt::format("inside holds the centroids of {} blocks (\"{}\", \"{}\"{}), that of one is needed",
                        blocks.size(), measure.block, scene_.block[blocks[1]].name,
                        blocks.size() > 2 ? ", ..." : ""));
  }

  void error(const std::string& path, std::string message) {
    diagnostics_.error(scene_.places.key(path + ".inside"), std::move(message));
  }

  Scene& scene_;
  Diagnostics& diagnostics_;
  std::vector<Vector3> centroids_;  ///< by block
};

}  // namespace

RegionTest::RegionTest(const Scene& scene, const SceneRegion& region, const std::string& path,
                       Diagnostics& diagnostics)
    : space_(region.space) {
  const SceneShape* shape = std::get_if<SceneShape>(&space_);
  if (shape == nullptr || std::holds_alternative<SceneBox>(*shape)) return;
  std::optional<Polyhedron> solid = solid_of(scene, *shape, path, diagnostics);
  good_ = solid.has_value();
  if (solid) solid_ = std::make_unique<const ClosestPointFinder>(std::move(*solid));
}

RegionTest::~RegionTest() = default;
RegionTest::RegionTest(RegionTest&&) noexcept = default;

bool RegionTest::contains(const Vector3& place) const {
  if (!good_ || !place.allFinite()) return false;
  if (const auto* half = std::get_if<SceneHalfspace>(&space_))
    return half->normal.dot(place - half->point) <= 0.0;
  if (const auto* box = std::get_if<SceneBox>(&std::get<SceneShape>(space_)))
    return (box->min.array() <= place.array()).all() && (place.array() <= box->max.array()).all();
  return solid_->find_any(place).place != PointPlace::outside;
}

bool has_regions(const Scene& scene) {
  const auto chosen = [](const auto& entry) { return entry.inside.has_value(); };
  const auto any = [&](const auto& list) { return std::any_of(list.begin(), list.end(), chosen); };
  const bool drifts =
      std::any_of(scene.measure.begin(), scene.measure.end(),
                  [](const SceneMeasure& measure) { return measure.drift && measure.drift->inside; });
  return any(scene.assign) || any(scene.joint) || any(scene.measure) || drifts ||
         std::any_of(scene.stage.begin(), scene.stage.end(), [&](const SceneStage& stage) {
           return stage.remove_inside || stage.add_inside || any(stage.fix) || any(stage.load) ||
                  any(stage.joint);
         });
}

void choose_blocks_inside(Scene& scene, Diagnostics& diagnostics, Preparation* preparation) {
  Chooser(scene, diagnostics, preparation).run();
}

}  // namespace ashlar
