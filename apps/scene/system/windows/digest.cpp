#include "apps/scene/system/digest.hpp"

#include <windows.h>

#include <bcrypt.h>
#include <wincrypt.h>

#include <utility>

namespace ashlar {
namespace {

/// Opened once, for the whole time of the program. Null if Windows has none.
BCRYPT_ALG_HANDLE algorithm() {
  static const BCRYPT_ALG_HANDLE opened = [] {
    BCRYPT_ALG_HANDLE handle = nullptr;
    const bool good = ::BCryptOpenAlgorithmProvider(&handle, BCRYPT_SHA256_ALGORITHM, nullptr, 0) >= 0;
    return good ? handle : nullptr;
  }();
  return opened;
}

UCHAR* as_bytes(std::string_view text) {
  return reinterpret_cast<UCHAR*>(const_cast<char*>(text.data()));  // only read
}

}  // namespace

Sha256::Sha256() {
  BCRYPT_HASH_HANDLE hash = nullptr;
  if (algorithm() != nullptr && ::BCryptCreateHash(algorithm(), &hash, nullptr, 0, nullptr, 0, 0) >= 0)
    state_ = hash;
}

Sha256::~Sha256() {
  if (state_ != nullptr) ::BCryptDestroyHash(state_);
}

void Sha256::add(std::string_view bytes) {
  if (state_ == nullptr ||
      ::BCryptHashData(state_, as_bytes(bytes), static_cast<ULONG>(bytes.size()), 0) >= 0)
    return;
  ::BCryptDestroyHash(std::exchange(state_, nullptr));
}

std::optional<Sha256Bytes> Sha256::bytes() {
  Sha256Bytes digest{};
  if (state_ == nullptr || ::BCryptFinishHash(state_, digest.data(), digest.size(), 0) < 0)
    return std::nullopt;
  return digest;
}

std::string base64_digits(std::string_view bytes) {
  std::string digits((bytes.size() + 2) / 3 * 4 + 1, '\0');  // and the zero that Windows writes
  auto size = static_cast<DWORD>(digits.size());
  constexpr DWORD plain = CRYPT_STRING_BASE64 | CRYPT_STRING_NOCRLF;
  if (bytes.empty() || ::CryptBinaryToStringA(as_bytes(bytes), static_cast<DWORD>(bytes.size()), plain,
                                              digits.data(), &size) == 0)
    size = 0;
  digits.resize(size);
  return digits;
}

std::string bytes_of_base64(std::string_view digits) {
  std::string bytes(digits.size() / 4 * 3, '\0');
  auto size = static_cast<DWORD>(bytes.size());
  if (!digits.empty())
    ::CryptStringToBinaryA(digits.data(), static_cast<DWORD>(digits.size()), CRYPT_STRING_BASE64,
                           reinterpret_cast<BYTE*>(bytes.data()), &size, nullptr, nullptr);
  return bytes;
}

}  // namespace ashlar
