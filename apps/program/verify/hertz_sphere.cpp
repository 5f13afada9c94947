#include "apps/program/verify/hertz_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/program/verify/verification_contacts.hpp"
#include "solver/accuracy/goal_error.hpp"

namespace ashlar {
namespace {

struct Cell {
  Vector3 low;
  Vector3 high;
  int order;
  int facets;  ///< along its sides
};

/// Height of the lower half of the sphere over the plane.
double height(double radius, double x, double y) {
  return radius - std::sqrt(radius * radius - x * x - y * y);
}

/// Boxes [0, R]^3 in shells of seven about the origin, if at least partly inside the sphere.
std::vector<Cell> cells_of(const HertzSphere& sphere) {
  std::vector<Cell> cells;
  const auto add = [&](const Vector3& low, const Vector3& high, int order, int facets) {
    if (low.head<2>().norm() < sphere.radius && height(sphere.radius, low.x(), low.y()) < high.z())
      cells.push_back({low, high, order, facets});
  };
  constexpr int coarse = 3;
  const double ratio = std::pow(sphere.radius / sphere.inner_size, 1.0 / sphere.shells);
  add(Vector3::Zero(), Vector3::Constant(sphere.inner_size), sphere.inner_order, sphere.facets);
  double inner = sphere.inner_size;
  for (int shell = 1; shell <= sphere.shells; ++shell) {
    const double outer = shell == sphere.shells ? sphere.radius : inner * ratio;
    for (int part = 1; part < 8; ++part) {
      Vector3 low = Vector3::Zero(), high = Vector3::Constant(inner);
      for (int axis = 0; axis < 3; ++axis) {
        if ((part >> axis & 1) == 0) continue;
        low[axis] = inner;
        high[axis] = outer;
      }
      // Beyond the first shell only the blocks below and beside the contact are affected by it.
      const bool is_near = low.norm() < 2.2 * sphere.inner_size;
      add(low, high, is_near ? sphere.near_order : sphere.far_order, coarse);
    }
    inner = outer;
  }
  return cells;
}

/// The part of a box inside the sphere, as the hull of its corners and of points on the sphere and on the circles
/// where the box's faces intersect it.
Polyhedron cut_to_sphere(const Cell& cell, double radius) {
  std::vector<Vector3> points;
  const auto add = [&](const Vector3& point) {
    if ((point.array() >= cell.low.array()).all() && (point.array() <= cell.high.array()).all())
      points.push_back(point);
  };
  for (int corner = 0; corner < 8; ++corner) {
    Vector3 point = cell.low;
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) == 1) point[axis] = cell.high[axis];
    }
    if ((point - Vector3(0, 0, radius)).norm() < radius) points.push_back(point);
  }
  const auto line = [&](int axis, int k) {
    if (k == cell.facets) return cell.high[axis];
    return cell.low[axis] + k * (cell.high[axis] - cell.low[axis]) / cell.facets;
  };
  for (int i = 0; i <= cell.facets; ++i) {
    for (int j = 0; j <= cell.facets; ++j) {
      const double x = line(0, i), y = line(1, j);
      if (x * x + y * y < radius * radius) add({x, y, height(radius, x, y)});
    }
  }
  for (const double z : {cell.low.z(), cell.high.z()}) {
    const double squared = radius * radius - (radius - z) * (radius - z);
    for (int k = 0; k <= cell.facets; ++k) {
      const double x = line(0, k), y = line(1, k);
      if (x * x <= squared) add({x, std::sqrt(squared - x * x), z});
      if (y * y <= squared) add({std::sqrt(squared - y * y), y, z});
    }
  }
  return hull_of(points);
}

/// Area of the faces of a solid in a plane, m^2.
double area_in(const Polyhedron& solid, const Plane& plane) {
  const SurfaceRule rule = surface_rule(solid, faces_in_plane(solid, plane), 1);
  double area = 0.0;
  for (const double weight : rule.weights) area += weight;
  return area;
}

}  // namespace

Simulation sphere_on_plane(const HertzSphere& sphere) {
  const Plane equator{{0, 0, sphere.radius}, Vector3::UnitZ()};
  std::vector<BlockDefinition> blocks;
  double loaded = 0.0;
  for (const Cell& cell : cells_of(sphere)) {
    blocks.push_back(define_block(cut_to_sphere(cell, sphere.radius),
                                  {2700, sphere.young_modulus, sphere.poisson_ratio}, cell.order));
    loaded += area_in(*blocks.back().solid, equator);
  }
  ContactScene scene;
  scene.settings.gravity.setZero();
  scene.settings.search.subdivisions = 0;
  scene.settings.area_springs = sphere.area_springs;
  scene.settings.curved_surface = sphere.curved_surface;
  scene.settings.contact_distance = 0.5 * sphere.approach();
  // The references are accurate to a few per cent.
  scene.settings.statics.tolerance = 1e-6;
  scene.settings.statics.residual_tolerance = 1e-9;
  const double share = sphere.inner_size / (sphere.facets + 1);
  *scene.law = {sphere.area_springs ? sphere.stiffness : sphere.stiffness * share * share,
                0.0,
                0.0,
                0.0,
                0.0,
                sphere.area_springs};
  for (BlockDefinition& block : blocks) {
    for (const auto& [axis, held] :
         {std::pair{0, std::array{true, false, false}}, {1, {false, true, false}}}) {
      const Plane side{Vector3::Zero(), Vector3::Unit(axis)};
      if (!faces_in_plane(*block.solid, side).empty()) block.supports.push_back({side, held});
    }
    if (!faces_in_plane(*block.solid, equator).empty())
      block.loads.push_back({equator, true, {0, 0, -0.25 * sphere.force / loaded}, {}});
    scene.add(std::move(block));
  }
  const double wide = 1.5 * sphere.radius;
  scene.add_fixed(Polyhedron(make_box({-wide, -wide, -wide}, {wide, wide, 0})));
  scene.tie_all();
  Simulation simulation = scene.build();
  return simulation;
}

double approach_of(const Simulation& simulation, const HertzSphere& sphere) {
  const Vector3 center(0, 0, sphere.radius);
  double approach = 0.0;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    const auto& corners = block.solid().mesh().points;
    if (!block.fixed() && std::find(corners.begin(), corners.end(), center) != corners.end())
      approach = -block.motion_of(simulation.states()[k], center).displacement.z();
  }
  return approach;
}

double HertzSphere::contact_radius() const {
  const double modulus = young_modulus / (1.0 - poisson_ratio * poisson_ratio);
  return std::cbrt(0.75 * force * radius / modulus);
}

double HertzSphere::approach() const {
  return contact_radius() * contact_radius() / radius;
}

double HertzSphere::peak_pressure() const {
  return 1.5 * force / (std::numbers::pi * contact_radius() * contact_radius());
}

HertzContact press(const HertzSphere& sphere) {
  Simulation simulation = sphere_on_plane(sphere);
  HertzContact contact;
  contact.unknowns = simulation.unknowns();
  contact.equilibrium = find_equilibrium(simulation) == StaticStatus::equilibrium;
  constexpr double quarters = 4.0;
  const double third = sphere.contact_radius() / 3.0;
  double area = 0.0, within = 0.0;
  for (const PairRecord& record : simulation.contacts()) {
    for (std::size_t k = 0; k < record.points.size(); ++k) {
      const double pressed = quarters * record.responses[k].force[0];
      if (pressed <= 0.0) continue;
      contact.force += pressed;
      area += quarters * record.points[k].area;
      if (record.points[k].place_a.head<2>().norm() < third) within += pressed;
    }
  }
  contact.radius = std::sqrt(area / std::numbers::pi);
  // The integral of p over r < a/3 is F (1 - (1 - 1/9)^(3/2)).
  const double share = 1.0 - std::pow(1.0 - 1.0 / 9.0, 1.5);
  contact.peak_pressure = sphere.peak_pressure() * within / (sphere.force * share);
  contact.approach = approach_of(simulation, sphere);
  if (sphere.estimates && contact.equilibrium) {
    const std::vector<GoalError> errors = goal_errors(simulation, [&](const Simulation& now) {
      return std::vector<Goal>{{"approach", {approach_of(now, sphere)}}};
    });
    contact.approach_error = errors.empty() ? std::nan("") : errors[0].relative;
  }
  return contact;
}

}  // namespace ashlar
