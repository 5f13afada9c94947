// The common part of two plane regions given as triangles: brute force in rational numbers. Every triangle of
// one is clipped by every triangle of the other; the gaps between the pieces around a point classify the
// point. Shares no code with the program.
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

namespace ashlar::oracle {

struct PlanePoint {
  mpq_class x, y;

  friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
  friend bool operator<(const PlanePoint& p, const PlanePoint& q) {
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  }
};

/// Counter-clockwise; the inner points of the triangles of one region are disjoint.
using PlaneRegion = std::vector<std::array<PlanePoint, 3>>;

class FlatOverlap {
 public:
  FlatOverlap(const PlaneRegion& a, const PlaneRegion& b);

  [[nodiscard]] mpq_class area() const;
  /// Vertices of the closure of the common inner points, each once, in lexicographic order.
  [[nodiscard]] std::vector<PlanePoint> vertices() const;
  [[nodiscard]] bool contains(const PlanePoint& p) const;

 private:
  using Polygon = std::vector<PlanePoint>;
  [[nodiscard]] bool is_vertex(const PlanePoint& p) const;

  std::vector<Polygon> pieces_;  // convex, counter-clockwise, of positive area
};

}  // namespace ashlar::oracle
