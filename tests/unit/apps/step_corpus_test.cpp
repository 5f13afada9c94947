// Scenes whose steps once failed, each with claims on its summary (data/corpora/steps):
//   # claim: /pointer/into/summary OP VALUE      OP: ==, < or >; VALUE: JSON
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::step_corpus_test {
namespace {

using Json = nlohmann::json;

struct Claim {
  Json::json_pointer place;
  std::string relation;
  Json value;

  [[nodiscard]] bool holds(const Json& summary) const {
    if (!summary.contains(place)) return false;
    const Json& found = summary.at(place);
    if (relation == "==") return found == value;
    return relation == "<" ? found < value : found > value;
  }
};

/// Lines "# claim: PLACE RELATION VALUE".
std::vector<Claim> claims_of(const std::filesystem::path& scene) {
  const std::string start = "# claim: ";
  std::vector<Claim> claims;
  std::ifstream file(scene);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(start)) continue;
    std::istringstream parts(line.substr(start.size()));
    std::string place, relation, value;
    parts >> place >> relation >> std::ws;
    std::getline(parts, value);
    if (relation != "==" && relation != "<" && relation != ">")
      throw std::runtime_error(scene.string() + ": a claim without a relation: " + line);
    claims.push_back({Json::json_pointer(place), relation, Json::parse(value)});
  }
  return claims;
}

std::vector<std::filesystem::path> scenes() {
  std::vector<std::filesystem::path> result;
  for (const auto& entry : std::filesystem::directory_iterator(ASHLAR_DATA_DIR "/corpora/steps"))
    if (entry.path().extension() == ".toml") result.push_back(entry.path());
  std::sort(result.begin(), result.end());
  return result;
}

class StepCorpus : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(StepCorpus, HoldsWhatItClaims) {
  const std::vector<Claim> claims = claims_of(GetParam());
  ASSERT_FALSE(claims.empty()) << "a scene of the corpus claims something";
  const TemporaryFolder folder;
  std::ostringstream out, err;
  ASSERT_EQ(
      run_command_line({"run", GetParam().string(), "--out", (folder / "out").string(), "--quiet"}, out, err),
      exit_status::done)
      << err.str();
  const Json summary = Json::parse(read_text(folder / "out/summary.json"));
  for (const Claim& claim : claims) {
    EXPECT_TRUE(claim.holds(summary))
        << claim.place << " " << claim.relation << " " << claim.value << ", but it is "
        << (summary.contains(claim.place) ? summary.at(claim.place).dump() : "missing");
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, StepCorpus, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param.stem().string(); });

TEST(StepCorpusClaims, AreRefusedWhereTheyDoNotHold) {
  const Json summary = {{"status", "completed"}, {"deepest", {{"value", 0.5}}}};
  const auto holds = [&](const char* place, const char* relation, const Json& value) {
    return Claim{Json::json_pointer(place), relation, value}.holds(summary);
  };
  EXPECT_TRUE(holds("/status", "==", "completed"));
  EXPECT_FALSE(holds("/status", "==", "failed"));
  EXPECT_TRUE(holds("/deepest/value", "<", 0.6));
  EXPECT_FALSE(holds("/deepest/value", "<", 0.5));
  EXPECT_TRUE(holds("/deepest/value", ">", 0.4));
  EXPECT_FALSE(holds("/deepest/share", "<", 1.0)) << "what is missing is not small";
}

}  // namespace
}  // namespace ashlar::step_corpus_test
