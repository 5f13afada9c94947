#include "apps/scene/read/pushover_reader.hpp"

#include <fmt/format.h>

#include <limits>
#include <string>
#include <utility>

#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/records/file_hash.hpp"
#include "apps/scene/records/spectrum_file.hpp"

namespace ashlar {
namespace {

constexpr int most_push_directions = 360;

void read_directions(TomlTableReader& table, ScenePushover& pushover) {
  Vector3 direction;
  if (table.read_vector("direction", direction)) {
    pushover.direction = direction;
    if (!(direction.norm() > 0.0))
      table.error_at_value("direction", "direction is zero ([0, 0, 0]), a vector of any length is needed");
  }
  table.read_integer("directions", pushover.directions, 2, most_push_directions);
}

/// Heights of a mechanism in a building belong together.
void read_building(TomlTableReader& table, ScenePushover& pushover) {
  table.read_number("height", pushover.height, range::not_negative);
  table.read_number("building_height", pushover.building_height, range::positive);
  table.read_integer("storeys", pushover.storeys, 1, std::numeric_limits<int>::max());
  table.read_number("period", pushover.period, range::positive);
  if (pushover.height.has_value() != pushover.building_height.has_value())
    table.error_at_table(fmt::format(
        "{} without {} (given alone), the heights of the mechanism and of its building are needed",
        pushover.height ? "height" : "building_height", pushover.height ? "building_height" : "height"));
  else if (pushover.height && *pushover.height > *pushover.building_height)
    table.error_at_value("height", fmt::format("height is above the building ({}), at most {} is needed",
                                               *pushover.height, *pushover.building_height));
  else if (!pushover.height && (pushover.storeys || pushover.period))
    table.error_at_table(
        "storeys and period belong to a mechanism in a building, height and building_height are needed");
}

void read_points(TomlTableReader& table, SceneSpectrum& spectrum) {
  std::vector<std::vector<double>> rows;
  if (!table.read_rows("points", rows, 2, 1, "[T, Sa]")) return;
  spectrum.source = SceneSpectrum::Source::points;
  for (const std::vector<double>& row : rows) {
    const bool in_order = spectrum.points.empty() || row[0] > spectrum.points.back().period;
    if (row[0] < 0.0 || row[1] < 0.0 || !in_order) {
      table.error_at_value(
          "points", fmt::format("points of a spectrum are out of order or negative ([{}, {}]), periods "
                                "that increase from 0 and accelerations of at least 0 are needed",
                                row[0], row[1]));
      return;
    }
    spectrum.points.push_back({row[0], row[1]});
  }
}

void read_spectrum_file(TomlTableReader& table, SceneSpectrum& spectrum) {
  std::string file;
  std::optional<double> scale = spectrum.scale;
  const bool given = table.read_name("file", file);
  if (table.read_number_or_word("scale", "g", scale, range::positive))
    spectrum.scale = scale.value_or(standard_gravity);
  if (!given) return;
  TomlReading& reading = table.reading();
  auto points = read_spectrum(file, spectrum.scale, reading.folder(),
                              reading.places().value(table.path("file")), reading.diagnostics());
  if (!points) return;
  spectrum.source = SceneSpectrum::Source::points;
  spectrum.file = file;
  spectrum.points = std::move(*points);
  spectrum.sha256 = sha256_of(reading.folder() / spectrum.file);
}

void read_code(TomlTableReader& table, SceneSpectrum& spectrum) {
  const bool given = table.read_choice("code", spectrum.source, spectrum_code_names);
  const bool has_ground = table.read_number("ag", spectrum.ground_acceleration, range::positive);
  const bool has_soil = table.read_choice("soil", spectrum.soil, soil_names);
  table.read_integer("type", spectrum.type, 1, 2);
  const bool has_factor = table.read_number("f0", spectrum.amplification, range::positive);
  const bool has_corner = table.read_number("tc_star", spectrum.corner_period, range::positive);
  table.read_number("topography", spectrum.topography, range::at_least_one);
  table.read_number("damping", spectrum.damping, range::positive);
  if (!given) return;
  const auto need = [&](bool has, const char* key) {
    if (!has && !table.given(key)) table.require(key);
  };
  need(has_ground, "ag");
  need(has_soil, "soil");
  if (spectrum.source != SceneSpectrum::Source::ntc2018) return;
  need(has_factor, "f0");
  need(has_corner, "tc_star");
}

void read_demand(TomlTableReader table, bool given, SceneSpectrum& spectrum) {
  if (given) spectrum = {};  // a stage replaces all of it
  read_points(table, spectrum);
  read_spectrum_file(table, spectrum);
  read_code(table, spectrum);
  const int sources = static_cast<int>(table.given("points")) + static_cast<int>(table.given("file")) +
                      static_cast<int>(table.given("code"));
  if (given && sources != 1)
    table.error_at_table(
        fmt::format("spectrum has {} of points, file and code, exactly one of them is needed", sources));
}

}  // namespace

void read_pushover(TomlTableReader& table, SceneAnalysis& analysis) {
  const bool spectrum = table.given("spectrum");
  TomlTableReader pushover = table.table_or_empty("pushover");
  ScenePushover& keys = analysis.pushover;
  read_directions(pushover, keys);
  pushover.read_name("control", keys.control);
  pushover.read_number_or_auto("limit", keys.limit, range::positive);
  pushover.read_texts("blocks", keys.blocks);
  pushover.read_number("confidence_factor", keys.confidence_factor, range::at_least_one);
  pushover.read_number("behaviour_factor", keys.behaviour_factor, range::at_least_one);
  read_building(pushover, keys);
  if (analysis.type == SceneAnalysis::Type::pushover && !keys.direction && !keys.directions &&
      !pushover.given("direction") && !pushover.given("directions"))
    pushover.error_at_table("a pushover has no direction, direction or directions is needed");
  read_demand(table.table_or_empty("spectrum"), spectrum, analysis.spectrum);
}

}  // namespace ashlar
