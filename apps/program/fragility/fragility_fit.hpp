// Fragility curve: probability that a limit is exceeded at an intensity, fitted to runs.
//
// Runs i = 1 ... n at intensities x_i > 0 exceed a limit (y_i = 1) or do not (y_i = 0). The curve is lognormal, with the
// median m and the dispersion s, the standard deviation of the logarithm of the intensity at which the limit is exceeded:
//
//   P(x) = Phi(ln(x / m) / s)                                                        (1)
//
// Maximum likelihood (Baker 2015, Earthquake Spectra 31, 579-599, equation 11, with one run in place of the counts at an
// intensity) chooses m and s so that
//
//   L = sum_i [ y_i ln Phi(q_i) + (1 - y_i) ln Phi(-q_i) ],  q_i = a + b ln x_i      (2)
//   b = 1 / s,  a = -ln(m) / s                                                       (3)
//
// is largest. L is concave in (a, b), Newton's method with halved steps finds its only maximum. With z_i = (1, ln x_i),
// phi the normal density and r(q) = phi(q) / Phi(q):
//
//   score of a run    u_i = z_i [ y_i r(q_i) - (1 - y_i) r(-q_i) ]                   (4)
//   information       H = sum_i w_i z_i z_i',  w = r (r + q) for y = 1, r(-q) (r(-q) - q) for y = 0   (5)
//
// Confidence. Runs of the same record at several scales are not independent. The covariance of (a, b) is that of
// independent records (cluster-robust, Liang and Zeger 1986): with u_k the sum of the scores of record k, of K records,
//
//   V = K / (K - 1) H^-1 [ sum_k u_k u_k' ] H^-1                                     (6)
//
// which tends to H^-1, that of Fisher's information, if each record has one run. Bounds at a level are those of the
// normal approximation: q(x) -+ c sqrt(z' V z) for the curve, ln m -+ c sd for the median with the gradient
// (-1, a / b) / b of ln m by (a, b), ln s -+ c sd for the dispersion with the gradient (0, -1 / b).
//
// Degenerate outcomes, which have no maximum:
// - no run exceeds the limit, or all do: the median is above or below all intensities, nothing else is known;
// - all runs below an intensity survive and all above exceed the limit (separation): L tends to its supremum as s tends to 0,
//   for each median between the largest intensity that is survived and the smallest that is not. The median is their geometric
//   mean, its bounds these two. The dispersion has an upper bound only, which the spacing of the intensities sets:
//   the largest s for which some m has 2 L >= 2 L_0 - c^2 (profile likelihood; c the normal quantile of the level, L_0 the
//   limit of L for s to 0, which is 0 unless runs at one intensity between the others have both outcomes);
// - the limit is exceeded at small intensities rather than at large ones: b <= 0, the runs have no such curve.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ashlar {

/// Outcome of a run.
struct FragilityRun {
  double intensity;    ///< > 0
  bool exceeded;       ///< the limit
  std::size_t record;  ///< number of its record: runs of one record depend on each other
};

enum class FragilityStatus {
  fitted,       ///< median and dispersion are those of largest likelihood
  separated,    ///< the dispersion is below a bound; more scales between the bounds of the median resolve it
  all_survive,  ///< the median is above all intensities; larger scales are needed
  all_exceed,   ///< the median is below all intensities; smaller scales are needed
  not_growing,  ///< the share of runs that exceed the limit does not grow with the intensity
  one_intensity,  ///< runs with both outcomes at a single intensity; more scales are needed
  no_runs,        ///< no run has an outcome
};
[[nodiscard]] const char* word_of(FragilityStatus status);

/// Bounds of a value.
struct FragilityBounds {
  double low, high;
};

struct FragilityFit {
  FragilityStatus status = FragilityStatus::no_runs;
  std::size_t runs = 0, exceeded = 0, records = 0;
  std::optional<double> median;                      ///< unit of the intensity; fitted and separated
  std::optional<double> dispersion;                  ///< fitted
  std::optional<double> likelihood;                  ///< L, natural logarithm; fitted
  double level = 0.95;                               ///< of the bounds
  std::optional<FragilityBounds> median_bounds;      ///< fitted with at least two records, separated
  std::optional<FragilityBounds> dispersion_bounds;  ///< fitted likewise; separated: from 0
  /// (a, b) and their covariance, by rows; fitted. The covariance is empty with a single record
  double intercept = 0.0, slope = 0.0;
  std::optional<std::vector<double>> covariance;

  /// P(x) of equation (1); separated: a step. Empty: no curve. @param intensity > 0
  [[nodiscard]] std::optional<double> probability(double intensity) const;
  /// Bounds of P(x) at the level. Empty: none
  [[nodiscard]] std::optional<FragilityBounds> probability_bounds(double intensity) const;
};

/// L of equation (2). @param median > 0. @param dispersion > 0
[[nodiscard]] double log_likelihood(const std::vector<FragilityRun>& runs, double median, double dispersion);

/// @param runs with finite intensities > 0. @param level strictly between 0 and 1
[[nodiscard]] FragilityFit fit_fragility(const std::vector<FragilityRun>& runs, double level = 0.95);

/// The fit in words: "median 2.31 (95 % between 2.1 and 2.5), dispersion 0.31 (0.25 to 0.4); 45 of 100 runs", or why there
/// is none. @param unit of the intensity, with a blank before it, or empty
[[nodiscard]] std::string describe(const FragilityFit& fit, const std::string& unit);

}  // namespace ashlar
