// Text inside XML attributes.
#pragma once

#include <string>
#include <string_view>

namespace ashlar {

/// @return `text` with the characters that XML reserves replaced by their entities.
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

}  // namespace ashlar
