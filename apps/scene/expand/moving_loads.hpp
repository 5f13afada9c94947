// A force that moves ([[load]]) becomes forces at points of blocks, each with a history.
//
// The path is divided at its own places and so that points are at most `spacing` apart. Where the line through a point
// along the force first enters one of the blocks, seen against the force, is its place of action: the path may lie above
// the blocks. While the force moves from one point to the next its share passes linearly from the first to the second,
// so that both together have its resultant and, on a straight part of one plane face, its moment too. Before the first
// time of the path it stands at the first point, after the last at the last one. Points beside all blocks have none, nor
// have those on blocks that never move.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Most points of one path.
inline constexpr double most_path_points = 1e4;

/// A point of a divided path.
struct PathPoint {
  double time;    ///< s
  Vector3 place;  ///< m
};

/// Points of a path, its own places among them, equal times and places between. @param spacing m, > 0, largest distance
[[nodiscard]] std::vector<PathPoint> divided_path(const std::vector<SceneMovingLoad::Stop>& path,
                                                  double spacing);

/// Length of a path, m.
[[nodiscard]] double length_of(const std::vector<SceneMovingLoad::Stop>& path);

/// Adds the forces to the blocks of a scene, with the place of their [[load]]. Without any nothing is done.
/// @param solids placed, one per block
/// @param diagnostics reports a path that leads over no block, one of too many points, and a name that matches no block
void lay_moving_loads(Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                      Diagnostics& diagnostics);

}  // namespace ashlar
