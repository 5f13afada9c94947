#include "apps/scene/read/model_origin.hpp"

#include <exception>
#include <filesystem>
#include <utility>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/masonry/masonry.hpp"
#include "apps/scene/meshes/mesh_import.hpp"
#include "apps/scene/model/model_position.hpp"
#include "apps/scene/toml/parameters.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"
#include "geometry/exact/axis_rotation.hpp"
#include "geometry/mesh/volume_mesh.hpp"

namespace ashlar {
namespace {

/// A box that holds a shape before it is rotated; empty if its file cannot be read.
struct ShapeBox {
  const std::filesystem::path& folder;

  Box operator()(std::monostate) const { return {}; }
  Box operator()(const ScenePiece&) const { return {}; }
  Box operator()(const SceneBox& box) const { return {box.min, box.max}; }
  Box operator()(const SceneHull& hull) const { return box_of(hull.points); }
  Box operator()(const SceneSphere& sphere) const {
    const Vector3 radius = Vector3::Constant(sphere.radius);
    return {sphere.center - radius, sphere.center + radius};
  }
  Box operator()(const SceneMesh& mesh) const {
    Box box;
    try {
      if (mesh.stone) {
        for (const Vector3& point : mesh.stone->points) box.include(mesh.scale * point);
        return box;
      }
      const std::filesystem::path file = folder / mesh.file;
      for (const Vector3& point :
           is_volume_mesh(file) ? read_volume_mesh(file).points : read_mesh_file(file).points)
        box.include(mesh.scale * point);
    } catch (const std::exception&) {
      return {};
    }
    return box;
  }
};

bool is_empty(const Box& box) {
  return !(box.low.array() <= box.high.array()).all();
}

/// Adds a ball that holds the rotated shape, or the shape's box, at both ends of an array.
void include_block(const SceneBlock& block, const Box& shape, Box& all) {
  if (is_empty(shape)) return;
  Vector3 center = 0.5 * shape.low + 0.5 * shape.high, half = 0.5 * shape.high - 0.5 * shape.low;
  if (block.rotate) {
    const Eigen::Matrix3d turn =
        rotation_matrix(block.rotate->axis.stableNormalized(), degree_turn(block.rotate->angle));
    center = turn * (center - block.rotate->about) + block.rotate->about;
    half.setConstant(half.norm());
  }
  center += block.translate;
  Vector3 last = center;
  if (block.array)
    for (std::size_t k = 0; k < block.array->step.size(); ++k)
      last += (block.array->count[k] - 1) * block.array->step[k];
  for (const Vector3& place : {center, last}) {
    all.include(place - half);
    all.include(place + half);
  }
}

}  // namespace

Vector3 origin_of_model(const toml::table& document, const std::vector<std::string>& files) {
  Diagnostics ignored;
  ScenePlaces places;
  TomlReading reading(files, ignored, places);
  reading.set_formulas(read_parameters(document, reading));
  TomlTableReader top(reading, document, "", "");
  const std::filesystem::path folder = reading.folder();
  Box all;
  const auto include = [&](const SceneBlock& block) {
    include_block(block, std::visit(ShapeBox{folder}, block.shape), all);
  };
  (void)top.read_tables("block", [&](TomlTableReader& table) {
    include(keys::block_place_keys().read(table));
    return 0;
  });
  for (const std::vector<SceneBlock>& pieces : top.read_tables("masonry", read_masonry))
    for (const SceneBlock& piece : pieces) include(piece);
  return origin_for(all);
}

Box box_of_blocks(const Scene& scene) {
  const std::filesystem::path folder = scene.file.parent_path();
  Box all;
  for (const SceneBlock& block : scene.block) {
    Box shape = std::visit(ShapeBox{folder}, block.shape);
    if (std::holds_alternative<SceneMesh>(block.shape)) {
      shape.low -= block.shape_origin;
      shape.high -= block.shape_origin;
    }
    include_block(block, shape, all);
  }
  return all;
}

Vector3 shape_origin_of(const SceneBlock& block, const TomlReading& reading) {
  if (reading.origin().isZero(0.0) || block.translate.isZero(0.0) ||
      std::holds_alternative<std::monostate>(block.shape))
    return reading.origin();
  const std::filesystem::path folder = reading.folder();
  return origin_for(std::visit(ShapeBox{folder}, block.shape));
}

}  // namespace ashlar
