#include "benchmarks/studies/contact_study.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/program/verify/hertz_sphere.hpp"
#include "benchmarks/studies/patch_test.hpp"

namespace ashlar::contact_study_test {
namespace {

TEST(ContactStudy, AreaSpringsAreExactAndStepsConverge) {
  ContactStudySize size;
  size.patch_levels = 1;
  size.hertz = false;
  size.reference_step = 2.5e-4;
  size.finest_step = 1e-3;
  size.falling_levels = 0;
  const StudyResult result = study_contact(size);
  EXPECT_TRUE(result.holds);
  ASSERT_EQ(result.columns.size(), 10U);
  // The patch: three curves of two levels and the paper's. The block: two steps, the paper's one, three
  // curves of one level, three stiffnesses.
  ASSERT_EQ(result.rows.size(), 8U + 2U + 1U + 3U + 3U);
  std::vector<double> errors;  // of the block by steps
  for (const auto& row : result.rows) {
    ASSERT_EQ(row.size(), result.columns.size());
    EXPECT_TRUE(std::isfinite(row[8]));
    EXPECT_EQ(result.plot.series[static_cast<std::size_t>(row[1]) - 1].name.find("incremental") !=
                  std::string::npos,
              row[2] == 1.0);
    if (row[0] == 1.0 && row[3] == 0.0) {
      EXPECT_LT(row[8], 1e-9);
    }
    if (row[0] == 1.0 && row[3] == 1.0) {
      EXPECT_GT(row[8], 1e-3);
    }
    if (row[0] == 3.0 && row[1] == 5.0) errors.push_back(row[8]);
  }
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_LT(errors[1], errors[0]);
}

TEST(PatchTest, JumpsByPressureOverStiffness) {
  PatchTest patch;
  patch.order = 2;
  patch.stiffness = 4e9;
  const PatchErrors errors = press(patch);
  EXPECT_LT(errors.stress, 1e-9);
  EXPECT_LT(errors.jump, 1e-9);
}

TEST(HertzSphere, FormulasOfRecord) {
  const HertzSphere sphere;
  EXPECT_NEAR(sphere.contact_radius(), 9.916e-4, 5e-8);
  EXPECT_NEAR(sphere.approach(), 9.833e-6, 1e-9);
  EXPECT_NEAR(sphere.peak_pressure(), 485.6e6, 1e5);
}

/// A coarse division in which the quarter's force is met by the plane all the same.
TEST(HertzSphere, ThePlaneCarriesTheForce) {
  HertzSphere sphere;
  sphere.shells = 3;
  sphere.inner_order = sphere.near_order = 3;
  sphere.far_order = 2;
  sphere.facets = 3;
  sphere.stiffness = 5e14;
  const HertzContact contact = press(sphere);
  EXPECT_TRUE(contact.equilibrium);
  EXPECT_NEAR(contact.force, 1000.0, 1.0);
  EXPECT_GT(contact.radius, 0.5 * sphere.contact_radius());
  EXPECT_LT(contact.radius, 2.0 * sphere.contact_radius());
}

}  // namespace
}  // namespace ashlar::contact_study_test
