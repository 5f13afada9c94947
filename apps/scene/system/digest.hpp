// SHA-256 and base64 by the library that a system has for them: OpenSSL, or the one of Windows.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ashlar {

using Sha256Bytes = std::array<unsigned char, 32>;

/// SHA-256 of bytes that come in parts.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  /// Called once, at the end. Empty if the library has failed.
  [[nodiscard]] std::optional<Sha256Bytes> bytes();

 private:
  void* state_ = nullptr;  ///< of the library; null after a failure
};

/// @param bytes fewer than 2^29
[[nodiscard]] std::string base64_digits(std::string_view bytes);

/// @param digits a multiple of four, all of base64, fewer than 2^30
/// @return three bytes for four digits, those of the padding too
[[nodiscard]] std::string bytes_of_base64(std::string_view digits);

}  // namespace ashlar
