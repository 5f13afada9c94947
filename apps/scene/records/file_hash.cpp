#include "apps/scene/records/file_hash.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "apps/scene/system/digest.hpp"

namespace ashlar {
namespace {

/// Empty after a failure.
std::string hexadecimal(const std::optional<Sha256Bytes>& bytes) {
  std::string text;
  if (bytes)
    for (const unsigned char byte : *bytes) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace

std::string sha256_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  Sha256 hash;
  std::array<char, 1 << 16> part{};
  do {
    stream.read(part.data(), part.size());
    hash.add({part.data(), static_cast<std::size_t>(stream.gcount())});
  } while (stream);
  return stream.bad() ? "" : hexadecimal(hash.bytes());
}

std::string sha256_of_text(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return hexadecimal(hash.bytes());
}

}  // namespace ashlar
