#include "apps/program/contacts/integrate_command.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/temporary_folder.hpp"

namespace ashlar::integrate_command_test {
namespace {

constexpr const char* tetrahedron =
    "OFF\n4 4 0\n0 0 0\n{0} 0 0\n0 {0} 0\n0 0 {0}\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string tetrahedron_of_size(const std::string& size) {
  std::string text = tetrahedron;
  for (auto place = text.find("{0}"); place != std::string::npos; place = text.find("{0}"))
    text.replace(place, 3, size);
  return text;
}

struct Answer {
  int status;
  std::string out;
  std::string err;
};

Answer integrate(const std::string& mesh, int degree, bool json) {
  const TemporaryFolder folder;
  std::ofstream(folder / "t.off") << mesh;
  std::ostringstream out, err;
  const int status = integrate_command({(folder / "t.off").string(), degree, json}, out, err);
  return {status, out.str(), err.str()};
}

TEST(IntegrateCommand, MomentsOfTheUnitTetrahedronAsJson) {
  const Answer answer = integrate(tetrahedron_of_size("1"), 6, true);
  ASSERT_EQ(answer.status, exit_status::done);
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json["degree"], 6);
  EXPECT_EQ(json["moments"].size(), 84U);  // 9! / (6! 3!)
  for (const auto& moment : json["moments"]) {
    const int a = moment["a"], b = moment["b"], c = moment["c"];
    const double exact =
        std::tgamma(a + 1) * std::tgamma(b + 1) * std::tgamma(c + 1) / std::tgamma(a + b + c + 4);
    EXPECT_NEAR(moment["value"].get<double>() / exact, 1.0, 1e-14);
  }
}

TEST(IntegrateCommand, TextHasALineForEachMoment) {
  const Answer answer = integrate(tetrahedron_of_size("1"), 1, false);
  EXPECT_EQ(
      answer.out,
      " a  b  c  integral of X^a Y^b Z^c\n 0  0  0  0.16666666666666666\n 1  0  0  0.041666666666666664\n"
      " 0  1  0  0.041666666666666664\n 0  0  1  0.041666666666666664\n");
}

TEST(IntegrateCommand, RefusesWhatIsNoSolidAndWhatIsTooLarge) {
  const Answer open = integrate("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 2, true);
  EXPECT_EQ(open.status, exit_status::bad_input);
  EXPECT_NE(open.err.find("error: "), std::string::npos);
  EXPECT_TRUE(open.out.empty());
  const Answer huge = integrate(tetrahedron_of_size("1e100"), 1, true);
  EXPECT_EQ(huge.status, exit_status::bad_input);
  EXPECT_NE(huge.err.find("beyond the largest double"), std::string::npos);
  EXPECT_EQ(integrate(tetrahedron_of_size("1e100"), 0, true).status, exit_status::done);
}

}  // namespace
}  // namespace ashlar::integrate_command_test
