// A crack that appears in a stage stays in the next ones, with the traction that its joint had.
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/results/frames/grid_arrays.hpp"
#include "apps/results/frames/joint_faces.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/fracture/cracked_blocks.hpp"

namespace ashlar::cracked_stages_test {
namespace {

// The bar of bar.toml: f_t = 3 MPa, G = 100 N/m, E/L = 1e11 Pa/m, so that u0 = 30 um and wf = 66.7 um. It is pulled to
// 1.4 u0 in the first stage, where its tension has fallen to f_t (wf - 1.4 u0)/(wf - u0), and rests in the second one.
constexpr double strength = 3e6, elongation = 3e-5, widest = 2.0 * 100.0 / strength;

double tension_at(double pulled) {
  return strength * (widest - pulled * elongation) / (widest - elongation);
}

double tension_of(const Run& run) {
  return run.motion("bar.crack1.a", Vector3(0.0, 0.05, 0.05)).stress(0, 0);
}

ashlar::Run run_of_bar(const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  auto scene = load_scene(std::filesystem::path(ASHLAR_DATA_DIR) / "verification/cracks/bar.toml", overrides,
                          diagnostics);
  if (!scene) throw std::invalid_argument(diagnostics.sorted().front().message);
  return ashlar::Run(std::move(*scene));
}

void expect_the_same_tension(const std::vector<std::string>& overrides) {
  std::vector<std::string> all = {
      "stage=[{ name = \"first\", analysis = { end_time = 1.4 } }, { name = \"second\", analysis = { "
      "end_time = 0.4 } }]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  ashlar::Run run = run_of_bar(all);
  while (run.step() && !run.stage_follows()) {
  }
  ASSERT_EQ(run.stage(), 1);
  const double before = tension_of(run);
  EXPECT_NEAR(before, tension_at(1.4), 0.01 * strength);
  while (run.step()) {
  }
  ASSERT_EQ(run.stage(), 2);
  EXPECT_NEAR(tension_of(run), before, 1e-3 * strength);
  EXPECT_EQ(run.simulation().blocks().size(), 2U);
  ASSERT_EQ(run.cracks().events.size(), 1U);
  EXPECT_EQ(run.cracks().events[0].stage, 0);
  EXPECT_NEAR(run.cracks().events[0].time, 1.0, 0.011);
}

TEST(CrackedStages, InStatics) {
  expect_the_same_tension({});
}

TEST(CrackedStages, InMotion) {
  expect_the_same_tension({"analysis.type=\"dynamic\""});
}

// Opened by w = 1.4 u0 - u0 t/f_t under the tension t, a linear fall has dissipated f_t w/2.
TEST(CrackedStages, FacesHaveTheEnergyOfTheCrack) {
  ashlar::Run run = run_of_bar({"analysis.end_time=1.4"});
  while (run.step()) {
  }
  const double width = elongation * (1.4 - tension_at(1.4) / strength);
  const UnstructuredGrid faces =
      joint_frame(run.simulation(), joint_surfaces(run.simulation().blocks()), true);
  double energy = 0.0, area = 0.0;
  for (std::size_t k = 0; k < faces.offsets.size(); ++k) {
    const double of_face = find_values<double>(faces.cell_data, "area", 1)->at(k);
    area += of_face;
    energy += find_values<double>(faces.cell_data, "fracture_energy", 1)->at(k) * of_face;
  }
  EXPECT_NEAR(area, 0.01, 1e-12);
  EXPECT_NEAR(energy, 0.5 * strength * width * area, 0.01 * energy);
  EXPECT_NEAR(energy, energy_of_cracks(run.simulation(), {0, 0}), 1e-9 * energy);
}

}  // namespace
}  // namespace ashlar::cracked_stages_test
