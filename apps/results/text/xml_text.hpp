// Text inside XML attributes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ashlar {

/// @return `text` with the characters reserved in XML replaced by their entities.
[[nodiscard]] inline std::string escape_xml(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// @return `text` with the entities of escape_xml replaced by their characters; others are kept.
[[nodiscard]] inline std::string unescape_xml(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 4> entities = {
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}}};
  std::string plain;
  plain.reserve(text.size());
  while (!text.empty()) {
    std::size_t used = 1;
    char c = text.front();
    for (const auto& [entity, character] : entities) {
      if (!text.starts_with(entity)) continue;
      used = entity.size();
      c = character;
    }
    plain += c;
    text.remove_prefix(used);
  }
  return plain;
}

/// The value of an attribute of a tag, ` name="value"`, as written by a program of this project. Earlier values are
/// skipped, whatever they contain.
/// @return unescaped; empty if the tag has no such attribute.
[[nodiscard]] inline std::optional<std::string> xml_attribute(std::string_view tag, std::string_view name) {
  constexpr std::string_view start = "=\"";
  for (;;) {
    const std::size_t equals = tag.find(start);
    if (equals == std::string_view::npos) return std::nullopt;
    const std::size_t end = tag.find('"', equals + start.size());
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view before = tag.substr(0, equals);
    const std::size_t blank = before.find_last_of(' ');
    if (blank != std::string_view::npos && before.substr(blank + 1) == name)
      return unescape_xml(tag.substr(equals + start.size(), end - equals - start.size()));
    tag.remove_prefix(end + 1);
  }
}

}  // namespace ashlar
