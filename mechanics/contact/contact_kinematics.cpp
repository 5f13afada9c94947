#include "mechanics/contact/contact_kinematics.hpp"

#include "geometry/index.hpp"
#include "geometry/subfaces/view_frame.hpp"

namespace ashlar {
namespace {

/// Number of corrections of a closest point: the first is exact for affine blocks. For others each reduces the error
/// by the factor gap times curvature; the limit only omits corrections below rounding error.
int corrections_of(const BlockModel& model) {
  constexpr int most = 8;
  return is_affine(model) ? 1 : most;
}

/// Size of a correction that is within rounding error, m.
double rounding_of(const BlockModel& model) {
  return 1e-14 * model.size();
}

struct Foot {
  Vector3 material;
  Vector3 place;
  Vector3 normal;  ///< outward normal of its block
};

/// Closest point of a face's polynomial surface to a point, by Gauss-Newton in the face's plane from a start
/// on it.
Foot closest_point(const PlacedBlock& block, int face, const Vector3& start, const Vector3& target) {
  const ViewFrame plane(start, block.model().solid().faces()[at(face)].normal);
  Eigen::Matrix<double, 3, 2> directions;
  directions << plane.e1, plane.e2;
  Foot foot{start, Vector3::Zero(), Vector3::Zero()};
  const int corrections = corrections_of(block.model());
  for (int step = 0; step <= corrections; ++step) {
    const PlacedBlock::Local local = block.at(foot.material);
    foot.place = local.place;
    const Eigen::Matrix<double, 3, 2> tangents = local.gradient * directions;
    foot.normal = tangents.col(0).cross(tangents.col(1)).normalized();
    const Eigen::Matrix2d metric = tangents.transpose() * tangents;
    const Eigen::Vector2d change = metric.inverse() * (tangents.transpose() * (target - foot.place));
    if (step == corrections || (tangents * change).norm() <= rounding_of(block.model())) break;
    foot.material += directions * change;
  }
  return foot;
}

/// Moves the material points to the closest points of the two edges. @return false if an edge ends long before
bool set_crossing(ContactPoint& point, const PlacedBlock& a, const PlacedBlock& b) {
  const Vector3 last_normal = point.normal;
  const int corrections = std::max(corrections_of(a.model()), corrections_of(b.model()));
  const double smallest = std::max(rounding_of(a.model()), rounding_of(b.model()));
  Eigen::Vector2d shares = Eigen::Vector2d::Zero();  // of the edges, relative to the detected point
  const ContactPoint found = point;
  for (int step = 0; step <= corrections; ++step) {
    Eigen::Matrix<double, 3, 2> lines;
    lines << a.at(point.material_a).gradient * point.edge_a,
        -(b.at(point.material_b).gradient * point.edge_b);
    point.normal = lines.col(1).cross(lines.col(0)).normalized();
    if (point.normal.dot(last_normal) < 0.0) point.normal = -point.normal;
    const Eigen::Matrix2d metric = lines.transpose() * lines;
    const Eigen::Vector2d change = metric.inverse() * (lines.transpose() * (point.place_b - point.place_a));
    if (step == corrections || (lines * change).norm() <= smallest) break;
    shares += change;
    if (!(shares.cwiseAbs().maxCoeff() <= 1.0)) return false;
    point.material_a = found.material_a + shares[0] * point.edge_a;
    point.material_b = found.material_b + shares[1] * point.edge_b;
    point.place_a = a.place(point.material_a);
    point.place_b = b.place(point.material_b);
  }
  return true;
}

}  // namespace

PlacedBlock::PlacedBlock(const BlockModel& model, const Eigen::MatrixX3d& position)
    : model_(&model), position_(&position), affine_(is_affine(model)) {
  const PolynomialBasis& basis = model.basis();
  if (affine_) {
    centroid_.place = position.transpose() * basis.values(basis.centroid());
    centroid_.gradient = position.transpose() * basis.gradients(basis.centroid());
    return;
  }
  coefficients_.resize(position.rows(), 9);
  for (int axis = 0; axis < 3; ++axis)
    coefficients_.middleCols<3>(3 * axis).noalias() =
        basis.derivative(axis).transpose().triangularView<Eigen::Upper>() * position;
}

Vector3 PlacedBlock::place(const Vector3& material) const {
  if (affine_) return centroid_.place + centroid_.gradient * (material - model_->basis().centroid());
  return position_->transpose() * model_->basis().values(material);
}

PlacedBlock::Local PlacedBlock::at(const Vector3& material) const {
  if (affine_) return {place(material), centroid_.gradient};
  const Eigen::VectorXd phi = model_->basis().values(material);
  const Eigen::Matrix<double, 9, 1> columns = coefficients_.transpose() * phi;
  return {position_->transpose() * phi, columns.reshaped(3, 3)};
}

bool is_affine(const BlockModel& model) {
  return model.fixed() || model.order() == 1;
}

void set_foot(ContactPoint& point, const PlacedBlock& master, int face, bool master_is_a) {
  const Foot foot = closest_point(master, face, master_is_a ? point.material_a : point.material_b,
                                  master_is_a ? point.place_b : point.place_a);
  (master_is_a ? point.material_a : point.material_b) = foot.material;
  (master_is_a ? point.place_a : point.place_b) = foot.place;
  point.normal = master_is_a ? Vector3(-foot.normal) : foot.normal;
}

void complete(ContactPoint& point) {
  const ViewFrame frame(Vector3::Zero(), point.normal);
  point.tangent_1 = frame.e1;
  point.tangent_2 = frame.e2;
  point.gap = point.normal.dot(point.place_a - point.place_b);
}

ContactPoint moved_to(const ContactPoint& point, const PlacedBlock& a, const PlacedBlock& b) {
  ContactPoint moved = point;
  moved.place_a = a.place(moved.material_a);
  moved.place_b = b.place(moved.material_b);
  const ContactPoint kept = moved;
  switch (point.source) {
    case NormalSource::as_found:
      break;
    case NormalSource::face_of_a:
      set_foot(moved, a, point.face_a, true);
      break;
    case NormalSource::face_of_b:
      set_foot(moved, b, point.face_b, false);
      break;
    case NormalSource::edges:
      if (!set_crossing(moved, a, b)) moved = kept;
      break;
  }
  const auto turn = Eigen::Quaterniond::FromTwoVectors(point.normal, moved.normal);
  moved.tangent_1 = turn * point.tangent_1;
  moved.tangent_2 = moved.normal.cross(moved.tangent_1);
  moved.gap = moved.normal.dot(moved.place_a - moved.place_b) + moved.overlap;
  return moved;
}

std::vector<ContactPoint> moved_to(const std::vector<ContactPoint>& points, const PlacedBlock& a,
                                   const PlacedBlock& b) {
  std::vector<ContactPoint> moved;
  moved.reserve(points.size());
  for (const ContactPoint& point : points) moved.push_back(moved_to(point, a, b));
  return moved;
}

}  // namespace ashlar
