// Random values of a sweep: strengths, spacings and loads given by a mean and a standard deviation.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace ashlar {

/// Distribution of a value. Parameters are those of the value itself, in its unit.
struct Distribution {
  enum class Kind {
    normal,      ///< mean, deviation >= 0
    lognormal,   ///< mean > 0, deviation >= 0
    uniform,     ///< least, most
    triangular,  ///< least, mode, most
  };
  Kind kind = Kind::normal;
  std::vector<double> parameters;
  /// For normal and lognormal: values outside are drawn again.
  std::optional<std::array<double, 2>> within;

  bool operator==(const Distribution&) const = default;
};

/// "normal(32, 2)", "normal(32, 2, 20, 45)" (least and most), "lognormal(1e5, 3e4)", "uniform(20, 30)",
/// "triangular(20, 25, 40)". @return empty if the text has none of these names
/// @throws std::invalid_argument with the fault and the requirement
[[nodiscard]] std::optional<Distribution> parse_distribution(const std::string& text);

/// Quantile of a distribution. @param share strictly between 0 and 1
[[nodiscard]] double quantile(const Distribution& distribution, double share);

/// Random numbers of a seed: the same on any machine, up to rounding of the mathematical library.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : numbers_(seed) {}
  /// @throws std::invalid_argument if very few values lie within its bounds
  [[nodiscard]] double draw(const Distribution& distribution);

 private:
  std::mt19937_64 numbers_;
};

}  // namespace ashlar
