// Data shared by the readers of all tables of one TOML document: places, faults, and known keys. Every key requested
// by a reader becomes known; keys that were never requested are reported at the end, with the nearest known one.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene_places.hpp"
#include "apps/scene/toml/formulas.hpp"
#include "apps/scene/toml/number_ranges.hpp"

namespace ashlar {

/// One document during reading.
class TomlReading {
 public:
  /// Data of one table: its content, its path, and the keys requested so far.
  struct KnownTable {
    const toml::table* table;
    std::string path;  ///< as in ScenePlaces
    std::string name;  ///< path without indices, as in a header: "block.fix"; "" is the top
    std::set<std::string, std::less<>> keys;
  };

  /// @param files names under which the document and its includes were parsed, its own first; nodes of any other
  /// source are arguments.
  TomlReading(std::vector<std::string> files, Diagnostics& diagnostics, ScenePlaces& places)
      : files_(std::move(files)), diagnostics_(diagnostics), places_(places) {}

  [[nodiscard]] Place place(const toml::source_region& region) const;
  /// Registers a table; places of its keys are recorded.
  KnownTable& add_table(const toml::table& table, std::string path, std::string name);
  void record_place(const std::string& path, const toml::node& node);
  void error(const toml::node& node, std::string message);
  void error(Place place, std::string message) { diagnostics_.error(std::move(place), std::move(message)); }
  [[nodiscard]] const ScenePlaces& places() const { return places_; }
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
  /// Folder of relative paths in the document.
  [[nodiscard]] std::filesystem::path folder() const {
    return std::filesystem::path(files_.front()).parent_path();
  }

  /// m, Scene::origin, for readers that make blocks. Zero until set
  [[nodiscard]] const Vector3& origin() const { return origin_; }
  void set_origin(const Vector3& origin) { origin_ = origin; }

  /// Counts pieces of masonry. @return total so far
  double add_pieces(double pieces) { return pieces_ += pieces; }

  /// Sets the parameters of the document for later formulas.
  void set_formulas(Formulas formulas) { formulas_ = std::move(formulas); }
  /// A number as a constant, a formula as a function of a place. Faults as in number(). @return empty after a fault
  [[nodiscard]] std::function<double(const Vector3&)> function(const toml::node& node, std::string_view key);
  [[nodiscard]] const Formulas& formulas() const { return formulas_; }

  /// True if a node is a number or the text of a formula.
  [[nodiscard]] static bool has_number(const toml::node& node);
  /// The value of such a node; a formula's is finite. A fault of a formula is reported at its character, with the
  /// key.
  [[nodiscard]] std::optional<double> number(const toml::node& node, std::string_view key);
  [[nodiscard]] std::optional<double> number(const toml::node& node, std::string_view key,
                                             const Formulas& formulas);

  /// Reports each key of a registered table that was never requested. For a key known in another table only, names
  /// that table: TOML makes it easy to write a key below the wrong header.
  void report_unknown_keys();

 private:
  [[nodiscard]] Place place_in_text(const toml::node& node, std::size_t offset) const;

  std::vector<std::string> files_;
  Diagnostics& diagnostics_;
  ScenePlaces& places_;
  Formulas formulas_;
  Vector3 origin_ = Vector3::Zero();
  double pieces_ = 0.0;
  std::list<KnownTable> tables_;  // readers keep references
};

/// Parses a document as toml::parse does. @throws toml::parse_error, also
/// - "'N' is not representable in double precision" for a whole number above 2^53 that would be rounded, and for a real
///   number so small that it would be zero: all numbers of a document are read as double (number_in);
/// - if a dotted key has more than a thousand parts: every part is a nested table, and the parser's recursion would
///   exhaust the stack.
[[nodiscard]] toml::table parse_toml(std::string_view text, std::string_view origin);

/// Value of a node that is a number of either kind (node.is_number()), exactly.
[[nodiscard]] double number_in(const toml::node& node);

/// A value for a message: short ones as TOML, long ones by their kind.
[[nodiscard]] std::string describe(const toml::node& node);

}  // namespace ashlar
