#include "mechanics/contact/contact_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/index.hpp"
#include "mechanics/basis/quadrature.hpp"
#include "mechanics/contact/overlap_outline.hpp"
#include "mechanics/contact/overlap_points.hpp"

namespace ashlar {
namespace {

/// A remembered cut in the frame of an overlap.
PressureEnd seen(const PressureCut& cut, const OverlapPoints& make) {
  const Eigen::Vector2d start = make.place(cut.of_a, cut.start);
  const Eigen::Vector2d along = make.place(cut.of_a, cut.end) - start;
  return {start, {-along.y(), along.x()}};
}

PressureCut remembered(const PressureEnd& end, const CellOverlap& overlap, bool of_a,
                       const OverlapPoints& make, double length) {
  const Eigen::Vector2d along = length * Eigen::Vector2d(end.open.y(), -end.open.x()).normalized();
  return {overlap.cell_a, overlap.cell_b, of_a, make.reference(of_a, end.point),
          make.reference(of_a, end.point + along)};
}

/// Data for the points of two blocks.
struct Search {
  const ContactBody& a;
  const ContactBody& b;
  const std::vector<CellOverlap>& overlaps;
  const ContactPointSettings& settings;
  const std::vector<PressureCut>& known;
  const std::vector<FacePair>& turning;
};

constexpr int affine = 1, least_degree = 2;

/// The degree of an overlap's rule. A uniform pressure acts on every function exactly, for any division. Friction
/// with torque over two faces has the direction of a vector that vanishes somewhere: it is no polynomial, and the
/// error of a rule for the blocks' order is up to 15 % (notes/turning_friction.md). Faces of blocks of order 0 and 1
/// are flat with affine gaps in any motion (notes/affine_rule.md).
int degree_of(const Search& search, const CellOverlap& cells) {
  constexpr int least_where_friction_turns = 6;
  const FacePair faces{cell_of(search.a, cells.cell_a).face, cell_of(search.b, cells.cell_b).face};
  const bool turns = std::find(search.turning.begin(), search.turning.end(), faces) != search.turning.end();
  const auto bends_by = [](const ContactBody& body) { return body.model->fixed() ? 0 : body.model->order(); };
  const int order = std::max(bends_by(search.a), bends_by(search.b));
  if (turns) return std::max(order, least_where_friction_turns);
  // With multipliers gaps do not show where pressure ends.
  return order <= affine && !search.settings.multipliers ? affine : std::max(order, least_degree);
}

/// The degree of a rule that springs need; 0: any. @param gaps of the points of a rule. @param degree of that rule
int degree_for_spring(const std::vector<double>& gaps, int degree, const NormalSpring& spring) {
  if (gaps.empty() || !spring.stiffens()) return 0;
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  const double middle = -0.5 * (*least + *most);
  // The points of other rules end before the corners.
  const double reach = degree == affine ? 1.0 : 1.0 + 1.0 / degree;
  const double half = 0.5 * reach * (*most - *least);
  return spring.needed_degree(middle - half, middle + half);
}

/// True if a face is neither completely closed nor completely open: pressure may end inside, or begin anywhere.
bool may_open_in_part(const std::vector<double>& gaps, double tolerance) {
  const auto pressed = [tolerance](double gap) { return gap < -tolerance; };
  const auto open = [tolerance](double gap) { return gap > tolerance; };
  return !std::all_of(gaps.begin(), gaps.end(), pressed) && !std::all_of(gaps.begin(), gaps.end(), open);
}

std::vector<double> gaps_of(const std::vector<ContactPoint>& points) {
  std::vector<double> gaps;
  gaps.reserve(points.size());
  for (const ContactPoint& point : points) gaps.push_back(point.gap);
  return gaps;
}

/// Line at which to cut an overlap; empty: no cut. @param points of the rule on the whole overlap
std::optional<PressureEnd> cut_of(const JoinedOverlap& joined, const std::vector<Eigen::Vector2d>& outline,
                                  const PolygonRule& rule, const std::vector<ContactPoint>& points,
                                  const OverlapPoints& make, const Search& search) {
  const double rounding = coordinate_rounding(*search.a.placed, *search.b.placed);
  const std::vector<double> gaps = gaps_of(points);
  const auto cut = std::find_if(search.known.begin(), search.known.end(), [&](const PressureCut& one) {
    return std::any_of(joined.cells.begin(), joined.cells.end(), [&](std::size_t n) {
      return one.cell_a == search.overlaps[n].cell_a && one.cell_b == search.overlaps[n].cell_b;
    });
  });
  std::optional<PressureEnd> last;
  if (cut != search.known.end()) last = seen(*cut, make);
  return end_of_pressure(outline, rule, gaps, rounding, last);
}

/// Area springs: a quadrature rule on every cell overlap, or on both of its parts where pressure ends inside.
void add_area_springs(const Search& search, const JoinedOverlap& joined, bool master_is_a,
                      ContactPoints& result) {
  const auto& [a, b, overlaps, settings, known, turning] = search;
  const CellOverlap& overlap = overlaps[joined.cells.front()];
  int degree = degree_of(search, overlap);
  const OverlapPoints make(a, b, overlap, joined.whole, master_is_a, settings);
  const std::vector<Eigen::Vector2d> outline =
      outline_of(make.polygon(), outline_tolerance(*a.placed, *b.placed));
  if (outline.empty()) return;
  std::vector<ContactPoint> points;
  const auto add_points = [&](const PolygonRule& rule) {
    for (std::size_t k = 0; k < rule.points.size(); ++k)
      points.push_back(make.at_place(rule.points[k], rule.weights[k]));
  };
  PolygonRule whole = rule_of(outline, degree);
  add_points(whole);
  if (degree == affine && may_open_in_part(gaps_of(points), coordinate_rounding(*a.placed, *b.placed))) {
    degree = least_degree;
    whole = rule_of(outline, degree);
    points.clear();
    add_points(whole);
  }
  if (const int needed = degree_for_spring(gaps_of(points), degree, settings.spring); needed > degree) {
    degree = needed;
    whole = rule_of(outline, degree);
    points.clear();
    add_points(whole);
  }
  // Flat sub-faces of blocks that bend separate elsewhere than their pressure ends.
  const bool true_gaps = !settings.multipliers && has_true_places(a, b, settings.curved);
  std::optional<PressureEnd> end;
  if (true_gaps) {
    end = cut_of(joined, outline, whole, points, make, search);
    result.overlaps.push_back({outline, degree, result.points.size(), points.size(), end, {}});
  }
  if (end) {
    result.overlaps.back().whole = std::move(points);
    points.clear();
    add_points(rule_of(part_under_pressure(outline, *end), degree));
    add_points(rule_of(part_without_pressure(outline, *end), degree));
    result.cuts.push_back(remembered(*end, overlap, !master_is_a, make, std::sqrt(area_of(outline))));
  }
  result.points.insert(result.points.end(), points.begin(), points.end());
}

/// Point springs: one at every vertex of the faces' overlap polygon, with an equal share of its area.
void add_point_springs(const Search& search, const FaceOverlap& face,
                       const std::vector<CellOverlap>& overlaps, bool master_is_a,
                       std::vector<ContactPoint>& points) {
  const ContactBody& a = search.a;
  const ContactBody& b = search.b;
  const bool divided = a.placed->surface().divided || b.placed->surface().divided;
  const FaceOutline outline = outline_of(face, overlaps, divided, outline_tolerance(*a.placed, *b.placed));
  const double area = outline.area / static_cast<double>(outline.corners.size());
  for (const FaceOverlapPoint& point : outline.corners) {
    const CellOverlap& overlap = overlaps[at(point.overlap)];
    points.push_back(OverlapPoints(a, b, overlap, false, master_is_a, search.settings)
                         .at_place(overlap.corners[at(point.corner)].place, area));
  }
}

void add_vertex(const ContactBody& a, const ContactBody& b, const VertexContact& contact,
                const ContactPointSettings& settings, std::vector<ContactPoint>& points) {
  const ContactBody& with_vertex = contact.vertex_of_a ? a : b;
  const ContactBody& with_cell = contact.vertex_of_a ? b : a;
  const Vector3& normal = with_cell.placed->normal(contact.cell);
  const Vector3 place = with_vertex.placed->point(contact.point);
  const Vector3 foot = place - contact.gap * normal;
  const ViewFrame frame(foot, normal);
  const int face = cell_of(with_cell, contact.cell).face;
  const int own_face = cell_of(with_vertex, contact.own_cell).face;
  ContactPoint point{};
  point.type = ContactPointType::vertex_face;
  point.face_a = contact.vertex_of_a ? own_face : face;
  point.face_b = contact.vertex_of_a ? face : own_face;
  const Vector3 foot_material = CellMap(with_cell, contact.cell, frame).reference(Eigen::Vector2d::Zero());
  point.material_a = contact.vertex_of_a ? reference_point(a, contact.point) : foot_material;
  point.material_b = contact.vertex_of_a ? foot_material : reference_point(b, contact.point);
  point.place_a = contact.vertex_of_a ? place : foot;
  point.place_b = contact.vertex_of_a ? foot : place;
  point.area = contact.area;
  if (has_true_places(a, b, settings.curved))
    point.source = contact.vertex_of_a ? NormalSource::face_of_b : NormalSource::face_of_a;
  if (settings.curved) {
    set_foot(point, *with_cell.configuration, face, !contact.vertex_of_a);
  } else {
    point.normal = contact.vertex_of_a ? normal : Vector3(-normal);
  }
  complete(point);
  count_from_placement(a, b, !contact.vertex_of_a, settings.known_overlap, point);
  points.push_back(point);
}

/// Material point of a side, and its place.
struct SidePoint {
  Vector3 material;
  Vector3 place;
};

SidePoint side_point(const ContactBody& body, const CrossedSide& side, bool curved) {
  const auto between = [&](const Vector3& start, const Vector3& end) {
    return Vector3(start + side.along * (end - start));
  };
  SidePoint point;
  point.material = between(reference_point(body, side.ends[0]), reference_point(body, side.ends[1]));
  point.place = curved ? body.configuration->place(point.material)
                       : between(body.placed->point(side.ends[0]), body.placed->point(side.ends[1]));
  return point;
}

void add_edge(const ContactBody& a, const ContactBody& b, const EdgeContact& contact,
              const ContactPointSettings& settings, std::vector<ContactPoint>& points) {
  const SidePoint on_a = side_point(a, contact.of_a, settings.curved);
  const SidePoint on_b = side_point(b, contact.of_b, settings.curved);
  ContactPoint point{};
  point.type = ContactPointType::edge_edge;
  point.face_a = cell_of(a, contact.of_a.cell).face;
  point.face_b = cell_of(b, contact.of_b.cell).face;
  point.material_a = on_a.material;
  point.material_b = on_b.material;
  point.place_a = on_a.place;
  point.place_b = on_b.place;
  point.normal = contact.normal;
  point.area = contact.area;
  if (has_true_places(a, b, settings.curved)) point.source = NormalSource::edges;
  const auto edge_of = [](const ContactBody& body, const CrossedSide& side) {
    return Vector3(reference_point(body, side.ends[1]) - reference_point(body, side.ends[0]));
  };
  point.edge_a = edge_of(a, contact.of_a);
  point.edge_b = edge_of(b, contact.of_b);
  complete(point);
  count_from_placement_of_edges(a, b, settings.known_overlap, point);
  points.push_back(point);
}

}  // namespace

PolygonRule rule_of(const std::vector<Eigen::Vector2d>& outline, int degree) {
  return degree == affine ? affine_rule(outline) : polygon_rule(outline, degree);
}

bool rule_lasts(const RuledOverlap& overlap, const std::vector<double>& gaps, double tolerance,
                const NormalSpring& spring) {
  constexpr int to_stay = 2;  // a rule lasts while the joint closes a little further
  if (degree_for_spring(gaps, overlap.degree, spring) > overlap.degree + to_stay) return false;
  if (overlap.degree == affine && may_open_in_part(gaps, tolerance)) return false;
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  const bool may_end = !gaps.empty() && -*least > tolerance && *most > tolerance;
  if (!overlap.end && !may_end) return true;
  const PolygonRule rule = rule_of(overlap.outline, overlap.degree);
  const std::optional<PressureEnd> end = end_of_pressure(overlap.outline, rule, gaps, tolerance, overlap.end);
  if (!end || !overlap.end) return !end && !overlap.end;
  return end->point == overlap.end->point && end->open == overlap.end->open;
}

namespace {

ContactPoints points_of(const ContactBody& a, const ContactBody& b, const PairContacts& contacts,
                        const std::vector<bool>& references_on_a, const ContactPointSettings& settings,
                        const std::vector<PressureCut>& known, const std::vector<FacePair>& turning) {
  const Search search{a, b, contacts.overlaps, settings, known, turning};
  ContactPoints result;
  if (settings.area_springs) {
    for (const JoinedOverlap& joined : join_whole_faces(a, b, contacts.overlaps, settings.curved))
      add_area_springs(search, joined, references_on_a[joined.cells.front()], result);
  } else {
    for (const FaceOverlap& face : join_by_faces(*a.placed, *b.placed, contacts.overlaps))
      add_point_springs(search, face, contacts.overlaps, references_on_a[at(face.cells.front())],
                        result.points);
  }
  for (const VertexContact& contact : contacts.vertices) add_vertex(a, b, contact, settings, result.points);
  for (const EdgeContact& contact : contacts.edges) add_edge(a, b, contact, settings, result.points);
  result.points.shrink_to_fit();  // they may be cached
  result.turning = turning;
  return result;
}

}  // namespace

ContactPoints contact_points(const ContactBody& a, const ContactBody& b, const PairContacts& contacts,
                             const std::vector<bool>& references_on_a, const ContactPointSettings& settings,
                             const std::vector<PressureCut>& known, const std::vector<FacePair>& turning) {
  if (!settings.curved) return points_of(a, b, contacts, references_on_a, settings, known, turning);
  const PlacedBlock of_a(*a.model, a.state->position);
  const PlacedBlock of_b(*b.model, b.state->position);
  return points_of({a.model, a.state, a.placed, &of_a}, {b.model, b.state, b.placed, &of_b}, contacts,
                   references_on_a, settings, known, turning);
}

}  // namespace ashlar
