#include "apps/scene/name_pattern.hpp"

#include <fnmatch.h>

namespace ashlar {

bool pattern_matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

bool pattern_matches_pair(const std::array<std::string, 2>& patterns, const std::string& a,
                          const std::string& b) {
  return (pattern_matches(patterns[0], a) && pattern_matches(patterns[1], b)) ||
         (pattern_matches(patterns[0], b) && pattern_matches(patterns[1], a));
}

}  // namespace ashlar
