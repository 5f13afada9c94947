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

/// The candidate with the smallest edit distance, the first of equals; empty if there are no candidates. A
/// name that is nearest to the beginning of a candidate is taken for its short form: the rest counts as one
/// letter.
[[nodiscard]] std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace ashlar
