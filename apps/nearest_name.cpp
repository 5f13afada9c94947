#include "apps/nearest_name.hpp"

#include <algorithm>
#include <iterator>

namespace ashlar {

namespace {

char to_small(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

// Edit distances of a text to every beginning of another, the empty one first.
std::vector<std::size_t> prefix_distances(std::string_view a, std::string_view b) {
  // Row i holds the distances of the first i letters of a to every beginning of b; swaps look two rows back.
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const char letter_a = to_small(a[i - 1]), letter_b = to_small(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (letter_a == letter_b ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && letter_a == to_small(b[j - 2]) && to_small(a[i - 2]) == letter_b;
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row;
}

std::size_t distance_or_short_form(std::string_view name, std::string_view candidate) {
  const std::vector<std::size_t> distances = prefix_distances(name, candidate);
  return std::min(distances.back(), *std::min_element(distances.begin(), distances.end()) + 1);
}

bool contains(std::string_view candidate, std::string_view name) {
  constexpr std::size_t fewest_letters = 3;
  const auto same = [](char a, char b) { return to_small(a) == to_small(b); };
  return name.size() >= fewest_letters &&
         std::search(candidate.begin(), candidate.end(), name.begin(), name.end(), same) != candidate.end();
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  return prefix_distances(a, b).back();
}

std::vector<std::string> likely_names(std::string_view name, const std::vector<std::string>& candidates) {
  std::vector<std::string> names = candidates;
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return distance_or_short_form(name, a) < distance_or_short_form(name, b);
  });
  std::vector<std::string> containing;
  std::copy_if(names.begin(), names.end(), std::back_inserter(containing),
               [&](const std::string& candidate) { return contains(candidate, name); });
  if (!containing.empty()) return containing;
  names.resize(std::min<std::size_t>(names.size(), 1));
  return names;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  const std::vector<std::string> names = likely_names(name, candidates);
  return names.empty() ? std::string() : names.front();
}

}  // namespace ashlar
