// Results for engineers: measures of pairs and blocks, largest values, failed joints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "apps/results/frames/grid_arrays.hpp"
#include "apps/results/frames/vtu/vtu_reader.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::answers_test {
namespace {

using ::testing::HasSubstr;

/// A cube of 1 m and 2000 kg, E = 1 GPa, on a fixed floor, and further keys of the scene.
std::string cube_on_floor(const std::string& analysis, const std::string& contact, const std::string& block,
                          const std::string& more) {
  return "[analysis]\n" + analysis + "[contact]\n" + contact + R"(
[[material]]
name = "stone"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.0
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [9, 2, 0] }
[[block]]
name = "cube"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
)" + block +
         more;
}

const std::string pair_measure = "[[measure]]\nname = \"joint\"\npair = [\"cube\", \"floor\"]\n";

class Answers : public RunCommand {
 protected:
  void scene(const std::string& text) { write_text(scene_, text); }
  [[nodiscard]] double last(const std::string& name) const { return column("out/history.csv", name).back(); }
  [[nodiscard]] nlohmann::json summary() const { return nlohmann::json::parse(text("out/summary.json")); }
};

// Gravity along an incline of 30 degrees; friction of 40 holds the cube.
TEST_F(Answers, APairBearsWeightAndShear) {
  scene(cube_on_floor("type = \"static\"\ngravity = [5, 0, -8.660254037844386]\n", "friction_angle = 40\n",
                      "", pair_measure));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_NEAR(last("joint.normal_force"), 2000 * 8.660254037844386, 1e-2);
  EXPECT_NEAR(last("joint.shear_force"), 2000 * 5.0, 1e-2);
  EXPECT_NEAR(last("joint.area"), 1.0, 1e-4);
  EXPECT_NEAR(last("joint.opening"), 0.0, 1e-6);
  EXPECT_NEAR(last("joint.slip"), 0.0, 2e-6);
}

TEST_F(Answers, SlipIsTheWayAlongTheJoint) {
  scene(cube_on_floor(
      "end_time = 0.4\ntime_step = 1e-3\ngravity = [5, 0, -8.660254037844386]\n", "friction_angle = 10\n", "",
      pair_measure + "[[measure]]\nname = \"foot\"\nblock = \"cube\"\npoint = [0.5, 0.5, 0]\n"));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const double displacement = 0.5 * 0.16 * (5.0 - 8.660254037844386 * std::tan(std::numbers::pi / 18.0));
  EXPECT_NEAR(last("joint.slip"), displacement, 0.01 * displacement);
  EXPECT_NEAR(last("joint.slip"), last("foot.ux"), 1e-5);
}

// Traction times area is the force: weight and shear of the cube, slip as its foot goes.
TEST_F(Answers, JointFacesBearWhatThePairDoes) {
  scene(cube_on_floor("end_time = 0.2\ntime_step = 1e-3\ngravity = [5, 0, -8.660254037844386]\n",
                      "friction_angle = 10\ntensile_strength = 1\n", "",
                      pair_measure + "[output]\nevery = 1000\n"));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const UnstructuredGrid grid = read_vtu(folder_ / "out/frames/joints_0000200.vtu");
  const auto& area = required_values<double>(grid.cell_data, "area", 1);
  const auto& normal = required_values<double>(grid.cell_data, "normal_traction", 1);
  const auto& shear = required_values<double>(grid.cell_data, "shear_traction", 1);
  const auto& slip = required_values<double>(grid.cell_data, "slip", 3);
  ASSERT_EQ(area.size(), 1U) << "one face on one face";
  EXPECT_NEAR(area[0], 1.0, 1e-3);
  EXPECT_NEAR(normal[0] * area[0], last("joint.normal_force"), 1e-6);
  EXPECT_NEAR(shear[0] * area[0], last("joint.shear_force"), 1e-6);
  EXPECT_NEAR(std::abs(slip[0]), last("joint.slip"), 1e-9);
  EXPECT_EQ(required_values<std::int32_t>(grid.cell_data, "state", 1)[0], 2);
  EXPECT_EQ(required_values<std::int32_t>(grid.cell_data, "block_a", 1)[0], 0);
  EXPECT_EQ(required_values<std::int32_t>(grid.cell_data, "block_b", 1)[0], 1);
  // The square between the two, where the cube is now.
  double low = 1e9, high = -1e9;
  for (const Vector3& point : grid.points) {
    low = std::min(low, point.x());
    high = std::max(high, point.x());
    EXPECT_NEAR(point.z(), 0.0, 1e-4);
  }
  EXPECT_NEAR(low, last("joint.slip"), 1e-3);
  EXPECT_NEAR(high - low, 1.0, 1e-3);
}

TEST_F(Answers, BlocksThatAreApartHaveNoOpening) {
  scene(cube_on_floor("end_time = 0.1\ntime_step = 1e-3\ngravity = [0, 0, 10]\n", "", "", pair_measure));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_EQ(last("joint.normal_force"), 0.0);
  EXPECT_EQ(last("joint.area"), 0.0);
  EXPECT_TRUE(std::isnan(last("joint.opening")));
  EXPECT_TRUE(std::isnan(last("joint.slip")));
}

TEST_F(Answers, ABlockTurnsByItsAngularVelocity) {
  scene(cube_on_floor("end_time = 0.5\ntime_step = 1e-3\ngravity = [0, 0, 0]\n", "",
                      "translate = [0, 0, 3]\nangular_velocity = [0, 1.2, 1.6]\n",
                      "[[measure]]\nname = \"body\"\nblock = \"cube\"\n"));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  // One radian in all about the axis [0, 0.6, 0.8].
  const double radian = 180.0 / std::numbers::pi;
  EXPECT_NEAR(last("body.rx"), 0.0, 0.05);
  EXPECT_NEAR(last("body.ry"), 0.6 * radian, 0.05);
  EXPECT_NEAR(last("body.rz"), 0.8 * radian, 0.05);
  EXPECT_NEAR(last("body.z"), 3.5, 1e-9);
  EXPECT_NEAR(last("body.szz"), 0.0, 1e4) << "but for what turning stretches";
}

TEST_F(Answers, TheSummaryHasTheLargestValues) {
  scene(cube_on_floor("type = \"static\"\ngravity = [0, 0, -10]\n", "", "", ""));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const nlohmann::json result = summary();
  // An affine cube has its mean stress, half of the weight over the area: its top goes down by 10 kPa / 1 GPa.
  EXPECT_EQ(result["largest_compression"]["block"], "cube");
  EXPECT_NEAR(result["largest_compression"]["value"].get<double>(), 10e3, 1.0);
  EXPECT_NEAR(result["largest_displacement"]["value"].get<double>(), 1e-5, 1e-8);
  EXPECT_NEAR(result["largest_displacement"]["place"][2].get<double>(), 1.0, 1e-4);
  if (!result["largest_tension"].is_null()) {
    EXPECT_LT(result["largest_tension"]["value"].get<double>(), 1.0) << "rounding";
  }
  EXPECT_EQ(result["broken"]["pairs"], 0);
}

// Gravity pulls the cube up with 20 kPa.
TEST_F(Answers, TheSummaryHasTheJointsThatBroke) {
  for (const auto& [strength, pairs, broken] : {std::tuple{"30e3", 0, 0.0}, std::tuple{"10e3", 1, 1.0}}) {
    scene(cube_on_floor("end_time = 0.05\ntime_step = 1e-3\ngravity = [0, 0, 10]\nmass_damping = 100\n",
                        "tensile_strength = " + std::string(strength) + "\n", "", ""));
    ASSERT_EQ(run("out", {"--force"}), exit_status::done) << faults_;
    const nlohmann::json result = summary();
    EXPECT_EQ(result["broken"]["pairs"], pairs) << strength;
    EXPECT_NEAR(result["broken"]["area"].get<double>(), broken, 1e-6) << strength;
    EXPECT_NEAR(result["broken"]["of_area"].get<double>(), 1.0, 1e-6) << strength;
  }
}

TEST_F(Answers, TheProgramTellsThem) {
  scene(cube_on_floor("type = \"static\"\ngravity = [0, 0, -10]\n", "", "", ""));
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string()}), exit_status::done);
  EXPECT_THAT(faults_,
              HasSubstr("largest: displacement 0.01 mm (block cube), compression 0.01 MPa (block cube)"));
}

TEST_F(Answers, MeasuresOfPairsAreChecked) {
  const auto faults_of = [&](const std::string& measure) {
    scene(cube_on_floor("type = \"static\"\n", "", "", "[[measure]]\nname = \"m\"\n" + measure));
    EXPECT_EQ(run("out"), exit_status::bad_input);
    return faults_;
  };
  EXPECT_THAT(faults_of("pair = [\"cube\"]\n"), HasSubstr("pair has the wrong length (1 entries)"));
  EXPECT_THAT(faults_of("pair = [\"cube\", \"cube\"]\n"),
              HasSubstr("measure of a block and itself (\"cube\")"));
  EXPECT_THAT(faults_of("pair = [\"cube\", \"flor\"]\n"),
              HasSubstr("unknown block (\"flor\"), did you mean"));
  EXPECT_THAT(faults_of("pair = [\"cube\", \"floor\"]\nblock = \"cube\"\n"), HasSubstr("block beside pair"));
  EXPECT_THAT(faults_of(""), HasSubstr("missing key (block)"));
}

}  // namespace
}  // namespace ashlar::answers_test
