#include "apps/results/frames/joint_faces.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "apps/results/tables/contact_state.hpp"
#include "apps/results/tables/measure.hpp"
#include "geometry/contacts/cell_overlap.hpp"
#include "geometry/index.hpp"
#include "solver/run/lost_strength.hpp"

namespace ashlar {
namespace {

/// Surfaces of blocks at the end of the step, computed at the first use.
class PresentSurfaces {
 public:
  PresentSurfaces(const Simulation& simulation, const std::vector<SubFaceSurface>& surfaces)
      : simulation_(simulation), cells_(surfaces) {}

  const PlacedSurface& of(int block) {
    const auto known = surfaces_.find(block);
    if (known != surfaces_.end()) return known->second;
    const BlockModel& model = simulation_.blocks()[at(block)];
    const BlockState& state = simulation_.states()[at(block)];
    if (model.incremental() != nullptr) {
      const BlockSurface& surface = simulation_.finder().surfaces()[at(block)];
      return placed(block, surface.surface(), surface.points(state));
    }
    std::vector<Vector3> points;
    for (const Vector3& point : cells_[at(block)].points)
      points.emplace_back(state.position.transpose() * model.basis().values(point));
    return placed(block, cells_[at(block)], std::move(points));
  }

 private:
  const PlacedSurface& placed(int block, const SubFaceSurface& cells, std::vector<Vector3> points) {
    return surfaces_
        .emplace(std::piecewise_construct, std::forward_as_tuple(block),
                 std::forward_as_tuple(cells, std::move(points)))
        .first->second;
  }

  const Simulation& simulation_;
  const std::vector<SubFaceSurface>& cells_;
  std::map<int, PlacedSurface> surfaces_;
};

/// Sums over the points of a polygon.
struct JointSums {
  double area = 0.0, gap = 0.0, normal = 0.0;
  Vector3 place = Vector3::Zero();  ///< first moment of the placed block b, m^3
  Vector3 shear = Vector3::Zero(), slip = Vector3::Zero();
  std::array<double, 3> of_state = {};  ///< m^2
  double broken = 0.0;                  ///< m^2
  double energy = 0.0;                  ///< J, dissipated by softening
};

struct JointFace {
  std::vector<Vector3> corners;
  ViewFrame frame;
  std::vector<Eigen::Vector2d> outline;  ///< counter-clockwise in the frame
  JointSums sums;
};

/// Distance of a place from a convex outline, m; 0 inside.
double distance_outside(const JointFace& face, const Vector3& place) {
  const Eigen::Vector2d point = face.frame.project(place);
  double most = 0.0;
  for (std::size_t k = 0; k < face.outline.size(); ++k) {
    const Eigen::Vector2d& from = face.outline[k];
    const Eigen::Vector2d along = face.outline[(k + 1) % face.outline.size()] - from;
    const Eigen::Vector2d to = point - from;
    const double length = along.norm();
    if (length > 0.0) most = std::max(most, (along.y() * to.x() - along.x() * to.y()) / length);
  }
  return most;
}

/// Point midway between both cells.
Vector3 lifted(const CellOverlap& overlap, std::size_t corner, const PlacedSurface& b) {
  const ViewFrame& frame = overlap.frame;
  const Eigen::Vector2d& place = overlap.corners[corner].place;
  const Vector3 seen = frame.origin + place.x() * frame.e1 + place.y() * frame.e2;
  const Vector3& normal = b.normal(overlap.cell_b);
  const Vector3& on_b = b.point(b.surface().cells[at(overlap.cell_b)].corners.front());
  const double depth = normal.dot(on_b - seen) / normal.dot(frame.w);
  return seen + (depth + 0.5 * overlap.gaps[corner]) * frame.w;
}

std::map<int, std::vector<int>> cells_of_faces(const PlacedSurface& surface) {
  std::map<int, std::vector<int>> cells;
  for (int c = 0; c < static_cast<int>(surface.surface().cells.size()); ++c)
    cells[surface.surface().cells[at(c)].face].push_back(c);
  return cells;
}

std::vector<JointFace> faces_between(const PlacedSurface& a, const std::vector<int>& cells_a,
                                     const PlacedSurface& b, const std::vector<int>& cells_b) {
  std::vector<JointFace> faces;
  DecisionCounts counts;
  for (const int cell_a : cells_a) {
    for (const int cell_b : cells_b) {
      const Box near = a.cell_box(cell_a).grown(0.1 * std::min(a.size(), b.size()));
      if (!near.meets(b.cell_box(cell_b)) || !(a.normal(cell_a).dot(b.normal(cell_b)) < 0.0)) continue;
      const std::optional<CellOverlap> overlap = overlap_of_cells(a, cell_a, b, cell_b, counts);
      if (!overlap) continue;
      JointFace face{{}, overlap->frame, {}, {}};
      for (std::size_t k = 0; k < overlap->corners.size(); ++k) {
        face.corners.push_back(lifted(*overlap, k, b));
        face.outline.push_back(overlap->corners[k].place);
      }
      double area = 0.0;
      for (std::size_t k = 0; k < face.outline.size(); ++k) {
        const Eigen::Vector2d& next = face.outline[(k + 1) % face.outline.size()];
        area += face.outline[k].x() * next.y() - face.outline[k].y() * next.x();
      }
      if (area < 0.0) std::reverse(face.outline.begin(), face.outline.end());
      faces.push_back(std::move(face));
    }
  }
  return faces;
}

void add(JointSums& sums, const ContactPoint& point, const PointResponse& response, ContactState state,
         double gap, const Vector3& slip, bool broken, double energy) {
  sums.area += point.area;
  sums.gap += point.area * gap;
  sums.place += point.area * point.material_b;
  sums.normal += response.force[0];
  sums.shear += response.force[1] * point.tangent_1 + response.force[2] * point.tangent_2;
  sums.slip += point.area * slip;
  sums.of_state.at(static_cast<std::size_t>(state)) += point.area;
  if (broken) sums.broken += point.area;
  sums.energy += point.area * energy;
}

/// The faces of a pair with the sums over their points.
std::vector<JointFace> faces_of(const Simulation& simulation, const PairRecord& record,
                                PresentSurfaces& surfaces) {
  const PlacedSurface& a = surfaces.of(record.a);
  const PlacedSurface& b = surfaces.of(record.b);
  const std::map<int, std::vector<int>> cells_a = cells_of_faces(a), cells_b = cells_of_faces(b);
  std::map<std::array<int, 2>, std::vector<JointFace>> faces;
  const std::vector<char> lost = simulation.points_without_strength(record);
  const std::vector<double> energies =
      dissipated_energies(simulation.system().law(record.a, record.b),
                          history_of(simulation.histories(), {record.a, record.b}), record);
  const std::vector<ContactState> states = shown_states(simulation, record);
  for (std::size_t k = 0; k < record.points.size(); ++k) {
    const ContactPoint& point = record.points[k];
    if (point.type != ContactPointType::face_face) continue;
    const std::array<int, 2> key = {point.face_a, point.face_b};
    const auto [found, is_new] = faces.try_emplace(key);
    if (is_new && cells_a.contains(key[0]) && cells_b.contains(key[1]))
      found->second = faces_between(a, cells_a.at(key[0]), b, cells_b.at(key[1]));
    JointFace* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (JointFace& face : found->second) {
      const double distance = distance_outside(face, point.place_b);
      if (distance >= least) continue;
      least = distance;
      nearest = &face;
    }
    if (nearest == nullptr) continue;
    add(nearest->sums, point, record.responses[k], states[k], record.gaps[k], slip_of(simulation, record, k),
        lost[k] != 0, energies[k]);
  }
  std::vector<JointFace> result;
  for (auto& [key, list] : faces)
    for (JointFace& face : list)
      if (face.sums.area > 0.0) result.push_back(std::move(face));
  return result;
}

}  // namespace

std::vector<SubFaceSurface> joint_surfaces(const std::vector<BlockModel>& blocks) {
  constexpr std::size_t most_triangles = 2000;
  std::vector<SubFaceSurface> surfaces;
  for (const BlockModel& block : blocks) {
    if (block.incremental() != nullptr) {
      surfaces.emplace_back();
    } else if (block.fixed() || block.order() == 1) {
      surfaces.push_back(whole_surface(block.solid()));
    } else {
      int levels = 0;
      for (std::size_t triangles = 4 * block.solid().mesh().triangles.size();
           levels < 2 && triangles <= most_triangles; triangles *= 4)
        ++levels;
      surfaces.push_back(divide_surface(block.solid(), levels));
    }
  }
  return surfaces;
}

UnstructuredGrid joint_frame(const Simulation& simulation, const std::vector<SubFaceSurface>& cells,
                             bool softens) {
  UnstructuredGrid grid;
  std::vector<double> opening, slip, normal, shear, energy, area;
  std::array<std::vector<std::int32_t>, 4> numbers;  // state, broken, block_a, block_b
  std::vector<double> water;
  PresentSurfaces surfaces(simulation, cells);
  for (const PairRecord& record : simulation.contacts()) {
    for (const JointFace& face : faces_of(simulation, record, surfaces)) {
      std::vector<int> corners;
      for (const Vector3& corner : face.corners) {
        corners.push_back(static_cast<int>(grid.points.size()));
        grid.points.push_back(corner);
      }
      grid.add_cell(VtkCellType::polygon, corners);
      const JointSums& sums = face.sums;
      opening.push_back(sums.gap / sums.area);
      const Vector3 mean_slip = sums.slip / sums.area;
      slip.insert(slip.end(), {mean_slip.x(), mean_slip.y(), mean_slip.z()});
      normal.push_back(sums.normal / sums.area);
      shear.push_back(sums.shear.norm() / sums.area);
      energy.push_back(sums.energy / sums.area);
      area.push_back(sums.area);
      if (simulation.joint_pressure())
        water.push_back(simulation.joint_pressure()(record.a, record.b, sums.place / sums.area));
      const auto most = std::max_element(sums.of_state.begin(), sums.of_state.end());
      numbers[0].push_back(static_cast<std::int32_t>(most - sums.of_state.begin()));
      numbers[1].push_back(sums.broken > 0.5 * sums.area ? 1 : 0);
      numbers[2].push_back(record.a);
      numbers[3].push_back(record.b);
    }
  }
  grid.cell_data.push_back({"opening", 1, {}, std::move(opening)});
  grid.cell_data.push_back({"slip", 3, {"x", "y", "z"}, std::move(slip)});
  grid.cell_data.push_back({"normal_traction", 1, {}, std::move(normal)});
  grid.cell_data.push_back({"shear_traction", 1, {}, std::move(shear)});
  if (softens) grid.cell_data.push_back({"fracture_energy", 1, {}, std::move(energy)});
  grid.cell_data.push_back({"area", 1, {}, std::move(area)});
  if (simulation.joint_pressure()) grid.cell_data.push_back({"water_pressure", 1, {}, std::move(water)});
  grid.cell_data.push_back({"state", 1, {}, std::move(numbers[0])});
  grid.cell_data.push_back({"broken", 1, {}, std::move(numbers[1])});
  grid.cell_data.push_back({"block_a", 1, {}, std::move(numbers[2])});
  grid.cell_data.push_back({"block_b", 1, {}, std::move(numbers[3])});
  return grid;
}

}  // namespace ashlar
