// Values of an untrusted JSON file: each access checks the type, and errors state the place.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

/// Largest nesting of arrays and objects. glTF itself needs 7 levels; data under "extras" may be deeper.
inline constexpr std::size_t most_json_levels = 100;

/// Parses a whole text. The tree needs up to 50 times its bytes. @throws MeshFileError with line and column
[[nodiscard]] nlohmann::json parse_json_file(std::string_view text);

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
