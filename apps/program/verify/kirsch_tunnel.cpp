#include "apps/program/verify/kirsch_tunnel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ashlar {
namespace {

constexpr double thickness = 1.0;  // m, along the tunnel

/// Polar coordinates about the tunnel's axis.
struct Polar {
  explicit Polar(const Vector3& place)
      : r(std::hypot(place.x(), place.z())),
        angle(std::atan2(place.z(), place.x())),
        out(place.x() / r, 0.0, place.z() / r),
        around(-out.z(), 0.0, out.x()) {}

  double r, angle;
  Vector3 out, around;
};

/// The solid between two polylines from the first to the last ray, in x and z, over the thickness.
Polyhedron sector_solid(const std::vector<Vector3>& inner, const std::vector<Vector3>& outer) {
  std::vector<Vector3> outline = inner;
  outline.insert(outline.end(), outer.rbegin(), outer.rend());
  const auto count = static_cast<int>(outline.size());
  TriangleMesh mesh;
  for (const double y : {0.0, thickness})
    for (const Vector3& point : outline) mesh.points.emplace_back(point.x(), y, point.z());
  const auto add = [&](int a, int b, int c) { mesh.triangles.push_back({a, c, b}); };
  for (int k = 0; k < count; ++k) {
    const int next = (k + 1) % count;
    add(k, next + count, next);
    add(k, k + count, next + count);
  }
  // Strips between both polylines: those with one segment more end in a fan.
  const auto of_inner = static_cast<int>(inner.size()), of_outer = static_cast<int>(outer.size());
  const auto outside = [&](int k) { return count - 1 - k; };
  int i = 0, o = 0;
  while (i + 1 < of_inner || o + 1 < of_outer) {
    const bool along_inner =
        o + 1 == of_outer || (i + 1 < of_inner && (i + 1) * (of_outer - 1) <= (o + 1) * (of_inner - 1));
    const int third = along_inner ? i + 1 : outside(o + 1);
    add(i, third, outside(o));
    add(i + count, outside(o) + count, third + count);
    (along_inner ? i : o) += 1;
  }
  return Polyhedron(std::move(mesh));
}

/// Places at a ray's angle: on the wall, two circles, and the square.
Vector3 place_on(const KirschTunnel& tunnel, std::size_t ring, double angle) {
  const Vector3 radial(std::cos(angle), 0.0, std::sin(angle));
  constexpr std::array circles = {1.0, 1.4, 2.1};
  if (ring < circles.size()) return circles[ring] * tunnel.radius * radial;
  return tunnel.half_width / std::max(radial.x(), radial.z()) * radial;
}

std::vector<Vector3> polyline(const KirschTunnel& tunnel, const TunnelMesh& mesh, std::size_t ring,
                              int sector) {
  constexpr std::size_t square = 3;
  const int facets = ring == square ? 1 : mesh.facets;
  std::vector<Vector3> points;
  for (int k = 0; k <= facets; ++k)
    points.push_back(
        place_on(tunnel, ring, 0.5 * std::numbers::pi * (sector * facets + k) / (mesh.sectors * facets)));
  // Exactly on the planes of symmetry.
  if (sector == 0) points.front().z() = 0.0;
  if (sector + 1 == mesh.sectors) points.back().x() = 0.0;
  return points;
}

BlockDefinition sector_block(const KirschTunnel& tunnel, const TunnelMesh& mesh, std::size_t ring,
                             int sector) {
  BlockDefinition block = define_block(
      sector_solid(polyline(tunnel, mesh, ring, sector), polyline(tunnel, mesh, ring + 1, sector)),
      tunnel.rock, mesh.order);
  block.initial_stress = [stress = tunnel.initial_stress()](const Vector3&) { return stress; };
  const auto hold = [&](const Vector3& point, int axis) {
    BlockSupport support{Plane{point, Vector3::Unit(axis)}, {false, false, false}, {}};
    support.components[static_cast<std::size_t>(axis)] = true;
    block.supports.push_back(std::move(support));
  };
  hold(Vector3::Zero(), 1);
  hold(thickness * Vector3::UnitY(), 1);
  if (sector == 0) hold(Vector3::Zero(), 2);
  if (sector + 1 == mesh.sectors) hold(Vector3::Zero(), 0);
  if (ring == 2) {
    const Vector3 normal = 2 * sector < mesh.sectors ? Vector3::UnitX() : Vector3::UnitZ();
    Load load{.where = Plane{tunnel.half_width * normal, normal}, .history = {}};
    load.field = [tunnel, normal](const Vector3& place) { return Vector3(tunnel.stress(place) * normal); };
    block.loads.push_back(std::move(load));
  }
  return block;
}

}  // namespace

Eigen::Matrix3d KirschTunnel::initial_stress() const {
  const double vertical = -pressure, horizontal = ratio * vertical;
  return Vector3(horizontal, rock.poisson_ratio * (horizontal + vertical), vertical).asDiagonal();
}

Eigen::Matrix3d KirschTunnel::stress(const Vector3& place) const {
  const Polar at(place);
  const double q = std::pow(radius / at.r, 2), half = 0.5 * pressure;
  const double cosine = std::cos(2.0 * at.angle), sine = std::sin(2.0 * at.angle);
  const double s_r = half * ((1 + ratio) * (1 - q) - (1 - ratio) * (1 - 4 * q + 3 * q * q) * cosine);
  const double s_t = half * ((1 + ratio) * (1 + q) + (1 - ratio) * (1 + 3 * q * q) * cosine);
  const double s_rt = half * (1 - ratio) * (1 + 2 * q - 3 * q * q) * sine;
  const Eigen::Matrix3d mixed = at.out * at.around.transpose();
  Eigen::Matrix3d sum = -s_r * at.out * at.out.transpose() - s_t * at.around * at.around.transpose() -
                        s_rt * (mixed + mixed.transpose());
  sum(1, 1) = -rock.poisson_ratio * (s_r + s_t);
  return sum;
}

Vector3 KirschTunnel::displacement(const Vector3& place) const {
  const Polar at(place);
  const double q = std::pow(radius / at.r, 2), n = rock.poisson_ratio;
  const double size = -pressure * radius * radius * (1.0 + n) / (2.0 * rock.young_modulus * at.r);
  const double u_r = size * ((1 + ratio) - (1 - ratio) * (4 * (1 - n) - q) * std::cos(2.0 * at.angle));
  const double u_t = size * (1 - ratio) * (2 * (1 - 2 * n) + q) * std::sin(2.0 * at.angle);
  return u_r * at.out + u_t * at.around;
}

TunnelErrors errors_at_the_wall(const KirschTunnel& tunnel, const TunnelMesh& mesh) {
  ContactScene scene;
  choose_as_for_statics(scene, tunnel.radius, tunnel.rock.young_modulus, 0.5);
  scene.settings.gravity.setZero();
  for (std::size_t ring = 0; ring < 3; ++ring)
    for (int sector = 0; sector < mesh.sectors; ++sector) scene.add(sector_block(tunnel, mesh, ring, sector));
  scene.tie_all();
  Simulation simulation = scene.build();
  TunnelErrors errors;
  errors.equilibrium = find_equilibrium(simulation) == StaticStatus::equilibrium;
  const Vector3 crown(0.0, 0.0, tunnel.radius), side(tunnel.radius, 0.0, 0.0);
  for (int sector = 0; sector < mesh.sectors; ++sector) {
    const auto index = static_cast<std::size_t>(sector);
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double angle = 0.5 * std::numbers::pi * (sector + share) / mesh.sectors;
      const Vector3 place(tunnel.radius * std::cos(angle), 0.5 * thickness, tunnel.radius * std::sin(angle));
      const PointMotion motion = simulation.blocks()[index].motion_of(simulation.states()[index], place);
      const Vector3 around = Polar(place).around;
      errors.hoop_stress =
          std::max(errors.hoop_stress, std::abs(around.dot((motion.stress - tunnel.stress(place)) * around)));
      errors.displacement =
          std::max(errors.displacement, (motion.displacement - tunnel.displacement(place)).norm());
    }
  }
  errors.hoop_stress /= std::abs(tunnel.stress(side)(2, 2));
  errors.displacement /= tunnel.displacement(crown).norm();
  return errors;
}

}  // namespace ashlar
