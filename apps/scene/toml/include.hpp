// include = ["materials.toml"]: scenes made of several files. The files are read first, in their order, each with its
// own includes. Lists of tables ([[block]]) are joined and tables are merged key by key. Of values given twice the
// later one is used: that of the including file, and of two included ones the second.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"

namespace ashlar {

/// A document with all includes; nodes keep their file, line and column.
struct SceneDocument {
  toml::table tree;                ///< without the key include
  std::vector<std::string> files;  ///< names under which files were parsed, the document's own first
};

/// Largest nesting of includes.
inline constexpr std::size_t deepest_include = 32;

/// Parses a document and its includes. Paths, of includes and of the key `file` anywhere, are relative to the file
/// they are in. In the tree they are relative to the document's folder. A file included several times is read once,
/// at its first place. Reported at the name of the file: a file that cannot be read or is not regular, circular
/// includes, deeper nesting than deepest_include, more than most_input_bytes in total. Reported in the included file:
/// malformed TOML.
/// @param file the document's name. @throws toml::parse_error of the document's own text
[[nodiscard]] SceneDocument parse_document(std::string_view text, const std::filesystem::path& file,
                                           Diagnostics& diagnostics);

/// The document of a file. Malformed TOML is reported at its place, a file that cannot be read at `place`.
/// @return empty after such a fault
[[nodiscard]] std::optional<SceneDocument> read_document(const std::filesystem::path& file,
                                                         const Place& place, Diagnostics& diagnostics);

}  // namespace ashlar
