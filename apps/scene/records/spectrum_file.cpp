#include "apps/scene/records/spectrum_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "apps/scene/model/scene_record.hpp"
#include "apps/scene/records/record_file.hpp"
#include "apps/scene/records/text_fields.hpp"
#include "geometry/text/reading_folder.hpp"

namespace ashlar {
namespace {

/// Names of the two columns, from the first line that has fields. Files without names have numbers there.
SceneRecord columns_of(const std::filesystem::path& file, const std::filesystem::path& folder) {
  SceneRecord record;
  record.file = file;
  record.time = std::string("1");
  record.values = {"2"};
  if (!refusal_to_read(folder / file).empty()) return record;  // refused again where the record is read
  std::ifstream stream(folder / file, std::ios::binary);
  for (std::string line; std::getline(stream, line);) {
    std::string_view text = trimmed_text(line);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.empty() || text.front() == '#') continue;
    const std::vector<TextField> fields = fields_of(text, separator_of(text));
    const bool named = std::any_of(fields.begin(), fields.end(),
                                   [](const TextField& field) { return !number_of(field.text); });
    if (!named || fields.size() < 2) return record;
    record.time = std::string(fields[0].text);
    record.values[0] = std::string(fields[1].text);
    for (const TextField& field : fields)
      if (field.text == "pseudo_acceleration") record.values[0] = std::string(field.text);
    return record;
  }
  return record;
}

}  // namespace

std::optional<std::vector<SceneSpectrum::Point>> read_spectrum(const std::filesystem::path& file,
                                                               double scale,
                                                               const std::filesystem::path& folder,
                                                               const Place& place, Diagnostics& diagnostics) {
  SceneRecord record = columns_of(file, folder);
  record.scale = scale;
  const auto rows = read_record(record, folder, place, diagnostics);
  if (!rows) return std::nullopt;
  std::vector<SceneSpectrum::Point> points;
  for (const std::vector<double>& row : *rows) {
    if (row[0] < 0.0 || row[1] < 0.0) {
      diagnostics.error(
          place, fmt::format("spectrum has a negative number ({} s, {} m/s^2), periods and accelerations of "
                             "at least 0 are needed",
                             row[0], row[1]));
      return std::nullopt;
    }
    points.push_back({row[0], row[1]});
  }
  return points;
}

}  // namespace ashlar
