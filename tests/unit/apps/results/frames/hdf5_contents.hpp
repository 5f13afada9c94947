// The content of a file of frames as text, to compare files whose bytes may differ.
#pragma once

#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/results/frames/vtkhdf/hdf5_file.hpp"

namespace ashlar {

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Layout and rows of a table.
inline std::string table_content(const Hdf5File& file, const std::string& name) {
  const Hdf5Table table = file.table(name);
  std::string content = std::to_string(static_cast<int>(table.type)) + " " + std::to_string(table.columns) +
                        " " + std::to_string(table.chunk_rows) + " " + std::to_string(table.rows) + " ";
  switch (table.type) {
    case Hdf5Type::real64:
      return content + bytes_of(file.read<double>(name, 0, table.rows));
    case Hdf5Type::real32:
      return content + bytes_of(file.read<float>(name, 0, table.rows));
    case Hdf5Type::integer32:
      return content + bytes_of(file.read<std::int32_t>(name, 0, table.rows));
    case Hdf5Type::integer64:
      return content + bytes_of(file.read<std::int64_t>(name, 0, table.rows));
    case Hdf5Type::unsigned8:
      return content + bytes_of(file.read<std::uint8_t>(name, 0, table.rows));
    case Hdf5Type::text:
      for (const std::string& text : file.read<std::string>(name, 0, table.rows)) content += text + '\n';
  }
  return content;
}

/// By path: every table and the number of steps of every series.
inline std::map<std::string, std::string> hdf5_contents(const std::filesystem::path& path) {
  const Hdf5File file(path, Hdf5File::Access::read);
  std::map<std::string, std::string> contents;
  for (const std::string& series : file.names_in("/VTKHDF")) {
    if (series == "Assembly") continue;
    const std::string group = "/VTKHDF/" + series;
    contents[group + " NSteps"] = std::to_string(file.integer_attribute(group + "/Steps", "NSteps"));
    for (const std::string folder :
         {"", "/PointData", "/CellData", "/FieldData", "/Steps", "/Steps/PointDataOffsets",
          "/Steps/CellDataOffsets", "/Steps/FieldDataOffsets", "/Steps/FieldDataSizes"}) {
      for (const std::string& name : file.names_in(group + folder)) {
        const bool is_group = (folder.empty() || folder == "/Steps") &&
                              (name.ends_with("Data") || name.ends_with("DataOffsets") || name == "Steps" ||
                               name == "FieldDataSizes");
        if (!is_group)
          contents[group + folder + "/" + name] = table_content(file, group + folder + "/" + name);
      }
    }
  }
  return contents;
}

}  // namespace ashlar
