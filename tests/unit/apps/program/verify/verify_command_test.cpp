#include "apps/program/verify/verify_command.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "apps/program/verify/verification.hpp"
#include "support/temporary_folder.hpp"

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
  const Answer answer = verify({.list = true});
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
class EveryCase : public testing::TestWithParam<std::string> {};

TEST_P(EveryCase, Passes) {
  const Answer answer = verify({.cases = {GetParam()}, .json = true});
  const auto json = nlohmann::json::parse(answer.out);
  ASSERT_EQ(json["cases"].size(), 1u);
  const auto& outcome = json["cases"][0];
  EXPECT_EQ(outcome["name"], GetParam());
  EXPECT_FALSE(outcome["checks"].empty());
  for (const auto& check : outcome["checks"]) EXPECT_TRUE(check["passed"].get<bool>()) << check;
  EXPECT_EQ(json["passed"], true);
  EXPECT_EQ(answer.status, exit_status::done);
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const auto& listed : nlohmann::json::parse(verify({.list = true, .json = true}).out))
    names.push_back(listed["name"]);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Verify, EveryCase, testing::ValuesIn(case_names()));

TEST(VerifyCommand, ListsCasesAsJson) {
  const Answer answer = verify({.list = true, .json = true});
  EXPECT_EQ(answer.status, exit_status::done);
  const auto json = nlohmann::json::parse(answer.out);
  ASSERT_GT(json.size(), all_verification_cases().size());
  // Scenes come first, with the references in words that the page of cases has.
  for (const char* key : {"name", "description", "reference", "source", "scene"})
    EXPECT_TRUE(json[0].contains(key)) << key;
  EXPECT_EQ(json.back()["name"], all_verification_cases().back().name);
}

TEST(VerifyCommand, UnknownCasesAreRefusedWithTheNearestName) {
  const Answer answer = verify({.cases = {"free-fal"}});
  EXPECT_EQ(answer.status, exit_status::bad_input);
  EXPECT_NE(answer.err.find("did you mean free-fall?"), std::string::npos);
  EXPECT_NE(
      verify({.cases = {"bar"}})
          .err.find("did you mean bar-impact or bonded-bar or crack-bar or torsion-bar or spinning-bar or "
                    "effectivity-bar?"),
      std::string::npos);
}

/// A folder with a cube on a floor, 8 m^3, and one case.
class OwnCases : public testing::Test {
 protected:
  OwnCases() {
    write_text(folder / "cube.toml", R"([parameters]
density = 2000
[analysis]
type = "static"
[[material]]
name = "rock"
density = "= density"
young_modulus = 1e10
poisson_ratio = 0
[[block]]
name = "floor"
fixed = true
box = { min = [-2, -2, -1], max = [3, 3, 0] }
[[block]]
name = "cube"
material = "rock"
order = 0
box = { min = [-1, -1, 0], max = [1, 1, 2] }
[[measure]]
name = "base"
pair = ["floor", "cube"]
)");
  }
  [[nodiscard]] Answer verified(const std::string& checks) const {
    write_text(folder / "cases.toml",
               "[cube-weight]\nabout = \"a cube\"\nreference = \"its weight\"\nsource = \"statics\"\n"
               "scene = \"cube.toml\"\nvary = [{ density = [2000, 3000] }]\ncheck = [" +
                   checks + "]\n");
    return verify({.folder = folder.path()});
  }
  [[nodiscard]] Answer verified_table(const std::string& keys) const {
    write_text(folder / "cases.toml",
               "[cube-weight]\nabout = \"a cube\"\nreference = \"its weight\"\nsource = \"statics\"\n" +
                   keys + "\n");
    return verify({.folder = folder.path()});
  }
  TemporaryFolder folder;
};

TEST_F(OwnCases, RunAndAreKept) {
  const Answer right =
      verified("{ value = \"base.normal_force\", expect = \"8*density*9.81\", relative = 1e-9 }");
  EXPECT_EQ(right.status, exit_status::done) << right.err << right.out;
  EXPECT_NE(right.out.find("base.normal_force, density 3000"), std::string::npos) << right.out;
  const Answer kept = verify({.folder = folder.path(), .kept = folder / "kept"});
  EXPECT_EQ(kept.status, exit_status::done);
  EXPECT_EQ(
      read_text(folder / "kept/cube-weight/density_3000/command.txt"),
      fmt::format("ashlar run '{}' --set 'parameters.density=3000'\n", (folder / "cube.toml").string()));
  EXPECT_TRUE(std::filesystem::exists(folder / "kept/cube-weight/cube.toml"));
  EXPECT_TRUE(std::filesystem::exists(folder / "kept/cube-weight/density_2000/history.csv"));
}

/// Variants, definitions, conditions, bounds and texts, and a command that a shell reads.
TEST_F(OwnCases, HaveVariantsAndKindsOfChecks) {
  const Answer right = verified_table(R"(scene = "cube.toml"
vary = [{ density = [2000, "= 1500*2"], "contact.friction_angle" = [10, 20] }, { density = 1000 }]
define = { W = "= 8*density*g", g = 9.81 }
check = [
  { what = "weight", value = "base.normal_force", expect = "W", absolute = "W*1e-9" },
  { what = "light", when = "density < 1500", value = "base.normal_force", at_most = "8*1500*9.81" },
  { what = "heavy", when = "density > 2500", value = "base.normal_force", at_least = 160000 },
  { value = "summary.status", is = "equilibrium" },
])");
  EXPECT_EQ(right.status, exit_status::done) << right.err << right.out;
  const auto count = [&](const std::string& words) {
    std::size_t found = 0;
    for (std::size_t at = right.out.find(words); at != std::string::npos; at = right.out.find(words, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("pass weight, density"), 5U);
  EXPECT_EQ(count("pass light, density 1000"), 1U);
  EXPECT_EQ(count("pass heavy, density 1500*2, friction_angle"), 2U);
  EXPECT_EQ(count("pass summary.status, "), 5U);
  const Answer kept = verify({.folder = folder.path(), .kept = folder / "kept"});
  EXPECT_EQ(kept.status, exit_status::done);
  EXPECT_EQ(read_text(folder / "kept/cube-weight/density_1500_2__friction_angle_10/command.txt"),
            fmt::format("ashlar run '{}' --set 'parameters.density='\\''= 1500*2'\\''' --set "
                        "'contact.friction_angle=10'\n",
                        (folder / "cube.toml").string()));
}

/// Springs that make the numbers of the system overflow: in motion and, before the first row, at rest.
TEST_F(OwnCases, ARunThatFailsFailsItsCase) {
  const std::string motion =
      R"("analysis.type" = "dynamic", "analysis.end_time" = 1, "analysis.time_step" = 0.1, "block.cube.order" = 1, )";
  for (const auto& [keys, status] : {std::pair{motion, "failed"}, {std::string(), "not converged"}}) {
    const Answer failed = verified_table("scene = \"cube.toml\"\nvary = [{ " + keys +
                                         R"toml("contact.normal_stiffness" = 1e300 }]
check = [
  { value = "last(time)", at_least = 0 },
  { value = "base.normal_force", at_least = "-1e99" },
  { when = "0", value = "summary.status", is = "completed" },
])toml");
    EXPECT_EQ(failed.status, exit_status::failed) << failed.out << failed.err;
    EXPECT_NE(failed.out.find(fmt::format("FAIL ended as {}: ", status)), std::string::npos)
        << failed.out << failed.err;
  }
}

/// The example of data/verification/README.md.
TEST(Verification, TheExampleOfItsReadmePasses) {
  const std::string readme = read_text(std::filesystem::path(ASHLAR_DATA_DIR) / "verification/README.md");
  const std::string start = "```toml\n";
  const std::size_t begin = readme.find(start) + start.size();
  const TemporaryFolder folder;
  write_text(folder / "cases.toml", readme.substr(begin, readme.find("```", begin) - begin));
  write_text(folder / "block.toml", R"([parameters]
density = 1
[[material]]
name = "rock"
density = "= density"
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "ground"
fixed = true
box = { min = [-2, -2, -1], max = [3, 3, 0] }
[[block]]
name = "block"
material = "rock"
box = { min = [0, 0, 0], max = [2, 1, 0.5] }
[[measure]]
name = "base"
pair = ["ground", "block"]
)");
  const Answer answer = verify({.folder = folder.path()});
  EXPECT_EQ(answer.status, exit_status::done) << answer.err << answer.out;
}

TEST_F(OwnCases, FailByValue) {
  const Answer wrong =
      verified("{ value = \"base.normal_force\", expect = \"8*2000*9.81\", relative = 1e-3 }");
  EXPECT_EQ(wrong.status, exit_status::failed);
  EXPECT_NE(wrong.out.find("FAIL base.normal_force, density 3000"), std::string::npos) << wrong.out;
  EXPECT_NE(wrong.out.find("pass base.normal_force, density 2000"), std::string::npos);
}

TEST_F(OwnCases, FaultsHaveTheirPlace) {
  const std::string here = (folder / "cases.toml").string();
  struct Fault {
    const char *check, *message;
  };
  for (const auto& [check, message] :
       {Fault{"", ":1:2: error: case cube-weight has no check, one is needed"},
        Fault{"{ value = \"bass.normal_force\", expect = 1, relative = 1 }",
              ":7:21: error: case cube-weight, density 2000: unknown result (bass.normal_force)"},
        Fault{"{ value = \"time\", expect = \"0/0\", relative = 1 }",
              ":7:38: error: case cube-weight, density 2000: formula has no finite value"},
        Fault{"{ value = \"time\", expect = 1 }", ":7:10: error: check has no single tolerance"},
        Fault{"{ value = \"summary.statsu\", is = \"moving\" }",
              ":7:20: error: case cube-weight, density 2000: no text (summary.statsu)"},
        Fault{"{ when = \"0\", value = \"time\", expect = 1, relative = 1 }",
              ":1:2: error: case cube-weight, density 2000: no check holds for it, one is needed"},
        Fault{"{ value = \"time\", relative = 1 }", ":7:10: error: check has 0 references"},
        Fault{"{ value = \"time\", expect = 1, relativ = 1, absolute = 1 }",
              "error: unknown key in cube-weight.check (relativ)"}}) {
    const Answer answer = verified(check);
    EXPECT_EQ(answer.status, exit_status::bad_input) << check;
    EXPECT_NE(answer.err.find(message), std::string::npos) << answer.err;
    EXPECT_NE(answer.err.find(here), std::string::npos);
  }
  EXPECT_EQ(verify({.folder = folder / "nothing"}).status, exit_status::bad_input);
}

TEST_F(OwnCases, FaultsOfVariantsHaveTheirPlace) {
  const std::string check =
      "\nscene = \"cube.toml\"\ncheck = [{ value = \"time\", expect = 1, relative = 1 }]";
  for (const auto& [keys, message] :
       {std::pair{"vary = []", ":5:8: error: vary has the wrong type, an array of tables is needed"},
        {"vary = [{ density = [] }]", ":1:2: error: case cube-weight has no variant"},
        {"vary = [{ weight = 1 }]", ":5:20: error: weight is no parameter of cube.toml"},
        {"define = { density = 1 }",
         ":5:22: error: density is a parameter of the scene, another name is needed"},
        {"define = { a = \"= b\", b = \"= a\" }", ":5:1: error: case cube-weight: circular definition"},
        {"define = { a = \"= densiti\" }",
         ":5:1: error: case cube-weight: a (\"= densiti\"): unknown name in a formula (densiti)"}}) {
    const Answer answer = verified_table(keys + check);
    EXPECT_EQ(answer.status, exit_status::bad_input) << keys;
    EXPECT_NE(answer.err.find(message), std::string::npos) << answer.err;
  }
}

TEST(Verification, AnErrorThatIsNoNumberDoesNotPass) {
  EXPECT_FALSE(check_relative("x", std::nan(""), 1.0, 0.5).passed());
  EXPECT_TRUE(check_relative("x", 1.4, 1.0, 0.5).passed());
  EXPECT_FALSE(check_absolute("x", 1.6, 1.0, 0.5).passed());
}

}  // namespace
}  // namespace ashlar::verify_command_test
