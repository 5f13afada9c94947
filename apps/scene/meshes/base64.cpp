#include "apps/scene/meshes/base64.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <stdexcept>

namespace ashlar {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
/// OpenSSL counts in int.
constexpr std::size_t most_bytes = 3U << 28U;

}  // namespace

std::string to_base64(std::string_view bytes) {
  std::string text;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), most_bytes))) {
    const std::string_view part = bytes.substr(0, most_bytes);
    std::string digits_of_part((part.size() + 2) / 3 * 4, '=');
    EVP_EncodeBlock(reinterpret_cast<unsigned char*>(digits_of_part.data()),
                    reinterpret_cast<const unsigned char*>(part.data()), static_cast<int>(part.size()));
    text += digits_of_part;
  }
  return text;
}

std::string from_base64(std::string_view text) {
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  const std::string_view given = text.substr(0, text.size() - padding);
  // OpenSSL ignores blanks at the ends.
  if (text.size() % 4 != 0 || given.find_first_not_of(digits) != std::string_view::npos)
    throw std::invalid_argument("not base64");
  std::string bytes;
  for (; !text.empty(); text.remove_prefix(std::min(text.size(), most_bytes))) {
    const std::string_view part = text.substr(0, most_bytes);
    std::string decoded(part.size() / 4 * 3, '\0');
    EVP_DecodeBlock(reinterpret_cast<unsigned char*>(decoded.data()),
                    reinterpret_cast<const unsigned char*>(part.data()), static_cast<int>(part.size()));
    bytes += decoded;
  }
  bytes.resize(bytes.size() - padding);
  return bytes;
}

}  // namespace ashlar
