#include "apps/scene/meshes/dxf_outline.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {
namespace {

bool same_place(const Vector3& a, const Vector3& b) {
  return a.x() == b.x() && a.y() == b.y();
}

double level_area(const std::vector<Vector3>& points) {
  double sum = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector3 a = points[k] - points[0], b = points[(k + 1) % points.size()] - points[0];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

}  // namespace

void add_face(PolygonSoup& soup, const std::vector<Vector3>& corners) {
  for (const Vector3& corner : corners) {
    soup.corners.push_back(static_cast<int>(soup.points.size()));
    soup.points.push_back(corner);
  }
  soup.face_ends.push_back(static_cast<int>(soup.corners.size()));
}

void add_prism(DxfOutline outline, PolygonSoup& soup) {
  std::vector<Vector3>& points = outline.points;
  if (outline.thickness == 0.0 || points.empty()) return;
  const bool returns = points.size() > 1 && same_place(points.front(), points.back());
  if (!outline.closed && !returns) return;
  if (returns) points.pop_back();
  points.erase(std::unique(points.begin(), points.end(), same_place), points.end());
  if (outline.has_arcs)
    throw MeshFileError("arc in an outline with a thickness (bulge, 42), straight edges are needed",
                        outline.line, 1);
  if (!outline.upward)
    throw MeshFileError(
        "outline with a thickness in another plane than xy, allowed is the direction (0, 0, 1) (210, 220, "
        "230)",
        outline.line, 1);
  if (points.size() < 3)
    throw MeshFileError("outline with a thickness has fewer than 3 corners, a polygon is needed",
                        outline.line, 1);
  if (level_area(points) < 0.0) std::reverse(points.begin(), points.end());
  const double low = outline.elevation + std::min(outline.thickness, 0.0);
  const double high = outline.elevation + std::max(outline.thickness, 0.0);
  std::vector<Vector3> bottom, top;
  for (const Vector3& point : points) {
    bottom.emplace_back(point.x(), point.y(), low);
    top.emplace_back(point.x(), point.y(), high);
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t next = (k + 1) % points.size();
    add_face(soup, {bottom[k], bottom[next], top[next], top[k]});
  }
  add_face(soup, top);
  std::reverse(bottom.begin(), bottom.end());
  add_face(soup, bottom);
}

}  // namespace ashlar
