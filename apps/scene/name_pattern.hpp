// Names of a scene meant by a glob.
//
// Names are UTF-8, and a glob compares code points: the same in every locale, in the program and in Python. A byte that
// belongs to no code point is a character of its own, equal to that byte only.
//   *        any characters, also none
//   ?        one character
//   [...]    one character of a set: single ones, ranges by code point (a-z), classes of ASCII ([:alpha:], [:digit:],
//            ...); a ] that comes first is a member, a - that comes first or last too; [!...] or [^...]: one that is not
//            in the set
//   \        takes the meaning from the character after it, also in a set
// A set that has no end is the character [; a \ at the end matches nothing.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace ashlar {

/// True if a glob matches a name as a whole. At most as many steps as the product of both lengths.
[[nodiscard]] bool pattern_matches(std::string_view pattern, std::string_view name);

/// The glob that matches one name only.
[[nodiscard]] std::string pattern_of(const std::string& name);

/// Whether two names are matched by a pair of globs, in either order.
[[nodiscard]] bool pattern_matches_pair(const std::array<std::string, 2>& patterns, const std::string& a,
                                        const std::string& b);

}  // namespace ashlar
