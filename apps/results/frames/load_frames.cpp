#include "apps/results/frames/load_frames.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "apps/results/tables/original_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "geometry/index.hpp"
#include "mechanics/supports/face_selection.hpp"
#include "mechanics/supports/loads.hpp"

namespace ashlar {
namespace {

DrawnSupport support_of(const SceneFix& fix, std::size_t block, int stage, const Polyhedron& solid) {
  DrawnSupport support{static_cast<int>(block), stage, fix.components, {}, Vector3::Zero()};
  if (const auto* point = std::get_if<Vector3>(&fix.where)) {
    support.point = *point;
    return support;
  }
  const auto& plane = std::get<ScenePlane>(fix.where);
  for (const int face : faces_in_plane(solid, {plane.point, plane.normal})) {
    for (const int triangle : solid.faces()[at(face)].triangles) {
      const auto& corners = solid.mesh().triangles[at(triangle)];
      const auto corner = [&](std::size_t k) { return solid.mesh().points[at(corners.at(k))]; };
      support.triangles.push_back({corner(0), corner(1), corner(2)});
    }
  }
  return support;
}

/// Resultant of a load at factor 1 (N) and the material point where it is drawn (m).
struct Resultant {
  Vector3 force;
  Vector3 place;
};

Resultant resultant_of(const Polyhedron& solid, const Load& load) {
  if (const auto* point = std::get_if<Vector3>(&load.where)) return {load.vector, *point};
  constexpr int degree_of_field = 4;
  const SurfaceRule rule = surface_rule(solid, faces_at(solid, load.where), load.field ? degree_of_field : 1);
  double area = 0.0;
  Vector3 centre = Vector3::Zero(), force = Vector3::Zero();
  for (std::size_t k = 0; k < rule.points.size(); ++k) {
    area += rule.weights[k];
    centre += rule.weights[k] * rule.points[k];
    if (load.field) force += rule.weights[k] * load.field(rule.points[k]);
  }
  if (!load.field) force = load.traction ? Vector3(area * load.vector) : load.vector;
  return {force, centre / area};
}

/// Arrays of cells.
struct CellFields {
  std::vector<double> force;
  std::vector<std::int32_t> held, block;

  void add(const Vector3& resultant, int components, int number) {
    force.insert(force.end(), {resultant.x(), resultant.y(), resultant.z()});
    held.push_back(components);
    block.push_back(number);
  }
};

Vector3 place_of(const Simulation& simulation, int block, const Vector3& point) {
  return simulation.blocks()[at(block)].motion_of(simulation.states()[at(block)], point).place;
}

/// A load of a state.
struct ActingLoad {
  int block;
  bool moving;
  double factor;
  Vector3 whole;  ///< N, at factor 1
  Vector3 place;  ///< m
};

std::vector<ActingLoad> acting_loads(const Simulation& simulation, const DrawnActions& actions) {
  std::vector<ActingLoad> acting;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    const int number = static_cast<int>(k);
    if (block.incremental() != nullptr || block.fixed() || !simulation.system().present(number)) continue;
    for (std::size_t n = 0; n < block.loads().size(); ++n) {
      const Load& load = block.loads()[n];
      const double factor = load.factor * load.history.at(simulation.time());
      if (!load.parts.empty() || factor == 0.0) continue;
      const Resultant resultant = resultant_of(block.solid(), load);
      if (resultant.force.isZero(0.0)) continue;
      const bool moving = n < actions.moving[k].size() && actions.moving[k][n];
      acting.push_back(
          {number, moving, factor, resultant.force, place_of(simulation, number, resultant.place)});
    }
  }
  return acting;
}

/// Joins the two shares of each load that is between two points of its path: of equal forces, the nearest two whose
/// shares are one load.
void join_shares(std::vector<ActingLoad>& loads) {
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if (!loads[i].moving || !(loads[i].factor < 1.0)) continue;
    std::size_t other = loads.size();
    for (std::size_t j = i + 1; j < loads.size(); ++j) {
      if (!loads[j].moving || loads[j].whole != loads[i].whole ||
          std::abs(loads[i].factor + loads[j].factor - 1.0) > rounding)
        continue;
      if (other == loads.size() ||
          (loads[j].place - loads[i].place).norm() < (loads[other].place - loads[i].place).norm())
        other = j;
    }
    if (other == loads.size()) continue;
    const ActingLoad &a = loads[i], &b = loads[other];
    const Vector3 place = (a.factor * a.place + b.factor * b.place) / (a.factor + b.factor);
    loads[i] = {a.factor < b.factor ? b.block : a.block, true, 1.0, a.whole, place};
    loads.erase(loads.begin() + static_cast<std::ptrdiff_t>(other));
  }
}

void add_support(const Simulation& simulation, const DrawnSupport& support, UnstructuredGrid& grid,
                 CellFields& fields) {
  int held = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) held += support.components.at(axis) ? 1 << axis : 0;
  const auto add_point = [&](const Vector3& point) {
    grid.points.push_back(place_of(simulation, support.block, point));
    return static_cast<int>(grid.points.size()) - 1;
  };
  for (const std::array<Vector3, 3>& corners : support.triangles) {
    const int a = add_point(corners[0]), b = add_point(corners[1]), c = add_point(corners[2]);
    grid.add_cell(VtkCellType::triangle, std::array{a, b, c});
    fields.add(Vector3::Zero(), held, support.block);
  }
  if (!support.triangles.empty()) return;
  grid.add_cell(VtkCellType::vertex, std::array{add_point(support.point)});
  fields.add(Vector3::Zero(), held, support.block);
}

}  // namespace

DrawnActions drawn_actions(const Scene& scene, const std::vector<BlockModel>& blocks) {
  DrawnActions actions;
  const std::vector<int> originals = original_blocks(scene, blocks);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const std::size_t original = at(originals[k]);
    const bool has_parts = std::count(originals.begin(), originals.end(), originals[k]) > 1;
    actions.moving.emplace_back();
    if (!has_parts)
      for (const SceneLoad& load : scene.block[k].load) actions.moving.back().push_back(load.of_path);
    if (blocks[k].fixed() || blocks[k].incremental() != nullptr) continue;
    const auto add = [&](const SceneFix& fix, int stage) {
      // The parts of a block have its supports where they have its faces.
      const auto* point = std::get_if<Vector3>(&fix.where);
      if (has_parts && point != nullptr &&
          part_at(blocks, originals, originals[k], *point) != static_cast<int>(k))
        return;
      DrawnSupport support = support_of(fix, k, stage, blocks[k].solid());
      if (point != nullptr || !support.triangles.empty()) actions.supports.push_back(std::move(support));
    };
    for (const SceneFix& fix : scene.block[original].fix) add(fix, 0);
    for (std::size_t s = 0; s < scene.stage.size(); ++s)
      for (const SceneStage::Fix& entry : scene.stage[s].fix)
        if (means_block(scene, entry.blocks, original)) add(entry.fix, static_cast<int>(s) + 1);
  }
  return actions;
}

bool has_loads_or_supports(const Scene& scene) {
  const auto has_any = [](const auto& entry) { return !entry.fix.empty() || !entry.load.empty(); };
  return std::any_of(scene.block.begin(), scene.block.end(), has_any) ||
         std::any_of(scene.stage.begin(), scene.stage.end(), has_any);
}

UnstructuredGrid load_frame(const Simulation& simulation, const DrawnActions& actions, int stage) {
  UnstructuredGrid grid;
  CellFields fields;
  std::vector<ActingLoad> loads = acting_loads(simulation, actions);
  join_shares(loads);
  for (const ActingLoad& load : loads) {
    grid.add_cell(VtkCellType::vertex, std::array{static_cast<int>(grid.points.size())});
    grid.points.push_back(load.place);
    fields.add(load.factor * load.whole, 0, load.block);
  }
  for (const DrawnSupport& support : actions.supports)
    if (support.stage <= stage && simulation.system().present(support.block))
      add_support(simulation, support, grid, fields);
  grid.cell_data.push_back({"force", 3, {"x", "y", "z"}, std::move(fields.force)});
  grid.cell_data.push_back({"held", 1, {}, std::move(fields.held)});
  grid.cell_data.push_back({"block", 1, {}, std::move(fields.block)});
  return grid;
}

}  // namespace ashlar
