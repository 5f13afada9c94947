#include "apps/scene/model/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

namespace ashlar {

namespace {

/// Largest share of changed letters: one in so many.
constexpr std::size_t most_changed = 3;

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

/// Similarity of a name to a candidate.
struct Likeness {
  std::size_t changes;   ///< of its letters, to the candidate or to a beginning of it
  std::size_t distance;  ///< the same, plus one for the rest after a beginning
};

/// An abbreviation has at least two letters and the same beginning as its candidate.
bool may_be_short(std::string_view name, std::string_view candidate) {
  return name.size() >= 2 && !candidate.empty() && to_small(name.front()) == to_small(candidate.front());
}

Likeness likeness_of(std::string_view name, std::string_view candidate) {
  const std::vector<std::size_t> distances = prefix_distances(name, candidate);
  const std::size_t whole = distances.back();
  if (!may_be_short(name, candidate)) return {whole, whole};
  const std::size_t beginning = *std::min_element(distances.begin(), distances.end());
  return {std::min(whole, beginning), std::min(whole, beginning + 1)};
}

bool contains(std::string_view candidate, std::string_view name) {
  constexpr std::size_t fewest_letters = 3;
  const auto same = [](char a, char b) { return to_small(a) == to_small(b); };
  return name.size() >= fewest_letters &&
         std::search(candidate.begin(), candidate.end(), name.begin(), name.end(), same) != candidate.end();
}

/// Names that differ in a number at their end.
struct Family {
  std::string_view stem, first, last;
};

std::vector<Family> families_of(std::string_view beginning, const std::vector<std::string>& names) {
  std::vector<Family> families;
  std::map<std::string_view, std::size_t> by_stem;
  for (const std::string& name : names) {
    if (!std::string_view(name).starts_with(beginning)) continue;
    const std::size_t end = name.find_last_not_of("0123456789") + 1;
    const std::string_view stem = end < name.size() ? std::string_view(name).substr(0, end) : name;
    const auto [found, is_new] = by_stem.emplace(stem, families.size());
    if (is_new)
      families.push_back({stem, name, name});
    else
      families[found->second].last = name;
  }
  return families;
}

std::string in_words(const std::vector<Family>& families) {
  constexpr std::size_t most_listed = 4;
  std::vector<std::string> words;
  for (const Family& family : families) {
    if (words.size() == most_listed) break;
    words.push_back(family.first == family.last ? fmt::format("\"{}\"", family.first)
                                                : fmt::format("\"{}\" to \"{}\"", family.first, family.last));
  }
  const std::size_t hidden = families.size() - words.size();
  return fmt::format("{}{}", fmt::join(words, ", "), hidden > 0 ? fmt::format(" and {} more", hidden) : "");
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  return prefix_distances(a, b).back();
}

std::vector<std::string> likely_names(std::string_view name, const std::vector<std::string>& candidates) {
  std::vector<std::pair<Likeness, std::string>> names;
  names.reserve(candidates.size());
  for (const std::string& candidate : candidates) names.emplace_back(likeness_of(name, candidate), candidate);
  std::stable_sort(names.begin(), names.end(),
                   [](const auto& a, const auto& b) { return a.first.distance < b.first.distance; });
  std::vector<std::string> containing;
  for (const auto& [likeness, candidate] : names)
    if (contains(candidate, name)) containing.push_back(candidate);
  if (!containing.empty()) return containing;
  for (const auto& [likeness, candidate] : names)
    if (!name.empty() && most_changed * likeness.changes <= name.size()) return {candidate};
  return {};
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  const std::vector<std::string> names = likely_names(name, candidates);
  return names.empty() ? std::string() : names.front();
}

std::string guess(std::string_view name, const std::vector<std::string>& candidates, std::string_view quote) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : fmt::format("did you mean {}{}{}? ", quote, nearest, quote);
}

std::string guess_block(std::string_view pattern, const std::vector<std::string>& names) {
  const std::string near = guess(pattern, names, "\"");
  for (std::string_view beginning = pattern.substr(0, pattern.find_first_of("*?[\\"));;) {
    const std::size_t dot = beginning.empty() ? std::string_view::npos : beginning.rfind('.');
    if (dot == std::string_view::npos) return near;
    const std::vector<Family> families = families_of(beginning.substr(0, dot + 1), names);
    if (!families.empty()) return fmt::format("{}{} begin alike; ", near, in_words(families));
    beginning = beginning.substr(0, dot);
  }
}

}  // namespace ashlar
