#include "apps/program/verify/verify_command.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "apps/program/verify/verification.hpp"

namespace ashlar::verify_command_test {
namespace {

struct Answer {
  int status;
  std::string out;
  std::string err;
};

Answer verify(const VerifyOptions& options) {
  std::ostringstream out, err;
  const int status = verify_command(options, out, err);
  return {status, out.str(), err.str()};
}

TEST(VerifyCommand, ListsCasesOfRecord) {
  const Answer answer = verify({{}, true, false});
  EXPECT_EQ(answer.status, exit_status::done);
  for (const char* name : {"moments-tetrahedron",
                           "free-fall",
                           "spin-volume",
                           "torque-free",
                           "spinning-bar",
                           "dda-damping",
                           "collision-momentum",
                           "stress-patch",
                           "pure-bending",
                           "self-weight-column",
                           "cantilever-end-load",
                           "cantilever-self-weight",
                           "cantilever-frequencies",
                           "torsion-bar",
                           "contact-derivatives",
                           "contact-patch",
                           "contact-patch-point",
                           "shear-patch",
                           "resting-six-types",
                           "incline-stick",
                           "incline-slide",
                           "block-slide-or-topple",
                           "wedge",
                           "goodman-bray",
                           "arch",
                           "overturning-limit",
                           "book-stack",
                           "bounce",
                           "bar-impact",
                           "hertz-sphere",
                           "base-record",
                           "joint-wave",
                           "rocking-block",
                           "cut-cube",
                           "cut-conserves",
                           "removable",
                           "wedge-geometry",
                           "falling-block"})
    EXPECT_NE(answer.out.find(std::string(name) + " "), std::string::npos) << name;
}

// Each case is a separate test: they run in parallel, and a preset can exclude slow ones by name.
class EveryCase : public testing::TestWithParam<const char*> {};

TEST_P(EveryCase, Passes) {
  const Answer answer = verify({{GetParam()}, false, true});
  const auto json = nlohmann::json::parse(answer.out);
  ASSERT_EQ(json["cases"].size(), 1u);
  const auto& outcome = json["cases"][0];
  EXPECT_EQ(outcome["name"], GetParam());
  EXPECT_FALSE(outcome["checks"].empty());
  for (const auto& check : outcome["checks"]) EXPECT_TRUE(check["passed"].get<bool>()) << check;
  EXPECT_EQ(json["passed"], true);
  EXPECT_EQ(answer.status, exit_status::done);
}

std::vector<const char*> case_names() {
  std::vector<const char*> names;
  for (const VerificationCase& listed : all_verification_cases()) names.push_back(listed.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Verify, EveryCase, testing::ValuesIn(case_names()));

TEST(VerifyCommand, ListsCasesAsJson) {
  const Answer answer = verify({{}, true, true});
  EXPECT_EQ(answer.status, exit_status::done);
  const auto json = nlohmann::json::parse(answer.out);
  ASSERT_EQ(json.size(), all_verification_cases().size());
  EXPECT_EQ(json[0]["name"], all_verification_cases()[0].name);
  EXPECT_EQ(json[0]["description"], all_verification_cases()[0].description);
}

TEST(VerifyCommand, UnknownCasesAreRefusedWithTheNearestName) {
  const Answer answer = verify({{"free-fal"}, false, false});
  EXPECT_EQ(answer.status, exit_status::bad_input);
  EXPECT_NE(answer.err.find("did you mean free-fall?"), std::string::npos);
  EXPECT_NE(
      verify({{"bar"}, false, false}).err.find("did you mean bar-impact or torsion-bar or spinning-bar?"),
      std::string::npos);
}

TEST(Verification, AnErrorThatIsNoNumberDoesNotPass) {
  EXPECT_FALSE(check_relative("x", std::nan(""), 1.0, 0.5).passed());
  EXPECT_TRUE(check_relative("x", 1.4, 1.0, 0.5).passed());
  EXPECT_FALSE(check_absolute("x", 1.6, 1.0, 0.5).passed());
}

}  // namespace
}  // namespace ashlar::verify_command_test
