#include "apps/verify_command.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/verification.hpp"

namespace ashlar {
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
                           "resting-six-types",
                           "incline-stick",
                           "incline-slide",
                           "block-slide-or-topple",
                           "wedge",
                           "goodman-bray",
                           "arch",
                           "book-stack",
                           "bounce",
                           "bar-impact",
                           "hertz-sphere",
                           "joint-wave",
                           "rocking-block",
                           "falling-block"})
    EXPECT_NE(answer.out.find(std::string(name) + " "), std::string::npos) << name;
}

TEST(VerifyCommand, EveryCasePasses) {
  const Answer answer = verify({{}, false, true});
  const auto json = nlohmann::json::parse(answer.out);
  for (const auto& outcome : json["cases"]) {
    EXPECT_FALSE(outcome["checks"].empty());
    for (const auto& check : outcome["checks"])
      EXPECT_TRUE(check["passed"].get<bool>()) << outcome["name"] << " " << check;
  }
  EXPECT_EQ(json["passed"], true);
  EXPECT_EQ(answer.status, exit_status::done);
}

TEST(VerifyCommand, UnknownCasesAreRefusedWithTheNearestName) {
  const Answer answer = verify({{"free-fal"}, false, false});
  EXPECT_EQ(answer.status, exit_status::bad_input);
  EXPECT_NE(answer.err.find("did you mean free-fall?"), std::string::npos);
}

TEST(Verification, AnErrorThatIsNoNumberDoesNotPass) {
  EXPECT_FALSE(check_relative("x", std::nan(""), 1.0, 0.5).passed());
  EXPECT_TRUE(check_relative("x", 1.4, 1.0, 0.5).passed());
  EXPECT_FALSE(check_absolute("x", 1.6, 1.0, 0.5).passed());
}

}  // namespace
}  // namespace ashlar
