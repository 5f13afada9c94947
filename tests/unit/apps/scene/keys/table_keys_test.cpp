#include "apps/scene/keys/table_keys.hpp"

#include <gmock/gmock.h>

#include "apps/scene/keys/values.hpp"

namespace ashlar::test::table_keys_test {
namespace {

using namespace keys;  // NOLINT: the words of declarations
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A beam with a spring, or a hinge in its place.
struct Spring {
  double stiffness = 0.0;
  std::optional<double> limit;
};
struct Beam {
  enum class Material { steel, timber };
  std::string name;
  double length = 2.5;
  std::optional<double> moisture;
  Material material = Material::steel;
  std::optional<Spring> spring;
  bool hinge = false;
};
constexpr std::array<std::pair<const char*, Beam::Material>, 2> material_words = {
    {{"steel", Beam::Material::steel}, {"timber", Beam::Material::timber}}};

const Keys<Spring> spring_table(
    "", {number("stiffness", &Spring::stiffness, range::positive, "N/m", "").required_always(),
         number("limit", &Spring::limit, range::positive, "N", "of its force").otherwise("unlimited")});
const Keys<Spring>& spring_keys() {
  return spring_table;
}

bool of_timber(const Beam& beam) {
  return beam.material == Beam::Material::timber;
}

bool check_length(TomlTableReader& table, Beam& beam) {
  if (beam.length < 10.0) return true;
  table.error_at_value("length", "too long");
  return false;
}

const Keys<Beam> beam_table("A beam",
                            {name("name", &Beam::name, "unique").required_always(),
                             number("length", &Beam::length, range::positive, "m", "between supports"),
                             choice("material", &Beam::material, material_words, ""),
                             number("moisture", &Beam::moisture, range::zero_to_one, "", "")
                                 .required_where(of_timber)
                                 .only_if(of_timber, "timber"),
                             table<spring_keys>("spring", &Beam::spring, ""),
                             flag("hinge", &Beam::hinge, "in place of the spring").not_beside({"spring"})},
                            {check_length});

struct Answer {
  std::vector<Beam> beams;
  std::vector<std::string> faults;
};

Answer read(const std::string& text) {
  Diagnostics diagnostics;
  ScenePlaces places;
  const toml::table document = parse_toml(text, "b.toml");
  TomlReading reading({"b.toml"}, diagnostics, places);
  TomlTableReader top(reading, document, "", "");
  Answer answer;
  answer.beams = beam_table.read_all(top, "beam");
  reading.report_unknown_keys();
  for (const Diagnostic& fault : diagnostics.sorted()) answer.faults.push_back(to_string(fault));
  return answer;
}

TEST(TableKeys, ReadTheirMembers) {
  const Answer answer = read(
      "[[beam]]\nname = \"B\"\nlength = \"= 2*2\"\nmaterial = \"timber\"\nmoisture = 0.2\n"
      "spring = { stiffness = 7 }\n[[beam]]\nname = \"C\"\n");
  EXPECT_THAT(answer.faults, IsEmpty());
  ASSERT_EQ(answer.beams.size(), 2U);
  const Beam& beam = answer.beams[0];
  EXPECT_EQ(beam.name, "B");
  EXPECT_EQ(beam.length, 4.0);
  EXPECT_TRUE(of_timber(beam));
  EXPECT_EQ(beam.moisture, 0.2);
  ASSERT_TRUE(beam.spring);
  EXPECT_EQ(beam.spring->stiffness, 7.0);
  EXPECT_FALSE(beam.spring->limit);
  EXPECT_EQ(answer.beams[1].length, 2.5);
  EXPECT_FALSE(answer.beams[1].spring);
}

TEST(TableKeys, ReportEveryFaultAtItsPlace) {
  const Answer answer = read(
      "[[beam]]\nlength = 12\nmaterial = \"steel\"\nmoisture = 0.2\nhinge = true\n"
      "spring = { stifness = 7 }\n[[beam]]\nname = \"C\"\nmaterial = \"timber\"\nlength = -1\n");
  EXPECT_THAT(
      answer.faults,
      ElementsAre("b.toml:1:1: error: missing key (name), beam needs it", "b.toml:2:10: error: too long",
                  "b.toml:4:1: error: moisture has no effect without timber, leave it out or choose that",
                  "b.toml:5:1: error: hinge beside spring (both given), only one of both is allowed",
                  "b.toml:6:1: error: missing key (stiffness), beam.spring needs it",
                  "b.toml:6:12: error: unknown key in beam.spring (stifness), did you mean stiffness? "
                  "known here: limit, stiffness",
                  "b.toml:7:1: error: missing key (moisture), beam needs it",
                  "b.toml:10:10: error: length is out of range (-1), a number > 0 is needed"));
}

TEST(TableKeys, WriteWhatAppliesInTheirOrder) {
  Beam beam;
  beam.name = "B";
  beam.moisture = 0.5;  // of steel: not written
  beam.spring = Spring{7.0, 9.0};
  EXPECT_EQ(
      beam_table.json(beam).dump(),
      R"({"name":"B","length":2.5,"material":"steel","spring":{"stiffness":7.0,"limit":9.0},"hinge":false})");
  beam.material = Beam::Material::timber;
  beam.spring.reset();
  EXPECT_EQ(beam_table.json(beam).dump(),
            R"({"name":"B","length":2.5,"material":"timber","moisture":0.5,"hinge":false})");
}

TEST(TableKeys, HaveASchema) {
  const Json schema = beam_table.table().schema();
  EXPECT_EQ(schema["description"], "A beam");
  EXPECT_EQ(schema["required"], Json({"name"}));
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["length"]["description"], "m, between supports");
  EXPECT_EQ(schema["properties"]["length"]["anyOf"][0]["exclusiveMinimum"], 0.0);
  EXPECT_EQ(schema["properties"]["material"]["enum"], Json({"steel", "timber"}));
  EXPECT_EQ(schema["properties"]["spring"]["required"], Json({"stiffness"}));
}

TEST(TableKeys, HaveRowsForTheReference) {
  std::vector<std::string> rows;
  for (const Json& row : beam_table.table().rows()) {
    std::string text;
    for (const char* cell : {"key", "value", "unit", "default", "meaning"})
      text += row.at(cell).get<std::string>() + "|";
    rows.push_back(text);
  }
  EXPECT_THAT(
      rows,
      ElementsAre("name|a text in quotes||required|unique|", "length|a number > 0|m|`2.5`|between supports|",
                  "material|one of \"steel\", \"timber\"||`\"steel\"`||",
                  "moisture|a number from 0 to 1||required||", "spring.stiffness|a number > 0|N/m|required||",
                  "spring.limit|a number > 0|N|unlimited|of its force|",
                  "hinge|true or false||`false`|in place of the spring|"));
}

}  // namespace
}  // namespace ashlar::test::table_keys_test
