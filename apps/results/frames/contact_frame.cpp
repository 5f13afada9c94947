#include "apps/results/frames/contact_frame.hpp"

#include <array>

#include "apps/results/tables/append_vector.hpp"
#include "apps/results/tables/contact_state.hpp"

namespace ashlar {
namespace {}  // namespace

UnstructuredGrid contact_frame(const Simulation& simulation) {
  UnstructuredGrid grid;
  std::vector<double> gap;
  std::vector<double> area;
  std::vector<double> normal;
  std::vector<double> force;
  std::vector<double> traction;
  std::array<std::vector<std::int32_t>, 4> numbers;  // type, state, block_a, block_b
  for (const PairRecord& pair : simulation.contacts()) {
    const std::vector<ContactState> states = shown_states(simulation, pair);
    for (std::size_t k = 0; k < pair.points.size(); ++k) {
      const ContactPoint& point = pair.points[k];
      const PointResponse& response = pair.responses[k];
      const int index = static_cast<int>(grid.points.size());
      grid.points.emplace_back(0.5 * (point.place_a + point.place_b));
      grid.add_cell(VtkCellType::vertex, std::array{index});
      gap.push_back(pair.gaps[k]);
      area.push_back(point.area);
      append(normal, point.normal);
      const Vector3 whole = response.force[0] * point.normal + response.force[1] * point.tangent_1 +
                            response.force[2] * point.tangent_2;
      append(force, whole);
      append(traction, whole / point.area);
      numbers[0].push_back(static_cast<std::int32_t>(point.type));
      numbers[1].push_back(static_cast<std::int32_t>(states[k]));
      numbers[2].push_back(pair.a);
      numbers[3].push_back(pair.b);
    }
  }
  grid.point_data.push_back({"gap", 1, {}, std::move(gap)});
  grid.point_data.push_back({"area", 1, {}, std::move(area)});
  grid.point_data.push_back({"normal", 3, {"x", "y", "z"}, std::move(normal)});
  grid.point_data.push_back({"force", 3, {"x", "y", "z"}, std::move(force)});
  grid.point_data.push_back({"traction", 3, {"x", "y", "z"}, std::move(traction)});
  grid.point_data.push_back({"type", 1, {}, std::move(numbers[0])});
  grid.point_data.push_back({"state", 1, {}, std::move(numbers[1])});
  grid.point_data.push_back({"block_a", 1, {}, std::move(numbers[2])});
  grid.point_data.push_back({"block_b", 1, {}, std::move(numbers[3])});
  return grid;
}

}  // namespace ashlar
