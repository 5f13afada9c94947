#include "geometry/any_solid/solid_relation.hpp"

#include <array>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include "geometry/any_solid/touching_features.hpp"
#include "geometry/boxes/box_tree.hpp"
#include "geometry/convex/convex_contact.hpp"
#include "geometry/exact/rounding_mode.hpp"
#include "geometry/solid/solid_location.hpp"

namespace ashlar {

namespace {

// One of the two solids, by its triangles.
struct TriangulatedSurface {
  const SolidFeatures& features;
  const TriangleMesh& mesh;
  std::vector<ConvexShape> triangles;
  BoxTree tree;

  explicit TriangulatedSurface(const SolidFeatures& solid)
      : features(solid), mesh(solid.solid().mesh()), tree(boxes_of(mesh)) {
    for (const auto& [i, j, k] : mesh.triangles)
      triangles.push_back(ConvexShape::from_triangle(mesh.points[i], mesh.points[j], mesh.points[k]));
  }
  static std::vector<Box> boxes_of(const TriangleMesh& mesh) {
    std::vector<Box> boxes(mesh.triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
      for (const int v : mesh.triangles[t]) boxes[t].include(mesh.points[v]);
    return boxes;
  }
  /// The merged feature that carries a part of a triangle.
  [[nodiscard]] ContactFeature feature(int t, const ContactFeature& part) const {
    const auto& points = mesh.triangles[t];
    if (part.dimension == 0) return features.feature_of_point(points[part.index], t);
    if (part.dimension == 2) return {2, features.solid().face_of_triangle()[t]};
    const auto& [from, to] = triangles[t].edges()[part.index].corners;
    return features.feature_of_side(points[from], points[to], t);
  }
};

class TrianglePairs {
 public:
  TrianglePairs(const SolidFeatures& a, const SolidFeatures& b) : a_(a), b_(b) {
    NumericRange range;
    for (const TriangleMesh* mesh : {&a_.mesh, &b_.mesh})
      for (const Vector3& p : mesh->points)
        for (int i = 0; i < 3; ++i) range.include(p[i]);
    ladder_.open(range);
  }

  SolidRelation relate() {
    const bool crossing = !for_each_near_pair(
        a_.tree, b_.tree, [this] { return least_; }, [this](int i, int k) { return visit(i, k); });
    SolidRelation result;
    if (crossing || (!touching_ && one_contains_the_other())) {
      result.relation = Relation::crossing;
    } else {
      result.relation = touching_ ? Relation::touching : Relation::apart;
      result.squared_distance = least_;
    }
    result.decided_by = ladder_.counts;
    return result;
  }

 private:
  // @return false to end the search: the solids cross
  bool visit(int i, int k) {
    const ConvexContact contact = classify(a_.triangles[i], b_.triangles[k], std::nullopt, {false, false});
    ladder_.counts.filter += contact.decided_by.filter;
    ladder_.counts.exact += contact.decided_by.exact;
    if (contact.relation == Relation::crossing) return false;
    least_ = std::min(least_, contact.squared_distance);
    if (contact.relation == Relation::apart) return true;
    touching_ = true;  // a tiny distance may round to zero
    const ContactFeature f = a_.feature(i, contact.region.a), g = b_.feature(k, contact.region.b);
    if (!known_.insert({f.dimension, f.index, g.dimension, g.index}).second) return true;
    return !cross_at(a_.features, f, b_.features, g, ladder_);
  }
  // Without common points of the boundaries one point of a solid decides for all of it.
  [[nodiscard]] bool one_contains_the_other() const {
    const auto any_point = [](const TriangleMesh& mesh) { return mesh.points[mesh.triangles[0][0]]; };
    return is_inside(a_.mesh, any_point(b_.mesh)) || is_inside(b_.mesh, any_point(a_.mesh));
  }

  TriangulatedSurface a_, b_;
  PredicateLadder ladder_;
  double least_ = std::numeric_limits<double>::infinity();
  bool touching_ = false;
  std::set<std::array<int, 4>> known_;  // pairs of features already checked
};

// Separate from relate_solids() so that no arithmetic is moved across the change of the rounding mode.
[[gnu::noinline]] SolidRelation relate_to_nearest(const SolidFeatures& a, const SolidFeatures& b) {
  return TrianglePairs(a, b).relate();
}

}  // namespace

SolidRelation relate_solids(const SolidFeatures& a, const SolidFeatures& b) {
  const NearestRounding nearest;
  return relate_to_nearest(a, b);
}

}  // namespace ashlar
