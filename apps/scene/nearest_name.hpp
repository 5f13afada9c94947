// The known name that a misspelt one probably meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one text into the other
/// (optimal string alignment); capital and small ASCII letters are the same.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// What a name that is none of the candidates may have meant: those that contain it, nearest first, if it has
/// three letters or more (fewer are part of too many names); else the one with the smallest edit distance,
/// the first of equals, unless more than a third of the name's letters would have to change: that is no slip,
/// and a guess would mislead. A name of two letters or more that begins as a candidate and is nearest to the
/// beginning of it is taken for its short form: the rest counts as one letter.
[[nodiscard]] std::vector<std::string> likely_names(std::string_view name,
                                                    const std::vector<std::string>& candidates);

/// The first of likely_names; empty if there is none.
[[nodiscard]] std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "did you mean NAME? " for the nearest name, in quotes of the kind given; empty if there is none.
[[nodiscard]] std::string guess(std::string_view name, const std::vector<std::string>& candidates,
                                std::string_view quote = "");

/// Suggestions for a name or glob that matches no block: the guess, and the names that begin as it does up to a dot,
/// those that differ in a number at their end as one: 'did you mean "rock.inside.1"? "rock.1" to "rock.5" and
/// "rock.inside.1" to "rock.inside.3" begin alike; '. @param names of all blocks
[[nodiscard]] std::string guess_block(std::string_view pattern, const std::vector<std::string>& names);

}  // namespace ashlar
