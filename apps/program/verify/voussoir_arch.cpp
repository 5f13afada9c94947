#include "apps/program/verify/voussoir_arch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ashlar {

double VoussoirArch::add_to(ContactScene& scene, const Material& material,
                            const std::vector<int>& orders) const {
  const auto joint = [&](int k, std::vector<Vector3>& points) {
    const double angle = std::numbers::pi * k / count;
    for (const double radius : {inner_radius(), outer_radius()}) {
      for (const double y : {0.0, depth})
        points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
  };
  double size = 0.0;
  for (int k = 0; k < count; ++k) {
    std::vector<Vector3> points;
    joint(k, points);
    joint(k + 1, points);
    const int order = orders.empty() ? 1 : orders.at(static_cast<std::size_t>(k));
    BlockDefinition block = define_block(hull_of(points), material, order);
    if (k == 0) size = BlockModel(block).size();
    scene.add(std::move(block));
  }
  for (const double side : {-mean_radius, mean_radius})
    scene.add_fixed(Polyhedron(make_box({side - 2.0, -1.0, -2.0}, {side + 2.0, depth + 1.0, 0})));
  return size;
}

double VoussoirArch::least_friction() const {
  const double ri = inner_radius(), ro = outer_radius(), turn = std::numbers::pi / count;
  // A voussoir between the angles a and a + turn: a triangle of the radius ro less one of ri.
  const auto area = [&](double r) { return 0.5 * r * r * std::sin(turn); };
  const auto moment = [&](double r, double a) {
    return area(r) * r * (std::cos(a) + std::cos(a + turn)) / 3.0;
  };
  const double voussoir = area(ro) - area(ri);
  const double half = voussoir * count / 2.0;
  const auto needed = [&](double phi) {
    double thrust = 0.0, above = 0.0, moment_above = 0.0;
    for (int k = count / 2 - 1; k >= 0; --k) {
      const double a = turn * k;
      above += voussoir;
      moment_above += moment(ro, a) - moment(ri, a);
      thrust = std::max(thrust, (ri * above * std::cos(a) - moment_above) / (ro - ri * std::sin(a)));
      thrust = std::max(thrust, above * std::tan(a - phi));
    }
    return thrust;
  };
  double low = 0.0, high = std::numbers::pi / 4.0;
  for (int k = 0; k < 60; ++k) {
    const double phi = 0.5 * (low + high);
    (needed(phi) <= half * std::tan(phi) ? high : low) = phi;
  }
  return std::tan(high);
}

}  // namespace ashlar
