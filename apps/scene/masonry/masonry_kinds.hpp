// [[masonry]] as written: walls, arches, columns and domes. Positions are the user's.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/scene_block.hpp"

namespace ashlar {

/// Keys of all kinds.
struct SceneMasonry {
  enum class Kind { wall, arch, column, dome };
  SceneBlock block;          ///< name, material and order of every piece
  std::optional<Kind> kind;  ///< empty: faulty
};

/// A piece that spans the opening above it.
struct SceneLintel {
  double height = 0.0;   ///< m, > 0
  double bearing = 0.0;  ///< m, > 0, on the wall at each end
};

struct SceneOpening {
  SceneBox box;  ///< m, in the axes of the wall: along, across, up
  std::optional<SceneLintel> lintel;
};

struct SceneWall {
  enum class Bond { running, stack, header };
  Vector3 origin = Vector3::Zero();      ///< m, lower corner, where courses begin
  Vector3 direction = Vector3::UnitX();  ///< of courses, level
  double length = 0.0;                   ///< m, > 0
  double height = 0.0;                   ///< m, > 0
  Vector3 brick = Vector3::Zero();       ///< m, > 0: length, thickness, height, joints included
  Bond bond = Bond::running;
  std::optional<double> thickness;  ///< m, > 0; empty: one brick
  std::vector<SceneOpening> openings;
};

/// Soil or rubble on an arch.
struct SceneFill {
  double top = 0.0;     ///< m, z of its level
  double weight = 0.0;  ///< N/m^3, > 0
};

struct SceneArch {
  Vector3 center = Vector3::Zero();      ///< m, of its curve, in the middle of its width
  Vector3 direction = Vector3::UnitX();  ///< of its span, level
  double radius = 0.0;                   ///< m, mean
  double thickness = 0.0;                ///< m, < 2 radius
  double width = 0.0;                    ///< m
  double from = 0.0;                     ///< deg
  double to = 180.0;                     ///< deg
  int voussoirs = 0;
  std::optional<SceneFill> fill;
};

struct SceneColumn {
  Vector3 center = Vector3::Zero();  ///< m, of its foot
  double radius = 0.0;               ///< m, of the corners
  std::optional<double> top_radius;  ///< m; empty: radius
  double height = 0.0;               ///< m
  int sides = 24;
  int drums = 0;
};

struct SceneDome {
  Vector3 center = Vector3::Zero();  ///< m, of the sphere
  double radius = 0.0;               ///< m, mean
  double thickness = 0.0;            ///< m, < 2 radius
  double from = 0.0;                 ///< deg, elevation
  double to = 80.0;                  ///< deg
  int courses = 0;
  int voussoirs = 0;  ///< of each course
  bool keystone = true;
};

}  // namespace ashlar
