// The reference of scenes, apps/docs/reference/scene.md, agrees with the reader.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "apps/scene/assemble/scene_schema.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_reference_test {
namespace {

const std::string least_scene = scene_with_every_table();

// Entries of [[masonry]] in it.
constexpr int masonry_kinds = 4;

// The same with nothing in any table.
const std::string empty_scene = R"(joint = [{}]
material = [{}]
masonry = [{}, { kind = "wall", openings = [{ box = {}, lintel = {} }] }, { kind = "arch", fill = {} }, { kind = "column" },
           { kind = "dome" }]
assign = [{}, { inside = { box = {} } }, { inside = { mesh = {} } }, { inside = { hull = {} } },
          { inside = { sphere = {} } }, { inside = { halfspace = {} } }]
load = [{}]
bolt = [{}, { pattern = { plane = {} } }]
prop = [{}]
measure = [{}, { drift = {} }, { crack = {} }]
water = [{ level = {} }]
initial_stress = {}
boundary = [{ plane = {} }]
[[block]]
box = {}
rotate = {}
array = {}
[[block.fix]]
plane = {}
[[block.load]]
plane = {}
[[block]]
mesh = {}
[[block]]
hull = {}
[[block]]
sphere = {}
[[cut]]
spacing = {}
[[cut]]
solid = { box = {} }
[[cut]]
solid = { mesh = {} }
[[cut]]
solid = { hull = {} }
[[cut]]
solid = { sphere = {} }
[[cut]]
voronoi = {}
[[cut]]
bonded = { fracture_energy = {} }
)";

struct Row {
  std::string value;
  std::string fallback;
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" `"), last = text.find_last_not_of(" `");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// "block.fix.point" and the like, from the rows `| `key` | value | default | meaning |` below headings
// "## `[[block.fix]]`"; keys below another heading stand at the top of the file.
std::map<std::string, Row> reference() {
  std::map<std::string, Row> rows;
  std::string table;
  for (const std::string& line : lines_of(read_text(ASHLAR_DATA_DIR "/../apps/docs/reference/scene.md"))) {
    if (line.starts_with('#')) {
      const std::size_t start = line.find('['), end = line.find(']');
      table = start == std::string::npos ? "" : fmt::format("{}.", line.substr(start, end - start));
      table.erase(0, table.find_first_not_of('['));
    }
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(trimmed(cell));
    if (cells.size() == 4) rows[table + cells[0]] = {cells[1], cells[2]};
  }
  return rows;
}

std::string between(const std::string& text, const std::string& start, const std::string& end) {
  const std::size_t found = text.find(start);
  if (found == std::string::npos) return "";
  const std::size_t from = found + start.size();
  return text.substr(from, text.find(end, from) - from);
}

std::string joined(const std::string& table, const std::string& key) {
  return table.empty() ? key : fmt::format("{}.{}", table, key);
}

// Every key that the reader knows.
std::set<std::string> known_keys() {
  std::string text = fmt::format("unknown = 0\n{}", least_scene);
  text.replace(
      text.find("[analysis]\n"), 11,
      "[analysis]\nsafety = { tolerance = 1 }\ncapacity = { tolerance = 1 }\nmovement = { limit = 1 }\n"
      "pushover = { limit = 1 }\nspectrum = { damping = 5 }\n");
  for (const std::string header :
       {"[analysis]\n", "[contact]\n", "[[joint]]\n", "[[material]]\n", "[[block]]\n", "[[block.fix]]\n",
        "[[block.load]]\n", "[[masonry]]\n", "[[assign]]\n", "[[cut]]\n", "[[load]]\n", "[[bolt]]\n",
        "[[prop]]\n", "[[water]]\n", "[initial_stress]\n", "[[boundary]]\n", "[[measure]]\n", "[[stage]]\n",
        "[output]\n"})
    for (std::size_t at = 0; (at = text.find(header, at)) != std::string::npos;)
      text.insert(at += header.size(), "unknown = 0\n");
  for (std::size_t at = 0; (at = text.find("{ ", at)) != std::string::npos; at += 2)
    text.replace(at, 2, "{ unknown = 0, ");
  std::set<std::string> keys;
  for (const std::string& fault : reading_faults(text)) {
    const std::string table = between(fault, "unknown key in ", " (unknown)");
    std::istringstream list(between(fault, "known here: ", "\n"));
    for (std::string key; std::getline(list, key, ',');) keys.insert(joined(table, trimmed(key)));
  }
  // A stage's analysis has the keys of [analysis], which are described once.
  std::erase_if(keys, [&](const std::string& key) {
    constexpr std::string_view of_stage = "stage.";
    return key.starts_with("stage.analysis.") && keys.contains(key.substr(of_stage.size()));
  });
  return keys;
}

TEST(SceneReference, NamesEveryKeyAndNoOther) {
  const std::set<std::string> known = known_keys();
  EXPECT_TRUE(known.contains("block.fix.plane.normal")) << "the reader was asked";
  std::set<std::string> named = {"include", "parameters"};
  for (const auto& [path, row] : reference())
    for (std::string part = path; !part.empty();
         part.erase(part.find('.') == std::string::npos ? 0 : part.rfind('.')))
      named.insert(part);
  std::vector<std::string> missing, idle;
  std::set_difference(known.begin(), known.end(), named.begin(), named.end(), std::back_inserter(missing));
  std::set_difference(named.begin(), named.end(), known.begin(), known.end(), std::back_inserter(idle));
  EXPECT_THAT(missing, ::testing::IsEmpty()) << "keys that the reference lacks";
  EXPECT_THAT(idle, ::testing::IsEmpty()) << "keys that no reader has";
}

// "block.fix.point" as --set takes it: "block.0.fix.0.point".
std::string path_in(std::string path, int block) {
  for (const std::string list : {"joint.", "material.", "cut.", "load.", "bolt.", "prop.", "water.",
                                 "boundary.", "measure.", "assign.", "stage."})
    if (path.starts_with(list)) path.insert(list.size(), "0.");
  if (path.starts_with("block.")) path.insert(6, fmt::format("{}.", block));
  if (path.starts_with("masonry.")) path.insert(8, fmt::format("{}.", block));
  for (const std::string list : {".fix.", ".load.", ".openings."})
    if (const std::size_t at = path.find(list); at != std::string::npos) path.insert(at + list.size(), "0.");
  return path;
}

TEST(SceneReference, ValuesAreInTheReadersWords) {
  for (const auto& [path, row] : reference()) {
    if (row.value == "a table") continue;
    bool refused = false;
    // Keys of masonry are those of its kind.
    for (int entry = 0; entry < (path.starts_with("masonry.") ? masonry_kinds : 1); ++entry) {
      const std::vector<std::string> faults = reading_faults(least_scene, {path_in(path, entry) + "={}"});
      for (const std::string& fault : faults) {
        const std::string words = between(fault, "the wrong type (a table), ", " is needed");
        if (words.empty()) continue;
        refused = true;
        EXPECT_EQ(row.value, words) << path;
      }
    }
    EXPECT_TRUE(refused) << path;
  }
}

TEST(SceneReference, RequiredIsWhatTheReaderMisses) {
  std::set<std::string> missing = {"block.material", "masonry.material"};  // of blocks that are not fixed
  // The times of the one analysis, or those of stages.
  for (const char* more : {"", "stage = [{ analysis = { end_time = 1, time_step = 1 } }]\n"}) {
    for (const std::string& fault : reading_faults(more + empty_scene)) {
      const std::string key = between(fault, "missing key (", ")");
      if (!key.empty()) missing.insert(joined(between(fault, key + "), ", " needs it"), key));
    }
  }
  std::set<std::string> required;
  for (const auto& [path, row] : reference())
    if (row.fallback == "required") required.insert(path);
  EXPECT_EQ(required, missing);
}

TEST(SceneReference, DefaultsAreTheReaders) {
  Diagnostics diagnostics;
  const nlohmann::json scene = to_json(parse_scene(least_scene, "s.toml", {}, diagnostics));
  EXPECT_THAT(printed(diagnostics), ::testing::IsEmpty());
  int compared = 0;
  for (const auto& [path, row] : reference()) {
    const nlohmann::json fallback = nlohmann::json::parse(row.fallback, nullptr, false);
    if (fallback.is_discarded()) continue;  // words
    bool found = false;
    for (int block = 0; block < 4 && !found; ++block) {
      std::string pointer = fmt::format("/{}", path_in(path, block));
      std::replace(pointer.begin(), pointer.end(), '.', '/');
      const nlohmann::json::json_pointer place(pointer);
      found = scene.contains(place);
      if (found) {
        EXPECT_EQ(scene.at(place), fallback) << path;
      }
    }
    EXPECT_TRUE(found) << path;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

}  // namespace
}  // namespace ashlar::test::scene_reference_test
