#include "apps/scene/meshes/shape_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/lexicographic.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

/// Sign of the determinant of the linear part, scaled so that products stay in the range of double precision.
double orientation(const Eigen::Affine3d& transformation, const std::string& name) {
  const double largest = transformation.matrix().cwiseAbs().maxCoeff();
  if (!transformation.matrix().allFinite() || largest > largest_coordinate)
    throw MeshFileError(
        fmt::format("transformation of \"{}\" is too large, allowed -1e150 to 1e150", printable(name)), 0, 0);
  const Eigen::Matrix3d linear = transformation.linear();
  const double scale = linear.cwiseAbs().maxCoeff();
  const double determinant = scale > 0.0 ? (linear / scale).determinant() : 0.0;
  if (determinant == 0.0)
    throw MeshFileError(
        fmt::format("transformation of \"{}\" is singular, allowed are those that keep a volume",
                    printable(name)),
        0, 0);
  return determinant;
}

void check_name(const std::string& name) {
  if (name.size() > longest_object_name)
    throw MeshFileError(fmt::format("name of {} bytes (\"{}\"), allowed up to {}", name.size(),
                                    printable(name), longest_object_name),
                        0, 0);
  const auto is_control = [](unsigned char c) { return c < ' ' || c == '\x7f'; };
  if (std::any_of(name.begin(), name.end(), is_control))
    throw MeshFileError(fmt::format("name with a control character (\"{}\"), allowed are printed characters",
                                    printable(name)),
                        0, 0);
}

}  // namespace

LayoutSize& LayoutSize::operator+=(const LayoutSize& other) {
  placements += other.placements;
  faces += other.faces;
  return *this;
}

LayoutLimits layout_limits(std::size_t bytes) {
  constexpr std::size_t a_byte = 50;
  constexpr std::size_t always = 100'000;
  constexpr std::size_t most = 500'000'000;  // corners are counted in int
  const LayoutLimits usual;
  const std::size_t small = std::clamp(a_byte * bytes, always, usual.faces);
  const std::size_t faces = std::min(std::max(small, bytes), most);
  return {faces, faces / 4};
}

PolygonSoup only_used_points(PolygonSoup soup) {
  std::vector<int> place(soup.points.size(), -1);
  for (const int corner : soup.corners) place[static_cast<std::size_t>(corner)] = 0;
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] < 0) continue;
    place[i] = static_cast<int>(points.size());
    points.push_back(soup.points[i]);
  }
  soup.points = std::move(points);
  for (int& corner : soup.corners) corner = place[static_cast<std::size_t>(corner)];
  return soup;
}

PolygonSoup equal_points_joined(PolygonSoup soup) {
  const auto point = [&](int i) -> const Vector3& { return soup.points[static_cast<std::size_t>(i)]; };
  std::vector<int> order(soup.points.size());
  std::iota(order.begin(), order.end(), 0);
  // Sorts equal points side by side, in the order of the file.
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return lexicographically_less(point(a), point(b)) || (point(a) == point(b) && a < b);
  });
  std::vector<int> first(soup.points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool repeated = k > 0 && point(order[k]) == point(order[k - 1]);
    first[static_cast<std::size_t>(order[k])] =
        repeated ? first[static_cast<std::size_t>(order[k - 1])] : order[k];
  }
  for (int& corner : soup.corners) corner = first[static_cast<std::size_t>(corner)];
  return only_used_points(std::move(soup));
}

std::size_t ShapeLayout::add(PolygonSoup shape) {
  shapes_.push_back(only_used_points(std::move(shape)));
  return shapes_.size() - 1;
}

void ShapeLayout::require_room(const LayoutSize& size) const {
  if (size.placements > static_cast<double>(limits_.placements))
    throw MeshFileError(fmt::format("objects are placed more than {} times, which is what is allowed of a "
                                    "file of this size",
                                    limits_.placements),
                        0, 0);
  if (size.faces > static_cast<double>(limits_.faces))
    throw MeshFileError(
        fmt::format("placed objects have more than {} faces, which is what is allowed of a file of this size",
                    limits_.faces),
        0, 0);
}

void ShapeLayout::place(const std::string& name, std::size_t shape, const Eigen::Affine3d& transformation) {
  size_ += {1.0, static_cast<double>(faces(shape))};
  require_room(size_);
  if (faces(shape) == 0) return;
  check_name(name);
  const bool mirrored = orientation(transformation, name) < 0.0;
  const std::string kept = name.empty() ? "object" : name;
  const auto [number, is_new] = number_of_name_.emplace(kept, names_.size());
  if (is_new) names_.push_back(kept);
  placements_.push_back({number->second, shape, transformation, mirrored});
}

std::vector<ShapeLayout::Group> ShapeLayout::grouped() const {
  struct Known {
    std::size_t group = 0;  ///< the first of the name
    int count = 0;
  };
  std::vector<Group> groups;
  std::vector<Known> known(names_.size());
  for (std::size_t k = 0; k < placements_.size(); ++k) {
    const std::string& name = names_[placements_[k].name];
    auto& [group, count] = known[placements_[k].name];
    if (++count > 1 && same_name_ == SameName::joined) {
      groups[group].placements.push_back(k);
      continue;
    }
    if (count == 1) group = groups.size();
    groups.push_back({count == 1 ? name : fmt::format("{}_{}", name, count), {k}});
  }
  return groups;
}

void ShapeLayout::append(const Placement& placement, PolygonSoup& soup) const {
  const PolygonSoup& shape = shapes_[placement.shape];
  const int offset = static_cast<int>(soup.points.size());
  for (const Vector3& point : shape.points) {
    // Removes the sign of zero: -0 and 0 are one point.
    const Vector3 placed = (placement.transformation * point).array() + 0.0;
    for (const double coordinate : placed)
      if (!(std::abs(coordinate) <= largest_coordinate))
        throw MeshFileError(
            fmt::format("coordinate of a placed object ({}), allowed -1e150 to 1e150", coordinate), 0, 0);
    soup.points.push_back(placed);
  }
  for (std::size_t f = 0; f < shape.face_count(); ++f) {
    const std::size_t begin = soup.corners.size();
    for (const int corner : shape.face(f)) soup.corners.push_back(corner + offset);
    if (placement.mirrored)
      std::reverse(soup.corners.begin() + static_cast<std::ptrdiff_t>(begin) + 1, soup.corners.end());
    soup.face_ends.push_back(static_cast<int>(soup.corners.size()));
  }
}

void ShapeLayout::require_faces() const {
  if (placements_.empty()) throw MeshFileError("file has no faces", 0, 0);
}

TriangleMesh ShapeLayout::whole() const {
  require_faces();
  PolygonSoup soup;
  for (const Group& group : grouped())
    for (const std::size_t k : group.placements) append(placements_[k], soup);
  return triangulated(equal_points_joined(std::move(soup)));
}

std::vector<MeshGroup> ShapeLayout::groups() const {
  require_faces();
  std::vector<MeshGroup> meshes;
  for (const Group& group : grouped()) {
    PolygonSoup soup;
    for (const std::size_t k : group.placements) append(placements_[k], soup);
    meshes.push_back({group.name, triangulated(equal_points_joined(std::move(soup)))});
  }
  return meshes;
}

}  // namespace ashlar
