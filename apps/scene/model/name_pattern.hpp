// Globs for names of a scene.
//
// Names are UTF-8, and a glob compares code points: the same in every locale, in the program and in Python. A byte
// that belongs to no code point is a character of its own, equal to that byte only.
//   *        any characters, also none
//   ?        one character
//   [...]    one character of a set: single ones, ranges by code point (a-z), classes of ASCII ([:alpha:], [:digit:],
//            ...); a ] that comes first is a member, a - that comes first or last too; [!...] or [^...]: one that is
//            not in the set
//   \        makes the next character literal, also in a set
// A set without end is the character [; a \ at the end matches nothing.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace ashlar {

/// True if a glob matches a whole name. The number of steps is at most the product of both lengths.
[[nodiscard]] bool pattern_matches(std::string_view pattern, std::string_view name);

/// The glob that matches one name only.
[[nodiscard]] std::string pattern_of(const std::string& name);

/// True if a pair of globs matches two names in either order.
[[nodiscard]] bool pattern_matches_pair(const std::array<std::string, 2>& patterns, const std::string& a,
                                        const std::string& b);

}  // namespace ashlar
