#include "geometry/subfaces/placed_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

constexpr int kept_bits = 70;
/// Fewer cells are looked at faster one after the other.
constexpr std::size_t few_cells = 256;

/// Rounds to multiples of unit = 2^k by adding a number whose last place is that.
double rounded(double value, double unit) {
  const double shift = 0x1.8p52 * unit;
  return std::abs(value) < 0x1p51 * unit ? (value + shift) - shift : value;
}

}  // namespace

/// Several searches may ask at a time.
struct PlacedSurface::CellTree {
  std::once_flag made;
  std::optional<BoxTree> tree;
};

Vector3 without_tiny_parts(const Vector3& vector) {
  const double largest = vector.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return vector;
  const double unit = std::ldexp(1.0, std::ilogb(largest) - kept_bits);
  return vector.unaryExpr([&](double value) { return rounded(value, unit); });
}

PlacedSurface::PlacedSurface(const SubFaceSurface& surface, std::vector<Vector3> points,
                             std::span<const CellShape> shapes)
    : surface_(&surface), points_(std::move(points)) {
  double largest = 0.0;
  for (const Vector3& point : points_) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  if (largest > 0.0 && std::isfinite(largest)) {
    const double unit = std::ldexp(1.0, std::ilogb(largest) - kept_bits);
    for (Vector3& point : points_) {
      for (double& coordinate : point) {
        coordinate = rounded(coordinate, unit);
        range_.include(coordinate);
      }
    }
  }
  box_ = box_of(points_);
  for (const Vector3& point : points_) size_ = std::max(size_, (point - points_.front()).norm());
  normals_.reserve(surface.cells.size());
  cell_boxes_.reserve(surface.cells.size());
  for (const SurfaceCell& cell : surface.cells) {
    const Vector3& first = point(cell.corners[0]);
    Vector3 area = Vector3::Zero();
    for (std::size_t k = 1; k + 1 < cell.corners.size(); ++k) {
      area += (point(cell.corners[k]) - first).cross(point(cell.corners[k + 1]) - first);
    }
    normals_.push_back(area.normalized());
    Box box;
    for (const int corner : cell.corners) box.include(point(corner));
    cell_boxes_.push_back(box);
  }
  for (std::size_t c = 0; c < shapes.size(); ++c) {
    cell_boxes_[c].include(shapes[c].box);
    box_.include(shapes[c].box);
    chord_bounds_.push_back(shapes[c].chord_bound);
    largest_chord_bound_ = std::max(largest_chord_bound_, shapes[c].chord_bound);
  }
  if (cell_boxes_.size() > few_cells) tree_ = std::make_shared<CellTree>();
}

const BoxTree& PlacedSurface::cell_tree() const {
  std::call_once(tree_->made, [this] { tree_->tree.emplace(cell_boxes_); });
  return *tree_->tree;
}

std::vector<Vector3> PlacedSurface::corners(int cell) const {
  std::vector<Vector3> places;
  for (const int corner : surface_->cells[at(cell)].corners) places.push_back(point(corner));
  return places;
}

std::array<Vector3, 2> PlacedSurface::edge(int index) const {
  const auto& ends = surface_->edges[at(index)].ends;
  return {point(ends[0]), point(ends[1])};
}

}  // namespace ashlar
