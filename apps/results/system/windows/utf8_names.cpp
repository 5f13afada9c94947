#include "apps/results/system/windows/utf8_names.hpp"

#include <cerrno>
#include <cstddef>
#include <cwchar>

namespace ashlar {
namespace {

constexpr auto wrong = static_cast<std::size_t>(-1);
constexpr auto incomplete = static_cast<std::size_t>(-2);

/// Bytes of a letter by its first byte; 0: none begins so.
std::size_t length_by_first(unsigned char first) {
  return first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
}

std::size_t refused() {
  errno = EILSEQ;
  return wrong;
}

}  // namespace

void use_utf8_names() {}

}  // namespace ashlar

extern "C" {

/// A letter of four bytes is two units of UTF-16: the first takes three bytes, the second the fourth. Between them
/// the state is the second unit.
std::size_t mbrtowc(wchar_t* unit, const char* text, std::size_t bytes, std::mbstate_t* state) {
  static std::mbstate_t own_state{};
  std::mbstate_t& kept = state == nullptr ? own_state : *state;
  if (text == nullptr) {
    kept = {};
    return 0;
  }
  if (bytes == 0) return ashlar::incomplete;
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  if (kept != std::mbstate_t{}) {
    if ((byte(0) & 0xC0U) != 0x80U) return ashlar::refused();
    if (unit != nullptr) *unit = static_cast<wchar_t>(static_cast<unsigned>(kept) | (byte(0) & 0x3FU));
    kept = {};
    return 1;
  }
  const std::size_t length = ashlar::length_by_first(byte(0));
  if (length == 0) return ashlar::refused();
  if (bytes < length) return ashlar::incomplete;
  unsigned letter = length == 1 ? byte(0) : byte(0) & (0xFFU >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xC0U) != 0x80U) return ashlar::refused();
    letter = (letter << 6U) | (byte(k) & 0x3FU);
  }
  const bool is_long_form = (length == 3 && letter < 0x800U) || (length == 4 && letter < 0x10000U);
  if (is_long_form || (letter >= 0xD800U && letter < 0xE000U) || letter > 0x10FFFFU) return ashlar::refused();
  if (letter < 0x10000U) {
    if (unit != nullptr) *unit = static_cast<wchar_t>(letter);
    return letter == 0 ? 0 : length;
  }
  const unsigned rest = letter - 0x10000U;
  if (unit != nullptr) *unit = static_cast<wchar_t>(0xD800U | (rest >> 10U));
  kept = static_cast<std::mbstate_t>(0xDC00U | (rest & 0x3C0U));
  return 3;
}

/// Beside mbrtowc in the C library, which would bring its own of both.
std::size_t mbrlen(const char* text, std::size_t bytes, std::mbstate_t* state) {
  static std::mbstate_t own_state{};
  return mbrtowc(nullptr, text, bytes, state == nullptr ? &own_state : state);
}

/// The first of two units is kept in the state, and writes nothing.
std::size_t wcrtomb(char* text, wchar_t unit, std::mbstate_t* state) {
  static std::mbstate_t own_state{};
  std::mbstate_t& kept = state == nullptr ? own_state : *state;
  if (text == nullptr) {
    kept = {};
    return 1;
  }
  unsigned letter = unit;
  if (kept != std::mbstate_t{}) {
    if (letter < 0xDC00U || letter > 0xDFFFU) return ashlar::refused();
    letter = 0x10000U + ((static_cast<unsigned>(kept) & 0x3FFU) << 10U) + (letter & 0x3FFU);
    kept = {};
  } else if (letter >= 0xD800U && letter < 0xDC00U) {
    kept = static_cast<std::mbstate_t>(letter);
    return 0;
  } else if (letter >= 0xDC00U && letter < 0xE000U) {
    return ashlar::refused();
  }
  const std::size_t length = letter < 0x80U ? 1 : letter < 0x800U ? 2 : letter < 0x10000U ? 3 : 4;
  for (std::size_t k = length - 1; k > 0; --k, letter >>= 6U)
    text[k] = static_cast<char>(0x80U | (letter & 0x3FU));
  constexpr unsigned char first[] = {0, 0, 0xC0, 0xE0, 0xF0};
  text[0] = static_cast<char>(first[length] | letter);
  return length;
}
}
