#include "geometry/cutting/cell_complex.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "geometry/cutting/plane_regions.hpp"

namespace ashlar {

std::vector<std::span<const int>> loops_of(const FaceOutline& outline) {
  std::vector<std::span<const int>> loops;
  const std::span<const int> points(outline.points);
  std::size_t start = 0;
  for (const int hole : outline.holes) {
    loops.push_back(points.subspan(start, static_cast<std::size_t>(hole) - start));
    start = static_cast<std::size_t>(hole);
  }
  loops.push_back(points.subspan(start));
  return loops;
}

std::vector<OutlineSide> sides_of(const FaceOutline& outline) {
  std::vector<OutlineSide> sides;
  for (const std::span<const int> loop : loops_of(outline))
    for (std::size_t k = 0; k < loop.size(); ++k)
      sides.push_back({loop[k], loop[(k + 1) % loop.size()], outline.edges[sides.size()]});
  return sides;
}

int CellComplex::add_plane(const ExactPlane& plane) {
  planes_.push_back(plane);
  return static_cast<int>(planes_.size()) - 1;
}

int CellComplex::add_point(ComplexPoint point) {
  points_.push_back(std::move(point));
  return static_cast<int>(points_.size()) - 1;
}

int CellComplex::add_edge(int from, int to, std::array<int, 2> planes) {
  edges_.push_back({{from, to}, planes, {}});
  return static_cast<int>(edges_.size()) - 1;
}

int CellComplex::add_cell(const ConvexShape& shape) {
  const int cell = cell_count(), first_face = static_cast<int>(faces_.size());
  cells_.emplace_back();
  std::vector<RationalVector> corners;
  const int first_point = static_cast<int>(points_.size());
  for (const Vector3& corner : shape.corners()) {
    add_point({ExactPoint::of(corner), {}});
    corners.push_back(to_rational(corner));
  }
  for (int f = 0; f < shape.facet_count(); ++f) {
    const auto loop = shape.facet(f);
    const int plane = add_plane(ExactPlane::through(corners[loop[0]], corners[loop[1]], corners[loop[2]]));
    ComplexFace face;
    face.plane = plane;
    face.cells = {cell, -1};
    for (const int corner : loop) {
      face.points.push_back(first_point + corner);
      points_[first_point + corner].planes.push_back(plane);
    }
    cells_[cell].faces.push_back(static_cast<int>(faces_.size()));
    faces_.push_back(std::move(face));
  }
  const int first_edge = static_cast<int>(edges_.size());
  for (const ConvexEdge& edge : shape.edges()) {
    const int left = first_face + edge.facets[0], right = first_face + edge.facets[1];
    const int index = add_edge(first_point + edge.corners[0], first_point + edge.corners[1],
                               {faces_[left].plane, faces_[right].plane});
    edges_[index].faces = {left, right};
  }
  for (int f = 0; f < shape.facet_count(); ++f)
    for (const int edge : shape.edges_of_facet(f)) faces_[first_face + f].edges.push_back(first_edge + edge);
  return cell;
}

int CellComplex::seam_point(const ExactPoint& place, int plane, CellSeams& seams) {
  const auto [found, is_new] = seams.points.emplace(std::array{place.x, place.y, place.z, place.w}, -1);
  if (is_new) found->second = add_point({place, {}});
  std::vector<int>& planes = points_[found->second].planes;
  if (std::find(planes.begin(), planes.end(), plane) == planes.end()) planes.push_back(plane);
  return found->second;
}

int CellComplex::seam_edge(int from, int to, int plane, CellSeams& seams) {
  const auto [found, is_new] = seams.edges.emplace(std::array{std::min(from, to), std::max(from, to)}, -1);
  if (is_new) found->second = add_edge(from, to, {plane, -1});
  std::array<int, 2>& planes = edges_[found->second].planes;
  if (planes[0] != plane && planes[1] < 0) planes[1] = plane;
  return found->second;
}

int CellComplex::add_cell(const std::vector<CellFace>& faces, CellSeams& seams) {
  const int cell = cell_count();
  cells_.emplace_back();
  for (const CellFace& of : faces) {
    std::vector<int> points;
    for (const ExactPoint& place : of.loop) points.push_back(seam_point(place, of.plane, seams));
    std::vector<int> sorted = points;
    std::sort(sorted.begin(), sorted.end());
    const auto [found, is_new] = seams.faces.emplace(std::move(sorted), static_cast<int>(faces_.size()));
    cells_[cell].faces.push_back(found->second);
    if (is_new) {
      ComplexFace face;
      face.points = points;
      face.plane = of.plane;
      face.mark = of.mark;
      for (std::size_t k = 0; k < points.size(); ++k) {
        face.edges.push_back(seam_edge(points[k], points[(k + 1) % points.size()], of.plane, seams));
        edges_[face.edges.back()].faces.push_back(found->second);
      }
      faces_.push_back(std::move(face));
    }
    faces_[found->second].cells[of.below ? 0 : 1] = cell;
  }
  return cell;
}

std::vector<int> CellComplex::points_of(int cell) const {
  std::vector<int> points;
  for (const int face : cells_[cell].faces)
    points.insert(points.end(), faces_[face].points.begin(), faces_[face].points.end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

int CellComplex::side(int plane, int point) const {
  ComplexPoint& of = points_[point];
  if (const auto quick = planes_[plane].quick_side(of.place.rounded)) return *quick;
  if (std::find(of.planes.begin(), of.planes.end(), plane) != of.planes.end()) return 0;
  const int side = planes_[plane].side(of.place);
  if (side == 0) of.planes.push_back(plane);
  return side;
}

int CellComplex::side_of_cell(int plane, int cell) const {
  int found = 0;
  for (const int face : cells_[cell].faces) {
    for (const int point : faces_[face].points) {
      const int of_point = side(plane, point);
      if (of_point * found < 0) return 0;
      if (of_point != 0) found = of_point;
    }
  }
  return found;
}

// The point is added to the loops of all faces around the edge.
void CellComplex::divide_edge(int edge, int plane) {
  const auto [from, to] = edges_[edge].points;
  const auto [p, q] = edges_[edge].planes;
  std::optional<ExactPoint> place = common_point(planes_[p], planes_[q], planes_[plane]);
  if (!place) throw std::logic_error("a plane that parts an edge has a common point with it");
  const int middle = add_point({std::move(*place), {p, q, plane}});
  edges_[edge].points = {from, middle};
  const int rest = add_edge(middle, to, {p, q});
  edges_[rest].faces = edges_[edge].faces;
  for (const int index : edges_[rest].faces) {
    ComplexFace& face = faces_[index];
    for (auto k = static_cast<int>(face.edges.size()) - 1; k >= 0; --k) {
      if (face.edges[k] != edge) continue;
      const bool forward = face.points[k] == from;
      face.points.insert(face.points.begin() + k + 1, middle);
      face.edges.insert(face.edges.begin() + (forward ? k + 1 : k), rest);
      for (int& hole : face.holes)
        if (hole > k) ++hole;
    }
  }
}

// The face keeps the part below.
void CellComplex::divide_convex_face(int index, int plane) {
  const std::vector<int> edges = faces_[index].edges;
  for (const int edge : edges)
    if (side(plane, edges_[edge].points[0]) * side(plane, edges_[edge].points[1]) < 0)
      divide_edge(edge, plane);
  ComplexFace whole = faces_[index];
  const auto count = static_cast<int>(whole.points.size());
  const auto side_at = [&](int k) { return side(plane, whole.points[k % count]); };
  // The first point of the part above, and of the part below.
  int up = 0, down = 0;
  while (side_at(up) != 0 || side_at(up + 1) != 1) ++up;
  while (side_at(down) != 0 || side_at(down + 1) != -1) ++down;
  const int first = whole.points[up], last = whole.points[down];
  const int line = add_edge(first, last, {whole.plane, plane});
  const auto loop_from = [&](int start, int end, ComplexFace& face) {
    face.points.clear();
    face.edges.clear();
    for (int k = start; k % count != end; ++k) {
      face.points.push_back(whole.points[k % count]);
      face.edges.push_back(whole.edges[k % count]);
    }
    face.points.push_back(whole.points[end]);
    face.edges.push_back(line);
  };
  const int above = static_cast<int>(faces_.size());
  ComplexFace part = whole;
  loop_from(up, down, part);
  loop_from(down, up, faces_[index]);
  for (const int edge : part.edges)
    if (edge != line) std::replace(edges_[edge].faces.begin(), edges_[edge].faces.end(), index, above);
  edges_[line].faces = {index, above};
  for (const int cell : part.cells)
    if (cell >= 0) cells_[cell].faces.push_back(above);
  faces_.push_back(std::move(part));
}

int CellComplex::part(int cell, int plane, int mark) {
  const std::vector<int> faces = cells_[cell].faces;
  for (const int face : faces) {
    bool above = false, below = false;
    for (const int point : faces_[face].points) {
      const int of_point = side(plane, point);
      above = above || of_point > 0;
      below = below || of_point < 0;
    }
    if (above && below) divide_convex_face(face, plane);
  }
  const int upper = cell_count();
  cells_.emplace_back();
  std::vector<int> kept;
  for (const int face : cells_[cell].faces) {
    const std::vector<int>& points = faces_[face].points;
    if (std::any_of(points.begin(), points.end(), [&](int point) { return side(plane, point) > 0; })) {
      cells_[upper].faces.push_back(face);
      exchange_cell(face, cell, upper);
    } else {
      kept.push_back(face);
    }
  }
  cells_[cell].faces = std::move(kept);
  add_section(cell, upper, plane, mark);
  return upper;
}

void CellComplex::exchange_cell(int face, int old_cell, int new_cell) {
  auto& cells = faces_[face].cells;
  std::replace(cells.begin(), cells.end(), old_cell, new_cell);
}

// The sides of the upper cell's faces in the plane, with their direction as seen from outside, run counter-clockwise
// around the section as seen from above.
void CellComplex::add_section(int below, int above, int plane, int mark) {
  std::map<int, std::array<int, 2>> next;  // by point: the next point and the edge to it
  for (const int index : cells_[above].faces) {
    const ComplexFace& face = faces_[index];
    const std::size_t count = face.points.size();
    for (std::size_t k = 0; k < count; ++k) {
      int from = face.points[k], to = face.points[(k + 1) % count];
      if (side(plane, from) != 0 || side(plane, to) != 0) continue;
      if (face.cells[1] == above) std::swap(from, to);
      next[from] = {to, face.edges[k]};
    }
  }
  ComplexFace section;
  section.plane = plane;
  section.cells = {below, above};
  section.mark = mark;
  const int index = static_cast<int>(faces_.size());
  int point = next.begin()->first;
  do {
    const auto [to, edge] = next.at(point);
    section.points.push_back(point);
    section.edges.push_back(edge);
    edges_[edge].faces.push_back(index);
    point = to;
  } while (section.points.size() <= next.size() && point != section.points.front());
  if (section.points.size() != next.size()) throw std::logic_error("the section of a cell is one loop");
  faces_.push_back(std::move(section));
  cells_[below].faces.push_back(index);
  cells_[above].faces.push_back(index);
}

int CellComplex::add_cell(bool convex) {
  cells_.push_back({{}, convex});
  return cell_count() - 1;
}

int CellComplex::add_face(int plane, FaceOutline outline, int mark) {
  ComplexFace face;
  face.plane = plane;
  face.mark = mark;
  faces_.push_back(std::move(face));
  const int index = static_cast<int>(faces_.size()) - 1;
  set_outline(index, std::move(outline));
  return index;
}

void CellComplex::set_outline(int index, FaceOutline outline) {
  ComplexFace& face = faces_[index];
  face.convex = is_convex(*this, planes_[face.plane], outline);
  static_cast<FaceOutline&>(face) = std::move(outline);
  for (const int edge : face.edges) {
    std::vector<int>& around = edges_[edge].faces;
    if (std::find(around.begin(), around.end(), index) == around.end()) around.push_back(index);
  }
}

void CellComplex::forget_face(int index) {
  for (const int edge : faces_[index].edges) std::erase(edges_[edge].faces, index);
  static_cast<FaceOutline&>(faces_[index]) = {};
}

void CellComplex::divide_face(int index, std::vector<FaceOutline> outlines) {
  forget_face(index);
  const auto [plane, cells, mark] = std::tuple(faces_[index].plane, faces_[index].cells, faces_[index].mark);
  set_outline(index, std::move(outlines.front()));
  for (std::size_t k = 1; k < outlines.size(); ++k) {
    const int face = add_face(plane, std::move(outlines[k]), mark);
    faces_[face].cells = cells;
    for (const int cell : cells)
      if (cell >= 0) cells_[cell].faces.push_back(face);
  }
}

void CellComplex::set_faces(int cell, const std::vector<std::pair<int, bool>>& faces) {
  cells_[cell].faces.clear();
  for (const auto& [face, below] : faces) {
    cells_[cell].faces.push_back(face);
    faces_[face].cells[below ? 0 : 1] = cell;
  }
}

void CellComplex::remove(int cell) {
  for (const int index : cells_[cell].faces) {
    ComplexFace& face = faces_[index];
    std::replace(face.cells.begin(), face.cells.end(), cell, -1);
    if (face.cells[0] < 0 && face.cells[1] < 0) forget_face(index);
  }
  cells_[cell].faces.clear();
}

}  // namespace ashlar
