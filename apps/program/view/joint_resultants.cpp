#include "apps/program/view/joint_resultants.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "apps/results/frames/grid_arrays.hpp"

namespace ashlar {
namespace {

/// Sums over the points of a pair.
struct Sums {
  Vector3 force = Vector3::Zero();
  double pressing = 0.0, size = 0.0;                           // N
  Vector3 pressed = Vector3::Zero(), moved = Vector3::Zero();  // N m: places times the two
  std::array<double, 3> of_state = {};                         // N
};

}  // namespace

std::vector<FrameResultant> joint_resultants(const UnstructuredGrid& contacts) {
  const auto& data = contacts.point_data;
  const auto& force = required_values<double>(data, "force", 3);
  const auto& normal = required_values<double>(data, "normal", 3);
  const auto& state = required_values<std::int32_t>(data, "state", 1);
  const auto& a = required_values<std::int32_t>(data, "block_a", 1);
  const auto& b = required_values<std::int32_t>(data, "block_b", 1);
  std::map<std::array<std::int32_t, 2>, Sums> pairs;
  for (std::size_t i = 0; i < contacts.points.size(); ++i) {
    const Vector3 f(force[3 * i], force[3 * i + 1], force[3 * i + 2]);
    const Vector3 n(normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]);
    const double size = f.norm(), pressing = std::max(f.dot(n), 0.0);
    if (size == 0.0) continue;
    Sums& sums = pairs[{a[i], b[i]}];
    sums.force += f;
    sums.size += size;
    sums.pressing += pressing;
    sums.moved += size * contacts.points[i];
    sums.pressed += pressing * contacts.points[i];
    sums.of_state.at(static_cast<std::size_t>(std::clamp(state[i], 0, 2))) += size;
  }
  std::vector<FrameResultant> resultants;
  for (const auto& [blocks, sums] : pairs) {
    const Vector3 place =
        sums.pressing > 0.0 ? Vector3(sums.pressed / sums.pressing) : Vector3(sums.moved / sums.size);
    const auto most = std::max_element(sums.of_state.begin(), sums.of_state.end());
    resultants.push_back(
        {blocks[0], blocks[1], sums.force, place, static_cast<std::int32_t>(most - sums.of_state.begin())});
  }
  return resultants;
}

}  // namespace ashlar
