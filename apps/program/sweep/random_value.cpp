#include "apps/program/sweep/random_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <boost/math/distributions/uniform.hpp>
#include <cmath>
#include <map>
#include <stdexcept>

#include "apps/results/text/csv_text.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

using Kind = Distribution::Kind;

const std::map<std::string, Kind>& distribution_kinds() {
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

/// The required parameters; empty if these are valid.
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

}  // namespace

std::optional<Distribution> parse_distribution(const std::string& text) {
  const std::string plain = without_spaces(text);
  const std::size_t open = plain.find('(');
  const auto kind = distribution_kinds().find(plain.substr(0, open));
  if (open == std::string::npos || kind == distribution_kinds().end() || plain.back() != ')')
    return std::nullopt;
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
  namespace math = boost::math;
  const std::vector<double>& p = distribution.parameters;
  const bool deviates = distribution.kind == Kind::normal || distribution.kind == Kind::lognormal;
  if (deviates && p[1] == 0.0) return p[0];
  switch (distribution.kind) {
    case Kind::normal:
      return math::quantile(math::normal(p[0], p[1]), share);
    case Kind::lognormal: {
      // Variance of the logarithm.
      const double square = correctly_rounded::log1p((p[1] / p[0]) * (p[1] / p[0]));
      return math::quantile(math::lognormal(correctly_rounded::log(p[0]) - 0.5 * square, std::sqrt(square)),
                            share);
    }
    case Kind::uniform:
      return math::quantile(math::uniform(p[0], p[1]), share);
    case Kind::triangular:
      return math::quantile(math::triangular(p[0], p[1], p[2]), share);
  }
  return p[0];
}

double Draws::draw(const Distribution& distribution) {
  constexpr int most_tries = 10'000;
  constexpr double half_step = 0x1p-53, steps = 0x1p-52;
  for (int n = 0; n < most_tries; ++n) {
    // The upper 52 bits, in the middle of their interval: neither 0 nor 1.
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
