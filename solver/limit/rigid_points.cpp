#include "solver/limit/rigid_points.hpp"

#include <algorithm>
#include <limits>

#include "geometry/index.hpp"
#include "mechanics/basis/quadrature.hpp"
#include "solver/limit/face_friction.hpp"
#include "solver/state/automatic.hpp"
#include "solver/step/detect/step_contacts.hpp"

namespace ashlar {
namespace {

/// The system with springs at the corners of overlaps, and no ties.
BlockSystem with_corners(const BlockSystem& system) {
  SimulationSettings settings = system.settings();
  settings.area_springs = false;
  settings.curved_surface = false;
  settings.augmented = false;
  settings.search.subdivisions = 0;
  settings.search.chord_tolerance = std::numeric_limits<double>::infinity();
  return BlockSystem(
      system.blocks(),
      [&system](int a, int b) {
        JointLaw law = system.law(a, b);
        law.area_springs = false;
        return law;
      },
      settings, {}, system.absent());
}

PointSpring spring_of(const JointLaw& law, double area) {
  const double scale = law.area_springs ? area : 1.0;
  return {law.normal_stiffness * scale, law.shear_stiffness * scale, 0.0};
}

/// Divides the overlaps of two blocks into parts.
class OverlapParts {
 public:
  OverlapParts(const ContactFinder& finder, const FoundContacts& found, const ContactPair& pair, double reach)
      : a_(finder.placed(found.blocks[0])),
        b_(finder.placed(found.blocks[1])),
        found_(found),
        pair_(pair),
        reach_(reach) {}

  /// @param law of the two blocks
  void add(const JointLaw& law, std::vector<RigidPoint>& points) const {
    each_closed([&](const CellOverlap& overlap, const ContactPoint& corner) {
      for (std::size_t k = 2; k < overlap.corners.size(); ++k)
        add_triangle({overlap.corners[0].place, overlap.corners[k - 1].place, overlap.corners[k].place},
                     overlap, corner, law, points);
    });
  }

  /// Triangles of the overlaps, with the friction of their faces.
  void add_areas(const JointLaw& law, const std::map<std::array<int, 2>, FaceFriction>& frictions,
                 std::vector<RigidPoint>& areas) const {
    each_closed([&](const CellOverlap& overlap, const ContactPoint& corner) {
      const auto friction = frictions.find({corner.face_a, corner.face_b});
      for (std::size_t k = 2; k < overlap.corners.size(); ++k) {
        const Triangle t = {overlap.corners[0].place, overlap.corners[k - 1].place, overlap.corners[k].place};
        const double area = area_of(t);
        if (!(area > 0.0)) continue;
        add_point((t[0] + t[1] + t[2]) / 3.0, area, overlap, corner, law, areas);
        RigidPoint& point = areas.back();
        CrushingPart part{{}, point.place, 1.0};
        for (std::size_t n = 0; n < 3; ++n) part.corners[n] = place_of(t[n], overlap);
        if (friction != frictions.end()) {
          part.middle = friction->second.middle;
          part.friction_share = friction->second.share;
        }
        point.friction_place = part.friction_place(point.place);
        point.part = part;
      }
    });
  }

  void add_springs(const JointLaw& law, std::vector<RigidPoint>& points) const {
    each_closed([&](const CellOverlap& overlap, const ContactPoint& corner) {
      std::vector<Eigen::Vector2d> outline;
      for (const OverlapCorner& one : overlap.corners) outline.push_back(one.place);
      const PolygonRule rule = affine_rule(outline);
      for (std::size_t k = 0; k < rule.points.size(); ++k) {
        add_point(rule.points[k], rule.weights[k], overlap, corner, law, points);
        points.back().spring = spring_of(law, rule.weights[k]);
      }
    });
  }

 private:
  using Triangle = std::array<Eigen::Vector2d, 3>;

  template <class Action>
  void each_closed(Action action) const {
    for (const CellOverlap& overlap : found_.contacts.overlaps) {
      const ContactPoint* corner = corner_of(overlap);
      if (corner == nullptr) continue;
      double gap = 0.0;
      for (const double g : overlap.gaps) gap += g / static_cast<double>(overlap.gaps.size());
      if (gap <= reach_) action(overlap, *corner);
    }
  }

  [[nodiscard]] const ContactPoint* corner_of(const CellOverlap& overlap) const {
    const int face_a = a_.surface().cells[at(overlap.cell_a)].face;
    const int face_b = b_.surface().cells[at(overlap.cell_b)].face;
    for (const ContactPoint& point : pair_.points())
      if (point.type == ContactPointType::face_face && point.face_a == face_a && point.face_b == face_b)
        return &point;
    return nullptr;
  }

  static double area_of(const Triangle& t) {
    const Eigen::Vector2d u = t[1] - t[0], v = t[2] - t[0];
    return 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
  }

  static Vector3 place_of(const Eigen::Vector2d& at, const CellOverlap& overlap) {
    return overlap.frame.origin + at.x() * overlap.frame.e1 + at.y() * overlap.frame.e2;
  }

  static ContactPoint part_of(ContactPoint corner, const Vector3& place, double area) {
    for (Vector3* material : {&corner.material_a, &corner.material_b}) *material += place - corner.place_a;
    corner.place_a = corner.place_b = place;
    corner.area = area;
    corner.gap = 0.0;
    return corner;
  }

  void add_triangle(const Triangle& t, const CellOverlap& overlap, const ContactPoint& corner,
                    const JointLaw& law, std::vector<RigidPoint>& points) const {
    const Eigen::Vector2d m01 = 0.5 * (t[0] + t[1]), m12 = 0.5 * (t[1] + t[2]), m20 = 0.5 * (t[2] + t[0]);
    for (const Triangle& part : {Triangle{t[0], m01, m20}, Triangle{t[1], m12, m01}, Triangle{t[2], m20, m12},
                                 Triangle{m01, m12, m20}}) {
      const double area = area_of(part);
      if (!(area > 0.0)) continue;
      add_point((part[0] + part[1] + part[2]) / 3.0, area, overlap, corner, law, points);
    }
  }

  void add_point(const Eigen::Vector2d& at, double area, const CellOverlap& overlap,
                 const ContactPoint& corner, const JointLaw& law, std::vector<RigidPoint>& points) const {
    Eigen::Matrix3d axes;
    axes << corner.normal.transpose(), corner.tangent_1.transpose(), corner.tangent_2.transpose();
    const Vector3 place = place_of(at, overlap);
    points.push_back({.blocks = {pair_.a(), pair_.b()},
                      .place = place,
                      .frame = axes,
                      .area = area,
                      .law = law,
                      .friction_place = place,
                      .contact = part_of(corner, place, area)});
  }

  const PlacedSurface& a_;
  const PlacedSurface& b_;
  const FoundContacts& found_;
  const ContactPair& pair_;
  double reach_;
};

}  // namespace

std::vector<RigidPoint> rigid_points(const BlockSystem& system, const RunState& state,
                                     const std::vector<int>& body_of, RigidPointKind kind,
                                     std::vector<RigidPoint>& areas) {
  const bool springs = kind == RigidPointKind::springs;
  BlockSystem view = with_corners(system);
  RunState copy;
  copy.states = state.states;
  for (const auto& [blocks, history] : state.pairs) copy.pairs[blocks].overlap = history.overlap;
  copy.clock = state.clock;
  StepContacts contacts(view);
  std::vector<FoundContacts> found = contacts.detect(view, copy, 0.0);
  std::erase_if(found, [&](const FoundContacts& one) {
    const auto [a, b] = one.blocks;
    const bool same = body_of[at(a)] >= 0 && body_of[at(a)] == body_of[at(b)];
    return same || (body_of[at(a)] < 0 && body_of[at(b)] < 0) || system.left_out().contains(one.blocks);
  });
  const double reach = system.settings().contact_distance;
  std::vector<RigidPoint> points;
  auto next = found.begin();
  for (const ContactPair& pair : contacts.pairs(view, copy, found, PairUse::statics)) {
    while (next->blocks != PairKey{pair.a(), pair.b()}) ++next;
    const JointLaw law = system.law(pair.a(), pair.b());
    const auto frictions =
        face_frictions(contacts.finder().placed(pair.a()), contacts.finder().placed(pair.b()),
                       next->contacts.overlaps, pair.points());
    const std::vector<Vector3> friction_places = places_of_friction(frictions, pair.points());
    for (std::size_t k = 0; k < pair.points().size(); ++k) {
      const ContactPoint& point = pair.points()[k];
      if (point.gap > reach || (springs && point.type == ContactPointType::face_face)) continue;
      Eigen::Matrix3d frame;
      frame << point.normal.transpose(), point.tangent_1.transpose(), point.tangent_2.transpose();
      points.push_back({.blocks = {pair.a(), pair.b()},
                        .place = middle_of_point(point),
                        .frame = frame,
                        .area = springs ? point.area : 0.0,
                        .law = law,
                        .friction_place = friction_places[k],
                        .contact = point});
      if (springs) points.back().spring = spring_of(law, point.area);
    }
    const OverlapParts parts(contacts.finder(), *next, pair, reach);
    if (springs)
      parts.add_springs(law, points);
    else if (law.cohesion > 0.0 || law.tensile_strength > 0.0)
      parts.add(law, points);
    if (!springs) parts.add_areas(law, frictions, areas);
  }
  return points;
}

}  // namespace ashlar
