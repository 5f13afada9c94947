#include "geometry/any_solid/near_features.hpp"

#include "geometry/boxes/box_tree.hpp"

namespace ashlar {

namespace {

struct FeatureBoxes {
  std::vector<ContactFeature> features;
  std::vector<Box> boxes;

  explicit FeatureBoxes(const SolidFeatures& solid) {
    for (const int v : solid.solid().corners()) add({0, v}).include(solid.point(v));
    for (int e = 0; e < static_cast<int>(solid.edges().size()); ++e) {
      Box& box = add({1, e});
      box.include(solid.point(solid.edges()[e].from));
      box.include(solid.point(solid.edges()[e].to));
    }
    for (int f = 0; f < static_cast<int>(solid.solid().faces().size()); ++f) {
      Box& box = add({2, f});
      for (const SolidSide& side : solid.sides(f)) box.include(solid.point(side.from));
    }
  }
  Box& add(const ContactFeature& feature) {
    features.push_back(feature);
    return boxes.emplace_back();
  }
};

bool has_cone(const SolidFeatures& solid, const ContactFeature& f) {
  if (f.dimension == 0) return solid.corner_kind(f.index) != CornerKind::reflex;
  return f.dimension == 2 || solid.edges()[f.index].convex;
}

}  // namespace

NearFeatures near_features(const SolidFeatures& a, const SolidFeatures& b, double squared_limit) {
  const FeatureBoxes boxes_a(a), boxes_b(b);
  const BoxTree tree_a(boxes_a.boxes), tree_b(boxes_b.boxes);
  NearFeatures pairs;
  for_each_near_pair(
      tree_a, tree_b, [squared_limit] { return squared_limit; },
      [&](int i, int k) {
        const ContactFeature &f = boxes_a.features[i], &g = boxes_b.features[k];
        const bool may_touch = boxes_a.boxes[i].meets(boxes_b.boxes[k]);
        if (may_touch || (has_cone(a, f) && has_cone(b, g)))
          pairs[f.dimension + g.dimension].emplace_back(f, g);
        return true;
      });
  return pairs;
}

}  // namespace ashlar
