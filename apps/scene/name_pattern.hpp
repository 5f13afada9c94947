// Names of a scene meant by a glob.
#pragma once

#include <array>
#include <string>

namespace ashlar {

/// Whether a name is matched by a shell glob (* ? [...], POSIX fnmatch without flags).
[[nodiscard]] bool pattern_matches(const std::string& pattern, const std::string& name);

/// The glob that matches one name only.
[[nodiscard]] std::string pattern_of(const std::string& name);

/// Whether two names are matched by a pair of globs, in either order.
[[nodiscard]] bool pattern_matches_pair(const std::array<std::string, 2>& patterns, const std::string& a,
                                        const std::string& b);

}  // namespace ashlar
