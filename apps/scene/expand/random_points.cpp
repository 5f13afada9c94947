#include "apps/scene/expand/random_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "apps/scene/expand/joint_planes.hpp"
#include "geometry/boxes/box.hpp"

namespace ashlar {
namespace {

/// A tetrahedron by three edges from the common corner.
using Edges = std::array<Vector3, 3>;

/// A place in a tetrahedron: sorted random numbers divide the unit interval into four weights of its corners.
Vector3 draw_place(const Vector3& apex, const Edges& edges, std::mt19937_64& random) {
  std::array<double, 3> shares;
  for (double& share : shares) share = random_share(random);
  std::sort(shares.begin(), shares.end());
  return apex +
         (shares[0] * edges[0] + (shares[1] - shares[0]) * edges[1] + (shares[2] - shares[1]) * edges[2]);
}

}  // namespace

std::vector<Vector3> random_points(const Polyhedron& solid, int count, std::mt19937_64& random) {
  const TriangleMesh& mesh = solid.mesh();
  const auto corner = [&](int point) { return mesh.points[static_cast<std::size_t>(point)]; };
  const Vector3 apex = corner(mesh.triangles.front().front());
  const Box box = box_of(mesh.points);
  // Volumes are relative to the cube of the box's longest side, so that they stay in the range of double precision.
  const double side = (box.high - box.low).maxCoeff();
  std::vector<Edges> tetrahedra;
  std::vector<double> volume_up_to;
  double volume = 0.0;
  for (const auto& triangle : mesh.triangles) {
    Edges edges;
    for (std::size_t k = 0; k < 3; ++k) edges[k] = corner(triangle[k]) - apex;
    const double here = (edges[0] / side).cross(edges[1] / side).dot(edges[2] / side);
    if (!(here > 0.0)) continue;
    tetrahedra.push_back(edges);
    volume_up_to.push_back(volume += here);
  }
  std::vector<Vector3> points;
  while (!tetrahedra.empty() && points.size() < static_cast<std::size_t>(count)) {
    const auto drawn =
        std::upper_bound(volume_up_to.begin(), volume_up_to.end() - 1, random_share(random) * volume);
    points.push_back(
        draw_place(apex, tetrahedra[static_cast<std::size_t>(drawn - volume_up_to.begin())], random));
  }
  return points;
}

}  // namespace ashlar
