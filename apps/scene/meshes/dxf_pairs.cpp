#include "apps/scene/meshes/dxf_pairs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/mesh/text_scanner.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

constexpr std::string_view dxf_blanks = " \t\r\v\f";

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(dxf_blanks);
  return begin == std::string_view::npos ? std::string_view()
                                         : text.substr(begin, text.find_last_not_of(dxf_blanks) + 1 - begin);
}

/// Reads a text that is a single number. std::from_chars does not accept a plus sign.
template <class Number>
bool read_number(std::string_view text, Number& value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = parse_number(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// Bytes of the first character of a text; 0 if it is not UTF-8.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t k) -> unsigned { return static_cast<unsigned char>(text[k]); };
  if (byte(0) < 0x80U) return 1;
  const std::size_t length = byte(0) >= 0xf0U ? 4 : byte(0) >= 0xe0U ? 3 : 2;
  if (byte(0) < 0xc2U || byte(0) > 0xf4U || length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0U) != 0x80U) return 0;
  // Overlong, a surrogate, or beyond the last character.
  const unsigned first = byte(0) << 8U | byte(1);
  const bool none = (first & 0xffe0U) == 0xe080U || (first & 0xffe0U) == 0xeda0U ||
                    (first & 0xfff0U) == 0xf080U || first >= 0xf490U;
  return none ? 0 : length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

std::string DxfPairs::text() const {
  if (is_utf8(value_)) return std::string(value_);
  std::string text;
  for (const char c : value_) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80U) text += static_cast<char>(0xc0U | byte >> 6U);
    text += static_cast<char>(byte >= 0x80U ? 0x80U | (byte & 0x3fU) : byte);
  }
  return text;
}

std::string_view DxfPairs::next_line() {
  if (rest_.empty()) throw MeshFileError("file ends before EOF, with which drawings end", line_, 0);
  const std::size_t end = rest_.find('\n');
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  ++line_;
  return without_blanks(line);
}

void DxfPairs::next() {
  constexpr int comment = 999;
  do {
    value_ = next_line();
    if (!read_number(value_, code_)) fail("is no group code, a whole number is needed here");
    value_ = next_line();
  } while (code_ == comment);
}

double DxfPairs::number(const char* what) const {
  double value = 0.0;
  if (!read_number(value_, value) || !std::isfinite(value))
    fail(fmt::format("is no number, but {} must be", what));
  if (is_too_far(value)) fail(fmt::format("is too far for {}, allowed -1e150 to 1e150", what));
  return value;
}

long long DxfPairs::integer(const char* what) const {
  long long value = 0;
  if (!read_number(value_, value)) fail(fmt::format("is no whole number, but {} must be", what));
  return value;
}

void DxfPairs::fail(const std::string& what) const {
  throw MeshFileError(fmt::format("\"{}\" {}", printable(value_), what), line_, 1);
}

}  // namespace ashlar
