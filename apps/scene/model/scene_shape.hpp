// Shape and rotation of a block of a scene (scene.hpp).
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// box = { min, max }
struct SceneBox {
  Vector3 min = Vector3::Zero();  ///< m, less than max in every component
  Vector3 max = Vector3::Zero();  ///< m
};

/// mesh = { file, scale, split, group, weld, close_below, flip, repair }
struct SceneMesh {
  enum class Split {
    none,        ///< "none": the file is one block
    components,  ///< "components": each closed surface is a block
    groups,      ///< "groups": each object or group of an OBJ file is a block, each physical group of an MSH
                 ///< file
    tetrahedra,  ///< "tetrahedra": each of an MSH file is a block
  };
  enum class Flip {
    automatic,  ///< "auto": inverted surfaces are flipped
    always,     ///< true: all surfaces are flipped
    never,      ///< false
  };
  std::filesystem::path file;  ///< as written; relative paths are relative to the scene file's folder
  double scale = 1.0;          ///< > 0
  Split split = Split::none;
  std::string group;  ///< of an MSH file: the only physical group that is read, by name or number; empty: all
  double weld = 0.0;  ///< m, >= 0: closer corners are merged
  std::optional<double> close_below;  ///< m, before rotate: z of the bottom of a body below an open surface
  Flip flip = Flip::never;
  bool repair = false;  ///< true: holes are filled and other defects repaired (surface_repair.hpp)
  /// Part of a split file for a block, in the file's units, and its 1-based number there.
  std::shared_ptr<const TriangleMesh> stone;
  int number = 0;
};

/// hull = { points }
struct SceneHull {
  std::vector<Vector3> points;  ///< m, at least 4, not coplanar
};

/// sphere = { center, radius, subdivisions }
struct SceneSphere {
  Vector3 center = Vector3::Zero();  ///< m
  double radius = 0.0;               ///< m, > 0; required
  int subdivisions = 3;              ///< 0 to 7
};

/// A piece of a block cut by a [[cut]], already placed. It cannot be given in a scene.
struct ScenePiece {
  std::shared_ptr<const Polyhedron> solid;
};

/// Empty (monostate) only if the scene has a fault there.
using SceneShape = std::variant<std::monostate, SceneBox, SceneMesh, SceneHull, SceneSphere, ScenePiece>;

/// rotate = { axis, angle, about }
struct SceneRotation {
  Vector3 axis = Vector3::UnitZ();  ///< not zero, any length
  double angle = 0.0;               ///< deg, right-handed about axis
  Vector3 about = Vector3::Zero();  ///< m
};

}  // namespace ashlar
