// Warnings of contacts that sub-faces or orders of blocks do not resolve.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/run/contact_resolution.hpp"
#include "apps/run/run.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::contact_resolution_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ContactResolution : public RunCommand {
 protected:
  /// The scene after its end.
  [[nodiscard]] ashlar::Run ended(const std::vector<std::string>& overrides = {}) const {
    Diagnostics faults;
    std::optional<LoadedScene> loaded = load_scene(scene_, overrides, faults);
    if (!loaded) throw std::runtime_error(to_string(faults.sorted().front()));
    ashlar::Run run(std::move(*loaded));
    while (run.step()) {
    }
    return run;
  }
};

// A beam of 10 x 1 x 1 m on two ledges, 9.8 m apart. Order 2 bends as w = c x^2 about its middle: least energy
//   E I (2c)^2 L / 2 - q c integral of (s^2 - x^2) dx,  c = q (s^2 L - L^3 / 12) / (4 E I L),  s = 4.9 m.
// Without division a face is two triangles, whose long sides are c L^2 / 4 from it.
constexpr const char* beam = R"([analysis]
type = "static"
gravity = [0, 0, -10]
[[material]]
name = "stone"
density = 2000
young_modulus = 1e9
poisson_ratio = 0
[[block]]
name = "beam"
material = "stone"
order = 2
box = { min = [-5, 0, 0], max = [5, 1, 1] }
[[block]]
name = "left"
fixed = true
box = { min = [-6, -1, -1], max = [-4.9, 2, 0] }
[[block]]
name = "right"
fixed = true
box = { min = [4.9, -1, -1], max = [6, 2, 0] }
)";

/// Of the lower edge of the beam below its ends, m.
double sag_of(const ashlar::Run& run) {
  const auto height = [&](double x) { return run.motion("beam", {x, 0, 0}).place.z(); };
  return (height(-5) + height(5)) / 2.0 - height(0);
}

TEST_F(ContactResolution, MeasuresTheChordErrorOfSubFacesInContact) {
  write_text(scene_, beam);
  const double load = 2000.0 * 10.0, s = 4.9, length = 10.0, inertia = 1.0 / 12.0;
  const double c = load * (s * s * length - std::pow(length, 3) / 12.0) / (4.0 * 1e9 * inertia * length);
  const double sag = c * length * length / 4.0;
  const ashlar::Run coarse = ended({"contact.subdivisions=0"});
  const auto error = largest_chord_error(coarse.simulation());
  ASSERT_TRUE(error);
  EXPECT_EQ(coarse.simulation().blocks()[static_cast<std::size_t>(error->block)].name(), "beam");
  EXPECT_NEAR(error->distance / sag, 1.0, 0.02);
  EXPECT_NEAR(error->distance, sag_of(coarse), 1e-3 * sag);
  EXPECT_NEAR(error->share, error->distance / std::cbrt(1.1 * 3.0 * 1.0), 1e-9);
  // The automatic tolerance is 5e-3 of the smallest size, that of a ledge.
  const ashlar::Run divided = ended();
  const auto fine = largest_chord_error(divided.simulation());
  ASSERT_TRUE(fine);
  EXPECT_LE(fine->share, 5e-3);
}

TEST_F(ContactResolution, ChordErrorsThatAreNotOrdinaryAreAWarning) {
  write_text(scene_, beam);
  ASSERT_EQ(run("coarse", {"--set", "contact.subdivisions=0"}), exit_status::done) << faults_;
  EXPECT_THAT(faults_, HasSubstr("block beam presses block"));
  EXPECT_THAT(faults_, HasSubstr("a smaller contact.chord_tolerance divides it further"));
  ASSERT_EQ(run("fine"), exit_status::done) << faults_;
  EXPECT_THAT(faults_, Not(HasSubstr("sub-faces")));
}

// A cube of order 3 on a column of 0.04 m^2, as wide as a disc of 0.226 m; its order resolves 1/3 m. It sinks by 2.5 mm, far
// more than it deforms, so that all of that area presses.
constexpr const char* on_a_column = R"([analysis]
type = "static"
[contact]
normal_stiffness = 2e8
friction_angle = 30
[[material]]
name = "stone"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "cube"
material = "stone"
order = 3
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[block]]
name = "column"
fixed = true
box = { min = [0.4, 0.4, -1], max = [0.6, 0.6, 0] }
)";

TEST_F(ContactResolution, NamesAContactThatIsTooSmallForTheOrder) {
  write_text(scene_, on_a_column);
  const ashlar::Run small = ended();
  const auto contact = unresolved_contact(small.simulation(), 0);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->other, 1);
  EXPECT_NEAR(contact->width, 2.0 * std::sqrt(0.04 / std::numbers::pi), 1e-6);
  EXPECT_NEAR(contact->resolved, 1.0 / 3.0, 1e-12);
  ASSERT_EQ(run("small"), exit_status::done) << faults_;
  EXPECT_THAT(faults_,
              HasSubstr("block cube of order 3: its contact with block column is 0.226 m wide, less than the "
                        "0.333 m that this order resolves: tie smaller blocks, small ones there"));
}

TEST_F(ContactResolution, ContactOverAFaceIsWideEnough) {
  write_text(scene_, on_a_column);
  const ashlar::Run wide = ended({"block.column.box.min=[0, 0, -1]", "block.column.box.max=[1, 1, 0]"});
  EXPECT_FALSE(unresolved_contact(wide.simulation(), 0));
}

}  // namespace
}  // namespace ashlar::contact_resolution_test
