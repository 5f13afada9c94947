#include "benchmarks/studies/patch_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {
namespace {

constexpr double pressure = 1e6;

/// A box whose horizontal face at one end is a fan of triangles about one of its points.
Polyhedron box_with_fan(const Vector3& low, const Vector3& high, bool at_top, double x, double y) {
  TriangleMesh mesh = make_box(low, high);
  const double level = at_top ? high.z() : low.z();
  const auto lies_in_face = [&](const std::array<int, 3>& triangle) {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](int point) { return mesh.points[static_cast<std::size_t>(point)].z() == level; });
  };
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> sides;
  for (const auto& triangle : mesh.triangles) {
    if (!lies_in_face(triangle)) {
      triangles.push_back(triangle);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<int, 2> side = {triangle[k], triangle[(k + 1) % 3]};
      const auto opposite = std::find(sides.begin(), sides.end(), std::array<int, 2>{side[1], side[0]});
      if (opposite == sides.end())
        sides.push_back(side);
      else
        sides.erase(opposite);
    }
  }
  const int center = static_cast<int>(mesh.points.size());
  mesh.points.emplace_back(x, y, level);
  for (const auto& [a, b] : sides) triangles.push_back({a, b, center});
  mesh.triangles = std::move(triangles);
  return Polyhedron(std::move(mesh));
}

Simulation put_together(const PatchTest& patch) {
  ContactScene scene;
  const double stiffness = patch.area_springs ? patch.stiffness : patch.stiffness / 4.0;
  *scene.law = {stiffness, 0.0, 0.0, 0.0, 0.0, patch.area_springs};
  scene.settings.gravity.setZero();
  scene.settings.area_springs = patch.area_springs;
  scene.settings.curved_surface = patch.curved_surface;
  scene.settings.search.subdivisions = patch.subdivisions;
  // Ten periods of the blocks on their springs: a dda step reduces such an oscillation to a seventieth.
  if (patch.formulation == Formulation::incremental) scene.settings.time_step = 0.1;
  for (const bool upper : {false, true}) {
    const Vector3 from(0, 0, upper ? 1.0 : 0.0), to(1, 1, upper ? 2.0 : 1.0);
    BlockDefinition block = define_block(
        upper ? box_with_fan(from, to, false, 0.3, 0.6) : box_with_fan(from, to, true, 0.55, 0.25),
        {2500, 1e9, patch.poisson_ratio}, patch.order);
    block.formulation = patch.formulation;
    block.sub_face_levels = patch.subdivisions;
    for (const Vector3& corner : {from, to}) {
      block.supports.push_back({Plane{corner, Vector3::UnitX()}, {true, false, false}});
      block.supports.push_back({Plane{corner, Vector3::UnitY()}, {false, true, false}});
    }
    if (upper)
      block.loads.push_back({Plane{to, Vector3::UnitZ()}, true, {0, 0, -pressure}, {}});
    else
      block.supports.push_back({Plane{from, Vector3::UnitZ()}, {false, false, true}});
    scene.add(std::move(block));
  }
  return scene.build();
}

double stress_error(const Simulation& simulation) {
  double error = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    for (const double x : {0.0, 0.3, 1.0}) {
      for (const double y : {0.0, 0.8}) {
        for (const double z : {0.0, 0.4, 1.0}) {
          const Vector3 at(x, y, z + static_cast<double>(k));
          const double stress = simulation.blocks()[k].stress(simulation.states()[k], at)(2, 2);
          error = std::max(error, std::abs(stress + pressure) / pressure);
        }
      }
    }
  }
  return error;
}

}  // namespace

PatchErrors press(const PatchTest& patch) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Simulation simulation = put_together(patch);
  const bool total = patch.formulation == Formulation::total;
  if (total) {
    if (find_equilibrium(simulation) != StaticStatus::equilibrium) return {infinity, infinity};
  } else {
    run_until(simulation, 3.0);
  }
  if (simulation.contacts().empty()) return {infinity, infinity};
  PatchErrors errors{total ? stress_error(simulation) : std::nan(""), 0.0};
  const double jump = pressure / patch.stiffness;
  for (const double gap : simulation.contacts()[0].gaps)
    errors.jump = std::max(errors.jump, std::abs(gap + jump) / jump);
  return errors;
}

}  // namespace ashlar
