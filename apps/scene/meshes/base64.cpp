#include "apps/scene/meshes/base64.hpp"

#include <algorithm>
#include <stdexcept>

#include "apps/scene/system/digest.hpp"

namespace ashlar {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
/// Libraries count in int.
constexpr std::size_t most_bytes = 3U << 28U;

}  // namespace

std::string to_base64(std::string_view bytes) {
  std::string text;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), most_bytes)))
    text += base64_digits(bytes.substr(0, most_bytes));
  return text;
}

std::string from_base64(std::string_view text) {
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  const std::string_view given = text.substr(0, text.size() - padding);
  // Libraries ignore blanks at the ends.
  if (text.size() % 4 != 0 || given.find_first_not_of(digits) != std::string_view::npos)
    throw std::invalid_argument("not base64");
  std::string bytes;
  for (; !text.empty(); text.remove_prefix(std::min(text.size(), most_bytes)))
    bytes += bytes_of_base64(text.substr(0, most_bytes));
  bytes.resize(bytes.size() - padding);
  return bytes;
}

}  // namespace ashlar
