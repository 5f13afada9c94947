#include "apps/scene/check/initial_overlap.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/any_solid/solid_depth.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/convex/convex_contact.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

/// Slack in barycentric coordinates and relative to a triangle's size: no crossing between two triangles is missed,
/// and a triangle is not mistaken for the opposite side of its solid.
constexpr double crossing_slack = 1e-9;

/// A solid with the queries for overlaps. Rounded crossings only choose the points; geometry determines their depth.
class Probe {
 public:
  explicit Probe(const Polyhedron& solid) : solid_(solid), box_(box_of(solid.mesh().points)), depths_(solid) {
    for (const auto& triangle : solid.mesh().triangles) {
      triangles_.push_back({point(triangle[0]), point(triangle[1]), point(triangle[2])});
    }
  }

  /// Distance to the surface, m; 0 outside.
  [[nodiscard]] double depth_of(const Vector3& place) const {
    if (!box_.meets({place, place})) return 0.0;
    const std::optional<SolidDepth> depth = depths_.of_point(place);
    return depth ? depth->depth : 0.0;
  }

  /// Intersections of the line from + t (to - from) with the surface, t increasing. An intersection with a side of a
  /// triangle may occur twice.
  [[nodiscard]] std::vector<double> crossings(const Vector3& from, const Vector3& to) const {
    const Vector3 direction = to - from;
    std::vector<double> found;
    for (const auto& corners : triangles_) {
      const Vector3 u = corners[1] - corners[0], v = corners[2] - corners[0];
      const Vector3 across = direction.cross(v);
      const double determinant = u.dot(across);
      if (determinant == 0.0) continue;
      const Vector3 offset = from - corners[0];
      const double first = offset.dot(across) / determinant;
      const Vector3 turned = offset.cross(u);
      const double second = direction.dot(turned) / determinant;
      if (first < -crossing_slack || second < -crossing_slack || first + second > 1.0 + crossing_slack)
        continue;
      found.push_back(v.dot(turned) / determinant);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Corners, and midpoints of the parts of edges between intersections with the other's surface.
  [[nodiscard]] std::vector<Vector3> edge_points(const Probe& other) const {
    std::vector<Vector3> result;
    for (const int corner : solid_.corners()) result.push_back(point(corner));
    for (const PolyhedronEdge& edge : solid_.edges()) {
      const Vector3& from = point(edge.vertices[0]);
      const Vector3& to = point(edge.vertices[1]);
      if (!other.box_.meets({from.cwiseMin(to), from.cwiseMax(to)})) continue;
      double last = 0.0;
      for (double t : other.crossings(from, to)) {
        t = std::clamp(t, 0.0, 1.0);
        result.emplace_back(from + 0.5 * (last + t) * (to - from));
        last = t;
      }
      result.emplace_back(from + 0.5 * (last + 1.0) * (to - from));
    }
    return result;
  }

  /// Points midway from the centre of each triangle, along its normal, to the opposite side of the solid.
  [[nodiscard]] std::vector<Vector3> inner_points(const Probe& other) const {
    std::vector<Vector3> result;
    for (const auto& corners : triangles_) {
      const Vector3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
      if (!other.box_.meets({middle, middle})) continue;
      const Vector3 inward = (corners[2] - corners[0]).cross(corners[1] - corners[0]);
      const double size = std::sqrt(inward.norm());
      const std::vector<double> exits = crossings(middle, middle + inward / size);
      const auto exit = std::upper_bound(exits.begin(), exits.end(), crossing_slack);
      if (exit != exits.end()) result.emplace_back(middle + 0.5 * *exit * inward / size);
    }
    return result;
  }

 private:
  [[nodiscard]] const Vector3& point(int index) const {
    return solid_.mesh().points[static_cast<std::size_t>(index)];
  }

  const Polyhedron& solid_;
  Box box_;
  SolidDepthFinder depths_;
  std::vector<std::array<Vector3, 3>> triangles_;
};

double sampled_depth(const Probe& a, const Probe& b) {
  double deepest = 0.0;
  for (const auto& [one, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    for (const Vector3& point : one->edge_points(*other)) deepest = std::max(deepest, other->depth_of(point));
    for (const Vector3& point : one->inner_points(*other)) {
      const double depth = other->depth_of(point);
      if (depth > 0.0) deepest = std::max({deepest, depth, one->depth_of(point)});
    }
  }
  return deepest;
}

/// The shape of a solid that is convex within rounding error.
std::optional<ConvexShape> convex_shape(const Polyhedron& solid) {
  if (!solid.convex()) return std::nullopt;
  try {
    return ConvexShape::from_mesh(solid.mesh());
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// A solid prepared for its kind of query, once for all its pairs.
class Candidate {
 public:
  explicit Candidate(const Polyhedron& solid) : solid_(&solid), shape_(convex_shape(solid)) {}
  [[nodiscard]] const std::optional<ConvexShape>& shape() const { return shape_; }
  /// Computed at the first use: pairs of convex solids do not need it.
  [[nodiscard]] const Probe& probe() {
    if (!probe_) probe_.emplace(*solid_);
    return *probe_;
  }

 private:
  const Polyhedron* solid_;
  std::optional<ConvexShape> shape_;
  std::optional<Probe> probe_;
};

OverlapDepth overlap_depth(Candidate& a, Candidate& b) {
  if (!a.shape() || !b.shape()) return {sampled_depth(a.probe(), b.probe()), false};
  const ConvexContact contact = classify(*a.shape(), *b.shape(), std::nullopt, CrossingDetail{false, false});
  return {contact.relation == Relation::crossing ? std::sqrt(contact.squared_depth) : 0.0, true};
}

/// Allowed depth of two blocks in each other, m.
struct AllowedDepth {
  double rounding;    ///< in any case
  double depth;       ///< as the scene has it
  std::string words;  ///< for a message
};

AllowedDepth allowed_depth(const Scene& scene, const Polyhedron& a, const Polyhedron& b) {
  const double size = correctly_rounded::cbrt(std::min(a.volume(), b.volume()));
  const double rounding = allowed_initial_overlap * size;
  const double given = scene.contact.allowed_overlap;
  const double most = most_allowed_overlap * size;
  if (given > most)
    return {rounding, most,
            fmt::format("{:.3g} m, {} of the smaller one's size", most, most_allowed_overlap)};
  if (given > rounding) return {rounding, given, fmt::format("{:.3g} m (contact.allowed_overlap)", given)};
  return {rounding, rounding, fmt::format("{:.3g} m; contact.allowed_overlap accepts more", rounding)};
}

}  // namespace

OverlapDepth overlap_depth(const Polyhedron& a, const Polyhedron& b) {
  Candidate first(a), second(b);
  return overlap_depth(first, second);
}

std::vector<KnownOverlap> check_initial_overlap(const ExpandedScene& scene,
                                                const std::vector<std::optional<Polyhedron>>& solids,
                                                Diagnostics& diagnostics) {
  std::vector<std::size_t> blocks;
  std::vector<Box> boxes;
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (!solids[k] || (!scene.absent.empty() && scene.absent[k])) continue;
    blocks.push_back(k);
    boxes.push_back(box_of(solids[k]->mesh().points));
    candidates.emplace_back(*solids[k]);
  }
  std::size_t found = 0;
  std::vector<KnownOverlap> known;
  const std::vector<std::array<int, 2>> pairs = meeting_boxes(boxes);
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const auto& [first, second] = pairs[n];
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    const SceneBlock& a = scene.block[blocks[i]];
    const SceneBlock& b = scene.block[blocks[j]];
    if (a.fixed && b.fixed) continue;
    const OverlapDepth overlap = overlap_depth(candidates[i], candidates[j]);
    const AllowedDepth allowed = allowed_depth(scene, *solids[blocks[i]], *solids[blocks[j]]);
    if (overlap.depth <= allowed.depth) {
      if (overlap.depth > 0.0 && scene.contact.allowed_overlap > 0.0)
        known.push_back({{static_cast<int>(blocks[i]), static_cast<int>(blocks[j])},
                         overlap,
                         overlap.depth <= allowed.rounding});
      continue;
    }
    diagnostics.error(
        scene.places.key(fmt::format("block.{}", blocks[j])),
        fmt::format("blocks \"{}\" and \"{}\" overlap by {}{:.3g} m, allowed is touching or {}", a.name,
                    b.name, overlap.exact ? "" : "at least ", overlap.depth, allowed.words));
    if (++found < listed_of_a_kind || n + 1 == pairs.size()) continue;
    diagnostics.error(
        scene.places.key(fmt::format("block.{}", blocks[j])),
        fmt::format("{} pairs of blocks overlap, {} more pairs with boxes that meet were not looked at",
                    found, pairs.size() - n - 1));
    break;
  }
  return known;
}

void warn_of_known_overlaps(const ExpandedScene& scene, const std::vector<KnownOverlap>& overlaps,
                            Diagnostics& diagnostics) {
  const KnownOverlap* deepest = nullptr;
  std::size_t count = 0;
  for (const KnownOverlap& known : overlaps) {
    if (known.rounding) continue;
    ++count;
    if (deepest == nullptr || known.overlap.depth > deepest->overlap.depth) deepest = &known;
  }
  if (deepest == nullptr) return;
  const auto name = [&](int block) { return scene.block[static_cast<std::size_t>(block)].name; };
  diagnostics.warning(
      scene.places.value("contact.allowed_overlap"),
      fmt::format("{} placed in each other, by {}{:.3g} m at the deepest (\"{}\" and \"{}\"); contacts "
                  "start without force there, and summary.json lists the pairs",
                  count == 1 ? "1 pair of blocks is" : fmt::format("{} pairs of blocks are", count),
                  deepest->overlap.exact ? "" : "at least ", deepest->overlap.depth, name(deepest->blocks[0]),
                  name(deepest->blocks[1])));
}

}  // namespace ashlar
