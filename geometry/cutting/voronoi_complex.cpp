#include "geometry/cutting/voronoi_complex.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/cutting/cut_error.hpp"

namespace ashlar {
namespace {

/// Above the rounding error of a ratio of two distances.
constexpr double distance_slack = 1.0 + 0x1p-40;

/// The other points in order of distance; equally near ones by number.
class NearestFirst {
 public:
  NearestFirst(const std::vector<Vector3>& points, int from) {
    for (int j = 0; j < static_cast<int>(points.size()); ++j)
      if (j != from) order_.emplace_back((points[j] - points[from]).squaredNorm(), j);
  }
  /// -1: there is none.
  int next() {
    if (given_ == order_.size()) return -1;
    if (given_ == sorted_) {
      sorted_ = std::min(order_.size(), std::max<std::size_t>(64, 2 * sorted_));
      const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(given_);
      std::partial_sort(begin, order_.begin() + static_cast<std::ptrdiff_t>(sorted_), order_.end());
    }
    return order_[given_++].second;
  }

 private:
  std::vector<std::pair<double, int>> order_;
  std::size_t sorted_ = 0, given_ = 0;
};

class VoronoiCells {
 public:
  VoronoiCells(const CellComplex& whole, const std::vector<Vector3>& points, int mark)
      : whole_(whole), points_(points), mark_(mark) {}

  CellComplex make() {
    for (const int face : whole_.faces(0)) own_planes_[whole_.face(face).plane] = -1;
    for (auto& [plane, index] : own_planes_) index = result_.add_plane(whole_.plane(plane));
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) add_cell(i);
    return std::move(result_);
  }

 private:
  /// Half way between two points, the one with the smaller index below.
  [[nodiscard]] ExactPlane plane_between(int i, int j) const {
    const RationalVector p = to_rational(points_[std::min(i, j)]), q = to_rational(points_[std::max(i, j)]);
    return {difference(q, p), Rational((dot_product(q, q) - dot_product(p, p)) / 2)};
  }

  /// True if every corner of a cell is certainly closer to point i than to j.
  [[nodiscard]] bool is_out_of_reach(const CellComplex& cells, int cell, int i, int j) const {
    const std::vector<int> corners = cells.points_of(cell);
    return std::all_of(corners.begin(), corners.end(), [&](int corner) {
      const Vector3& x = cells.point(corner).place.rounded;
      const double to_i = (x - points_[i]).norm(), to_j = (x - points_[j]).norm();
      return to_j - to_i > 0x1p-40 * (x.cwiseAbs().sum() + to_i + to_j);
    });
  }

  /// @return false if nothing remains
  bool cut_off(CellComplex& cells, int& cell, int i, int j) {
    const int plane = cells.add_plane(plane_between(i, j));
    const int inner = i < j ? -1 : 1, side = cells.side_of_cell(plane, cell);
    others_of_plane_[plane] = j;
    if (side == -inner) return false;
    if (side == inner) return true;
    const int above = cells.part(cell, plane, mark_);
    cells.remove(inner > 0 ? cell : above);
    if (inner > 0) cell = above;
    return true;
  }

  void add_cell(int i) {
    CellComplex cells = whole_;
    others_of_plane_.clear();
    int cell = 0;
    NearestFirst others(points_, i);
    for (int j = others.next(); j >= 0; j = others.next()) {
      const double distance = (points_[j] - points_[i]).norm();
      if (points_[j] == points_[i])
        throw CutError("two points of a Voronoi cut are one (" + std::to_string(i) + " and " +
                       std::to_string(j) + "), different ones are needed");
      double farthest = 0.0;
      for (const int point : cells.points_of(cell))
        farthest = std::max(farthest, (cells.point(point).place.rounded - points_[i]).norm());
      if (distance > 2.0 * distance_slack * farthest) break;
      if (is_out_of_reach(cells, cell, i, j)) continue;
      if (!cut_off(cells, cell, i, j)) return;
    }
    std::vector<CellFace> faces;
    for (const int index : cells.faces(cell)) {
      const ComplexFace& face = cells.face(index);
      CellFace of{plane_in_result(face.plane, i), face.cells[0] == cell, face.mark, {}};
      for (const int point : face.points) of.loop.push_back(cells.point(point).place);
      faces.push_back(std::move(of));
    }
    result_.add_cell(faces, seams_);
  }

  [[nodiscard]] int plane_in_result(int plane, int i) {
    const auto other = others_of_plane_.find(plane);
    if (other == others_of_plane_.end()) return own_planes_.at(plane);
    const int j = other->second;
    const auto [found, is_new] = planes_.emplace(std::array{std::min(i, j), std::max(i, j)}, -1);
    if (is_new) found->second = result_.add_plane(plane_between(i, j));
    return found->second;
  }

  const CellComplex& whole_;
  const std::vector<Vector3>& points_;
  int mark_;
  CellComplex result_;
  CellSeams seams_;
  std::map<int, int> own_planes_;             ///< planes of the whole, as numbered in the result
  std::map<std::array<int, 2>, int> planes_;  ///< planes between two points, as numbered in the result
  std::map<int, int> others_of_plane_;        ///< of the present cell: the point beyond a plane
};

}  // namespace

CellComplex voronoi_complex(const CellComplex& whole, const std::vector<Vector3>& points, int mark) {
  return VoronoiCells(whole, points, mark).make();
}

}  // namespace ashlar
