#include "apps/scene/name_pattern.hpp"

#include <fnmatch.h>

#include <string_view>

namespace ashlar {

bool pattern_matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::string pattern_of(const std::string& name) {
  std::string pattern;
  for (const char letter : name) {
    if (std::string_view("*?[\\").find(letter) != std::string_view::npos) pattern += '\\';
    pattern += letter;
  }
  return pattern;
}

bool pattern_matches_pair(const std::array<std::string, 2>& patterns, const std::string& a,
                          const std::string& b) {
  return (pattern_matches(patterns[0], a) && pattern_matches(patterns[1], b)) ||
         (pattern_matches(patterns[0], b) && pattern_matches(patterns[1], a));
}

}  // namespace ashlar
