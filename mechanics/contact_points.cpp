#include "mechanics/contact_points.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/quadrature.hpp"

namespace ashlar {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

const SurfaceCell& cell_of(const ContactBody& body, int cell) {
  return body.placed->surface().cells[at(cell)];
}

const Vector3& reference_point(const ContactBody& body, int point) {
  return body.placed->surface().points[at(point)];
}

/// The affine map from places seen along a direction to reference points of a flat cell.
class CellMap {
 public:
  CellMap(const ContactBody& body, int cell, const ViewFrame& frame) {
    const auto& corners = cell_of(body, cell).corners;
    const auto place = [&](std::size_t k) { return frame.project(body.placed->point(corners[k])); };
    // The widest of the triangles at the first corner spans the cell's plane best.
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
  [[nodiscard]] Vector3 reference(const Eigen::Vector2d& place) const {
    return reference_ + reference_slope_ * (place - first_);
  }
  [[nodiscard]] Vector3 placed(const Eigen::Vector2d& place) const {
    return placed_ + placed_slope_ * (place - first_);
  }

 private:
  Eigen::Vector2d first_;
  Vector3 reference_;
  Vector3 placed_;
  Eigen::Matrix<double, 3, 2> reference_slope_;
  Eigen::Matrix<double, 3, 2> placed_slope_;
};

struct Foot {
  Vector3 material;
  Vector3 place;
  Vector3 normal;  ///< outward of the body it is on
};

/// Closest point of a face's polynomial surface to a point, by Gauss-Newton in the face's plane from a start
/// on it. For an affine block it is exact after one step; else the contraction per step is gap times
/// curvature, and the step limit only cuts what is below rounding.
Foot closest_point(const ContactBody& body, int face, const Vector3& start, const Vector3& target) {
  const PolynomialBasis& basis = body.model->basis();
  const ViewFrame plane(start, body.model->solid().faces()[at(face)].normal);
  Eigen::Matrix<double, 3, 2> directions;
  directions << plane.e1, plane.e2;
  Foot foot{start, Vector3::Zero(), Vector3::Zero()};
  constexpr int step_limit = 8;
  const double smallest = 1e-14 * (body.placed->box().high - body.placed->box().low).norm();
  for (int step = 0; step <= step_limit; ++step) {
    foot.place = body.state->position.transpose() * basis.values(foot.material);
    const Eigen::Matrix<double, 3, 2> tangents =
        body.state->position.transpose() * (basis.gradients(foot.material) * directions);
    foot.normal = tangents.col(0).cross(tangents.col(1)).normalized();
    const Eigen::Matrix2d metric = tangents.transpose() * tangents;
    const Eigen::Vector2d change = metric.inverse() * (tangents.transpose() * (target - foot.place));
    if (step == step_limit || (tangents * change).norm() <= smallest) break;
    foot.material += directions * change;
  }
  return foot;
}

Vector3 true_place(const ContactBody& body, const Vector3& material) {
  return body.state->position.transpose() * body.model->basis().values(material);
}

void complete(ContactPoint& point) {
  const ViewFrame frame(Vector3::Zero(), point.normal);
  point.tangent_1 = frame.e1;
  point.tangent_2 = frame.e2;
  point.gap = point.normal.dot(point.place_a - point.place_b);
}

/// Puts the foot of the slave's point on the master's true surface.
void set_foot(ContactPoint& point, const ContactBody& master, int face, bool master_is_a) {
  const Foot foot = closest_point(master, face, master_is_a ? point.material_a : point.material_b,
                                  master_is_a ? point.place_b : point.place_a);
  (master_is_a ? point.material_a : point.material_b) = foot.material;
  (master_is_a ? point.place_a : point.place_b) = foot.place;
  point.normal = master_is_a ? Vector3(-foot.normal) : foot.normal;
}

/// Corners of the polygon with the area that falls to each, for point springs.
PolygonRule corner_rule(const std::vector<Eigen::Vector2d>& polygon) {
  PolygonRule rule;
  double area = 0.0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Eigen::Vector2d u = polygon[k] - polygon[0];
    const Eigen::Vector2d v = polygon[k + 1] - polygon[0];
    area += 0.5 * (u.x() * v.y() - u.y() * v.x());
  }
  rule.points = polygon;
  rule.weights.assign(polygon.size(), area / static_cast<double>(polygon.size()));
  return rule;
}

void add_overlap(const ContactBody& a, const ContactBody& b, const CellOverlap& overlap, bool master_is_a,
                 const ContactPointSettings& settings, std::vector<ContactPoint>& points) {
  std::vector<Eigen::Vector2d> polygon;
  for (const OverlapCorner& corner : overlap.corners) polygon.push_back(corner.place);
  int degree = std::max({2, a.model->order(), b.model->order()});
  if (a.placed->surface().divided || b.placed->surface().divided)
    degree = std::min(degree, settings.max_quadrature_degree);
  const PolygonRule rule = settings.area_springs ? polygon_rule(polygon, degree) : corner_rule(polygon);
  const CellMap map_a(a, overlap.cell_a, overlap.frame);
  const CellMap map_b(b, overlap.cell_b, overlap.frame);
  for (std::size_t k = 0; k < rule.points.size(); ++k) {
    ContactPoint point{};
    point.type = ContactPointType::face_face;
    point.face_a = cell_of(a, overlap.cell_a).face;
    point.face_b = cell_of(b, overlap.cell_b).face;
    point.material_a = map_a.reference(rule.points[k]);
    point.material_b = map_b.reference(rule.points[k]);
    point.area = rule.weights[k];
    if (settings.curved) {
      point.place_a = true_place(a, point.material_a);
      point.place_b = true_place(b, point.material_b);
      set_foot(point, master_is_a ? a : b, master_is_a ? point.face_a : point.face_b, master_is_a);
    } else {
      point.place_a = map_a.placed(rule.points[k]);
      point.place_b = map_b.placed(rule.points[k]);
      point.normal =
          master_is_a ? Vector3(-a.placed->normal(overlap.cell_a)) : b.placed->normal(overlap.cell_b);
    }
    complete(point);
    points.push_back(point);
  }
}

void add_vertex(const ContactBody& a, const ContactBody& b, const VertexContact& contact,
                const ContactPointSettings& settings, std::vector<ContactPoint>& points) {
  const ContactBody& with_vertex = contact.vertex_of_a ? a : b;
  const ContactBody& with_cell = contact.vertex_of_a ? b : a;
  const SurfaceVertex& vertex = with_vertex.placed->surface().vertices[at(contact.vertex)];
  const Vector3& normal = with_cell.placed->normal(contact.cell);
  const Vector3 place = with_vertex.placed->point(vertex.point);
  const Vector3 foot = place - contact.gap * normal;
  const ViewFrame frame(foot, normal);
  const int face = cell_of(with_cell, contact.cell).face;
  const int own_face = cell_of(with_vertex, vertex.cells.front()).face;
  ContactPoint point{};
  point.type = ContactPointType::vertex_face;
  point.face_a = contact.vertex_of_a ? own_face : face;
  point.face_b = contact.vertex_of_a ? face : own_face;
  const Vector3 foot_material = CellMap(with_cell, contact.cell, frame).reference(Eigen::Vector2d::Zero());
  point.material_a = contact.vertex_of_a ? reference_point(a, vertex.point) : foot_material;
  point.material_b = contact.vertex_of_a ? foot_material : reference_point(b, vertex.point);
  point.place_a = contact.vertex_of_a ? place : foot;
  point.place_b = contact.vertex_of_a ? foot : place;
  point.area = contact.area;
  if (settings.curved) {
    set_foot(point, with_cell, face, !contact.vertex_of_a);
  } else {
    point.normal = contact.vertex_of_a ? normal : Vector3(-normal);
  }
  complete(point);
  points.push_back(point);
}

void add_edge(const ContactBody& a, const ContactBody& b, const EdgeContact& contact,
              const ContactPointSettings& settings, std::vector<ContactPoint>& points) {
  const SurfaceEdge& edge_a = a.placed->surface().edges[at(contact.edge_a)];
  const SurfaceEdge& edge_b = b.placed->surface().edges[at(contact.edge_b)];
  const auto between = [](const Vector3& start, const Vector3& end, double share) {
    return Vector3(start + share * (end - start));
  };
  ContactPoint point{};
  point.type = ContactPointType::edge_edge;
  point.face_a = cell_of(a, edge_a.cells[0]).face;
  point.face_b = cell_of(b, edge_b.cells[0]).face;
  point.material_a =
      between(reference_point(a, edge_a.ends[0]), reference_point(a, edge_a.ends[1]), contact.along_a);
  point.material_b =
      between(reference_point(b, edge_b.ends[0]), reference_point(b, edge_b.ends[1]), contact.along_b);
  if (settings.curved) {
    point.place_a = true_place(a, point.material_a);
    point.place_b = true_place(b, point.material_b);
  } else {
    point.place_a =
        between(a.placed->point(edge_a.ends[0]), a.placed->point(edge_a.ends[1]), contact.along_a);
    point.place_b =
        between(b.placed->point(edge_b.ends[0]), b.placed->point(edge_b.ends[1]), contact.along_b);
  }
  point.normal = contact.normal;
  point.area = contact.area;
  complete(point);
  points.push_back(point);
}

}  // namespace

std::vector<Vector3> placed_points(const Eigen::MatrixXd& phi, const BlockState& state) {
  const Eigen::MatrixX3d places = phi * state.position;
  std::vector<Vector3> points;
  points.reserve(static_cast<std::size_t>(places.rows()));
  for (Eigen::Index k = 0; k < places.rows(); ++k) points.emplace_back(places.row(k));
  return points;
}

bool first_is_master(const ContactBody& a, const ContactBody& b) {
  if (a.model->fixed() != b.model->fixed()) return a.model->fixed();
  const bool divided_a = a.placed->surface().divided;
  const bool divided_b = b.placed->surface().divided;
  if (divided_a != divided_b) return !divided_a;
  return a.model->basis().volume() > b.model->basis().volume();
}

std::vector<ContactPoint> contact_points(const ContactBody& a, const ContactBody& b,
                                         const PairContacts& contacts, const ContactPointSettings& settings) {
  std::vector<ContactPoint> points;
  const bool master_is_a = first_is_master(a, b);
  for (const CellOverlap& overlap : contacts.overlaps)
    add_overlap(a, b, overlap, master_is_a, settings, points);
  for (const VertexContact& contact : contacts.vertices) add_vertex(a, b, contact, settings, points);
  for (const EdgeContact& contact : contacts.edges) add_edge(a, b, contact, settings, points);
  return points;
}

}  // namespace ashlar
