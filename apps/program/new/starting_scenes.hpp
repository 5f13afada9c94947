// Commented scenes to begin with (*.toml beside this file), embedded in the program.
#pragma once

#include <span>
#include <string_view>

namespace ashlar {

struct StartingScene {
  std::string_view kind;
  std::string_view text;
};

/// In the order of their kinds.
[[nodiscard]] std::span<const StartingScene> starting_scenes();

}  // namespace ashlar
