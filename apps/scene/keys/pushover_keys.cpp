// analysis.pushover and analysis.spectrum.
#include <fmt/format.h>

#include <limits>

#include "apps/scene/keys/analysis_keys.hpp"
#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/records/file_hash.hpp"
#include "apps/scene/records/spectrum_file.hpp"

namespace ashlar::keys {
namespace {

using Analysis = SceneAnalysis;
using Push = ScenePushover;
using Spectrum = SceneSpectrum;

constexpr int most_push_directions = 360;

/// Heights of a mechanism in a building belong together.
bool check_building(TomlTableReader& table, Push& push) {
  if (push.height.has_value() != push.building_height.has_value())
    table.error_at_table(fmt::format(
        "{} without {} (given alone), the heights of the mechanism and of its building are needed",
        push.height ? "height" : "building_height", push.height ? "building_height" : "height"));
  else if (push.height && *push.height > *push.building_height)
    table.error_at_value("height", fmt::format("height is above the building ({}), at most {} is needed",
                                               *push.height, *push.building_height));
  else if (!push.height && (push.storeys || push.period))
    table.error_at_table(
        "storeys and period belong to a mechanism in a building, height and building_height are needed");
  else
    return true;
  return false;
}

const Keys<Push> push_table(
    "",
    {direction("direction", &Push::direction, "",
               "`pushover` only, and required there unless `directions` is given: not zero, any length. "
               "Forces act along it, and the displacement is that along it"),
     whole("directions", &Push::directions, 2, most_push_directions, "",
           "so many horizontal directions at equal angles, the first one along the horizontal part of "
           "`direction`, or x. The one with the least multiplier is shown"),
     name("control", &Push::control,
          "name of a `[[measure]]` of a point or block whose displacement is that of the curve. None: the "
          "mean of the blocks that move first, by mass"),
     number_or("auto", "limit", &Push::limit, range::positive, "m",
               "largest displacement. Auto: the diagonal of the box around all blocks that may move"),
     names("blocks", &Push::blocks,
           "names or globs of blocks whose `[[block.load]]`s are multiplied. None: forces in proportion to "
           "mass, 1 being the weight")
         .unless_empty(),
     number("confidence_factor", &Push::confidence_factor, range::at_least_one, "",
            "of the kinematic check. None: 1.35"),
     number("behaviour_factor", &Push::behaviour_factor, range::at_least_one, "",
            "q, of the linear check. None: 2"),
     number("height", &Push::height, range::not_negative, "m",
            "of what the mechanism stands on above the foundation of its building"),
     number("building_height", &Push::building_height, range::positive, "m", "with `height` only"),
     whole("storeys", &Push::storeys, 1, std::numeric_limits<int>::max(), "", "of the building. None: 1"),
     number("period", &Push::period, range::positive, "s",
            "first period of the building. None: 0.05 `building_height`^(3/4)")},
    {check_building});

const Keys<Push>& push_keys() {
  return push_table;
}

bool in_scene(const Spectrum& spectrum) {
  return spectrum.source == Spectrum::Source::points && spectrum.file.empty();
}
bool from_file(const Spectrum& spectrum) {
  return spectrum.source == Spectrum::Source::points && !spectrum.file.empty();
}
bool ec8(const Spectrum& spectrum) {
  return spectrum.source == Spectrum::Source::ec8;
}
bool ntc(const Spectrum& spectrum) {
  return spectrum.source == Spectrum::Source::ntc2018;
}
bool of_code(const Spectrum& spectrum) {
  return ec8(spectrum) || ntc(spectrum);
}

bool read_points(TomlTableReader& table, const std::string& key, Spectrum& spectrum) {
  std::vector<std::vector<double>> rows;
  if (!table.read_rows(key, rows, 2, 1, "[T, Sa]")) return false;
  spectrum.source = Spectrum::Source::points;
  for (const std::vector<double>& row : rows) {
    const bool in_order = spectrum.points.empty() || row[0] > spectrum.points.back().period;
    if (row[0] < 0.0 || row[1] < 0.0 || !in_order) {
      table.error_at_value(
          key, fmt::format("points of a spectrum are out of order or negative ([{}, {}]), periods "
                           "that increase from 0 and accelerations of at least 0 are needed",
                           row[0], row[1]));
      return false;
    }
    spectrum.points.push_back({row[0], row[1]});
  }
  return true;
}

Json json_of_points(const Spectrum& spectrum) {
  Json points = Json::array();
  for (const auto& [period, acceleration] : spectrum.points) points.push_back({period, acceleration});
  return points;
}

bool read_scale(TomlTableReader& table, const std::string& key, Spectrum& spectrum) {
  std::optional<double> scale;
  if (!table.read_number_or_word(key, "g", scale, range::positive)) return false;
  spectrum.scale = scale.value_or(standard_gravity);
  return true;
}

/// Reads the file, whose scale is known.
bool read_file(TomlTableReader& table, Spectrum& spectrum) {
  if (spectrum.file.empty()) return true;
  TomlReading& reading = table.reading();
  auto points = read_spectrum(spectrum.file.string(), spectrum.scale, reading.folder(),
                              reading.places().value(table.path("file")), reading.diagnostics());
  if (!points) {
    spectrum.file.clear();
    return false;
  }
  spectrum.source = Spectrum::Source::points;
  spectrum.points = std::move(*points);
  spectrum.sha256 = sha256_of(reading.folder() / spectrum.file);
  return true;
}

bool check_source(TomlTableReader& table, Spectrum&) {
  return check_one_of(table, "source", {"points", "file", "code"});
}

const Own<Spectrum> points = {"an array of [T, Sa]", [] { return schema_of_array(schema_of_row(2), 1); },
                              read_points, json_of_points};
const Own<Spectrum> scale = {
    "a number > 0 or \"g\"",
    [] {
      return schema_of_any({Json{{"const", "g"}}, schema_of_number(range::positive, "number")});
    },
    read_scale, [](const Spectrum& spectrum) { return Json(spectrum.scale); }};

std::vector<Key<Spectrum>> keys_of_points() {
  return {own("points", points, "",
              "`pushover` only: s and m/s^2, elastic response spectrum at the ground that the check compares "
              "with; periods increase, linear between them, constant beyond. Exactly one of `points`, `file` "
              "and `code`")
              .written_if(in_scene)
              .otherwise("none"),
          name("file", &Spectrum::file,
               "a table of periods (first column) and accelerations (`pseudo_acceleration`, else the second "
               "column), as `ashlar spectrum` writes"),
          own("scale", scale, "", "of the accelerations of `file`. None: 1").written_if(from_file),
          found<Spectrum>("sha256", [](const Spectrum& spectrum) {
            return from_file(spectrum) ? Json(spectrum.sha256) : Json();
          })};
}

std::vector<Key<Spectrum>> keys_of_code() {
  return {choice("code", &Spectrum::source, spectrum_code_names, "EN 1998-1, 3.2.2.2, or NTC 2018, 3.2.3.2")
              .written_if(of_code),
          number("ag", &Spectrum::ground_acceleration, range::positive, "m/s^2",
                 "of a code: acceleration of the ground on rock")
              .required_where(of_code)
              .written_if(of_code)
              .otherwise("none"),
          choice("soil", &Spectrum::soil, soil_names, "of a code")
              .required_where(of_code)
              .written_if(of_code)
              .otherwise("none"),
          whole("type", &Spectrum::type, 1, 2, "", "of ec8. None: 1").written_if(ec8),
          number("f0", &Spectrum::amplification, range::positive, "", "F0, of ntc2018")
              .required_where(ntc)
              .written_if(ntc)
              .otherwise("none"),
          number("tc_star", &Spectrum::corner_period, range::positive, "s", "TC*, of ntc2018")
              .required_where(ntc)
              .written_if(ntc)
              .otherwise("none"),
          number("topography", &Spectrum::topography, range::at_least_one, "", "ST, of ntc2018. None: 1")
              .written_if(ntc),
          number("damping", &Spectrum::damping, range::positive, "percent", "of a code. None: 5")
              .written_if(of_code)};
}

const Keys<Spectrum> spectrum_table("", joined(keys_of_points(), keys_of_code()), {read_file, check_source});

const Keys<Spectrum>& spectrum_keys() {
  return spectrum_table;
}

bool is_pushover(const Analysis& analysis) {
  return analysis.type == Analysis::Type::pushover;
}

}  // namespace

Key<SceneAnalysis> pushover_of_analysis() {
  return table<push_keys>("pushover", &Analysis::pushover, "").written_if(is_pushover);
}

Key<SceneAnalysis> spectrum_of_analysis() {
  // A stage replaces all of it.
  const TableHolder holder{table_keys<spectrum_keys>,
                           [](void* member) -> void* {
                             *static_cast<Spectrum*>(member) = {};
                             return member;
                           },
                           [](const void* member) -> const void* {
                             const bool none =
                                 static_cast<const Spectrum*>(member)->source == Spectrum::Source::none;
                             return none ? nullptr : member;
                           }};
  return key_of("spectrum", &Analysis::spectrum, table_values(holder), "", "").written_if(is_pushover);
}

bool check_push_direction(TomlTableReader& table, SceneAnalysis& analysis) {
  const Push& push = analysis.pushover;
  if (!is_pushover(analysis) || push.direction || push.directions) return true;
  const toml::table* given = table.table_at("pushover");
  if (given != nullptr && (given->contains("direction") || given->contains("directions"))) return true;
  table.error_at_key("pushover", "a pushover has no direction, direction or directions is needed");
  return false;
}

}  // namespace ashlar::keys
