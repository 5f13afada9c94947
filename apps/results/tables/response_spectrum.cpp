#include "apps/results/tables/response_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

constexpr double steps_per_period = 20.0;

/// An oscillator under equation (1), and the free motion of a step of one length.
class Oscillator {
 public:
  Oscillator(double period, double damping)
      : w_(2.0 * std::numbers::pi / period),
        z_(damping),
        wd_(w_ * std::sqrt(1.0 - damping * damping)),
        longest_step_(period / steps_per_period) {}

  void follow(const AccelerationSegment& segment) {
    const double steps = std::max(1.0, std::ceil(segment.length / longest_step_));
    set_step(segment.length / steps);
    const double change = (segment.end - segment.start) / steps;
    for (double k = 0.0; k < steps; ++k) step(segment.start + k * change, change / step_);
  }
  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] double frequency() const { return w_; }

 private:
  /// Displacement and velocity after a step by those before it.
  struct FreeMotion {
    double uu = 1.0, uv = 0.0, vu = 0.0, vv = 1.0;
  };

  void set_step(double length) {
    if (length == step_) return;
    step_ = length;
    const auto [known, is_new] = known_.try_emplace(length);
    if (is_new) known->second = motion_after(length);
    free_ = known->second;
  }

  [[nodiscard]] FreeMotion motion_after(double length) const {
    const double decay = correctly_rounded::exp(-z_ * w_ * length);
    const double c = decay * correctly_rounded::cos(wd_ * length);
    const double s = decay * correctly_rounded::sin(wd_ * length);
    return {c + z_ * w_ / wd_ * s, s / wd_, -w_ * w_ / wd_ * s, c - z_ * w_ / wd_ * s};
  }

  /// Equation (2): the difference from the particular solution moves freely.
  void step(double acceleration, double slope) {
    const double start = -acceleration / (w_ * w_) + 2.0 * z_ * slope / (w_ * w_ * w_);
    const double rate = -slope / (w_ * w_);
    const double u = u_ - start, v = v_ - rate;
    const double next_u = free_.uu * u + free_.uv * v + start + rate * step_;
    const double next_v = free_.vu * u + free_.vv * v + rate;
    note_largest(next_u, next_v);
    u_ = next_u;
    v_ = next_v;
  }

  /// The cubic has p'(x) = a x^2 + b x + c in the step, 0 <= x <= 1, with different signs at its ends.
  void note_largest(double next_u, double next_v) {
    largest_ = std::max(largest_, std::abs(next_u));
    if (!(v_ * next_v < 0.0)) return;
    const double rise = next_u - u_, from = step_ * v_, to = step_ * next_v;
    const double a = 3.0 * (from + to) - 6.0 * rise, b = 6.0 * rise - 4.0 * from - 2.0 * to, c = from;
    // Both roots without cancellation; one of them is in the step.
    const double q = -0.5 * (b + std::copysign(std::sqrt(std::max(0.0, b * b - 4.0 * a * c)), b));
    for (const double x : {c / q, q / a}) {
      if (!(x >= 0.0 && x <= 1.0)) continue;
      const double y = 1.0 - x;
      const double peak =
          y * y * (1.0 + 2.0 * x) * u_ + x * x * (3.0 - 2.0 * x) * next_u + x * y * y * from - x * x * y * to;
      largest_ = std::max(largest_, std::abs(peak));
    }
  }

  double w_, z_, wd_, longest_step_;
  std::map<double, FreeMotion> known_;  ///< by length: those of a record's steps differ by rounding
  double step_ = 0.0;
  FreeMotion free_;
  double u_ = 0.0, v_ = 0.0, largest_ = 0.0;
};

template <class Segment>
std::vector<AccelerationSegment> segments(const std::vector<double>& times, Segment of) {
  std::vector<AccelerationSegment> result;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) result.push_back(of(k, times[k + 1] - times[k]));
  return result;
}

}  // namespace

std::vector<AccelerationSegment> segments_of_acceleration(const std::vector<double>& times,
                                                          const std::vector<double>& accelerations) {
  return segments(times, [&](std::size_t k, double length) {
    return AccelerationSegment{length, accelerations[k], accelerations[k + 1]};
  });
}

std::vector<AccelerationSegment> segments_of_velocity(const std::vector<double>& times,
                                                      const std::vector<double>& velocities) {
  return segments(times, [&](std::size_t k, double length) {
    const double acceleration = (velocities[k + 1] - velocities[k]) / length;
    return AccelerationSegment{length, acceleration, acceleration};
  });
}

std::vector<SpectrumPoint> response_spectrum(const std::vector<AccelerationSegment>& segments,
                                             const std::vector<double>& periods, double damping) {
  std::vector<SpectrumPoint> spectrum;
  for (const double period : periods) {
    Oscillator oscillator(period, damping);
    for (const AccelerationSegment& segment : segments) oscillator.follow(segment);
    oscillator.follow({period, 0.0, 0.0});
    const double w = oscillator.frequency(), largest = oscillator.largest();
    spectrum.push_back({period, largest, w * largest, w * w * largest});
  }
  return spectrum;
}

std::vector<double> spectrum_periods(double first, double last, int count) {
  std::vector<double> periods = {first};
  for (int k = 1; k + 1 < count; ++k)
    periods.push_back(first * correctly_rounded::pow(last / first, static_cast<double>(k) / (count - 1)));
  periods.push_back(last);
  return periods;
}

}  // namespace ashlar
