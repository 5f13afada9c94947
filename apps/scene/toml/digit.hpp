// Digits in texts, whatever the locale.
#pragma once

namespace ashlar {

[[nodiscard]] constexpr bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

}  // namespace ashlar
