#include "oracle/flat_overlap.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace ashlar::oracle {

namespace {

using Polygon = std::vector<PlanePoint>;

mpq_class turn(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r) {
  return mpq_class((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
}

mpq_class twice_area(const Polygon& polygon) {
  mpq_class sum(0);
  for (std::size_t k = 2; k < polygon.size(); ++k) sum += turn(polygon[0], polygon[k - 1], polygon[k]);
  return sum;
}

Polygon clip(const Polygon& polygon, const PlanePoint& p, const PlanePoint& q) {
  Polygon result;
  const auto add = [&](const PlanePoint& x) {
    if (result.empty() || !(result.back() == x)) result.push_back(x);
  };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &x = polygon[k], &y = polygon[(k + 1) % polygon.size()];
    const mpq_class height_x = turn(p, q, x), height_y = turn(p, q, y);
    if (height_x >= 0) add(x);
    if (sgn(height_x) * sgn(height_y) < 0) {
      const mpq_class t(height_x / (height_x - height_y));
      add({mpq_class(x.x + t * (y.x - x.x)), mpq_class(x.y + t * (y.y - x.y))});
    }
  }
  while (result.size() > 1 && result.back() == result.front()) result.pop_back();
  return result;
}

// Directions as points of the diamond |x| + |y| = 1.
PlanePoint direction(const PlanePoint& from, const PlanePoint& to) {
  const mpq_class dx(to.x - from.x), dy(to.y - from.y), length(abs(dx) + abs(dy));
  return {mpq_class(dx / length), mpq_class(dy / length)};
}

}  // namespace

FlatOverlap::FlatOverlap(const PlaneRegion& a, const PlaneRegion& b) {
  for (const auto& s : a)
    for (const auto& t : b) {
      Polygon piece(s.begin(), s.end());
      for (int k = 0; k < 3 && piece.size() > 2; ++k) piece = clip(piece, t[k], t[(k + 1) % 3]);
      if (piece.size() > 2 && twice_area(piece) > 0) pieces_.push_back(std::move(piece));
    }
}

mpq_class FlatOverlap::area() const {
  mpq_class sum(0);
  for (const Polygon& piece : pieces_) sum += twice_area(piece);
  return mpq_class(sum / 2);
}

bool FlatOverlap::contains(const PlanePoint& p) const {
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const Polygon& piece) {
    for (std::size_t k = 0; k < piece.size(); ++k)
      if (turn(piece[k], piece[(k + 1) % piece.size()], p) < 0) return false;
    return true;
  });
}

// Each piece at p is a sector; there is no gap where one ends and another one begins.
bool FlatOverlap::is_vertex(const PlanePoint& p) const {
  std::map<PlanePoint, int> open;
  for (const Polygon& piece : pieces_)
    for (std::size_t k = 0; k < piece.size(); ++k) {
      const PlanePoint &before = piece[(k + piece.size() - 1) % piece.size()], &at = piece[k],
                       &after = piece[(k + 1) % piece.size()];
      if (at == p) {
        ++open[direction(p, after)];
        --open[direction(p, before)];
      } else if (!(after == p) && turn(at, after, p) == 0 && !(direction(p, at) == direction(p, after))) {
        ++open[direction(p, after)];
        --open[direction(p, at)];
      }
    }
  std::erase_if(open, [](const auto& entry) { return entry.second == 0; });
  if (open.empty()) return false;
  if (open.size() != 2) return true;
  const PlanePoint &first = open.begin()->first, &second = open.rbegin()->first;
  return !(first.x == -second.x && first.y == -second.y);
}

std::vector<PlanePoint> FlatOverlap::vertices() const {
  std::set<PlanePoint> candidates;
  for (const Polygon& piece : pieces_) candidates.insert(piece.begin(), piece.end());
  std::vector<PlanePoint> result;
  for (const PlanePoint& p : candidates)
    if (is_vertex(p)) result.push_back(p);
  return result;
}

}  // namespace ashlar::oracle
