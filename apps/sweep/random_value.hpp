// Values of a sweep that are drawn: strengths, spacings and loads that are known by a mean and a deviation.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace ashlar {

/// How a value is spread. Parameters are of the value itself, in its unit.
struct Distribution {
  enum class Kind {
    normal,      ///< mean, deviation >= 0
    lognormal,   ///< mean > 0, deviation >= 0
    uniform,     ///< least, most
    triangular,  ///< least, mode, most
  };
  Kind kind = Kind::normal;
  std::vector<double> parameters;
  /// Of normal and lognormal: values outside are drawn again.
  std::optional<std::array<double, 2>> within;

  bool operator==(const Distribution&) const = default;
};

/// "normal(32, 2)", "normal(32, 2, 20, 45)" (least and most), "lognormal(1e5, 3e4)", "uniform(20, 30)",
/// "triangular(20, 25, 40)". @return empty: the text has none of these names
/// @throws std::invalid_argument with what is wrong and needed
[[nodiscard]] std::optional<Distribution> parse_distribution(const std::string& text);

/// The value that a share of all draws is below. @param share within 0 to 1, without them
[[nodiscard]] double quantile(const Distribution& distribution, double share);

/// Numbers of a seed: the same ones on any machine, to rounding of the functions of the mathematical library.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : numbers_(seed) {}
  /// @throws std::invalid_argument if hardly any value lies within its bounds
  [[nodiscard]] double draw(const Distribution& distribution);

 private:
  std::mt19937_64 numbers_;
};

}  // namespace ashlar
