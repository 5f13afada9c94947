#include "apps/scene/check/formulation_checks.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::formulation_checks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::vector<std::string> faults_of(const std::string& text, const std::string& formulation) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, "s.toml", {"analysis.formulation=" + formulation}, diagnostics);
  check_formulation(scene, diagnostics);
  return printed(diagnostics);
}

TEST(FormulationChecks, TheSampleHasEachFormulation) {
  for (const char* formulation : {"total", "incremental", "paper"})
    EXPECT_THAT(faults_of(sample(), formulation), IsEmpty()) << formulation;
}

TEST(FormulationChecks, ReboundAsOfSpringsIsAllowed) {
  EXPECT_THAT(faults_of(sample_with(5, "restitution = \"springs\""), "paper"), IsEmpty());
}

TEST(FormulationChecks, FixedBlocksMayHaveOrderZero) {
  EXPECT_THAT(faults_of(sample_with(15, "fixed = true\norder = 0"), "paper"), IsEmpty());
}

class FormulationCheckFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(FormulationCheckFault, IsReportedOnceOfIncrementalBlocks) {
  const FaultCase& fault = GetParam();
  const std::string text = sample_with(fault.line, fault.replacement);
  EXPECT_THAT(faults_of(text, "total"), IsEmpty());
  for (const char* formulation : {"incremental", "paper"})
    EXPECT_THAT(faults_of(text, formulation),
                ElementsAre(AllOf(StartsWith(fault.expected),
                                  EndsWith(", leave it out or choose analysis.formulation = \"total\""))))
        << formulation;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, FormulationCheckFault,
    ::testing::Values(
        FaultCase{2, "end_time = 1.0\ntype = \"static\"",
                  "s.toml:3:8: error: static analysis of incremental blocks (type = \"static\")"},
        FaultCase{3, "time_step = 0.01\ninitial_state = \"static\"",
                  "s.toml:4:17: error: static analysis of incremental blocks (initial_state = \"static\")"},
        FaultCase{3, "time_step = 0.01\naccuracy = 0.1",
                  "s.toml:4:12: error: accuracy of incremental blocks (0.1)"},
        FaultCase{5, "chord_tolerance = 0.01",
                  "s.toml:5:19: error: the sub-faces of an incremental block are fixed, see "
                  "contact.subdivisions (0.01)"},
        FaultCase{5, "allowed_overlap = 1e-4",
                  "s.toml:5:19: error: allowed_overlap of incremental blocks, which do not keep where they "
                  "were placed (0.0001 m)"},
        FaultCase{5, "restitution = 0.5", "s.toml:5:15: error: restitution of incremental blocks (0.5)"},
        FaultCase{7, "blocks = [\"A\", \"B*\"]\nrestitution = 0.5",
                  "s.toml:8:15: error: restitution of incremental blocks (0.5)"},
        FaultCase{12, "poisson_ratio = 0.25\nelasticity = \"st-venant-kirchhoff\"",
                  "s.toml:13:14: error: an incremental block accumulates linear stress"},
        FaultCase{15, "material = \"rock\"\norder = 0",
                  "s.toml:16:9: error: a block of order 0 has no incremental formulation (\"A\")"},
        FaultCase{29, "",
                  "s.toml:28:9: error: an incremental block is measured at points only (\"tip\" has none)"},
        FaultCase{31, "curved = true",
                  "s.toml:31:10: error: the surface of an incremental block is its flat sub-faces (true)"},
        FaultCase{31, "solid = true",
                  "s.toml:31:9: error: points inside an incremental block are not tracked (true)"}));

INSTANTIATE_TEST_SUITE_P(
    Tables, FormulationCheckFault,
    ::testing::Values(
        FaultCase{31,
                  "[[water]]\nname = \"lake\"\nlevel = { point = [0, 0, 2], normal = [0, 0, 1] }\n"
                  "unit_weight = 9810",
                  "s.toml:31:1: error: water of incremental blocks"},
        FaultCase{31, "[initial_stress]\nk0 = 0.5",
                  "s.toml:31:2: error: initial stress of incremental blocks"},
        FaultCase{31, "[[boundary]]\nplane = { point = [0, 0, 0], normal = [0, 0, -1] }\nkind = \"quiet\"",
                  "s.toml:31:1: error: a boundary of incremental blocks"},
        FaultCase{31,
                  "[[bolt]]\nname = \"b\"\nfrom = [0.5, 0.5, 0.5]\nto = [0.5, 0.5, 1.5]\narea = 1e-3\n"
                  "young_modulus = 2e11\nbond_stiffness = 1e9",
                  "s.toml:31:1: error: bolts of incremental blocks"},
        FaultCase{31, "[[prop]]\nname = \"p\"\nfrom = [0.5, 0.5, 0.5]\nto = [0.5, 0.5, 1.5]\nstiffness = 1e6",
                  "s.toml:31:1: error: props of incremental blocks"},
        FaultCase{31, "[[measure]]\nname = \"d\"\ndrift = { blocks = [\"B\"], heights = [0, 1] }",
                  "s.toml:33:9: error: measure of the drift of incremental blocks (\"d\")"},
        FaultCase{31, "[[measure]]\nname = \"c\"\ncrack = { joints = [\"A\"] }",
                  "s.toml:33:9: error: measure of cracks of incremental blocks (\"c\")"}));

}  // namespace
}  // namespace ashlar::test::formulation_checks_test
