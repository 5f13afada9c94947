#include "apps/scene/read/formulation_reader.hpp"

#include <gmock/gmock.h>

#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::formulation_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Formulation = SceneAnalysis::Formulation;
using Springs = SceneContact::Springs;
using Surface = SceneContact::Surface;

Scene read(const std::vector<std::string>& overrides, const std::string& text = sample()) {
  Diagnostics diagnostics;
  Scene scene = parse_scene(text, "s.toml", overrides, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  return scene;
}

TEST(FormulationReader, PaperIsTheIncrementalFormulationWithPointSpringsAndFlatSubFaces) {
  const Scene scene = read({"analysis.formulation=paper"});
  EXPECT_EQ(scene.analysis.formulation, Formulation::incremental);
  EXPECT_TRUE(scene.analysis.paper);
  EXPECT_EQ(scene.contact.springs, Springs::point);
  EXPECT_EQ(scene.contact.surface, Surface::flat);
}

// These words have the same meaning in all versions, and no warning.
TEST(FormulationReader, EachKeyOfContactHasItsOwnMeaningWithTheOtherFormulations) {
  const Scene total = read({});
  EXPECT_EQ(total.analysis.formulation, Formulation::total);
  EXPECT_EQ(total.contact.springs, Springs::area);
  EXPECT_EQ(total.contact.surface, Surface::curved);
  const Scene points = read({"contact.springs=point", "contact.surface=flat"});
  EXPECT_EQ(points.analysis.formulation, Formulation::total);
  EXPECT_EQ(points.contact.springs, Springs::point);
  EXPECT_EQ(points.contact.surface, Surface::flat);
  const Scene incremental = read({"analysis.formulation=incremental"});
  EXPECT_EQ(incremental.analysis.formulation, Formulation::incremental);
  EXPECT_FALSE(incremental.analysis.paper);
  EXPECT_EQ(incremental.contact.springs, Springs::area);
  EXPECT_EQ(incremental.contact.surface, Surface::flat);
  const Scene three_keys =
      read({"analysis.formulation=incremental", "contact.springs=point", "contact.surface=flat"});
  EXPECT_FALSE(three_keys.analysis.paper);
  EXPECT_EQ(three_keys.contact.springs, Springs::point);
  EXPECT_EQ(three_keys.contact.surface, Surface::flat);
}

TEST(FormulationReader, KeysOfContactThatContradictTheFormulationAreReported) {
  EXPECT_THAT(reading_faults(sample_with(5, "springs = \"area\""), {"analysis.formulation=paper"}),
              ElementsAre("s.toml:5:11: error: springs is not that of formulation = \"paper\" (\"area\"), "
                          "\"point\" or no springs is needed"));
  EXPECT_THAT(reading_faults(sample_with(5, "springs = \"area\""), {"analysis.formulation=incremental"}),
              IsEmpty());
  for (const std::string formulation : {"incremental", "paper"}) {
    EXPECT_THAT(
        reading_faults(sample_with(5, "surface = \"curved\""), {"analysis.formulation=" + formulation}),
        ElementsAre("s.toml:5:11: error: surface is not that of formulation = \"" + formulation +
                    "\" (\"curved\"), \"flat\" or no surface is needed"));
    EXPECT_THAT(reading_faults(sample_with(5, "surface = \"flat\""), {"analysis.formulation=" + formulation}),
                IsEmpty());
  }
}

TEST(FormulationReader, TheWordIsWrittenAsItWasGiven) {
  for (const std::string word : {"total", "incremental", "paper"}) {
    const nlohmann::json json = to_json(read({"analysis.formulation=" + word}));
    EXPECT_EQ(json["analysis"]["formulation"], word);
    // The written scene reads as the same one.
    const auto of_contact = [&](const char* key) {
      return std::string("contact.") + key + "=" + json["contact"][key].get<std::string>();
    };
    EXPECT_EQ(nlohmann::json(to_json(
                  read({"analysis.formulation=" + word, of_contact("springs"), of_contact("surface")}))),
              json);
  }
}

TEST(FormulationReader, TheFirstStageDecides) {
  const Scene scene =
      read({}, sample() + "[[stage]]\nname = \"a\"\nanalysis = { formulation = \"paper\" }\n");
  EXPECT_TRUE(scene.analysis.paper);
  EXPECT_EQ(scene.contact.springs, Springs::point);
  EXPECT_EQ(scene.contact.surface, Surface::flat);
}

TEST(FormulationReader, LaterStagesHaveTheFormulationOfTheFirst) {
  const auto faults_of = [](const std::string& word) {
    const std::string stages =
        "[[stage]]\nname = \"a\"\n[[stage]]\nname = \"b\"\nanalysis = { formulation = \"" + word + "\" }\n";
    Diagnostics diagnostics;
    check_stages(read({"analysis.formulation=paper"}, sample() + stages), diagnostics);
    return printed(diagnostics);
  };
  EXPECT_THAT(faults_of("paper"), IsEmpty());
  for (const char* word : {"total", "incremental"})
    EXPECT_THAT(faults_of(word),
                ElementsAre(HasSubstr(std::string("formulation changes between stages (\"") + word + "\")")));
}

}  // namespace
}  // namespace ashlar::test::formulation_reader_test
