#include "geometry/cutting/edge_fan.hpp"

#include <algorithm>
#include <stdexcept>

namespace ashlar {

namespace {

// A face lies in direction way (n x d) from an edge along d. The body below the face is on the side of smaller angles
// around d if the edge goes forwards: with d = z and n = x the face lies along -y, and the body along -x.
FanSide fan_side(int edge, int face, int plane, int sense, bool below) {
  return {edge, face, plane, sense, below != (sense > 0)};
}

}  // namespace

std::vector<FanSide> fan_sides(const CellComplex& complex, const std::vector<std::pair<int, bool>>& faces) {
  std::vector<FanSide> sides;
  for (int k = 0; k < static_cast<int>(faces.size()); ++k) {
    const auto& [index, below] = faces[static_cast<std::size_t>(k)];
    const ComplexFace& face = complex.face(index);
    for (const OutlineSide& side : sides_of(face))
      sides.push_back(
          fan_side(side.edge, k, face.plane, complex.edge(side.edge).points[0] == side.from ? 1 : -1, below));
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const FanSide& a, const FanSide& b) { return a.edge < b.edge; });
  return sides;
}

std::vector<std::pair<int, bool>> surface_of(const CellComplex& complex, int cell) {
  std::vector<std::pair<int, bool>> faces;
  for (const int face : complex.faces(cell)) faces.emplace_back(face, complex.face(face).cells[0] == cell);
  return faces;
}

EdgeFan::EdgeFan(const CellComplex& complex, int edge, std::vector<FanSide> sides)
    : complex_(complex), first_(sides.front()), sides_(std::move(sides)) {
  const auto& [from, to] = complex.edge(edge).points;
  const ExactPoint &p = complex.point(from).place, &q = complex.point(to).place;
  along_ = {Integer(q.x * p.w - p.x * q.w), Integer(q.y * p.w - p.y * q.w), Integer(q.z * p.w - p.z * q.w)};
  std::sort(sides_.begin(), sides_.end(), [&](const FanSide& a, const FanSide& b) { return before(a, b); });
}

// A face with normal n lies in direction t = way (n x d) from an edge along d, and d . (t x s) of two of them is
// the product of their ways, |d|^2 and det(n, m, d).
int EdgeFan::turn(const FanSide& a, const FanSide& b) const {
  const auto& n = complex_.plane(a.plane).coefficients();
  const auto& m = complex_.plane(b.plane).coefficients();
  const Integer determinant = along_[0] * (n[1] * m[2] - n[2] * m[1]) +
                              along_[1] * (n[2] * m[0] - n[0] * m[2]) +
                              along_[2] * (n[0] * m[1] - n[1] * m[0]);
  return a.sense * b.sense * sgn(determinant);
}

/// Counted from the first side: along it, up to half a turn on, against it, more than half a turn.
int EdgeFan::quarter(const FanSide& side) const {
  const int turned = turn(first_, side);
  if (turned != 0) return turned > 0 ? 1 : 3;
  const auto& n = complex_.plane(first_.plane).coefficients();
  const auto& m = complex_.plane(side.plane).coefficients();
  const Integer product = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
  return first_.sense * side.sense * sgn(product) > 0 ? 0 : 2;
}

bool EdgeFan::before(const FanSide& a, const FanSide& b) const {
  const int of_a = quarter(a), of_b = quarter(b);
  if (of_a != of_b) return of_a < of_b;
  return of_a % 2 == 1 && turn(a, b) > 0;
}

bool EdgeFan::holds(int plane, int sense) const {
  const FanSide asked{-1, -1, plane, sense, false};
  const auto next =
      std::find_if(sides_.begin(), sides_.end(), [&](const FanSide& of) { return !before(of, asked); });
  if (next != sides_.end() && !before(asked, *next)) return false;
  return next == sides_.begin() ? sides_.back().ahead : std::prev(next)->ahead;
}

bool EdgeFan::flat() const {
  return sides_.size() == 2 && turn(sides_[0], sides_[1]) == 0;
}

std::optional<int> EdgeFan::parting_plane() const {
  if (sides_.size() == 2) {
    const bool first_ahead = sides_[0].ahead;
    if (turn(sides_[first_ahead ? 0 : 1], sides_[first_ahead ? 1 : 0]) >= 0) return std::nullopt;
    return sides_[0].plane;
  }
  for (const FanSide& side : sides_) {
    const auto is_turned = [&](int sense) {
      return std::any_of(sides_.begin(), sides_.end(),
                         [&](const FanSide& other) { return turn(side, other) == sense; });
    };
    if (is_turned(1) && is_turned(-1)) return side.plane;
  }
  throw std::logic_error("parts that meet in an edge are on different sides of the plane of a face");
}

}  // namespace ashlar
