#include "apps/scene/expand/scene_solids.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/json/value_json.hpp"
#include "apps/scene/meshes/mesh_import.hpp"
#include "geometry/exact/axis_rotation.hpp"
#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/solid/hull_solid.hpp"
#include "geometry/solid/shape_loss.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar {
namespace {

// Scale, to the origin of the model, then rotate. Steps that are not given leave the points unchanged bit for bit.
// @param mesh null: another shape
std::vector<Vector3> turned_points(std::vector<Vector3> points, const SceneMesh* mesh,
                                   const SceneBlock& block) {
  if (mesh != nullptr && mesh->scale != 1.0)
    for (Vector3& point : points) point *= mesh->scale;
  if (mesh != nullptr && !block.shape_origin.isZero(0.0))
    for (Vector3& point : points) point -= block.shape_origin;
  if (block.rotate) {
    const Eigen::Matrix3d matrix =
        rotation_matrix(block.rotate->axis.stableNormalized(), degree_turn(block.rotate->angle));
    for (Vector3& point : points) point = matrix * (point - block.rotate->about) + block.rotate->about;
  }
  return points;
}

double largest_coordinate_of(const std::vector<Vector3>& points) {
  double largest = 0.0;
  for (const Vector3& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return largest;
}

// A shape that bounds no solid, with the whole message.
struct ShapeError : std::runtime_error {
  using runtime_error::runtime_error;
};

constexpr double resolution_share = 0x1p-46;  // 64 units in the last place of the largest coordinate

Polyhedron not_lost(Polyhedron solid, double resolution) {
  if (!is_lost_in_rounding(solid)) return solid;
  throw ShapeError(fmt::format(
      "shape is lost in rounding (coordinates up to {:.4g} m are known to {:.4g} m), a thicker one or one "
      "nearer to the origin is needed",
      resolution / resolution_share, resolution));
}

// The points as the user gave them have the resolution.
double resolution_about(std::vector<Vector3> points, const Vector3& origin) {
  for (Vector3& point : points) point += origin;
  return resolution_of(points);
}

void require_coordinates(const std::vector<Vector3>& points) {
  const double largest = largest_coordinate_of(points);
  if (!is_too_far(largest)) return;
  throw ShapeError(
      fmt::format("shape has a coordinate that is too large ({:.4g} m), at most {:.4g} m is allowed", largest,
                  largest_coordinate));
}

// All defects by kind, each with the first elements that have it.
std::string describe_defects(const MeshError& error) {
  constexpr std::size_t elements_shown = 3;
  std::map<MeshDefectKind, std::vector<std::string>> elements;
  for (const MeshDefect& defect : error.defects()) elements[defect.kind].push_back(defect.element);
  std::vector<std::string> kinds;
  for (auto& [kind, names] : elements) {
    const std::size_t hidden = names.size() - std::min(names.size(), elements_shown);
    names.resize(names.size() - hidden);
    const std::string more = hidden > 0 ? ", and more" : "";
    kinds.push_back(fmt::format("{}: {}{}", to_string(kind), fmt::join(names, ", "), more));
  }
  return fmt::format("{}", fmt::join(kinds, "; "));
}

Polyhedron build_mesh_solid(const Scene& scene, const SceneMesh& shape) {
  const std::filesystem::path file = scene.file.parent_path() / shape.file;
  try {
    TriangleMesh mesh = shape.stone ? *shape.stone : read_mesh_file(file);
    const double resolution = resolution_of(mesh.points);
    return not_lost(Polyhedron(std::move(mesh), resolution), resolution);
  } catch (const MeshFileError& error) {
    const std::string place = to_string(Place{file.string(), error.line(), error.column()});
    throw ShapeError(
        fmt::format("mesh file cannot be used ({}: {}), {} is needed", place, error.what(), readable_mesh));
  } catch (const MeshError& error) {
    throw ShapeError(
        fmt::format("mesh bounds no solid ({}: {}), one closed surface without self-intersections, "
                    "triangles counter-clockwise from outside, is needed",
                    file.string(), describe_defects(error)));
  }
}

struct SolidBuilder {
  const Scene& scene;
  const SceneBlock& block;

  Polyhedron operator()(std::monostate) const { throw std::logic_error("block without a shape"); }
  Polyhedron operator()(const SceneBox& box) const { return Polyhedron(make_box(box.min, box.max)); }
  Polyhedron operator()(const SceneMesh& mesh) const { return build_mesh_solid(scene, mesh); }
  Polyhedron operator()(const SceneHull& hull) const {
    const double resolution = resolution_about(hull.points, block.shape_origin);
    return not_lost(make_hull_solid(hull.points, resolution), resolution);
  }
  Polyhedron operator()(const SceneSphere& sphere) const {
    return Polyhedron(make_sphere(sphere.center, sphere.radius, sphere.subdivisions));
  }
  Polyhedron operator()(const ScenePiece& piece) const { return *piece.solid; }
};

// Shape before translation.
Polyhedron build_shape(const Scene& scene, const SceneBlock& block) {
  const SceneMesh* mesh = std::get_if<SceneMesh>(&block.shape);
  try {
    const Polyhedron own = std::visit(SolidBuilder{scene, block}, block.shape);
    std::vector<Vector3> points = turned_points(own.mesh().points, mesh, block);
    require_coordinates(points);
    return own.with_points(std::move(points));
  } catch (const MeshError& error) {
    throw ShapeError(fmt::format("shape bounds no solid ({}), a larger or rounder one is needed",
                                 describe_defects(error)));
  } catch (const std::invalid_argument& error) {
    throw ShapeError(
        fmt::format("shape cannot be built ({}), a solid of finite size is needed", error.what()));
  }
}

Polyhedron translated(const Polyhedron& shape, const Vector3& shift) {
  std::vector<Vector3> points = shape.mesh().points;
  for (Vector3& point : points) point += shift;
  require_coordinates(points);
  try {
    return shape.with_points(std::move(points));
  } catch (const std::invalid_argument& error) {
    throw ShapeError(
        fmt::format("shape cannot be placed ({}), a solid of finite size is needed", error.what()));
  }
}

const char* shape_key(const SceneShape& shape) {
  constexpr std::array<const char*, 6> keys = {"", "box", "mesh", "hull", "sphere", ""};
  return keys[shape.index()];
}

// Place of the name of the mesh's file, which may come from an argument, or of the key of any other shape.
Place shape_place(const Scene& scene, std::size_t index) {
  const SceneShape& shape = scene.block[index].shape;
  const std::string key = fmt::format("block.{}.{}", index, shape_key(shape));
  return std::holds_alternative<SceneMesh>(shape) ? scene.places.value(key + ".file") : scene.places.key(key);
}

}  // namespace

double resolution_of(const std::vector<Vector3>& points) {
  const double largest = largest_coordinate_of(points);
  return std::isfinite(largest) ? resolution_share * largest : 0.0;
}

double resolution_of(const SceneBlock& block, const Polyhedron& placed) {
  const bool rounded =
      std::holds_alternative<SceneHull>(block.shape) || std::holds_alternative<SceneMesh>(block.shape);
  return resolution_about(placed.mesh().points, rounded ? block.shape_origin : Vector3(Vector3::Zero()));
}

std::vector<std::optional<Polyhedron>> build_solids(const Scene& scene, Diagnostics& diagnostics,
                                                    std::vector<std::shared_ptr<const Polyhedron>>* shapes,
                                                    Preparation* preparation) {
  std::vector<std::optional<Polyhedron>> solids(scene.block.size());
  if (shapes != nullptr) shapes->assign(scene.block.size(), nullptr);
  const nlohmann::ordered_json json = blocks_to_json(scene.block);
  std::map<std::string, std::shared_ptr<const Polyhedron>> built;  // by the description of the shape in the
                                                                   // scene
  for (std::size_t i = 0; i < scene.block.size(); ++i) {
    const SceneBlock& block = scene.block[i];
    if (std::holds_alternative<std::monostate>(block.shape)) continue;
    if (preparation != nullptr)
      preparation->phase(fmt::format("solid of block {} ({} of {})", block.name, i + 1, scene.block.size()));
    if (const auto* piece = std::get_if<ScenePiece>(&block.shape)) {
      solids[i].emplace(*piece->solid);
      if (shapes != nullptr) (*shapes)[i] = piece->solid;
      continue;
    }
    const auto& keys = json.at(i);
    const std::string said = shape_key(block.shape) + keys.at(shape_key(block.shape)).dump() +
                             (keys.contains("rotate") ? keys.at("rotate").dump() : "") +
                             (block.shape_origin.isZero(0.0) ? "" : to_json(block.shape_origin).dump());
    try {
      auto& shape = built[said];
      if (!shape) shape = std::make_shared<const Polyhedron>(build_shape(scene, block));
      solids[i].emplace(translated(*shape, block.translate));
      if (shapes != nullptr) (*shapes)[i] = shape;
    } catch (const ShapeError& error) {
      diagnostics.error(shape_place(scene, i), error.what());
    }
  }
  return solids;
}

}  // namespace ashlar
