#include "oracle/variants.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>

namespace ashlar::oracle {
namespace {

bool one_in(Random& random, std::int64_t n) {
  return pick(random, 1, n) == 1;
}

template <class T>
void shuffle(Random& random, std::vector<T>& items) {
  for (std::int64_t i = std::ssize(items) - 1; i > 0; --i) {
    std::swap(items[static_cast<std::size_t>(i)], items[static_cast<std::size_t>(pick(random, 0, i))]);
  }
}

/// The sum, if no rounding happened (the error of a rounded sum is itself a double: Knuth's two-sum).
std::optional<double> exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double error = (a - (sum - b_part)) + (b - b_part);
  return error == 0.0 && std::isfinite(sum) ? std::optional(sum) : std::nullopt;
}

/// (a + b) / 2 where it is a double in every component.
std::optional<Point> exact_middle(const Point& a, const Point& b) {
  Point middle;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto sum = exact_sum(a[k], b[k]);
    if (!sum || (*sum / 2) * 2 != *sum) return std::nullopt;
    middle[k] = *sum / 2;
  }
  return middle;
}

/// A point inside the triangle a, b, c where one is exact.
std::optional<Point> exact_inner_point(const Point& a, const Point& b, const Point& c) {
  const auto middle = exact_middle(a, b);
  return middle ? exact_middle(*middle, c) : std::nullopt;
}

/// Cuts facets into triangles; every new point belongs to all facets it lies on, so the mesh stays closed.
class Mesher {
 public:
  Mesher(const Shape& solid, Random& random) : random_(random) { shape_.points = solid.points; }

  Shape mesh(const std::vector<std::vector<int>>& facets) {
    split_edges_ = one_in(random_, 3);
    for (const auto& corners : facets) mesh_facet(corners);
    return drop_unused();
  }

 private:
  [[nodiscard]] const Point& point(int i) const { return shape_.points[static_cast<std::size_t>(i)]; }

  int add_point(const Point& point) {
    shape_.points.push_back(point);
    return static_cast<int>(shape_.points.size()) - 1;
  }

  /// A point in the middle of the edge, or -1: decided once for both facets of the edge.
  int middle_of(int a, int b) {
    const auto [entry, added] = middles_.emplace(std::minmax(a, b), -1);
    if (added && split_edges_ && one_in(random_, 3)) {
      if (const auto middle = exact_middle(point(a), point(b))) entry->second = add_point(*middle);
    }
    return entry->second;
  }

  void mesh_facet(const std::vector<int>& corners) {
    std::vector<int> cycle;
    std::vector<std::size_t> hubs;  // places a fan can start from without triangles of zero area
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int before = corners[(i + corners.size() - 1) % corners.size()];
      const int after = corners[(i + 1) % corners.size()];
      const int middle_before = middle_of(before, corners[i]);
      const int middle_after = middle_of(corners[i], after);
      if (middle_before < 0 && middle_after < 0) hubs.push_back(cycle.size());
      cycle.push_back(corners[i]);
      if (middle_after < 0) continue;
      hubs.push_back(cycle.size());
      cycle.push_back(middle_after);
    }
    const auto inner = one_in(random_, 2) ? inner_point(corners) : std::nullopt;
    if (inner) {
      const int hub = add_point(*inner);
      for (std::size_t i = 0; i < cycle.size(); ++i)
        add_triangle(hub, cycle[i], cycle[(i + 1) % cycle.size()]);
      return;
    }
    const std::size_t start = hubs[static_cast<std::size_t>(pick(random_, 0, std::ssize(hubs) - 1))];
    for (std::size_t i = 1; i + 1 < cycle.size(); ++i) {
      add_triangle(cycle[start], cycle[(start + i) % cycle.size()], cycle[(start + i + 1) % cycle.size()]);
    }
  }

  /// Inside the facet: in a triangle of three of its corners.
  std::optional<Point> inner_point(std::vector<int> corners) {
    shuffle(random_, corners);
    return exact_inner_point(point(corners[0]), point(corners[1]), point(corners[2]));
  }

  void add_triangle(int a, int b, int c) {
    const auto inner = one_in(random_, 8) ? exact_inner_point(point(a), point(b), point(c)) : std::nullopt;
    if (!inner) {
      shape_.triangles.push_back({a, b, c});
      return;
    }
    const int hub = add_point(*inner);
    shape_.triangles.push_back({a, b, hub});
    shape_.triangles.push_back({b, c, hub});
    shape_.triangles.push_back({c, a, hub});
  }

  Shape drop_unused() const {
    Shape result;
    std::map<int, int> index;
    for (auto triangle : shape_.triangles) {
      for (int& corner : triangle) {
        const auto [entry, added] = index.emplace(corner, static_cast<int>(result.points.size()));
        if (added) result.points.push_back(point(corner));
        corner = entry->second;
      }
      result.triangles.push_back(triangle);
    }
    return result;
  }

  Random& random_;
  Shape shape_;
  bool split_edges_ = false;
  std::map<std::pair<int, int>, int> middles_;
};

/// Points and triangles in another order, each triangle from another corner; `reversed` turns them over.
Shape renumbered(const Shape& shape, bool reversed, Random& random) {
  std::vector<int> place(shape.points.size());
  std::iota(place.begin(), place.end(), 0);
  shuffle(random, place);
  Shape result;
  result.points.resize(shape.points.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    result.points[static_cast<std::size_t>(place[i])] = shape.points[i];
  }
  for (auto triangle : shape.triangles) {
    for (int& corner : triangle) corner = place[static_cast<std::size_t>(corner)];
    if (reversed) std::swap(triangle[0], triangle[1]);
    std::rotate(triangle.begin(), triangle.begin() + pick(random, 0, 2), triangle.end());
    result.triangles.push_back(triangle);
  }
  shuffle(random, result.triangles);
  return result;
}

/// Exact on all points of both shapes.
Similarity random_similarity(const Shape& p, const Shape& q, Random& random) {
  Similarity result;
  std::vector<int> axes{0, 1, 2};
  shuffle(random, axes);
  for (std::size_t k = 0; k < 3; ++k) {
    result.axis[k] = axes[k];
    result.sign[k] = one_in(random, 2) ? -1 : 1;
  }
  if (one_in(random, 2)) result.scale = static_cast<int>(pick(random, -40, 40));
  if (!one_in(random, 3)) return result;
  // Moves a corner to where another one is zero, or by a small whole number.
  const auto& points = p.points;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(result.axis[k]);
    const auto corner = static_cast<std::size_t>(pick(random, 0, std::ssize(points) - 1));
    const double offset = one_in(random, 2) ? -result.sign[k] * points[corner][axis]
                                            : static_cast<double>(pick(random, -1000, 1000));
    bool exact = true;
    for (const Shape* shape : {&p, &q}) {
      for (const Point& point : shape->points) {
        exact = exact && exact_sum(result.sign[k] * point[axis], offset).has_value();
      }
    }
    if (exact) result.offset[k] = offset;
  }
  return result;
}

}  // namespace

Point Similarity::turn(const Point& x) const {
  Point result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = std::ldexp(sign[k] * x[static_cast<std::size_t>(axis[k])], scale);
  }
  return result;
}

Point Similarity::operator()(const Point& x) const {
  Point result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = std::ldexp(sign[k] * x[static_cast<std::size_t>(axis[k])] + offset[k], scale);
  }
  return result;
}

bool Similarity::reflects() const {
  const bool odd = (axis[1] - axis[0] + 3) % 3 == 2;
  return (sign[0] * sign[1] * sign[2] < 0) != odd;
}

Variants::Variants(Shape p, Shape q) : p_{std::move(p), {}}, q_{std::move(q), {}} {
  for (Body* body : {&p_, &q_}) {
    if (body->shape.triangles.size() > 1) body->facets = facet_cycles(body->shape);
  }
}

Variant Variants::random(Random& random) const {
  const auto remeshed = [&](const Body& body) {
    const bool anew = !body.facets.empty() && one_in(random, 2);
    return anew ? meshed_anew(body.shape, body.facets, random) : body.shape;
  };
  Variant variant;
  variant.p = remeshed(p_);
  variant.q = remeshed(q_);
  variant.similarity = random_similarity(variant.p, variant.q, random);
  for (Shape* shape : {&variant.p, &variant.q}) {
    for (Point& point : shape->points) point = variant.similarity(point);
    const bool solid = shape->triangles.size() > 1;
    *shape = renumbered(*shape, solid ? variant.similarity.reflects() : one_in(random, 2), random);
  }
  variant.swapped = one_in(random, 2);
  if (variant.swapped) std::swap(variant.p, variant.q);
  return variant;
}

Shape meshed_anew(const Shape& solid, const std::vector<std::vector<int>>& facets, Random& random) {
  return Mesher(solid, random).mesh(facets);
}

}  // namespace ashlar::oracle
