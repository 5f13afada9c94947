#include "apps/sweep/random_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "apps/results/csv_text.hpp"

namespace ashlar {
namespace {

using Kind = Distribution::Kind;

const std::map<std::string, Kind>& kinds() {
  static const std::map<std::string, Kind> kinds = {{"normal", Kind::normal},
                                                    {"lognormal", Kind::lognormal},
                                                    {"uniform", Kind::uniform},
                                                    {"triangular", Kind::triangular}};
  return kinds;
}

std::string without_spaces(std::string text) {
  text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\t'; }),
             text.end());
  return text;
}

std::vector<double> numbers_in(const std::string& list, const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find(',', from), list.size());
    const std::optional<double> number = csv_number(list.substr(from, comma - from));
    if (!number || !std::isfinite(*number))
      throw std::invalid_argument(
          fmt::format("--vary has no number in a distribution ({}), numbers are needed", text));
    numbers.push_back(*number);
    from = comma + 1;
  }
  return numbers;
}

/// The parameters that are needed; empty: these are right.
std::string fault_of(Kind kind, const std::vector<double>& p) {
  const bool deviates = kind == Kind::normal || kind == Kind::lognormal;
  if (deviates && p.size() != 2 && p.size() != 4)
    return "mean and deviation, or these and the least and most value";
  if (deviates && (p[1] < 0.0 || (p.size() == 4 && !(p[2] < p[3]))))
    return "a deviation of at least 0, and a least value below the most";
  if (kind == Kind::lognormal && !(p[0] > 0.0)) return "a mean above 0";
  if (kind == Kind::uniform && (p.size() != 2 || !(p[0] < p[1]))) return "a least value below the most";
  if (kind == Kind::triangular && (p.size() != 3 || !(p[0] <= p[1] && p[1] <= p[2] && p[0] < p[2])))
    return "least, mode and most, in this order";
  return "";
}

/// Of the normal distribution of mean 0 and deviation 1: Acklam's rational approximation and a step of Halley's method,
/// to rounding.
double normal_quantile(double share) {
  constexpr std::array a = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                            1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr std::array b = {-5.447609879822406e+01, 1.615858368580409e+02, -1.556989798598866e+02,
                            6.680131188771972e+01, -1.328068155288572e+01};
  constexpr std::array c = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                            -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr std::array d = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                            3.754408661907416e+00};
  constexpr double tail = 0.02425;
  double x = 0.0;
  if (share < tail || share > 1.0 - tail) {
    const double q = std::sqrt(-2.0 * std::log(std::min(share, 1.0 - share)));
    x = (((((c[0] * q + c[1]) * q + c[2]) * q + c[3]) * q + c[4]) * q + c[5]) /
        ((((d[0] * q + d[1]) * q + d[2]) * q + d[3]) * q + 1.0);
    if (share > 0.5) x = -x;
  } else {
    const double q = share - 0.5, r = q * q;
    x = (((((a[0] * r + a[1]) * r + a[2]) * r + a[3]) * r + a[4]) * r + a[5]) * q /
        (((((b[0] * r + b[1]) * r + b[2]) * r + b[3]) * r + b[4]) * r + 1.0);
  }
  const double error = 0.5 * std::erfc(-x / std::sqrt(2.0)) - share;
  const double u = error * std::sqrt(2.0 * 3.14159265358979323846) * std::exp(0.5 * x * x);
  return x - u / (1.0 + 0.5 * x * u);
}

}  // namespace

std::optional<Distribution> parse_distribution(const std::string& text) {
  const std::string plain = without_spaces(text);
  const std::size_t open = plain.find('(');
  const auto kind = kinds().find(plain.substr(0, open));
  if (open == std::string::npos || kind == kinds().end() || plain.back() != ')') return std::nullopt;
  Distribution distribution;
  distribution.kind = kind->second;
  distribution.parameters = numbers_in(plain.substr(open + 1, plain.size() - open - 2), text);
  const std::string needed = fault_of(distribution.kind, distribution.parameters);
  if (!needed.empty())
    throw std::invalid_argument(
        fmt::format("--vary has a distribution that is none ({}), {} is needed", text, needed));
  if (distribution.parameters.size() == 4) {
    distribution.within = {distribution.parameters[2], distribution.parameters[3]};
    distribution.parameters.resize(2);
  }
  return distribution;
}

double quantile(const Distribution& distribution, double share) {
  const std::vector<double>& p = distribution.parameters;
  switch (distribution.kind) {
    case Kind::normal:
      return p[0] + p[1] * normal_quantile(share);
    case Kind::lognormal: {
      const double square = std::log1p((p[1] / p[0]) * (p[1] / p[0]));
      return p[0] * std::exp(std::sqrt(square) * normal_quantile(share) - 0.5 * square);
    }
    case Kind::uniform:
      return p[0] + share * (p[1] - p[0]);
    case Kind::triangular: {
      const double width = p[2] - p[0];
      if (share * width < p[1] - p[0]) return p[0] + std::sqrt(share * width * (p[1] - p[0]));
      return p[2] - std::sqrt((1.0 - share) * width * (p[2] - p[1]));
    }
  }
  return p[0];
}

double Draws::draw(const Distribution& distribution) {
  constexpr int most_tries = 10'000;
  constexpr double half_step = 0x1p-53, steps = 0x1p-52;
  for (int n = 0; n < most_tries; ++n) {
    // The upper 52 bits, in the middle of their step: neither 0 nor 1.
    const double share = static_cast<double>(numbers_() >> 12U) * steps + half_step;
    const double value = quantile(distribution, share);
    if (!distribution.within || (value >= (*distribution.within)[0] && value <= (*distribution.within)[1]))
      return value;
  }
  throw std::invalid_argument(
      fmt::format("--vary draws hardly any value between {} and {}, bounds around the mean are needed",
                  (*distribution.within)[0], (*distribution.within)[1]));
}

}  // namespace ashlar
