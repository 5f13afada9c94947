#include "apps/results/frames/drawn_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/results/frames/lagrange_triangle.hpp"
#include "geometry/index.hpp"
#include "geometry/subfaces/sub_face_surface.hpp"

namespace ashlar {
namespace {

constexpr int pieces_per_order = 4;
constexpr int most_pieces = 16;
constexpr double most_triangles = 40'000;

/// Longest side of the triangles over the diagonal of the box around them; 0 if that is a point or not finite.
double relative_side(const CurvedTriangles& block) {
  Eigen::AlignedBox3d box;
  double longest = 0.0;
  for (const auto& corners : block.corners) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& start = block.points[at(corners[k])];
      box.extend(start);
      longest = std::max(longest, (block.points[at(corners[(k + 1) % 3])] - start).norm());
    }
  }
  const double share = box.isEmpty() ? 0.0 : longest / box.diagonal().norm();
  return std::isfinite(share) ? share : 0.0;
}

DrawnSurface flat_surface(const SubFaceSurface& surface) {
  DrawnSurface drawn;
  drawn.points = surface.points;
  for (const SurfaceCell& cell : surface.cells)
    drawn.cells.push_back(
        {cell.corners.size() == 3 ? VtkCellType::triangle : VtkCellType::polygon, cell.face, cell.corners});
  return drawn;
}

CurvedTriangles triangles_of(const BlockModel& block) {
  CurvedTriangles triangles{block.order(), block.solid().mesh().points, {}};
  for (const auto& triangle : block.solid().mesh().triangles)
    triangles.corners.push_back({triangle[0], triangle[1], triangle[2]});
  return triangles;
}

DrawnSurface divided(const CurvedTriangles& triangles, const std::vector<int>& faces, int pieces,
                     VtkCellType type) {
  const SharedLattice lattice = shared_lattice(triangles.corners, pieces);
  DrawnSurface drawn;
  for (const SharedLattice::Point& point : lattice.points) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      sum += point.weights[k] * triangles.points[at(triangles.corners[point.cell][k])];
    drawn.points.emplace_back(sum / pieces);
  }
  const auto small = lattice_triangles(pieces);
  for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
    const std::vector<int>& nodes = lattice.nodes[t];
    if (type == VtkCellType::lagrange_triangle) {
      drawn.cells.push_back({type, faces[t], nodes});
      continue;
    }
    for (const auto& [a, b, c] : small)
      drawn.cells.push_back({type, faces[t], {nodes[at(a)], nodes[at(b)], nodes[at(c)]}});
  }
  return drawn;
}

}  // namespace

std::vector<int> pieces_of_sides(const std::vector<CurvedTriangles>& blocks) {
  std::vector<double> wanted;
  wanted.reserve(blocks.size());
  for (const CurvedTriangles& block : blocks)
    wanted.push_back(std::min(pieces_per_order * block.order, most_pieces) * relative_side(block));
  for (int share = most_pieces;; --share) {
    std::vector<int> pieces;
    double triangles = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const double part = std::ceil(wanted[b] * share / most_pieces);
      pieces.push_back(std::max(1, static_cast<int>(part)));
      triangles += static_cast<double>(blocks[b].corners.size()) * pieces[b] * pieces[b];
    }
    if (triangles <= most_triangles || share == 0) return pieces;
  }
}

bool may_curve(const BlockModel& block) {
  return block.incremental() == nullptr && block.order() >= 2 && !block.fixed();
}

std::vector<DrawnSurface> drawn_surfaces(const std::vector<BlockModel>& blocks, bool lagrange) {
  std::vector<CurvedTriangles> curved;
  for (const BlockModel& block : blocks)
    if (may_curve(block)) curved.push_back(triangles_of(block));
  const std::vector<int> pieces = pieces_of_sides(curved);
  std::vector<DrawnSurface> surfaces;
  std::size_t next = 0;
  for (const BlockModel& block : blocks) {
    if (block.incremental() != nullptr) {
      surfaces.push_back(flat_surface(block.incremental()->surface()));
    } else if (!may_curve(block)) {
      surfaces.push_back(flat_surface(whole_surface(block.solid())));
    } else {
      const auto& faces = block.solid().face_of_triangle();
      surfaces.push_back(lagrange
                             ? divided(curved[next], faces, block.order(), VtkCellType::lagrange_triangle)
                             : divided(curved[next], faces, pieces[next], VtkCellType::triangle));
      ++next;
    }
  }
  return surfaces;
}

}  // namespace ashlar
