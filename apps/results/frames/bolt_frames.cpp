#include "apps/results/frames/bolt_frames.hpp"

#include <array>

#include "geometry/exact/rounded_functions.hpp"
#include "solver/bolts/step_bolt.hpp"

namespace ashlar {
namespace {

/// Fields of the lines of a frame.
struct LineFields {
  std::vector<double> axial, shear, bond;
  std::vector<std::int32_t> state, bolt;
};

/// Shear force on each spring of a bar that crosses a dowelled joint, N, and whether it has yielded there.
struct Dowels {
  std::vector<double> force;
  std::vector<bool> yielded;
};

Dowels dowels_of(const Bolt& bolt, const BoltState& state) {
  Dowels dowels{std::vector<double>(state.axial.size(), 0.0), std::vector<bool>(state.axial.size(), false)};
  const BoltShape& shape = bolt.chain.shape();
  std::size_t n = 0;
  for (const BoltCrossing& crossing : shape.crossings()) {
    if (!crossing.dowelled) continue;
    for (std::size_t i = 0; i < state.axial.size(); ++i) {
      if (shape.stations()[i].piece != crossing.piece || shape.stations()[i + 1].piece == crossing.piece)
        continue;
      dowels.force[i] = correctly_rounded::hypot(state.dowels[2 * n], state.dowels[2 * n + 1]);
      dowels.yielded[i] = state.reached.sheared[shape.stations().size() + n] != 0;
    }
    ++n;
  }
  return dowels;
}

void add_bolt(const Simulation& simulation, std::size_t index, UnstructuredGrid& grid, LineFields& fields) {
  const Bolt& bolt = simulation.system().bolts()[index];
  const BoltState& state = simulation.bolts()[index];
  const BoltShape& shape = bolt.chain.shape();
  const Eigen::Matrix3Xd points = points_in(bolt, simulation.blocks(), simulation.states());
  const bool grouted = !shape.stations().empty();
  const Eigen::Matrix3Xd places =
      grouted ? Eigen::Matrix3Xd(points * shape.interpolation().transpose()) : points;
  const auto first = static_cast<int>(grid.points.size());
  for (Eigen::Index k = 0; k < places.cols(); ++k) grid.points.emplace_back(places.col(k));
  const Dowels dowels = dowels_of(bolt, state);
  for (std::size_t i = 0; i < state.axial.size(); ++i) {
    grid.add_cell(VtkCellType::line,
                  std::array{first + static_cast<int>(i), first + static_cast<int>(i) + 1});
    fields.axial.push_back(state.axial[i]);
    fields.shear.push_back(dowels.force[i]);
    double bond = 0.0;
    bool slipped = dowels.yielded[i];
    if (grouted) {
      for (const std::size_t k : {i, i + 1}) {
        bond -= 0.5 * state.bond[k] / shape.stations()[k].length;
        slipped = slipped || state.reached.sheared[k] != 0;
      }
    }
    fields.bond.push_back(bond);
    fields.state.push_back(state.reached.ruptured[i] != 0             ? 3
                           : bolt.chain.has_yielded(state.reached, i) ? 2
                           : slipped                                  ? 1
                                                                      : 0);
    fields.bolt.push_back(static_cast<std::int32_t>(index));
  }
}

}  // namespace

UnstructuredGrid bolt_frame(const Simulation& simulation) {
  UnstructuredGrid grid;
  LineFields fields;
  for (std::size_t k = 0; k < simulation.bolts().size(); ++k)
    if (simulation.bolts()[k].installed()) add_bolt(simulation, k, grid, fields);
  grid.cell_data.push_back({"axial_force", 1, {}, std::move(fields.axial)});
  grid.cell_data.push_back({"shear_force", 1, {}, std::move(fields.shear)});
  grid.cell_data.push_back({"bond_force", 1, {}, std::move(fields.bond)});
  grid.cell_data.push_back({"state", 1, {}, std::move(fields.state)});
  grid.cell_data.push_back({"bolt", 1, {}, std::move(fields.bolt)});
  return grid;
}

}  // namespace ashlar
