#include "apps/program/view/pack_marks.hpp"

#include <cstdint>
#include <vector>

#include "apps/results/frames/grid_arrays.hpp"
#include "geometry/index.hpp"

namespace ashlar {

void pack_bolts(PackedNumbers& numbers, const UnstructuredGrid& grid, nlohmann::ordered_json& head) {
  const auto& data = grid.cell_data;
  const auto& state = required_values<std::int32_t>(data, "state", 1);
  const auto& bolt = required_values<std::int32_t>(data, "bolt", 1);
  const auto& axial = required_values<double>(data, "axial_force", 1);
  head["bolts"] = state.size();
  if (state.empty()) return;
  numbers.add_integers(state);
  numbers.add_integers(bolt);
  numbers.add_reals(axial, 1);
  std::vector<Vector3> ends;
  for (const int point : grid.connectivity) ends.push_back(grid.points[at(point)]);
  numbers.add_points(ends);
}

void pack_loads_and_supports(PackedNumbers& numbers, const UnstructuredGrid& grid,
                             nlohmann::ordered_json& head) {
  const auto& force = required_values<double>(grid.cell_data, "force", 3);
  const auto& held = required_values<std::int32_t>(grid.cell_data, "held", 1);
  const auto& block = required_values<std::int32_t>(grid.cell_data, "block", 1);
  std::vector<std::int32_t> loaded, components, supported, sizes;
  std::vector<double> forces;
  std::vector<Vector3> places, corners;
  for (std::size_t c = 0; c < held.size(); ++c) {
    const int start = c == 0 ? 0 : grid.offsets[c - 1], end = grid.offsets[c];
    if (held[c] == 0) {
      loaded.push_back(block[c]);
      for (std::size_t k = 0; k < 3; ++k) forces.push_back(force[3 * c + k]);
      places.push_back(grid.points[at(grid.connectivity[at(start)])]);
      continue;
    }
    components.push_back(held[c]);
    supported.push_back(block[c]);
    sizes.push_back(end - start);
    for (int k = start; k < end; ++k) corners.push_back(grid.points[at(grid.connectivity[at(k)])]);
  }
  head["loads"] = loaded.size();
  head["supports"] = components.size();
  head["support_corners"] = corners.size();
  if (!loaded.empty()) {
    numbers.add_integers(loaded);
    numbers.add_reals(forces, 3);
    numbers.add_points(places);
  }
  if (components.empty()) return;
  for (const auto* values : {&components, &supported, &sizes}) numbers.add_integers(*values);
  numbers.add_points(corners);
}

}  // namespace ashlar
