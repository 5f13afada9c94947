#include "apps/program/fragility/fragility_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

namespace ashlar {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

double normal_share(double q) {
  return 0.5 * std::erfc(-q / std::numbers::sqrt2);
}

/// Below this Phi is taken from its asymptotic series: erfc loses its digits at -37.
constexpr double far_tail = -30.0;

/// ln Phi(q).
double log_share(double q) {
  if (q > far_tail) return std::log(normal_share(q));
  const double square = q * q;
  return -0.5 * square - std::log(-q) - 0.5 * std::log(2.0 * std::numbers::pi) +
         std::log1p(-1.0 / square + 3.0 / (square * square));
}

/// r(q) = phi(q) / Phi(q).
double hazard(double q) {
  return std::exp(-0.5 * q * q - 0.5 * std::log(2.0 * std::numbers::pi) - log_share(q));
}

/// A run with the logarithm of its intensity relative to that of all runs.
struct LoggedRun {
  double x;
  bool exceeded;
  std::size_t record;
};

double likelihood_of(const std::vector<LoggedRun>& points, const Vector2d& line) {
  double sum = 0.0;
  for (const LoggedRun& point : points) {
    const double q = line[0] + line[1] * point.x;
    sum += log_share(point.exceeded ? q : -q);
  }
  return sum;
}

/// Derivative of the likelihood of one run by its q, and minus the second one.
std::pair<double, double> slope_and_weight(const LoggedRun& point, const Vector2d& line) {
  const double q = line[0] + line[1] * point.x;
  const double r = hazard(point.exceeded ? q : -q);
  return {point.exceeded ? r : -r, r * (point.exceeded ? r + q : r - q)};
}

struct Derivatives {
  Vector2d score = Vector2d::Zero();
  Matrix2d information = Matrix2d::Zero();
};

Derivatives derivatives_of(const std::vector<LoggedRun>& points, const Vector2d& line) {
  Derivatives sum;
  for (const LoggedRun& point : points) {
    const Vector2d z(1.0, point.x);
    const auto [slope, weight] = slope_and_weight(point, line);
    sum.score += slope * z;
    sum.information += weight * z * z.transpose();
  }
  return sum;
}

/// The line of largest likelihood, which exists as the outcomes overlap.
Vector2d best_line(const std::vector<LoggedRun>& points) {
  constexpr int most_steps = 200, most_halvings = 60;
  // Increase of the likelihood by a step, relative to it, below which rounding hides it. That step is the last one: the
  // error after it is of the order of its square.
  constexpr double converged = 1e-10;
  Vector2d line = Vector2d::Zero();
  double likelihood = likelihood_of(points, line);
  for (int step = 0; step < most_steps; ++step) {
    const auto [score, information] = derivatives_of(points, line);
    const Vector2d change = information.ldlt().solve(score);
    if (change.dot(score) < converged * std::max(std::abs(likelihood), 1.0)) return line + change;
    double share = 1.0, next = likelihood_of(points, line + change);
    for (int k = 0; !(next > likelihood) && k < most_halvings; ++k) {
      share *= 0.5;
      next = likelihood_of(points, line + share * change);
    }
    if (!(next > likelihood)) break;
    line += share * change;
    likelihood = next;
  }
  return line;
}

/// Equation (6). Empty with a single record
std::optional<Matrix2d> covariance_of(const std::vector<LoggedRun>& points, const Vector2d& line) {
  std::map<std::size_t, Vector2d> scores;
  for (const LoggedRun& point : points)
    scores.try_emplace(point.record, Vector2d::Zero()).first->second +=
        slope_and_weight(point, line).first * Vector2d(1.0, point.x);
  const auto count = static_cast<double>(scores.size());
  if (count < 2.0) return std::nullopt;
  Matrix2d middle = Matrix2d::Zero();
  for (const auto& [record, score] : scores) middle += score * score.transpose();
  const Matrix2d inverse = derivatives_of(points, line).information.inverse();
  return Matrix2d(count / (count - 1.0) * inverse * middle * inverse);
}

double quantile_of(double level) {
  return boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * level);
}

/// Largest likelihood over all medians at a dispersion. @param low,high between which it lies, logarithms
double profile(const std::vector<LoggedRun>& points, double dispersion, double low, double high) {
  constexpr double golden = 0.6180339887498949;
  constexpr int steps = 80;
  const auto at = [&](double median) {
    return likelihood_of(points, {-median / dispersion, 1.0 / dispersion});
  };
  for (int k = 0; k < steps; ++k) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (at(a) < at(b) ? low : high) = at(a) < at(b) ? a : b;
  }
  return at(0.5 * (low + high));
}

/// Limit of the likelihood of separated outcomes as the dispersion tends to 0: 0, less than that if runs at the intensity
/// between them have both outcomes.
double separated_likelihood(const std::vector<LoggedRun>& points, double between) {
  double survived = 0.0, exceeded = 0.0;
  for (const LoggedRun& point : points)
    if (point.x == between) (point.exceeded ? exceeded : survived) += 1.0;
  if (survived == 0.0 || exceeded == 0.0) return 0.0;
  const double all = survived + exceeded;
  return survived * std::log(survived / all) + exceeded * std::log(exceeded / all);
}

/// Largest dispersion that separated outcomes allow. @param between largest logarithm that is survived
double largest_dispersion(const std::vector<LoggedRun>& points, double between, double level) {
  const auto ends = std::minmax_element(points.begin(), points.end(),
                                        [](const LoggedRun& a, const LoggedRun& b) { return a.x < b.x; });
  const double first = ends.first->x, last = ends.second->x;
  const double least = separated_likelihood(points, between) - 0.5 * std::pow(quantile_of(level), 2);
  const auto allowed = [&](double dispersion) {
    const double beyond = 10.0 * dispersion;
    return profile(points, dispersion, first - beyond, last + beyond) >= least;
  };
  double low = 1e-6, high = 1.0;
  constexpr double widest = 1e6;  // few runs allow any dispersion
  while (allowed(high) && high < widest) high *= 2.0;
  if (high >= widest) return std::numeric_limits<double>::infinity();
  constexpr int halvings = 60;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (allowed(middle) ? low : high) = middle;
  }
  return low;
}

/// Least and largest logarithm of intensities with an outcome.
struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
};

FragilityStatus status_of(const FragilityFit& fit, const Extent& survived, const Extent& exceeded) {
  if (fit.runs == 0) return FragilityStatus::no_runs;
  if (fit.exceeded == 0) return FragilityStatus::all_survive;
  if (fit.exceeded == fit.runs) return FragilityStatus::all_exceed;
  if (std::max(survived.most, exceeded.most) == std::min(survived.least, exceeded.least))
    return FragilityStatus::one_intensity;
  if (survived.most <= exceeded.least) return FragilityStatus::separated;
  if (exceeded.most <= survived.least) return FragilityStatus::not_growing;
  return FragilityStatus::fitted;
}

/// Bounds of a positive value whose logarithm has a standard deviation.
FragilityBounds around(double value, double deviation) {
  return {value * std::exp(-deviation), value * std::exp(deviation)};
}

/// @param center logarithm that those of the points are relative to
void fit_line(const std::vector<LoggedRun>& points, double center, FragilityFit& fit) {
  const Vector2d line = best_line(points);
  if (!(line[1] > 0.0)) {
    fit.status = FragilityStatus::not_growing;
    return;
  }
  fit.intercept = line[0] - line[1] * center;
  fit.slope = line[1];
  fit.median = std::exp(center - line[0] / line[1]);
  fit.dispersion = 1.0 / line[1];
  fit.likelihood = likelihood_of(points, line);
  const std::optional<Matrix2d> covariance = covariance_of(points, line);
  if (!covariance) return;
  const double c = quantile_of(fit.level);
  const Vector2d of_median(-1.0 / line[1], line[0] / (line[1] * line[1]));
  fit.median_bounds = around(*fit.median, c * std::sqrt(of_median.dot(*covariance * of_median)));
  fit.dispersion_bounds = around(*fit.dispersion, c * std::sqrt((*covariance)(1, 1)) / line[1]);
  // Of the line in ln x instead of ln x - center.
  Matrix2d shift = Matrix2d::Identity();
  shift(0, 1) = -center;
  const Matrix2d of_line = shift * *covariance * shift.transpose();
  fit.covariance = {of_line(0, 0), of_line(0, 1), of_line(1, 0), of_line(1, 1)};
}

}  // namespace

const char* word_of(FragilityStatus status) {
  switch (status) {
    case FragilityStatus::fitted:
      return "fitted";
    case FragilityStatus::separated:
      return "separated";
    case FragilityStatus::all_survive:
      return "all survive";
    case FragilityStatus::all_exceed:
      return "all exceed";
    case FragilityStatus::not_growing:
      return "not growing";
    case FragilityStatus::one_intensity:
      return "one intensity";
    case FragilityStatus::no_runs:
      return "no runs";
  }
  return "no runs";
}

std::optional<double> FragilityFit::probability(double intensity) const {
  if (status == FragilityStatus::separated) return intensity < *median ? 0.0 : 1.0;
  if (status != FragilityStatus::fitted) return std::nullopt;
  return normal_share(intercept + slope * std::log(intensity));
}

std::optional<FragilityBounds> FragilityFit::probability_bounds(double intensity) const {
  if (!covariance) return std::nullopt;
  const double x = std::log(intensity);
  const std::vector<double>& v = *covariance;
  const double q = intercept + slope * x;
  const double deviation =
      quantile_of(level) * std::sqrt(std::max(v[0] + (v[1] + v[2]) * x + v[3] * x * x, 0.0));
  return FragilityBounds{normal_share(q - deviation), normal_share(q + deviation)};
}

double log_likelihood(const std::vector<FragilityRun>& runs, double median, double dispersion) {
  double sum = 0.0;
  for (const FragilityRun& run : runs) {
    const double q = std::log(run.intensity / median) / dispersion;
    sum += log_share(run.exceeded ? q : -q);
  }
  return sum;
}

FragilityFit fit_fragility(const std::vector<FragilityRun>& runs, double level) {
  FragilityFit fit;
  fit.level = level;
  fit.runs = runs.size();
  std::set<std::size_t> records;
  Extent survived, exceeded;
  double center = 0.0;
  for (const FragilityRun& run : runs) {
    fit.exceeded += run.exceeded ? 1 : 0;
    records.insert(run.record);
    (run.exceeded ? exceeded : survived).add(std::log(run.intensity));
    center += std::log(run.intensity) / static_cast<double>(runs.size());
  }
  fit.records = records.size();
  fit.status = status_of(fit, survived, exceeded);
  std::vector<LoggedRun> points;
  points.reserve(runs.size());
  for (const FragilityRun& run : runs)
    points.push_back({std::log(run.intensity) - center, run.exceeded, run.record});
  if (fit.status == FragilityStatus::fitted) fit_line(points, center, fit);
  if (fit.status == FragilityStatus::separated) {
    fit.median = std::exp(0.5 * (survived.most + exceeded.least));
    fit.median_bounds = {std::exp(survived.most), std::exp(exceeded.least)};
    fit.dispersion_bounds = {0.0, largest_dispersion(points, survived.most - center, level)};
  }
  return fit;
}

std::string describe(const FragilityFit& fit, const std::string& unit) {
  const std::string of = fmt::format("{} of {} runs exceed it", fit.exceeded, fit.runs);
  const double percent = 100.0 * fit.level;
  switch (fit.status) {
    case FragilityStatus::fitted: {
      std::string text = fmt::format("median {:.4g}{}", *fit.median, unit);
      if (fit.median_bounds)
        text += fmt::format(" ({:g} % between {:.4g} and {:.4g})", percent, fit.median_bounds->low,
                            fit.median_bounds->high);
      text += fmt::format(", dispersion {:.3g}", *fit.dispersion);
      if (fit.dispersion_bounds)
        text += fmt::format(" ({:.3g} to {:.3g})", fit.dispersion_bounds->low, fit.dispersion_bounds->high);
      else
        text += ", without confidence: a single record";
      return text + "; " + of;
    }
    case FragilityStatus::separated:
      return fmt::format(
          "median between {:.4g} and {:.4g}{}: no run below exceeds it, all above do; the dispersion is not "
          "resolved{}; more scales there resolve it; {}",
          fit.median_bounds->low, fit.median_bounds->high, unit,
          std::isfinite(fit.dispersion_bounds->high)
              ? fmt::format(", it is below {:.3g} ({:g} %)", fit.dispersion_bounds->high, percent)
              : " by so few runs",
          of);
    case FragilityStatus::all_survive:
      return fmt::format("no median: no run exceeds it ({} runs), larger scales are needed", fit.runs);
    case FragilityStatus::all_exceed:
      return fmt::format("no median: all runs exceed it ({} runs), smaller scales are needed", fit.runs);
    case FragilityStatus::not_growing:
      return "no curve: the share of runs that exceed it does not grow with the intensity; " + of;
    case FragilityStatus::one_intensity:
      return "no curve: all runs have one intensity, more scales are needed; " + of;
    case FragilityStatus::no_runs:
      return "no curve: no run has ended";
  }
  return of;
}

}  // namespace ashlar
