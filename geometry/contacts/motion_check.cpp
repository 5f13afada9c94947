#include "geometry/contacts/motion_check.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/any_solid/triangle_distance.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Linear path of a point.
struct Path {
  Vector3 start;
  Vector3 step;
  [[nodiscard]] Vector3 at(double share) const { return start + share * step; }
};

Path path_of(const MovingSurface& s, int point) {
  return {s.start->point(point), s.end->point(point) - s.start->point(point)};
}

/// Bernstein coefficients over the step of (p - a) . ((b - a) x (c - a)): products of linear functions.
std::array<double, 4> signed_volume(const Path& p, const Path& a, const Path& b, const Path& c) {
  const auto difference = [](const Path& x, const Path& y) {
    return std::array<Vector3, 2>{x.start - y.start, x.start + x.step - y.start - y.step};
  };
  const auto u = difference(p, a), v = difference(b, a), w = difference(c, a);
  std::array<double, 4> sums{};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      for (std::size_t k = 0; k < 2; ++k) sums[i + j + k] += u[i].dot(v[j].cross(w[k]));
    }
  }
  return {sums[0], sums[1] / 3.0, sums[2] / 3.0, sums[3]};
}

/// Least coefficient of a cubic over the part of the step from a share on.
double least_after(std::array<double, 4> cubic, double share) {
  for (std::size_t step = 1; step < 4; ++step) {
    for (std::size_t k = 0; k + step < 4; ++k) cubic[k] += share * (cubic[k + 1] - cubic[k]);
  }
  return *std::min_element(cubic.begin(), cubic.end());
}

/// Closest points of two segments (a, b) and (c, d), as shares of them.
std::array<double, 2> nearest_shares(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 u = b - a, v = d - c, r = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 0.0 ? std::clamp((uv * v.dot(r) - vv * u.dot(r)) / determinant, 0.0, 1.0) : 0.0;
  const double t = vv > 0.0 ? std::clamp((uv * s + v.dot(r)) / vv, 0.0, 1.0) : 0.0;
  s = uu > 0.0 ? std::clamp((uv * t - u.dot(r)) / uu, 0.0, 1.0) : 0.0;
  return {s, t};
}

/// A share of the step before which two features are farther apart than `near`; empty if they are for the whole step.
/// @param distance_at by share. @param speed fastest approach, m per step
template <class Distance>
std::optional<double> first_touch(Distance distance_at, double speed, double near) {
  constexpr int most_advances = 64;  // then the share reached is a safe result too
  double share = 0.0;
  for (int advance = 0; advance < most_advances; ++advance) {
    const double distance = distance_at(share);
    if (distance <= near) return share;
    if (!(speed * (1.0 - share) > distance - near)) return std::nullopt;
    share += (distance - 0.5 * near) / speed;
    if (share >= 1.0) return std::nullopt;
  }
  return share;
}

/// Place and faces of a known contact: near both of two points or convex polygons.
struct KnownPlace {
  int face_a;
  int face_b;
  std::array<std::vector<Vector3>, 2> outlines;
};

double distance_to_place(const Vector3& p, const std::vector<Vector3>& outline) {
  double least = (p - outline[0]).norm();
  for (std::size_t k = 1; k + 1 < outline.size(); ++k)
    least = std::min(least, distance_to_triangle(p, {outline[0], outline[k], outline[k + 1]}));
  return least;
}

/// Distance of the place from the segment `start` to `end`.
double distance_to_place(const Vector3& start, const Vector3& end, const std::vector<Vector3>& outline) {
  if (outline.size() == 1) return (closest_on_segment(outline[0], start, end) - outline[0]).norm();
  double least = std::min(distance_to_place(start, outline), distance_to_place(end, outline));
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vector3& corner = outline[k];
    const Vector3& next = outline[(k + 1) % outline.size()];
    const auto [s, t] = nearest_shares(start, end, corner, next);
    least = std::min(least, (start + s * (end - start) - corner - t * (next - corner)).norm());
  }
  return least;
}

std::vector<KnownPlace> places_of(const PlacedSurface& a, const PlacedSurface& b, const PairContacts& known) {
  std::vector<KnownPlace> places;
  const auto face = [](const PlacedSurface& s, int cell) { return s.surface().cells[at(cell)].face; };
  const auto corners = [](const PlacedSurface& s, int cell) {
    std::vector<Vector3> result;
    for (const int corner : s.surface().cells[at(cell)].corners) result.push_back(s.point(corner));
    return result;
  };
  for (const CellOverlap& overlap : known.overlaps) {
    places.push_back({face(a, overlap.cell_a),
                      face(b, overlap.cell_b),
                      {corners(a, overlap.cell_a), corners(b, overlap.cell_b)}});
  }
  for (const VertexContact& contact : known.vertices) {
    const Vector3& place = contact.vertex_of_a ? a.point(contact.point) : b.point(contact.point);
    const int of_a = contact.vertex_of_a ? contact.own_cell : contact.cell;
    const int of_b = contact.vertex_of_a ? contact.cell : contact.own_cell;
    places.push_back({face(a, of_a), face(b, of_b), {{{place}, {place}}}});
  }
  for (const EdgeContact& contact : known.edges) {
    const auto& ends = contact.of_a.ends;
    const Vector3 place = a.point(ends[0]) + contact.of_a.along * (a.point(ends[1]) - a.point(ends[0]));
    places.push_back({face(a, contact.of_a.cell), face(b, contact.of_b.cell), {{{place}, {place}}}});
  }
  return places;
}

/// Finds the touches of one pair of surfaces.
class MotionCheck {
 public:
  MotionCheck(const MovingSurface& a, const MovingSurface& b, const PairContacts& known,
              const MotionLimits& limits)
      : a_(a), b_(b), limits_(limits), known_(known) {}

  std::vector<Touch> run() {
    const double near = limits_.tolerance;
    const MovingFeatures of_a = features_near(a_, all(b_).grown(near));
    const MovingFeatures of_b = features_near(b_, all(a_).grown(near));
    check_points(of_a.points, of_b.cells, true);
    check_points(of_b.points, of_a.cells, false);
    for (const auto& [i, j] : meeting_boxes(grown(of_a.sides.boxes, near), of_b.sides.boxes))
      check_sides(of_a.sides.list[at(i)], of_b.sides.list[at(j)]);
    return std::move(touches_);
  }

 private:
  static Box all(const MovingSurface& s) {
    Box box = s.start->box();
    box.include(s.end->box());
    return box;
  }

  static std::vector<Box> grown(std::vector<Box> boxes, double margin) {
    for (Box& box : boxes) box = box.grown(margin);
    return boxes;
  }

  /// True if a known contact between faces is at the place of a point or side at the start or the end of the step.
  /// @param ends of the point or side of surface s
  [[nodiscard]] bool is_known(const std::vector<int>& faces_a, const std::vector<int>& faces_b,
                              const MovingSurface& s, const std::array<int, 2>& ends) {
    const auto has = [](const std::vector<int>& faces, int face) {
      return std::find(faces.begin(), faces.end(), face) != faces.end();
    };
    const Path first = path_of(s, ends[0]), last = path_of(s, ends[1]);
    const auto is_near = [&](const Vector3& start, const Vector3& end, const KnownPlace& place) {
      return std::all_of(place.outlines.begin(), place.outlines.end(), [&](const auto& outline) {
        return distance_to_place(start, end, outline) <= limits_.reach;
      });
    };
    if (!places_) places_ = places_of(*a_.start, *b_.start, known_);
    return std::any_of(places_->begin(), places_->end(), [&](const KnownPlace& place) {
      return has(faces_a, place.face_a) && has(faces_b, place.face_b) &&
             (is_near(first.at(0.0), last.at(0.0), place) || is_near(first.at(1.0), last.at(1.0), place));
    });
  }
  [[nodiscard]] bool is_known_vertex(bool point_of_a, int point, int cell) {
    const MovingSurface& with_point = point_of_a ? a_ : b_;
    const std::vector<int> of_point = faces_of_point(with_point.start->surface(), point);
    const std::vector<int> of_cell = faces_of_cell((point_of_a ? b_ : a_).start->surface(), cell);
    return is_known(point_of_a ? of_point : of_cell, point_of_a ? of_cell : of_point, with_point,
                    {point, point});
  }
  [[nodiscard]] bool is_known_crossing(const SurfaceSide& of_a, const SurfaceSide& of_b) {
    const std::vector<int> faces_a = faces_of_side(a_.start->surface(), of_a);
    const std::vector<int> faces_b = faces_of_side(b_.start->surface(), of_b);
    return is_known(faces_a, faces_b, a_, of_a.ends) && is_known(faces_a, faces_b, b_, of_b.ends);
  }

  // Known contacts are checked last: most near features do not touch.
  void check_points(const FeatureList<int>& points, const FeatureList<int>& cells, bool point_of_a) {
    const MovingSurface& with_point = point_of_a ? a_ : b_;
    const MovingSurface& with_cell = point_of_a ? b_ : a_;
    for (const auto& [i, j] : meeting_boxes(grown(points.boxes, limits_.tolerance), cells.boxes)) {
      const int point = points.list[at(i)];
      const int cell = cells.list[at(j)];
      const auto& outline = with_cell.start->surface().cells[at(cell)].corners;
      const Path p = path_of(with_point, point);
      const Path first = path_of(with_cell, outline[0]);
      for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
        const std::array<Path, 3> corners = {first, path_of(with_cell, outline[k]),
                                             path_of(with_cell, outline[k + 1])};
        if (const auto share = enters(p, corners)) {
          if (!is_known_vertex(point_of_a, point, cell)) add_vertex(point_of_a, point, cell, *share);
          break;
        }
      }
    }
  }

  /// Time at which a point outside a triangle's plane at the start may pass through it; empty: never.
  [[nodiscard]] std::optional<double> enters(const Path& p, const std::array<Path, 3>& corners) const {
    const auto volume = signed_volume(p, corners[0], corners[1], corners[2]);
    const auto doubled_area = [&](double share) {
      return (corners[1].at(share) - corners[0].at(share))
          .cross(corners[2].at(share) - corners[0].at(share))
          .norm();
    };
    const double allowed = limits_.tolerance * std::min(doubled_area(0.0), doubled_area(1.0));
    if (volume[0] < -allowed || *std::min_element(volume.begin(), volume.end()) >= -allowed)
      return std::nullopt;
    double speed = 0.0;
    for (const Path& corner : corners) speed = std::max(speed, (p.step - corner.step).norm());
    const auto distance = [&](double share) {
      return distance_to_triangle(p.at(share),
                                  {corners[0].at(share), corners[1].at(share), corners[2].at(share)});
    };
    const auto share = first_touch(distance, speed, 0.25 * limits_.tolerance);
    if (share && least_after(volume, *share) >= -allowed) return std::nullopt;
    return share;
  }

  void add_vertex(bool point_of_a, int point, int cell, double share) {
    const PlacedSurface& with_point = *(point_of_a ? a_ : b_).start;
    const PlacedSurface& with_cell = *(point_of_a ? b_ : a_).start;
    const int own_cell = with_point.surface().cells_at[at(point)].front();
    const int corner = with_cell.surface().cells[at(cell)].corners[0];
    const double gap = with_cell.normal(cell).dot(with_point.point(point) - with_cell.point(corner));
    touches_.push_back({share, VertexContact{point_of_a, point, own_cell, cell, gap,
                                             tributary_area(with_point.surface(), {own_cell})}});
  }

  /// True if two sides that start close together diverge by less than the tolerance there. They meet at their ends,
  /// which pass through the cells beside the other one. The crossing of their lines, and their initial order, are
  /// matters of rounding.
  [[nodiscard]] bool start_parallel(const std::array<Path, 2>& a, const std::array<Path, 2>& b) const {
    const Vector3 u = a[1].start - a[0].start;
    const Vector3 v = b[1].start - b[0].start;
    return u.cross(v).norm() <= limits_.tolerance * std::max(u.norm(), v.norm());
  }

  void check_sides(const SurfaceSide& of_a, const SurfaceSide& of_b) {
    const std::array<Path, 2> a = {path_of(a_, of_a.ends[0]), path_of(a_, of_a.ends[1])};
    const std::array<Path, 2> b = {path_of(b_, of_b.ends[0]), path_of(b_, of_b.ends[1])};
    const auto across = [&](double share) {
      return Vector3((a[1].at(share) - a[0].at(share)).cross(b[1].at(share) - b[0].at(share)));
    };
    if (start_parallel(a, b)) return;
    // The volume is positive while b is ahead of a along u x v; the direction into b decides the order.
    auto volume = signed_volume(b[0], a[0], a[1], b[1]);
    const double sign =
        across(0.0).dot(outward_of(*a_.start, of_a) - outward_of(*b_.start, of_b)) < 0.0 ? -1.0 : 1.0;
    for (double& coefficient : volume) coefficient *= sign;
    const double allowed = limits_.tolerance * std::min(across(0.0).norm(), across(1.0).norm());
    if (volume[0] < -allowed || *std::min_element(volume.begin(), volume.end()) >= -allowed) return;
    double speed = 0.0;
    for (const Path& p : a) {
      for (const Path& q : b) speed = std::max(speed, (p.step - q.step).norm());
    }
    const auto shares = [&](double share) {
      return nearest_shares(a[0].at(share), a[1].at(share), b[0].at(share), b[1].at(share));
    };
    const auto place = [](const std::array<Path, 2>& side, double along, double share) {
      return Vector3(side[0].at(share) + along * (side[1].at(share) - side[0].at(share)));
    };
    const auto distance = [&](double share) {
      const auto [s, t] = shares(share);
      return (place(a, s, share) - place(b, t, share)).norm();
    };
    const auto share = first_touch(distance, speed, 0.25 * limits_.tolerance);
    if (!share || least_after(volume, *share) >= -allowed) return;
    const auto [s, t] = shares(*share);
    // An end of one that meets the other passes through an adjacent cell: which sides of a corner cross there is a
    // matter of rounding.
    const auto is_end = [&](const std::array<Path, 2>& side, double along) {
      const double length = (side[1].at(*share) - side[0].at(*share)).norm();
      return std::min(along, 1.0 - along) * length <= 0.25 * limits_.tolerance;
    };
    if (is_end(a, s) || is_end(b, t) || is_known_crossing(of_a, of_b)) return;
    const Vector3 normal = -sign * across(*share).normalized();
    const Vector3 apart = place(a, s, 0.0) - place(b, t, 0.0);
    touches_.push_back({*share, EdgeContact{{of_a.ends, of_a.cells[0], s},
                                            {of_b.ends, of_b.cells[0], t},
                                            normal,
                                            normal.dot(apart),
                                            std::min(tributary_area(a_.start->surface(), {of_a.cells[0]}),
                                                     tributary_area(b_.start->surface(), {of_b.cells[0]}))}});
  }

  const MovingSurface a_;
  const MovingSurface b_;
  const MotionLimits limits_;
  const PairContacts& known_;
  std::optional<std::vector<KnownPlace>> places_;  ///< of known contacts, computed at the first use
  std::vector<Touch> touches_;
};

}  // namespace

std::vector<Touch> find_touches(const MovingSurface& a, const MovingSurface& b, const PairContacts& known,
                                const MotionLimits& limits) {
  return MotionCheck(a, b, known, limits).run();
}

}  // namespace ashlar
