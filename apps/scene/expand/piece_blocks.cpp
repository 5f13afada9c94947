#include "apps/scene/expand/piece_blocks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <limits>

#include "geometry/any_solid/closest_point.hpp"
#include "geometry/boxes/box.hpp"
#include "mechanics/basis/moments.hpp"
#include "mechanics/supports/face_selection.hpp"

namespace ashlar {
namespace {

using Pieces = std::vector<std::shared_ptr<const Polyhedron>>;

double area_in_plane(const Polyhedron& solid, const ScenePlane& plane) {
  double sum = 0.0;
  for (const int face : faces_in_plane(solid, {plane.point, plane.normal})) {
    for (const int t : solid.faces()[static_cast<std::size_t>(face)].triangles) {
      const auto& [a, b, c] = solid.mesh().triangles[static_cast<std::size_t>(t)];
      const auto point = [&](int k) { return solid.mesh().points[static_cast<std::size_t>(k)]; };
      sum += 0.5 * (point(b) - point(a)).cross(point(c) - point(a)).norm();
    }
  }
  return sum;
}

/// By piece, its share of a support or load at a place: all or nothing, except for a force on a plane.
std::vector<double> shares_of(const Pieces& pieces, const std::variant<ScenePlane, Vector3>& where) {
  std::vector<double> shares(pieces.size(), 0.0);
  if (const Vector3* point = std::get_if<Vector3>(&where)) {
    if (point->allFinite()) shares[piece_at(pieces, *point)] = 1.0;
    return shares;
  }
  const ScenePlane& plane = std::get<ScenePlane>(where);
  if (!plane.point.allFinite() || !plane.normal.allFinite()) return shares;
  double sum = 0.0;
  for (std::size_t k = 0; k < pieces.size(); ++k) sum += shares[k] = area_in_plane(*pieces[k], plane);
  if (sum > 0.0)
    for (double& share : shares) share /= sum;
  return shares;
}

/// Rotation about the centroid of the whole moves the centroid of a piece.
void set_velocity(const Pieces& pieces, const SceneBlock& whole, std::vector<PieceBlock>& blocks) {
  if (whole.angular_velocity.isZero(0.0)) return;
  std::vector<Vector3> centroids;
  Vector3 sum = Vector3::Zero();
  double volume = 0.0;
  for (const auto& piece : pieces) {
    centroids.push_back(centroid_of(*piece));
    sum += piece->volume() * centroids.back();
    volume += piece->volume();
  }
  for (std::size_t k = 0; k < pieces.size(); ++k)
    blocks[k].block.velocity += whole.angular_velocity.cross(centroids[k] - sum / volume);
}

}  // namespace

Vector3 centroid_of(const Polyhedron& solid) {
  return centroid_of(solid.mesh());
}

Vector3 centroid_of(const TriangleMesh& mesh) {
  const std::vector<double> m = moments(mesh, 1);
  const auto exponents = monomial_exponents(1);
  Vector3 centroid = Vector3::Zero();
  for (std::size_t k = 1; k < 4; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (exponents[k][axis] == 1) centroid[static_cast<Eigen::Index>(axis)] = m[k] / m[0];
  return centroid;
}

std::size_t piece_at(const Pieces& pieces, const Vector3& point) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Box box = box_of(pieces[k]->mesh().points);
    const double to_box = (box.low - point).cwiseMax(point - box.high).cwiseMax(0.0).squaredNorm();
    if (to_box >= least) continue;
    const ClosestPoint found = ClosestPointFinder(*pieces[k]).find_any(point);
    if (found.place != PointPlace::outside) return k;
    if (found.squared_distance >= least) continue;
    least = found.squared_distance;
    nearest = k;
  }
  return nearest;
}

void share_supports(const Scene& scene, const SceneBlock& whole, const std::string& path,
                    const Pieces& pieces, std::vector<PieceBlock>& blocks, Diagnostics& diagnostics) {
  for (PieceBlock& piece : blocks) {
    piece.block.fix.clear();
    piece.block.load.clear();
  }
  const auto missing = [&](const char* table, std::size_t j) {
    diagnostics.error(
        scene.places.value(fmt::format("{}.{}.{}.plane", path, table, j)),
        fmt::format("no piece of block \"{}\" has a face in the plane, a plane of the block before it is "
                    "cut, or of a cut, is needed",
                    whole.name));
  };
  const auto give = [&](const auto& where, const char* table, std::size_t j, auto receive) {
    bool any = false;
    const std::vector<double> shares = shares_of(pieces, where);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (shares[k] <= 0.0) continue;
      any = true;
      receive(blocks[k], shares[k]);
    }
    if (!any && std::holds_alternative<ScenePlane>(where)) missing(table, j);
  };
  for (std::size_t j = 0; j < whole.fix.size(); ++j) {
    give(whole.fix[j].where, "fix", j, [&](PieceBlock& piece, double) {
      piece.block.fix.push_back(whole.fix[j]);
      piece.fix.push_back(j);
    });
  }
  for (std::size_t j = 0; j < whole.load.size(); ++j) {
    give(whole.load[j].where, "load", j, [&](PieceBlock& piece, double share) {
      SceneLoad load = whole.load[j];
      if (load.kind == SceneLoad::Kind::force) load.vector *= share;
      piece.block.load.push_back(std::move(load));
      piece.load.push_back(j);
    });
  }
}

void move_measures(Scene& scene, const std::string& block, const Pieces& pieces,
                   const std::vector<std::string>& names) {
  for (SceneMeasure& measure : scene.measure)
    if (measure.block == block && measure.point && measure.point->allFinite())
      measure.block = names[piece_at(pieces, *measure.point)];
}

std::vector<PieceBlock> make_piece_blocks(const Scene& scene, std::size_t index, const Pieces& pieces,
                                          const std::vector<std::string>& names, Diagnostics& diagnostics) {
  const SceneBlock& whole = scene.block[index];
  std::vector<PieceBlock> blocks(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    SceneBlock& block = blocks[k].block;
    block = whole;
    block.name = names[k];
    block.shape = ScenePiece{pieces[k]};
    block.rotate.reset();
    block.translate.setZero();
  }
  share_supports(scene, whole, fmt::format("block.{}", index), pieces, blocks, diagnostics);
  set_velocity(pieces, whole, blocks);
  return blocks;
}

}  // namespace ashlar
