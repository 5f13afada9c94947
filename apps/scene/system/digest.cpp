#include "apps/scene/system/digest.hpp"

#include <openssl/evp.h>

#include <utility>

namespace ashlar {
namespace {

EVP_MD_CTX* context_of(void* state) {
  return static_cast<EVP_MD_CTX*>(state);
}

}  // namespace

Sha256::Sha256() : state_(EVP_MD_CTX_new()) {
  if (state_ == nullptr || EVP_DigestInit_ex(context_of(state_), EVP_sha256(), nullptr) == 1) return;
  EVP_MD_CTX_free(context_of(std::exchange(state_, nullptr)));
}

Sha256::~Sha256() {
  EVP_MD_CTX_free(context_of(state_));
}

void Sha256::add(std::string_view bytes) {
  if (state_ == nullptr || EVP_DigestUpdate(context_of(state_), bytes.data(), bytes.size()) == 1) return;
  EVP_MD_CTX_free(context_of(std::exchange(state_, nullptr)));
}

std::optional<Sha256Bytes> Sha256::bytes() {
  Sha256Bytes digest{};
  if (state_ == nullptr || EVP_DigestFinal_ex(context_of(state_), digest.data(), nullptr) != 1)
    return std::nullopt;
  return digest;
}

std::string base64_digits(std::string_view bytes) {
  std::string digits((bytes.size() + 2) / 3 * 4, '=');
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(digits.data()),
                  reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  return digits;
}

std::string bytes_of_base64(std::string_view digits) {
  std::string bytes(digits.size() / 4 * 3, '\0');
  EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                  reinterpret_cast<const unsigned char*>(digits.data()), static_cast<int>(digits.size()));
  return bytes;
}

}  // namespace ashlar
