// Values of an untrusted JSON file: each access checks the type, and errors state the place.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

/// Largest nesting of arrays and objects. glTF itself needs 7 levels; data under "extras" may be deeper.
inline constexpr std::size_t most_json_levels = 100;

/// Parses a whole text. The tree needs up to 50 times its bytes. @param kind of the file, for the message
/// @throws MeshFileError with line and column
[[nodiscard]] nlohmann::json parse_json_file(std::string_view text, std::string_view kind = "a glTF file");

/// A value of a tree with its path, such as accessors[3].count.
/// All members @throws MeshFileError "PATH is ..., allowed ...".
class JsonNode {
 public:
  /// @param value not null; one within a tree shares the tree
  JsonNode(std::shared_ptr<const nlohmann::json> value, std::string path);

  /// A member of an object; empty if there is none.
  [[nodiscard]] std::optional<JsonNode> find(const char* key) const;
  /// The same for a required member.
  [[nodiscard]] JsonNode at(const char* key) const;
  /// Elements of an array.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] JsonNode at(std::size_t index) const;
  /// Members of an object with their names, sorted by these; numbers among them by value.
  [[nodiscard]] std::vector<std::pair<std::string, JsonNode>> members() const;

  [[nodiscard]] bool is_null() const { return value_->is_null(); }
  [[nodiscard]] bool is_object() const { return value_->is_object(); }
  [[nodiscard]] bool is_array() const { return value_->is_array(); }
  [[nodiscard]] bool is_text() const { return value_->is_string(); }

  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] double number() const;
  [[nodiscard]] bool boolean() const;
  /// A whole number below 2^32.
  [[nodiscard]] std::size_t count() const;
  /// An index into something of `size` elements.
  [[nodiscard]] std::size_t index(std::size_t size) const;

  [[noreturn]] void fail(const std::string& fault, const std::string& allowed) const;

 private:
  /// A part of the value.
  [[nodiscard]] std::shared_ptr<const nlohmann::json> part(const nlohmann::json& value) const {
    return {value_, &value};
  }

  std::shared_ptr<const nlohmann::json> value_;
  std::string path_;
};

}  // namespace ashlar
