#include "solver/fracture/divided_block.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <variant>

#include "geometry/any_solid/closest_point.hpp"
#include "geometry/cutting/cut_solid.hpp"
#include "geometry/index.hpp"
#include "geometry/solid/mesh_defects.hpp"

namespace ashlar {
namespace {

/// Least and greatest distance of a solid above a plane, m.
std::pair<double, double> extent_of(const Polyhedron& solid, const Plane& plane) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const int corner : solid.corners()) {
    const double height = plane.normal.dot(solid.mesh().points[at(corner)] - plane.point);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return {low, high};
}

/// Resolution of coordinates relative to the largest one: 64 units in the last place. Less keeps slivers of rounding, more
/// joins corners.
constexpr double rounding_share = 0x1p-46;
/// Of the faces that a crack makes in the cutter.
constexpr int mark_of_crack = 0;
/// Parts are named a to z, then aa, ab, ...
constexpr std::size_t letters = 26;

/// Resolution of the coordinates of a solid, m: corners of cuts are rounded once.
double resolution_of(const Polyhedron& solid) {
  double largest = 0.0;
  for (const Vector3& point : solid.mesh().points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return rounding_share * largest;
}

double area_in(const Polyhedron& solid, const Plane& plane) {
  const SurfaceRule rule = surface_rule(solid, faces_in_plane(solid, plane), 0);
  return std::accumulate(rule.weights.begin(), rule.weights.end(), 0.0);
}

/// Number of the part nearest to a point.
std::size_t part_at(const DividedSolid& solids, const Vector3& point) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < solids.parts.size(); ++k) {
    const ClosestPoint closest = ClosestPointFinder(*solids.parts[k]).find_any(point);
    const double distance = closest.place == PointPlace::inside ? 0.0 : closest.squared_distance;
    if (distance < least) least = distance, nearest = k;
  }
  return nearest;
}

/// Share of each part in a support or load at a place: by area in a plane, all or nothing at a point.
std::vector<double> shares_of(const DividedSolid& solids, const BlockPlace& where) {
  std::vector<double> shares(solids.parts.size(), 0.0);
  if (const auto* point = std::get_if<Vector3>(&where)) {
    shares[part_at(solids, *point)] = 1.0;
    return shares;
  }
  const auto* plane = std::get_if<Plane>(&where);
  if (plane == nullptr) throw std::invalid_argument("faces by number do not fit the parts of a block");
  double sum = 0.0;
  for (std::size_t k = 0; k < shares.size(); ++k) sum += shares[k] = area_in(*solids.parts[k], *plane);
  if (!(sum > 0.0))
    throw std::invalid_argument("no part of a divided block has the faces of its support or load");
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace

std::optional<Plane> plane_with_room(const Polyhedron& solid, const Plane& plane, double least_size) {
  const auto [low, high] = extent_of(solid, plane);
  if (!(high - low >= 2.0 * least_size)) return std::nullopt;
  const double offset = std::clamp(0.0, low + least_size, high - least_size);
  return Plane{plane.point + offset * plane.normal, plane.normal};
}

std::optional<DividedSolid> divided_solid(const Polyhedron& solid, const Plane& plane, double least_size) {
  CutSolid cut(solid);
  cut.cut({plane.normal, plane.point}, mark_of_crack, [](int) { return true; });
  struct Piece {
    double middle;  ///< m, above the plane
    std::shared_ptr<const Polyhedron> solid;
  };
  std::vector<Piece> pieces;
  DividedSolid result;
  const double resolution = resolution_of(solid);
  for (const int piece : cut.pieces()) {
    for (const PieceFace& face : cut.faces(piece))
      if (face.mark == mark_of_crack && face.below) result.area += cut.area(face);
    try {
      pieces.push_back({0.0, std::make_shared<const Polyhedron>(cut.mesh(piece, resolution), resolution)});
    } catch (const MeshError&) {
      return std::nullopt;
    }
    const auto [low, high] = extent_of(*pieces.back().solid, plane);
    if (!(high - low >= 0.5 * least_size)) return std::nullopt;
    pieces.back().middle = low + high;
  }
  if (pieces.size() < 2) return std::nullopt;
  std::stable_partition(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.middle < 0.0; });
  for (Piece& piece : pieces) result.parts.push_back(std::move(piece.solid));
  return result;
}

std::string name_of_part(const std::string& block, int crack, std::size_t part) {
  std::string word;
  for (std::size_t rest = part + 1; rest > 0; rest = (rest - 1) / letters)
    word.insert(word.begin(), static_cast<char>('a' + (rest - 1) % letters));
  return block + ".crack" + std::to_string(crack) + "." + word;
}

std::vector<BlockPart> parts_of(const BlockDefinition& whole, const DividedSolid& solids,
                                const std::vector<std::string>& names) {
  std::vector<BlockDefinition> definitions(solids.parts.size(), whole);
  std::vector<std::vector<int>> loads(solids.parts.size());
  for (std::size_t k = 0; k < definitions.size(); ++k) {
    definitions[k].name = names.at(k);
    definitions[k].solid = solids.parts[k];
    definitions[k].shape = nullptr;
    definitions[k].supports.clear();
    definitions[k].loads.clear();
  }
  for (const BlockSupport& support : whole.supports) {
    const std::vector<double> shares = shares_of(solids, support.where);
    for (std::size_t k = 0; k < shares.size(); ++k)
      if (shares[k] > 0.0) definitions[k].supports.push_back(support);
  }
  for (std::size_t n = 0; n < whole.loads.size(); ++n) {
    const std::vector<double> shares = shares_of(solids, whole.loads[n].where);
    for (std::size_t k = 0; k < shares.size(); ++k) {
      if (!(shares[k] > 0.0)) continue;
      Load load = whole.loads[n];
      if (!load.traction) load.vector *= shares[k];
      definitions[k].loads.push_back(std::move(load));
      loads[k].push_back(static_cast<int>(n));
    }
  }
  std::vector<BlockPart> parts;
  for (std::size_t k = 0; k < definitions.size(); ++k)
    parts.push_back({BlockModel(definitions[k]), definitions[k], std::move(loads[k])});
  return parts;
}

Eigen::MatrixX3d field_of_part(const BlockModel& whole, const Eigen::MatrixX3d& field,
                               const BlockModel& part) {
  return re_expansion(whole.basis(), part.basis(), Vector3::Zero()) * field;
}

BlockState state_of_part(const BlockModel& whole, const BlockState& state, const BlockModel& part) {
  const Eigen::MatrixXd to_part = re_expansion(whole.basis(), part.basis(), Vector3::Zero());
  return {part.basis().identity_map() + to_part * (state.position - whole.basis().identity_map()),
          to_part * state.velocity};
}

}  // namespace ashlar
