#include "apps/results/frames/drawn_solid.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/results/frames/drawn_surface.hpp"
#include "apps/results/frames/lagrange_tetrahedron.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "geometry/cutting/tetrahedra.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

constexpr double most_tetrahedra = 100'000;

/// Tetrahedra of blocks, shared by blocks that differ by a translation within rounding error.
class TetrahedraLibrary {
 public:
  TetrahedronMesh find(const BlockModel& block) {
    const TriangleMesh& mesh = block.solid().mesh();
    const Vector3& corner = mesh.points.front();
    std::vector<double> places;
    for (const Vector3& point : mesh.points)
      for (int axis = 0; axis < 3; ++axis) places.push_back(point[axis] - corner[axis]);
    const auto [found, is_new] = known_.try_emplace({mesh.triangles, std::move(places)});
    if (!is_new) return translated(found->second.tetrahedra, corner - found->second.corner);
    try {
      found->second = {tetrahedra_of(block.solid(), resolution_of(mesh.points)), corner};
    } catch (const CutError& error) {
      throw CutError(fmt::format("output.solid: block \"{}\": {}", block.name(), error.what()));
    }
    return found->second.tetrahedra;
  }

 private:
  struct Shape {
    TetrahedronMesh tetrahedra;
    Vector3 corner;  ///< place of its first point
  };
  std::map<std::pair<std::vector<std::array<int, 3>>, std::vector<double>>, Shape> known_;
};

/// Divisions of the sides of each block's tetrahedra.
std::vector<int> pieces_of_solids(const std::vector<BlockModel>& blocks,
                                  const std::vector<TetrahedronMesh>& meshes) {
  std::vector<int> wanted;
  for (const BlockModel& block : blocks) {
    const TriangleMesh& mesh = block.solid().mesh();
    wanted.push_back(
        may_curve(block) ? pieces_of_sides({{block.order(), mesh.points, mesh.triangles}}).front() : 1);
  }
  for (int most = wanted.empty() ? 1 : *std::max_element(wanted.begin(), wanted.end());; --most) {
    double cells = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      wanted[b] = std::max(1, std::min(wanted[b], most));
      cells += static_cast<double>(meshes[b].cells.size()) * wanted[b] * wanted[b] * wanted[b];
    }
    if (cells <= most_tetrahedra || most <= 1) return wanted;
  }
}

DrawnSolid divided(const TetrahedronMesh& mesh, int pieces, VtkCellType type) {
  const SimplexLattice<4> lattice = simplex_lattice<4>(mesh.cells, tetrahedron_nodes(pieces));
  DrawnSolid solid{type, {}, {}};
  for (const auto& point : lattice.points) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < 4; ++k) sum += point.weights[k] * mesh.points[at(mesh.cells[point.cell][k])];
    solid.points.emplace_back(sum / pieces);
  }
  const std::vector<std::array<int, 4>> small = lattice_tetrahedra(pieces);
  for (const std::vector<int>& nodes : lattice.nodes) {
    if (type == VtkCellType::lagrange_tetrahedron) {
      solid.cells.push_back(nodes);
      continue;
    }
    for (const auto& [a, b, c, d] : small)
      solid.cells.push_back({nodes[at(a)], nodes[at(b)], nodes[at(c)], nodes[at(d)]});
  }
  return solid;
}

}  // namespace

std::vector<DrawnSolid> drawn_solids(const std::vector<BlockModel>& blocks, bool lagrange) {
  TetrahedraLibrary library;
  std::vector<TetrahedronMesh> meshes;
  meshes.reserve(blocks.size());
  for (const BlockModel& block : blocks) meshes.push_back(library.find(block));
  const std::vector<int> pieces = pieces_of_solids(blocks, meshes);
  std::vector<DrawnSolid> solids;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    solids.push_back(lagrange && may_curve(blocks[b])
                         ? divided(meshes[b], blocks[b].order(), VtkCellType::lagrange_tetrahedron)
                         : divided(meshes[b], pieces[b], VtkCellType::tetrahedron));
  return solids;
}

}  // namespace ashlar
