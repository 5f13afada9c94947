// Scenes of blocks whose limits are known by hand.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sample_statics.hpp"
#include "solver/limit/limit_analysis.hpp"

namespace ashlar::test_support {

inline constexpr double g = 9.81;

inline double tangent_of(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

inline JointLaw joint(double friction, double cohesion = 0.0, double dilation = 0.0) {
  JointLaw law{1e10, 1e10, friction, cohesion, 0.0, true};
  law.dilation = dilation;
  return law;
}

/// Blocks that a test turns, scales and orders as it likes.
struct LimitScene {
  std::vector<BlockDefinition> blocks;
  JointLaw law = joint(0.5);
  Vector3 gravity{0.0, 0.0, -g};
  std::vector<TieRequest> ties;
  double contact_distance = 1e-3;  ///< m

  int add(const std::string& name, Polyhedron solid, int order = 0) {
    blocks.push_back(block_of(name, std::move(solid), rock, order));
    return static_cast<int>(blocks.size()) - 1;
  }
  void add_fixed(Polyhedron solid) { blocks.push_back(fixed_block(std::move(solid))); }

  [[nodiscard]] LimitScene turned(const Eigen::AngleAxisd& turn) const {
    LimitScene scene = *this;
    scene.gravity = turn * gravity;
    for (BlockDefinition& block : scene.blocks) {
      block.solid = std::make_shared<const Polyhedron>(test_support::turned(*block.solid, turn));
      for (Load& load : block.loads) {
        load.where = Vector3(turn * std::get<Vector3>(load.where));
        load.vector = turn * load.vector;
      }
    }
    return scene;
  }
  [[nodiscard]] LimitScene scaled(double by) const {
    LimitScene scene = *this;
    scene.contact_distance *= by;
    for (BlockDefinition& block : scene.blocks) {
      std::vector<Vector3> points;
      for (const Vector3& point : block.solid->mesh().points) points.emplace_back(by * point);
      block.solid = std::make_shared<const Polyhedron>(block.solid->with_points(std::move(points)));
    }
    return scene;
  }
  /// @param order the block that comes k-th is order[k]
  [[nodiscard]] LimitScene reordered(const std::vector<std::size_t>& order) const {
    LimitScene scene = *this;
    for (std::size_t k = 0; k < order.size(); ++k) scene.blocks[k] = blocks[order[k]];
    return scene;
  }

  [[nodiscard]] Simulation build() const {
    std::vector<BlockModel> models;
    for (const BlockDefinition& block : blocks) models.emplace_back(block);
    SimulationSettings settings;
    settings.gravity = gravity;
    settings.contact_distance = contact_distance;
    return Simulation(std::move(models), std::vector<InitialMotion>(blocks.size()), same_law(law), settings,
                      ties);
  }
  /// @param multiplied by block
  [[nodiscard]] LimitAnalysis analysis(const std::vector<bool>& multiplied = {}) const {
    return LimitAnalysis(
        build().rigid_model(1.0, multiplied), [](int, int) { return true; }, 1);
  }
  [[nodiscard]] LimitAnswer safety(double tolerance = 1e-3) const {
    return analysis().strength_factor({0.1, 10.0, tolerance}, [] { return true; });
  }
};

/// A flat block on a slope of some degrees.
inline LimitScene on_slope(double incline, const JointLaw& law, int order) {
  LimitScene scene;
  scene.law = law;
  scene.add("A", tilted_box({-1, -0.5, 0}, {1, 0.5, 0.5}, incline), order);
  scene.add_fixed(tilted_box({-6, -2, -1}, {6, 2, 0}, incline));
  return scene;
}

/// A prism in a groove of two planes of 45 degrees that dips.
inline LimitScene groove(double dip, double friction) {
  LimitScene scene;
  scene.law = joint(friction);
  const auto prism = [&](const std::vector<std::array<double, 2>>& outline, double from, double to) {
    std::vector<Vector3> points;
    for (const auto& [y, z] : outline)
      for (const double x : {from, to}) points.emplace_back(x, y, z);
    return turned(Polyhedron(make_convex_hull(points)),
                  Eigen::AngleAxisd(dip * std::numbers::pi / 180.0, Vector3::UnitY()));
  };
  scene.add_fixed(prism({{0, 0}, {3, 3}, {3, -1}, {0, -1}}, -4, 4));
  scene.add_fixed(prism({{0, 0}, {-3, 3}, {-3, -1}, {0, -1}}, -4, 4));
  scene.add("wedge", prism({{0, 0}, {1, 1}, {-1, 1}}, -1, 1));
  return scene;
}

/// A stone on a plane of 45 degrees below a roof that stands by
/// itself on a pedestal and touches it from above.
inline LimitScene leaning_roof(double friction, double dilation) {
  const auto prism = [](const std::vector<std::array<double, 2>>& outline) {
    std::vector<Vector3> points;
    for (const auto& [x, z] : outline)
      for (const double y : {0.0, 1.0}) points.emplace_back(x, y, z);
    return Polyhedron(make_convex_hull(points));
  };
  LimitScene scene;
  scene.law = joint(friction, 0.0, dilation);
  const double end = -0.36397023426620234, corner = -0.47316130454606303;
  scene.add_fixed(prism({{-1, 1}, {-1, -3}, {2, -3}, {2, -2}}));
  scene.add_fixed(Polyhedron(make_box({1.3, 0, corner - 0.3}, {6, 1, corner})));
  scene.add("stone", prism({{0, 0}, {1, -1}, {1, end}}));
  scene.add("roof", prism({{0, 0}, {1.3, corner}, {6, corner}, {6, 1.5}, {0, 1.5}}));
  return scene;
}

}  // namespace ashlar::test_support
