// The known name most similar to a misspelt one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

/// Smallest number of insertions, deletions, replacements and swaps of neighbours between two texts (optimal string
/// alignment); upper and lower case of ASCII letters are equal.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// Candidates that may be meant by an unknown name. If it has three letters or more, those that contain it, nearest
/// first (shorter ones are part of too many names). Otherwise the one with the smallest edit distance, the first of
/// equals, unless more than a third of the letters would have to change: such a guess would mislead. A name of two
/// letters or more with the same beginning as a candidate, and closest to the beginning of it, is taken for its
/// abbreviation: the rest counts as one letter.
[[nodiscard]] std::vector<std::string> likely_names(std::string_view name,
                                                    const std::vector<std::string>& candidates);

/// The first of likely_names; empty if there is none.
[[nodiscard]] std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "did you mean NAME? " for the nearest name, in the given quotes; empty if there is none.
[[nodiscard]] std::string guess(std::string_view name, const std::vector<std::string>& candidates,
                                std::string_view quote = "");

/// Suggestions for a name or glob that matches no block: the guess, and the names with the same beginning up to a
/// dot, with those that differ in a final number as one: 'did you mean "rock.inside.1"? "rock.1" to "rock.5" and
/// "rock.inside.1" to "rock.inside.3" begin alike; '. @param names of all blocks
[[nodiscard]] std::string guess_block(std::string_view pattern, const std::vector<std::string>& names);

}  // namespace ashlar
