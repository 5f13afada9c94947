#include "apps/run/answers/drawing_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {

DrawingView::DrawingView(const Scene& scene, const Simulation& simulation, PlaceOf place)
    : place_(place ? std::move(place) : [](int, const Vector3& point) { return point; }) {
  const Vector3& gravity = scene.analysis.gravity;
  up_ = gravity.squaredNorm() > 0.0 ? Vector3(-gravity.normalized()) : Vector3(Vector3::UnitZ());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Vector3 middle = Vector3::Zero();
  int count = 0;
  for (const BlockModel& block : simulation.blocks()) {
    if (block.fixed()) continue;
    middle += block.basis().centroid();
    ++count;
  }
  middle /= std::max(count, 1);
  for (const BlockModel& block : simulation.blocks()) {
    if (block.fixed()) continue;
    const Vector3 arm = block.basis().centroid() - middle;
    const Vector3 level = arm - arm.dot(up_) * up_;
    spread += level * level.transpose();
  }
  along_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  along_ -= along_.dot(up_) * up_;
  if (along_.norm() < 1e-6) along_ = up_.unitOrthogonal();
  along_.normalize();
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.fixed()) continue;
    for (const Vector3& point : block.solid().mesh().points) {
      const Vector3 placed = place_(static_cast<int>(k), point);
      const Eigen::Vector2d seen(placed.dot(along_), placed.dot(up_));
      low_ = low_.cwiseMin(seen);
      high_ = high_.cwiseMax(seen);
    }
  }
  scale_ = (width_ - 2.0 * margin_) / std::max((high_ - low_).maxCoeff(), 1e-300);
}

std::string DrawingView::at(const Vector3& place) const {
  return fmt::format("{:.2f},{:.2f}", margin_ + scale_ * (place.dot(along_) - low_.x()),
                     margin_ + scale_ * (high_.y() - place.dot(up_)));
}

double DrawingView::height() const {
  return 2.0 * margin_ + scale_ * (high_ - low_).y();
}

std::string DrawingView::head() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
      "height=\"{1:.0f}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width_, height() + 40.0);
}

std::string DrawingView::blocks(const Simulation& simulation) const {
  std::string text;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.fixed()) continue;
    const TriangleMesh& mesh = block.solid().mesh();
    const auto seen = [&](int corner) {
      return at(place_(static_cast<int>(k), mesh.points[ashlar::at(corner)]));
    };
    for (const auto& triangle : mesh.triangles) {
      std::string points;
      for (const int corner : triangle) points += seen(corner) + ' ';
      text += fmt::format(
          "<polygon points=\"{}\" fill=\"#d9d2c3\" stroke=\"#d9d2c3\" stroke-width=\"0.5\"/>\n", points);
    }
    for (const PolyhedronEdge& edge : block.solid().edges())
      text +=
          fmt::format("<polyline points=\"{} {}\" stroke=\"#8a8271\" stroke-width=\"0.7\" fill=\"none\"/>\n",
                      seen(edge.vertices[0]), seen(edge.vertices[1]));
  }
  return text;
}

std::string DrawingView::foot(const std::vector<Note>& notes) const {
  std::string text = fmt::format("<text x=\"{}\" y=\"{:.0f}\" font-family=\"sans-serif\" font-size=\"14\">",
                                 margin_, height() + 20.0);
  for (std::size_t k = 0; k < notes.size(); ++k)
    text += fmt::format("<tspan{} fill=\"{}\">{}</tspan>", k > 0 ? " dx=\"20\"" : "", notes[k].colour,
                        notes[k].text);
  return text + "</text>\n</svg>\n";
}

}  // namespace ashlar
