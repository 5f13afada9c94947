#include "apps/program/sweep/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "apps/scene/records/file_hash.hpp"

namespace ashlar {
namespace {

constexpr std::size_t most_variants = 100'000;
constexpr std::size_t longest_folder = 120;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Parts between commas outside brackets and quotes.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts = {""};
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0)
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '[' || c == '{' || c == '(')
      ++depth;
    else if (c == ']' || c == '}' || c == ')')
      --depth;
    if (c == ',' && depth <= 0 && quote == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  if (depth != 0 || quote != 0) return {""};
  for (std::string& part : parts) part = trimmed(part);
  return parts;
}

/// Keys and values as a file name; a digest makes it unique.
std::string folder_of(const std::vector<VariedKey>& keys, const std::vector<std::string>& values) {
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k)
    text += fmt::format("{}{}={}", k == 0 ? "" : ",", keys[k].key, values[k]);
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string("._=+-,").find(c) != std::string::npos;
    name += plain ? c : '_';
  }
  if (name == text && name.size() <= longest_folder && name.front() != '.') return name;
  if (name.size() > longest_folder) name.resize(longest_folder);
  return fmt::format("{}-{}", name, sha256_of_text(text).substr(0, 12));
}

/// Number of combinations of listed values.
std::size_t combinations(const std::vector<VariedKey>& keys, const Samples& samples) {
  std::set<std::string> known;
  std::size_t count = 1;
  // Each combination has as many variants as samples.
  const std::size_t most = most_variants / std::max<std::size_t>(samples.count, 1);
  const auto refuse_more = [&](std::size_t factor) {
    if (factor > most / count)
      throw std::invalid_argument(fmt::format("too many variants; at most {} are allowed", most_variants));
  };
  refuse_more(1);
  bool draws = false;
  for (const VariedKey& key : keys) {
    if (!known.insert(key.key).second)
      throw std::invalid_argument(
          fmt::format("--vary names a key twice ({}); give all its values in one", key.key));
    draws = draws || key.drawn;
    if (key.drawn && samples.count == 0)
      throw std::invalid_argument(
          fmt::format("--vary draws values of {} without their number; give --samples", key.key));
    if (key.drawn) continue;
    std::set<std::string> values;
    for (const std::string& value : key.values)
      if (!values.insert(value).second)
        throw std::invalid_argument(
            fmt::format("--vary gives {} a value twice ({}); give each once", key.key, value));
    refuse_more(key.values.size());
    count *= key.values.size();
  }
  if (samples.count > 0 && !draws)
    throw std::invalid_argument("--samples without a random value; give --vary key=normal(...)");
  return count;
}

}  // namespace

VariedKey parse_varied_key(const std::string& text) {
  const auto refuse = [&](const char* what) {
    throw std::invalid_argument(fmt::format("--vary {} ({}), key=a,b,c is needed", what, text));
  };
  const std::size_t equals = text.find('=');
  VariedKey result;
  if (equals == std::string::npos) refuse("has no \"=\"");
  result.key = trimmed(text.substr(0, equals));
  if (result.key.empty()) refuse("has no key");
  result.values = parts_of(text.substr(equals + 1));
  if (result.values.size() == 1) result.drawn = parse_distribution(result.values.front());
  if (result.drawn) {
    result.values.clear();
    return result;
  }
  if (std::any_of(result.values.begin(), result.values.end(),
                  [](const std::string& value) { return value.empty(); }))
    refuse("has an empty value");
  return result;
}

std::vector<Variant> variants_of(const std::vector<VariedKey>& keys, const Samples& samples) {
  const std::size_t count = combinations(keys, samples);
  // For each sample, the values of the random keys, in order.
  std::vector<std::vector<std::string>> drawn(std::max<std::size_t>(samples.count, 1));
  Draws draws(samples.seed);
  for (std::vector<std::string>& sample : drawn)
    for (const VariedKey& key : keys)
      if (key.drawn) sample.push_back(fmt::format("{:.6g}", draws.draw(*key.drawn)));
  std::vector<Variant> variants;
  variants.reserve(count * drawn.size());
  for (std::size_t k = 0; k < count; ++k) {
    for (const std::vector<std::string>& sample : drawn) {
      Variant variant;
      std::size_t rest = k, left = sample.size();
      for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
        const std::string& value = key->drawn ? sample[--left] : key->values[rest % key->values.size()];
        variant.values.insert(variant.values.begin(), value);
        if (!key->drawn) rest /= key->values.size();
      }
      variant.folder = folder_of(keys, variant.values);
      variants.push_back(std::move(variant));
    }
  }
  return variants;
}

}  // namespace ashlar
