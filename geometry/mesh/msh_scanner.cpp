#include "geometry/mesh/msh_scanner.hpp"

#include <cstdint>
#include <sstream>

#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/mesh/binary_values.hpp"

namespace ashlar {

std::string_view MshScanner::take(std::string_view what, std::size_t bytes) {
  const std::string_view rest = scan_.rest();
  byte_ = text_.size() - rest.size();
  if (rest.size() < bytes)
    throw MeshFileError("file ends before " + std::string(what) + " at byte " + std::to_string(byte_), 0, 0);
  scan_ = TextScanner(rest.substr(bytes), '\0');
  return rest.substr(0, bytes);
}

template <class Number>
Number MshScanner::value(std::string_view what) {
  const auto value = read_binary<Number>(take(what, sizeof(Number)), order_);
  last_ = value;
  return value;
}

void MshScanner::fail_at_byte(std::string_view what, std::string_view allowed) const {
  std::ostringstream text;
  text << what << " at byte " << byte_ << " (";
  std::visit([&](auto value) { text << value; }, last_);
  text << "), " << allowed;
  throw MeshFileError(text.str(), 0, 0);
}

template <class Read>
auto MshScanner::of_line(Read read) {
  if (!binary_) return read();
  byte_ = text_.size() - scan_.rest().size();
  try {
    return read();
  } catch (const MeshFileError& error) {
    throw MeshFileError(std::string(error.what()) + ", near byte " + std::to_string(byte_), 0, 0);
  }
}

void MshScanner::begin_binary() {
  binary_ = true;
  order_ = std::endian::little;
  constexpr std::int32_t swapped_one = 0x01000000;
  const auto one = value<std::int32_t>("the number 1 that tells the order of bytes");
  if (one == swapped_one) order_ = std::endian::big;
  if (one != 1 && one != swapped_one) fail_at_byte("first number", "must be 1, in either order of bytes");
}

bool MshScanner::next_line() {
  return of_line([&] { return scan_.next_line(); });
}

void MshScanner::require_line(std::string_view what) {
  of_line([&] { scan_.require_line(what); });
}

std::string_view MshScanner::word() {
  return of_line([&] { return scan_.word(); });
}

std::string_view MshScanner::require_word(std::string_view what) {
  return of_line([&] { return scan_.require_word(what); });
}

void MshScanner::expect(std::initializer_list<std::string_view> words) {
  of_line([&] { scan_.expect(words); });
}

long long MshScanner::word_as_integer(std::string_view what, long long low, long long high) {
  return of_line([&] { return scan_.integer(what, low, high); });
}

void MshScanner::skip_past_line(const std::string& word) {
  if (!binary_) {
    do scan_.require_line(word);
    while (scan_.word() != word);
    return;
  }
  const std::size_t found = scan_.rest().find("\n" + word);
  byte_ = text_.size() - scan_.rest().size();
  if (found == std::string_view::npos)
    throw MeshFileError("file ends before " + word + ", after byte " + std::to_string(byte_), 0, 0);
  scan_ = TextScanner(scan_.rest().substr(found + 1 + word.size()), '\0');
}

void MshScanner::begin_record(std::string_view what) {
  if (!binary_) scan_.require_line(what);
}

long long MshScanner::integer(std::string_view what, long long low, long long high) {
  if (!binary_) return scan_.integer(what, low, high);
  const long long number = value<std::int32_t>(what);
  if (number < low || number > high)
    fail_at_byte(what, "allowed " + std::to_string(low) + " to " + std::to_string(high));
  return number;
}

long long MshScanner::size(std::string_view what, long long low, long long high) {
  if (!binary_) return scan_.integer(what, low, high);
  const auto number = value<std::uint64_t>(what);
  if (number > static_cast<std::uint64_t>(high) || static_cast<long long>(number) < low)
    fail_at_byte(what, "allowed " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<long long>(number);
}

double MshScanner::number(std::string_view what) {
  return binary_ ? value<double>(what) : scan_.number(what);
}

double MshScanner::coordinate(std::string_view what) {
  if (!binary_) return scan_.coordinate(what);
  const auto number = value<double>(what);
  if (is_too_far(number)) fail_at_byte(what, "allowed -1e150 to 1e150");
  return number;
}

void MshScanner::skip_numbers(std::string_view what, long long count, int bytes) {
  if (!binary_) return;
  const auto left = static_cast<long long>(scan_.rest().size());
  const long long wanted = count > left ? left + 1 : count * bytes;
  (void)take(what, static_cast<std::size_t>(wanted));
}

long long MshScanner::place() const {
  return binary_ ? static_cast<long long>(byte_) : scan_.line();
}

void MshScanner::fail(std::string_view what, std::string_view allowed) const {
  if (!binary_) scan_.fail(what, allowed);
  fail_at_byte(what, allowed);
}

}  // namespace ashlar
