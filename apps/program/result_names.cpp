#include "apps/program/result_names.hpp"

#include <cctype>

#include "apps/scene/toml/digit.hpp"

namespace ashlar {
namespace {

/// Digits with a decimal point, then an exponent.
std::size_t number_length(std::string_view text) {
  const auto digits = [&](std::size_t k) {
    while (k < text.size() && (is_digit(text[k]) || text[k] == '.')) ++k;
    return k;
  };
  std::size_t end = digits(0);
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (digits(exponent) > exponent) end = digits(exponent);
  }
  return end;
}

}  // namespace

bool begins_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::size_t name_length(std::string_view text) {
  if (text.empty() || !begins_name(text.front())) return 0;
  std::size_t length = 1;
  while (length < text.size() && (begins_name(text[length]) || is_digit(text[length]) || text[length] == '.'))
    ++length;
  return length;
}

std::size_t plain_length(std::string_view text) {
  if (begins_name(text.front())) return name_length(text);
  // With its exponent, so that its letter does not begin a name.
  return is_digit(text.front()) ? number_length(text) : 1;
}

}  // namespace ashlar
