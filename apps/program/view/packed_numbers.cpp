#include "apps/program/view/packed_numbers.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "apps/scene/meshes/base64.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

constexpr double most = 32767.0;
constexpr double most_of_box = 65535.0;
constexpr std::uint16_t no_number = 0x8000;

std::uint16_t word_of(double whole) {
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(whole)));
}

/// sign(v) 32767 sqrt(|v| / largest)
std::uint16_t root_word(double value, double largest) {
  if (!std::isfinite(value)) return no_number;
  if (largest == 0.0) return 0;
  return word_of(std::copysign(most * std::sqrt(std::min(std::abs(value) / largest, 1.0)), value));
}

/// The least e with 2^e >= size; 0 for size 0.
int exponent_of(double size) {
  if (size == 0.0) return 0;
  int exponent = 0;
  const double mantissa = std::frexp(size, &exponent);  // size = mantissa 2^exponent, 1/2 <= mantissa < 1
  return mantissa == 0.5 ? exponent - 1 : exponent;
}

/// Points first to end are those of one block.
struct BlockSpan {
  std::size_t first, end;
};

std::vector<BlockSpan> spans_of(std::span<const int> block_of_point) {
  std::vector<BlockSpan> spans;
  for (std::size_t i = 0; i < block_of_point.size(); ++i) {
    if (i == 0 || block_of_point[i] != block_of_point[i - 1]) spans.push_back({i, i});
    spans.back().end = i + 1;
  }
  return spans;
}

}  // namespace

void PackedNumbers::add_words(const std::vector<std::uint16_t>& words) {
  std::string high;
  std::uint16_t last = 0;
  for (const std::uint16_t word : words) {
    const auto difference = static_cast<std::uint16_t>(word - last);
    bytes_ += static_cast<char>(difference & 0xFFU);
    high += static_cast<char>(difference >> 8U);
    last = word;
  }
  bytes_ += high;
}

void PackedNumbers::add_float(double value) {
  const auto number = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  for (unsigned shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>((number >> shift) & 0xFFU);
}

void PackedNumbers::add_integers(const std::vector<std::int32_t>& values) {
  std::vector<std::uint16_t> words;
  words.reserve(values.size());
  for (const std::int32_t value : values) words.push_back(static_cast<std::uint16_t>(value));
  add_words(words);
}

void PackedNumbers::add_reals(const std::vector<double>& values, std::size_t components) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  largest = std::min(largest, static_cast<double>(std::numeric_limits<float>::max()));
  add_float(largest);
  std::vector<std::uint16_t> words;
  words.reserve(values.size());
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t i = c; i < values.size(); i += components)
      words.push_back(root_word(values[i], largest));
  add_words(words);
}

void PackedNumbers::add_points(const std::vector<Vector3>& points) {
  std::vector<std::uint16_t> words;
  for (int k = 0; k < 3; ++k) {
    double low = points.empty() ? 0.0 : points.front()[k], high = low;
    for (const Vector3& point : points) {
      low = std::min(low, point[k]);
      high = std::max(high, point[k]);
    }
    add_float(low);
    add_float(high);
    const double side = high - low;
    for (const Vector3& point : points) {
      const double share = side > 0.0 ? (point[k] - low) / side : 0.0;
      words.push_back(static_cast<std::uint16_t>(std::lround(most_of_box * share)));
    }
  }
  add_words(words);
}

void PackedNumbers::add_displacements(const std::vector<Vector3>& displacements,
                                      std::span<const int> block_of_point) {
  const std::vector<BlockSpan> spans = spans_of(block_of_point);
  std::vector<std::int32_t> exponents;
  std::vector<std::uint16_t> words(3 * displacements.size());
  for (const auto& [first, end] : spans) {
    Vector3 mean = Vector3::Zero();
    for (std::size_t i = first; i < end; ++i) mean += displacements[i];
    mean /= static_cast<double>(end - first);
    for (int k = 0; k < 3; ++k) {
      add_float(mean[k]);
      mean[k] = static_cast<float>(mean[k]);  // as decoded
    }
    double spread = 0.0;
    for (std::size_t i = first; i < end; ++i)
      spread = std::max(spread, (displacements[i] - mean).lpNorm<Eigen::Infinity>());
    const bool is_there = std::isfinite(spread) && mean.allFinite();
    const int exponent = is_there ? exponent_of(spread) : 0;
    exponents.push_back(exponent);
    for (std::size_t i = first; i < end; ++i) {
      for (int k = 0; k < 3; ++k) {
        const double share = std::ldexp(displacements[i][k] - mean[k], -exponent);
        words[at(k) * displacements.size() + i] = is_there ? word_of(most * share) : std::uint16_t{0};
      }
    }
  }
  add_integers(exponents);
  add_words(words);
}

std::string PackedNumbers::base64() const {
  return deflated_base64(bytes_);
}

std::string deflated_base64(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib has no memory");
  packed.resize(size);
  return to_base64(packed);
}

}  // namespace ashlar
