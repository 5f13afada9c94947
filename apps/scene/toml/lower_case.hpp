// Letters of text formats whose words may be in capitals.
#pragma once

#include <string>
#include <string_view>

namespace ashlar {

/// ASCII letters in lower case; others stay, whatever the locale.
[[nodiscard]] inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return result;
}

}  // namespace ashlar
