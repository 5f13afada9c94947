#include "mechanics/contact/overlap_points.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/index.hpp"
#include "mechanics/contact/overlap_outline.hpp"

namespace ashlar {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

const PolyhedronFace& face_of(const ContactBody& body, int cell) {
  return body.model->solid().faces()[at(cell_of(body, cell).face)];
}

/// By face: cells.
std::vector<std::size_t> cells_of_faces(const ContactBody& body) {
  std::vector<std::size_t> count(body.model->solid().faces().size(), 0);
  for (const SurfaceCell& cell : body.placed->surface().cells) ++count[at(cell.face)];
  return count;
}

/// Current places of the corners of a face.
std::vector<Vector3> placed_corners(const ContactBody& body, const PolyhedronFace& face) {
  std::vector<Vector3> places;
  places.reserve(face.loops.front().size());
  for (const int corner : face.loops.front())
    places.push_back(body.configuration->place(body.model->solid().mesh().points[at(corner)]));
  return places;
}

/// Unit area vector of a face between its corners, independent of its triangles.
Vector3 normal_of_corners(const std::vector<Vector3>& corners) {
  Vector3 area = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    area += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
  return area.normalized();
}

/// For two cells, that of their overlap; for whole faces, which may be warped, along the mean of both normals.
ViewFrame frame_of(const ContactBody& a, const ContactBody& b, const CellOverlap& cells, bool whole) {
  if (!whole) return cells.frame;
  const Vector3 normal_a = normal_of_corners(placed_corners(a, face_of(a, cells.cell_a)));
  const Vector3 normal_b = normal_of_corners(placed_corners(b, face_of(b, cells.cell_b)));
  return {cells.frame.origin, normal_b - normal_a};
}

/// Projection of a face against w: counter-clockwise.
Corners seen_corners(const ContactBody& body, const PolyhedronFace& face, const ViewFrame& frame,
                     bool towards_viewer) {
  Corners corners;
  for (const Vector3& place : placed_corners(body, face)) corners.push_back(frame.project(place));
  if (!towards_viewer) std::reverse(corners.begin(), corners.end());
  return corners;
}

/// The part of a polygon to the left of a line.
Corners left_of(const Corners& polygon, const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  const Eigen::Vector2d along = end - start;
  return part_under_pressure(polygon, {start, Eigen::Vector2d(along.y(), -along.x())});
}

/// The overlap of two whole faces.
Corners overlap_of_faces(const ContactBody& a, const ContactBody& b, const CellOverlap& cells,
                         const ViewFrame& frame) {
  Corners polygon = seen_corners(a, face_of(a, cells.cell_a), frame, false);
  const Corners other = seen_corners(b, face_of(b, cells.cell_b), frame, true);
  for (std::size_t k = 0; k < other.size() && !polygon.empty(); ++k)
    polygon = left_of(polygon, other[k], other[(k + 1) % other.size()]);
  return polygon;
}

/// @param normal out of b, reference configuration; zero: edges are parallel
void count_from(const Vector3& normal, double known, ContactPoint& point) {
  point.overlap = std::clamp(-normal.dot(point.material_a - point.material_b), 0.0, known);
  point.gap += point.overlap;
}

}  // namespace

CellMap::CellMap(const ContactBody& body, int cell, const ViewFrame& frame) {
  const auto& corners = cell_of(body, cell).corners;
  const auto place = [&](std::size_t k) { return frame.project(body.placed->point(corners[k])); };
  // The widest of the triangles at the first corner determines the cell's plane best.
  double widest = 0.0;
  const Eigen::Vector2d first = place(0);
  std::size_t best = 1;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Eigen::Vector2d u = place(k) - first;
    const Eigen::Vector2d v = place(k + 1) - first;
    const double area = std::abs(u.x() * v.y() - u.y() * v.x());
    if (area > widest) {
      widest = area;
      best = k;
    }
  }
  Eigen::Matrix2d sides;
  sides << place(best) - first, place(best + 1) - first;
  Eigen::Matrix<double, 3, 2> reference_sides;
  reference_sides << reference_point(body, corners[best]) - reference_point(body, corners[0]),
      reference_point(body, corners[best + 1]) - reference_point(body, corners[0]);
  Eigen::Matrix<double, 3, 2> placed_sides;
  placed_sides << body.placed->point(corners[best]) - body.placed->point(corners[0]),
      body.placed->point(corners[best + 1]) - body.placed->point(corners[0]);
  const Eigen::Matrix2d inverse = sides.inverse();
  first_ = first;
  reference_ = reference_point(body, corners[0]);
  reference_slope_ = reference_sides * inverse;
  placed_ = body.placed->point(corners[0]);
  placed_slope_ = placed_sides * inverse;
}

Eigen::Vector2d CellMap::place(const Vector3& reference) const {
  const Eigen::Matrix2d squares = reference_slope_.transpose() * reference_slope_;
  return first_ + squares.inverse() * (reference_slope_.transpose() * (reference - reference_));
}

void count_from_placement(const ContactBody& a, const ContactBody& b, bool master_is_a, double known,
                          ContactPoint& point) {
  if (known == 0.0) return;
  const Vector3 normal = master_is_a ? Vector3(-a.model->solid().faces()[at(point.face_a)].normal)
                                     : b.model->solid().faces()[at(point.face_b)].normal;
  count_from(normal, known, point);
}

void count_from_placement_of_edges(const ContactBody& a, const ContactBody& b, double known,
                                   ContactPoint& point) {
  if (known == 0.0) return;
  const Vector3 across = point.edge_a.cross(point.edge_b).normalized();
  const Vector3 out_of_b =
      b.model->solid().faces()[at(point.face_b)].normal - a.model->solid().faces()[at(point.face_a)].normal;
  count_from(across.dot(out_of_b) < 0.0 ? Vector3(-across) : across, known, point);
}

bool has_true_places(const ContactBody& a, const ContactBody& b, bool curved) {
  return curved || (is_affine(*a.model) && is_affine(*b.model));
}

std::vector<JoinedOverlap> join_whole_faces(const ContactBody& a, const ContactBody& b,
                                            const std::vector<CellOverlap>& overlaps, bool curved) {
  std::vector<JoinedOverlap> result;
  const bool divided = a.placed->surface().divided || b.placed->surface().divided;
  if (!curved || !divided) {
    for (std::size_t n = 0; n < overlaps.size(); ++n) result.push_back({{n}, false});
    return result;
  }
  const std::vector<std::size_t> cells_a = cells_of_faces(a);
  const std::vector<std::size_t> cells_b = cells_of_faces(b);
  const auto is_whole = [](const ContactBody& body, int cell, const std::vector<std::size_t>& cells) {
    const std::size_t count = cells[at(cell_of(body, cell).face)];
    return face_of(body, cell).convex && (count == 1 || count == face_of(body, cell).triangles.size());
  };
  std::map<std::array<int, 2>, std::size_t> joined;  // of faces
  for (std::size_t n = 0; n < overlaps.size(); ++n) {
    const int cell_a = overlaps[n].cell_a;
    const int cell_b = overlaps[n].cell_b;
    const std::array<int, 2> faces{cell_of(a, cell_a).face, cell_of(b, cell_b).face};
    if (!is_whole(a, cell_a, cells_a) || !is_whole(b, cell_b, cells_b) ||
        (cells_a[at(faces[0])] == 1 && cells_b[at(faces[1])] == 1)) {
      result.push_back({{n}, false});
      continue;
    }
    const auto [place, added] = joined.try_emplace(faces, result.size());
    if (added) result.push_back({{}, true});
    result[place->second].cells.push_back(n);
  }
  return result;
}

OverlapPoints::OverlapPoints(const ContactBody& a, const ContactBody& b, const CellOverlap& cells, bool whole,
                             bool master_is_a, const ContactPointSettings& settings)
    : a_(a),
      b_(b),
      cells_(cells),
      whole_(whole),
      master_is_a_(master_is_a),
      curved_(settings.curved),
      known_overlap_(settings.known_overlap),
      frame_(frame_of(a, b, cells, whole)),
      map_a_(a, cells.cell_a, frame_),
      map_b_(b, cells.cell_b, frame_),
      polygon_(whole ? overlap_of_faces(a, b, cells, frame_) : places_of(cells)) {
  if (!whole_ || polygon_.empty()) return;
  for (const Eigen::Vector2d& corner : polygon_) middle_ += corner;
  middle_ /= static_cast<double>(polygon_.size());
  if (follows(true)) tangent_a_ = seen_at(true, middle_, map_a_.reference(middle_));
  if (follows(false)) tangent_b_ = seen_at(false, middle_, map_b_.reference(middle_));
}

OverlapPoints::Tangent OverlapPoints::seen_at(bool of_a, const Eigen::Vector2d& place,
                                              const Vector3& start) const {
  constexpr int most_corrections = 8;
  const double rounding = 1e-14 * body(of_a).placed->size();
  const ViewFrame plane(Vector3::Zero(), face_of(body(of_a), cell(of_a)).normal);
  Eigen::Matrix<double, 3, 2> directions;
  directions << plane.e1, plane.e2;
  Eigen::Matrix<double, 2, 3> seen;
  seen << frame_.e1.transpose(), frame_.e2.transpose();
  Tangent result;
  result.reference = start;
  for (int step = 0; step <= most_corrections; ++step) {
    const PlacedBlock::Local local = body(of_a).configuration->at(result.reference);
    const Eigen::Matrix2d slope = seen * local.gradient * directions;
    result.slope = directions * slope.inverse();
    const Eigen::Vector2d off = place - frame_.project(local.place);
    if (step == most_corrections || off.norm() <= rounding) break;
    result.reference += result.slope * off;
  }
  return result;
}

Vector3 OverlapPoints::reference(bool of_a, const Eigen::Vector2d& place) const {
  if (!follows(of_a)) return map(of_a).reference(place);
  const Tangent& tangent = of_a ? tangent_a_ : tangent_b_;
  return tangent.reference + tangent.slope * (place - middle_);
}

Eigen::Vector2d OverlapPoints::place(bool of_a, const Vector3& reference) const {
  if (!follows(of_a)) return map(of_a).place(reference);
  const Tangent& tangent = of_a ? tangent_a_ : tangent_b_;
  const Eigen::Matrix2d squares = tangent.slope.transpose() * tangent.slope;
  return middle_ + squares.inverse() * (tangent.slope.transpose() * (reference - tangent.reference));
}

ContactPoint OverlapPoints::at_place(const Eigen::Vector2d& place, double area) const {
  const auto material = [&](bool of_a) {
    const Vector3 near = reference(of_a, place);
    return follows(of_a) ? seen_at(of_a, place, near).reference : near;
  };
  ContactPoint point{};
  point.type = ContactPointType::face_face;
  point.face_a = cell_of(a_, cells_.cell_a).face;
  point.face_b = cell_of(b_, cells_.cell_b).face;
  point.material_a = material(true);
  point.material_b = material(false);
  point.area = area;
  if (has_true_places(a_, b_, curved_))
    point.source = master_is_a_ ? NormalSource::face_of_a : NormalSource::face_of_b;
  if (curved_) {
    point.place_a = a_.configuration->place(point.material_a);
    point.place_b = b_.configuration->place(point.material_b);
    set_foot(point, *(master_is_a_ ? a_ : b_).configuration, master_is_a_ ? point.face_a : point.face_b,
             master_is_a_);
  } else {
    point.place_a = map_a_.placed(place);
    point.place_b = map_b_.placed(place);
    point.normal =
        master_is_a_ ? Vector3(-a_.placed->normal(cells_.cell_a)) : b_.placed->normal(cells_.cell_b);
  }
  complete(point);
  count_from_placement(a_, b_, master_is_a_, known_overlap_, point);
  return point;
}

}  // namespace ashlar
