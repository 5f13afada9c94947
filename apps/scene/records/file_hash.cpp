#include "apps/scene/records/file_hash.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>

namespace ashlar {
namespace {

std::string hexadecimal(const unsigned char* bytes, unsigned int size) {
  std::string text;
  for (unsigned int k = 0; k < size; ++k) text += fmt::format("{:02x}", bytes[k]);
  return text;
}

}  // namespace

std::string sha256_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) return {};
  std::array<char, 1 << 16> part{};
  do {
    stream.read(part.data(), part.size());
    if (EVP_DigestUpdate(context.get(), part.data(), static_cast<std::size_t>(stream.gcount())) != 1)
      return {};
  } while (stream);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (stream.bad() || EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1) return {};
  return hexadecimal(digest.data(), size);
}

std::string sha256_of_text(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) return {};
  return hexadecimal(digest.data(), size);
}

}  // namespace ashlar
