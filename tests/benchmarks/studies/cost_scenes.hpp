// Scenes of many blocks for measurements of run time.
#pragma once

#include <string>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Text of a scene, block by block: rock of 1e10 Pa and 2600 kg/m^3 with a friction coefficient of 0.5 on a fixed
/// ground, steps of 1/240 s.
class SceneText {
 public:
  /// @param order of the blocks. @param analysis lines of its table besides end_time and time_step
  explicit SceneText(int order, const std::string& analysis = "");

  void add_box(const Vector3& low, const Vector3& high);
  /// Adds a cube of 1 m. @param x,y,z its lowest corner
  void add_cube(double x, double y, double z) { add_box({x, y, z}, {x + 1, y + 1, z + 1}); }
  /// Adds a hull of 20 corners on a sphere of 1 m. @param number selects the corners
  void add_hull(const Vector3& centre, int number);
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] int blocks() const { return blocks_; }

 private:
  void begin_block();

  std::string text_;
  int order_;
  int blocks_ = 0;
};

/// n x n separate cubes of order 1.
[[nodiscard]] SceneText floor_of(int n);
/// n courses of n bricks 1 x 0.5 x 0.5 m in running bond; odd courses end in half bricks.
[[nodiscard]] SceneText wall_of(int n);
/// The same without sleeping.
[[nodiscard]] SceneText waking_wall_of(int n);
/// The same without half bricks: the last one of the top course is barely supported on its edge and topples.
[[nodiscard]] SceneText loose_wall_of(int n);
/// n x n columns of n cubes that fall on each other. @param gap between those of a column, m
[[nodiscard]] SceneText pile_of(int n, double gap);
/// Layers of n x n, (n - 1) x (n - 1), ... cubes, each on four.
[[nodiscard]] SceneText pyramid_of(int n);
/// One cube.
[[nodiscard]] SceneText cube_of_order(int order);
/// n different separate hulls of 20 points.
[[nodiscard]] SceneText hulls_of(int n, int order);
/// 16 dominoes of 48 x 24 x 7.5 mm, 24 mm apart, of 2e11 Pa, the first with 4 rad/s; steps of 2.5e-4 s.
[[nodiscard]] std::string dominoes_text();

}  // namespace ashlar
