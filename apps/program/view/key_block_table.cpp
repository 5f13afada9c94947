#include "apps/program/view/key_block_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/results/text/csv_text.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

Json value_of(const std::string& field) {
  const std::optional<double> number = csv_number(field);
  if (!number) return unmarked_csv_field(field);
  return std::isfinite(*number) ? Json(*number) : Json();
}

}  // namespace

Json read_key_blocks(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "key_blocks.csv";
  Json rows = Json::array();
  if (!std::filesystem::exists(path)) return rows;
  naming_the_file(path, [&] { require_regular_file(path); });
  std::istringstream input(naming_the_file(path, [&] { return whole_file(path); }));
  std::string line;
  std::getline(input, line);
  const std::vector<std::string> columns = split_csv_line(line);
  for (std::size_t number = 2; std::getline(input, line); ++number) {
    const std::vector<std::string> fields = split_csv_line(line);
    if (fields.size() != columns.size())
      throw std::runtime_error(fmt::format("cannot read {}: line {} has {} fields, {} are needed",
                                           path.string(), number, fields.size(), columns.size()));
    Json row;
    for (std::size_t k = 0; k < columns.size(); ++k)
      row[columns[k]] = columns[k] == "block" ? Json(unmarked_csv_field(fields[k])) : value_of(fields[k]);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace ashlar
