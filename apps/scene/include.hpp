// include = ["materials.toml"]: scenes made of several files. The files are read first, in their order, each
// with what it includes itself. Lists of tables ([[block]]) are joined, tables are merged key by key, and of
// what is given twice the later counts: the including file's, and of two included ones the second's.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/diagnostics.hpp"

namespace ashlar {

/// A document with all that it includes; nodes keep the file, line and column that they were written at.
struct SceneDocument {
  toml::table tree;                ///< without the key include
  std::vector<std::string> files;  ///< names under which files were parsed, the document's own first
};

/// Files within files within files.
inline constexpr std::size_t deepest_include = 32;

/// Parses a document and what it includes. Paths, of includes and of the key `file` anywhere, are relative to
/// the file that says them; in the tree they are relative to the document's folder. A file that several others
/// include is read once, where it comes first. Reported at the name of the file: one that cannot be read or is
/// no regular file, files in a circle, deeper nesting than deepest_include, more than most_input_bytes in all; in the
/// included file: malformed TOML.
/// @param file the document's name. @throws toml::parse_error of the document's own text
[[nodiscard]] SceneDocument parse_document(std::string_view text, const std::filesystem::path& file,
                                           Diagnostics& diagnostics);

}  // namespace ashlar
