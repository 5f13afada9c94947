#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "apps/results/folder/scratch_folder.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/read/disc_table.hpp"
#include "apps/scene/records/record_file.hpp"
#include "apps/scene/toml/formulas.hpp"
#include "fuzz/targets.hpp"

namespace ashlar::fuzz {

namespace {

bool read(std::string_view text, const std::filesystem::path& file) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, file, {}, diagnostics);
  for (const Diagnostic& fault : diagnostics.sorted())
    require(fault.place.line >= 1 && fault.place.column >= 1, "every fault has a place");
  if (!diagnostics.good()) return false;
  // The scene as used goes into summary.json, which `ashlar view` reads.
  (void)parse_json(json_text(to_json(scene)));
  return true;
}

}  // namespace

bool scene(std::string_view bytes) {
  return read(bytes, "scene.toml");
}

bool include(std::string_view bytes) {
  constexpr std::string_view between = "\n# part.toml\n";
  const std::size_t end = bytes.find(between);
  if (end == std::string_view::npos) return false;
  static const ScratchFolder folder;
  std::ofstream(folder.path() / "part.toml", std::ios::binary) << bytes.substr(end + between.size());
  return read(bytes.substr(0, end), folder.path() / "scene.toml");
}

bool formula(std::string_view bytes) {
  Formulas formulas;
  formulas.define("h", 0.25);
  formulas.define("n", 4.0);
  formulas.leave_out("lost");
  try {
    require(std::isfinite(formulas.value(std::string(1, '=').append(bytes))), "a formula's value is finite");
    return true;
  } catch (const FormulaError& error) {
    require(error.offset() <= bytes.size() + 1, "faults of formulas are in them");
    return false;
  }
}

/// Reads a record with two columns and an empty one.
static bool check_record(std::string_view bytes, const std::string& name, const std::string& first,
                         const std::string& second) {
  const SceneRecord record{
      .file = name, .time = "t", .values = {first, "", second}, .scale = 2.0, .sha256 = {}};
  Diagnostics diagnostics;
  std::istringstream content{std::string(bytes)};
  const auto rows = parse_record(record, content, name, diagnostics);
  require(rows.has_value() == diagnostics.good(), "a record that is refused has a fault");
  for (const Diagnostic& fault : diagnostics.sorted())
    require(fault.place.line >= 1 && fault.place.column >= 1, "every fault has a place");
  if (!rows) return false;
  double last = -std::numeric_limits<double>::infinity();
  for (const std::vector<double>& row : *rows) {
    require(row.size() == 4 && row[0] > last, "rows are whole and later than those before");
    for (const double value : row) require(std::isfinite(value), "values are finite");
    last = row[0];
  }
  return true;
}

bool record(std::string_view bytes) {
  return check_record(bytes, "r.csv", "a", "b");
}

bool volume2(std::string_view bytes) {
  return check_record(bytes, "r.V2", "acceleration", "velocity");
}

bool smc(std::string_view bytes) {
  return check_record(bytes, "r.smc", "a", "b");
}

bool joints(std::string_view bytes) {
  Diagnostics diagnostics;
  std::istringstream content{std::string(bytes)};
  const auto table = parse_disc_table(content, "j.csv", diagnostics);
  require(table.has_value() == diagnostics.good(), "a table that is refused has a fault");
  for (const Diagnostic& fault : diagnostics.sorted())
    require(fault.place.line >= 1 && fault.place.column >= 1, "every fault has a place");
  if (!table) return false;
  for (const MeasuredJoint& joint : *table)
    require(joint.center.allFinite() &&
                std::isfinite(joint.dip + joint.dip_direction + joint.radius.value_or(1.0)),
            "values are finite");
  return true;
}

}  // namespace ashlar::fuzz
