// SHA-256 as FIPS 180-4 defines it, and base64 (RFC 4648): a page has no library for them that answers at once.
#include "apps/scene/system/digest.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace ashlar {
namespace {

constexpr std::size_t block_bytes = 64;
constexpr std::size_t rounds = 64;

/// First 32 bits of the fractional parts of the cube roots of the first 64 primes (FIPS 180-4, 4.2.2).
constexpr std::array<std::uint32_t, rounds> round_constants = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

/// Hash of the bytes so far, and those of a block that is not complete.
struct Sha256State {
  std::array<std::uint32_t, 8> hash = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                       0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, block_bytes> block{};
  std::uint64_t bytes = 0;

  void add(unsigned char byte) {
    block[bytes++ % block_bytes] = byte;
    if (bytes % block_bytes == 0) add_block();
  }
  void add_block();
};

void Sha256State::add_block() {
  std::array<std::uint32_t, rounds> words{};
  for (std::size_t k = 0; k < block_bytes; ++k) words[k / 4] = words[k / 4] << 8U | block[k];
  for (std::size_t k = 16; k < rounds; ++k) {
    const std::uint32_t near = words[k - 2], far = words[k - 15];
    words[k] = words[k - 16] + words[k - 7] + (std::rotr(far, 7) ^ std::rotr(far, 18) ^ far >> 3U) +
               (std::rotr(near, 17) ^ std::rotr(near, 19) ^ near >> 10U);
  }
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t k = 0; k < rounds; ++k) {
    const std::uint32_t one = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                              ((e & f) ^ (~e & g)) + round_constants[k] + words[k];
    const std::uint32_t other =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + one;
    d = c, c = b, b = a, a = one + other;
  }
  const std::array added = {a, b, c, d, e, f, g, h};
  for (std::size_t k = 0; k < hash.size(); ++k) hash[k] += added[k];
}

Sha256State& state_of(void* state) {
  return *static_cast<Sha256State*>(state);
}

constexpr std::string_view digits_of_base64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

Sha256::Sha256() : state_(new Sha256State) {}

Sha256::~Sha256() {
  delete &state_of(state_);
}

void Sha256::add(std::string_view bytes) {
  for (const char byte : bytes) state_of(state_).add(static_cast<unsigned char>(byte));
}

std::optional<Sha256Bytes> Sha256::bytes() {
  Sha256State& state = state_of(state_);
  const std::uint64_t bits = 8 * state.bytes;
  state.add(0x80);
  while (state.bytes % block_bytes != block_bytes - 8) state.add(0);
  for (int shift = 56; shift >= 0; shift -= 8) state.add(static_cast<unsigned char>(bits >> shift));
  Sha256Bytes digest{};
  for (std::size_t k = 0; k < digest.size(); ++k)
    digest[k] = static_cast<unsigned char>(state.hash[k / 4] >> (24 - 8 * (k % 4)));
  return digest;
}

std::string base64_digits(std::string_view bytes) {
  std::string digits;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    for (std::size_t i = k; i < k + 3; ++i)
      three = three << 8U | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
    for (int shift = 18; shift >= 0; shift -= 6) digits += digits_of_base64[three >> shift & 63U];
  }
  for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) digits[digits.size() - 1 - k] = '=';
  return digits;
}

std::string bytes_of_base64(std::string_view digits) {
  std::string bytes;
  for (std::size_t k = 0; k + 4 <= digits.size(); k += 4) {
    std::uint32_t three = 0;
    for (const char digit : digits.substr(k, 4)) {
      const std::size_t value = digits_of_base64.find(digit);
      three = three << 6U | (value == std::string_view::npos ? 0U : static_cast<std::uint32_t>(value));
    }
    for (int shift = 16; shift >= 0; shift -= 8) bytes += static_cast<char>(three >> shift & 255U);
  }
  return bytes;
}

}  // namespace ashlar
