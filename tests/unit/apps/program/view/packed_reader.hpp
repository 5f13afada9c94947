// Reads the data of a page like its script (page/numbers.js), written from the description in packed_numbers.hpp.
#pragma once

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/meshes/base64.hpp"

namespace ashlar {

inline std::string inflated(const std::string& base64) {
  const std::string packed = from_base64(base64);
  std::string bytes(std::size_t{1} << 24, '\0');
  uLongf size = bytes.size();
  if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                 packed.size()) != Z_OK)
    throw std::runtime_error("no zlib stream");
  bytes.resize(size);
  return bytes;
}

class PackedReader {
 public:
  explicit PackedReader(std::string bytes) : bytes_(std::move(bytes)) {}

  float number() {
    float value = 0.0F;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  std::vector<int> words(int count, bool with_sign = false) {
    std::vector<int> words;
    unsigned last = 0;
    const auto byte = [&](std::size_t place) {
      return static_cast<unsigned>(static_cast<unsigned char>(bytes_.at(place)));
    };
    const auto size = static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < size; ++i) {
      last = (last + byte(at_ + i) + 256 * byte(at_ + size + i)) % 65536;
      words.push_back(static_cast<int>(last) - (with_sign && last >= 32768 ? 65536 : 0));
    }
    at_ += 2 * size;
    return words;
  }

  /// Tuple after tuple.
  std::vector<float> reals(int count, int components) {
    const float largest = number();
    const std::vector<int> packed = words(count * components, true);
    std::vector<float> values(packed.size());
    for (int c = 0; c < components; ++c) {
      for (int i = 0; i < count; ++i) {
        const int word = packed[static_cast<std::size_t>(c * count + i)];
        const float share = static_cast<float>(word) / 32767.0F;
        values[static_cast<std::size_t>(i * components + c)] =
            word == -32768 ? std::numeric_limits<float>::quiet_NaN()
                           : std::copysign(largest * share * share, share);
      }
    }
    return values;
  }

  std::vector<std::array<float, 3>> points(int count) {
    std::array<float, 6> box{};
    for (float& side : box) side = number();
    const std::vector<int> packed = words(3 * count);
    std::vector<std::array<float, 3>> points(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        points[i][k] = box[2 * k] + (box[2 * k + 1] - box[2 * k]) *
                                        static_cast<float>(packed[k * points.size() + i]) / 65535.0F;
    return points;
  }

  /// @param spans first point of each block and the one after its last
  std::vector<std::array<float, 3>> displacements(const std::vector<std::pair<int, int>>& spans, int count) {
    std::vector<std::array<float, 3>> means(spans.size());
    for (auto& mean : means)
      for (float& component : mean) component = number();
    const std::vector<int> exponents = words(static_cast<int>(spans.size()), true);
    const std::vector<int> packed = words(3 * count, true);
    std::vector<std::array<float, 3>> values(static_cast<std::size_t>(count));
    for (std::size_t s = 0; s < spans.size(); ++s)
      for (int i = spans[s].first; i < spans[s].second; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          values[static_cast<std::size_t>(i)][k] =
              means[s][k] +
              std::ldexp(
                  static_cast<float>(packed[k * values.size() + static_cast<std::size_t>(i)]) / 32767.0F,
                  exponents[s]);
    return values;
  }

  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace ashlar
