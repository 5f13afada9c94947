#include "apps/scene/toml/include.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "apps/scene/toml/toml_faults.hpp"
#include "apps/scene/toml/toml_reading.hpp"

namespace ashlar {
namespace {

namespace fs = std::filesystem;

bool lists_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr &&
         std::all_of(array->begin(), array->end(), [](const toml::node& entry) { return entry.is_table(); });
}

// Nodes are moved, as a copy would lose its source.
void merge(toml::table& into, toml::table&& from) {
  for (auto&& [key, node] : from) {
    toml::node* present = into.get(key.str());
    if (present != nullptr && present->is_table() && node.is_table()) {
      merge(*present->as_table(), std::move(*node.as_table()));
    } else if (present != nullptr && lists_tables(*present) && lists_tables(node)) {
      for (toml::node& entry : *node.as_array()) present->as_array()->push_back(std::move(*entry.as_table()));
    } else {
      into.erase(key.str());
      node.visit([&, &name = key](auto& value) { into.insert_or_assign(name, std::move(value)); });
    }
  }
}

// Every `file` of a scene is a path.
void put_into_folder(toml::node& node, const fs::path& folder) {
  if (toml::array* array = node.as_array()) {
    for (toml::node& entry : *array) put_into_folder(entry, folder);
  } else if (toml::table* table = node.as_table()) {
    for (auto&& [key, value] : *table) {
      auto* text = value.as_string();
      if (key.str() == "file" && text != nullptr && !(**text).empty())
        *text = (folder / fs::path(**text)).lexically_normal().string();
      else
        put_into_folder(value, folder);
    }
  }
}

class DocumentReader {
 public:
  explicit DocumentReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// @param folder of the file, relative to the document's own; prefix of paths in the tree
  toml::table parse(std::string_view text, const fs::path& file, const fs::path& folder) {
    const std::string name = file.string();
    files_.push_back(name);
    bytes_ += text.size();
    open_.push_back(fs::weakly_canonical(file, ignored_));
    read_.insert(open_.back());
    toml::table own = parse_toml(text, name);
    if (!folder.empty()) put_into_folder(own, folder);
    toml::table all = included_by(own, file, folder);
    own.erase("include");
    // The document's own table keeps its place.
    if (all.empty()) {
      open_.pop_back();
      return own;
    }
    merge(all, std::move(own));
    open_.pop_back();
    return all;
  }

  [[nodiscard]] std::vector<std::string> files() && { return std::move(files_); }

 private:
  toml::table included_by(const toml::table& own, const fs::path& file, const fs::path& folder) {
    toml::table all;
    const toml::node* include = own.get("include");
    if (include == nullptr) return all;
    const toml::array* names = include->as_array();
    if (names == nullptr) {
      error(*include, file,
            fmt::format("include has the wrong type ({}), an array of names of files is needed",
                        describe(*include)));
      return all;
    }
    for (const toml::node& entry : *names) {
      const auto* text = entry.as_string();
      if (text == nullptr || (**text).empty()) {
        error(entry, file,
              fmt::format("include has the wrong type ({}), the name of a file is needed", describe(entry)));
      } else if (auto tree = read(entry, **text, file, folder)) {
        merge(all, std::move(*tree));
      }
    }
    return all;
  }

  std::optional<toml::table> read(const toml::node& entry, const std::string& said, const fs::path& file,
                                  const fs::path& folder) {
    const fs::path path = (file.parent_path() / said).lexically_normal();
    const fs::path canonical = fs::weakly_canonical(path, ignored_);
    const auto circle = std::find(open_.begin(), open_.end(), canonical);
    if (circle != open_.end()) {
      std::vector<std::string> names;
      for (auto step = circle; step != open_.end(); ++step) names.push_back(step->filename().string());
      names.push_back(canonical.filename().string());
      error(entry, file,
            fmt::format("circular include of files ({}); remove one of them", fmt::join(names, " -> ")));
      return std::nullopt;
    }
    if (read_.contains(canonical)) return std::nullopt;
    if (open_.size() > deepest_include) {
      error(entry, file,
            fmt::format("includes are nested too deeply ({} levels), at most {} are allowed", open_.size(),
                        deepest_include));
      return std::nullopt;
    }
    return read_included(entry, path, file, (folder / said).parent_path());
  }

  std::optional<toml::table> read_included(const toml::node& entry, const fs::path& path,
                                           const fs::path& file, const fs::path& folder) {
    std::string text;
    try {
      text = whole_file(path, most_input_bytes);
      if (bytes_ + text.size() > most_input_bytes)
        throw std::runtime_error("with all files before it " + too_large(bytes_ + text.size()));
    } catch (const std::runtime_error& reason) {
      error(entry, file,
            fmt::format("included file cannot be read ({}: {}), a readable TOML file is needed",
                        path.string(), fault_text(reason)));
      return std::nullopt;
    }
    const std::size_t depth = open_.size();
    try {
      return parse(text, path, folder);
    } catch (const toml::parse_error& fault) {
      open_.resize(depth);
      const toml::source_position& position = fault.source().begin;
      diagnostics_.error({path.string(), static_cast<int>(position.line), static_cast<int>(position.column)},
                         malformed_toml(text, fault));
      return std::nullopt;
    }
  }

  void error(const toml::node& node, const fs::path& file, std::string message) {
    const toml::source_position& position = node.source().begin;
    diagnostics_.error({file.string(), static_cast<int>(position.line), static_cast<int>(position.column)},
                       std::move(message));
  }

  Diagnostics& diagnostics_;
  std::vector<std::string> files_;
  std::size_t bytes_ = 0;       ///< of all files
  std::vector<fs::path> open_;  ///< being read, each includes the next
  std::set<fs::path> read_;     ///< read or being read
  std::error_code ignored_;
};

}  // namespace

SceneDocument parse_document(std::string_view text, const std::filesystem::path& file,
                             Diagnostics& diagnostics) {
  DocumentReader reader(diagnostics);
  toml::table tree = reader.parse(text, file, {});
  return {std::move(tree), std::move(reader).files()};
}

std::optional<SceneDocument> read_document(const std::filesystem::path& file, const Place& place,
                                           Diagnostics& diagnostics) {
  std::string text;
  try {
    text = whole_file(file, most_input_bytes);
    return parse_document(text, file, diagnostics);
  } catch (const toml::parse_error& error) {
    const toml::source_position& at = error.source().begin;
    diagnostics.error({file.string(), static_cast<int>(at.line), static_cast<int>(at.column)},
                      malformed_toml(text, error));
  } catch (const std::runtime_error& error) {
    diagnostics.error(place, fmt::format("{} cannot be read ({}), a readable file is needed", file.string(),
                                         fault_text(error)));
  }
  return std::nullopt;
}

}  // namespace ashlar
