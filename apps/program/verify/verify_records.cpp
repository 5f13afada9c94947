// Cases of records: response spectra.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/program/verify/verification.hpp"
#include "apps/results/tables/response_spectrum.hpp"

namespace ashlar {
namespace {

struct Motion {
  double displacement, velocity;
};

/// An oscillator of frequency w and damping z on a base with the acceleration A sin(v t), from rest:
///   u = exp(-z w t) (C cos wd t + D sin wd t) + P sin v t + Q cos v t
/// with r = v / w, n = (1 - r^2)^2 + (2 z r)^2, P = -A (1 - r^2) / (n w^2), Q = 2 A z r / (n w^2), C = -Q,
/// D = (z w C - v P) / wd.
class SineResponse {
 public:
  SineResponse(double amplitude, double v, double w, double z) : v_(v), w_(w), z_(z) {
    const double r = v / w, n = (1.0 - r * r) * (1.0 - r * r) + 4.0 * z * z * r * r;
    wd_ = w * std::sqrt(1.0 - z * z);
    p_ = -amplitude * (1.0 - r * r) / (n * w * w);
    q_ = 2.0 * amplitude * z * r / (n * w * w);
    c_ = -q_;
    d_ = (z * w * c_ - v * p_) / wd_;
  }
  [[nodiscard]] Motion at(double t) const {
    const Motion free = free_motion(c_, d_, t);
    return {free.displacement + p_ * std::sin(v_ * t) + q_ * std::cos(v_ * t),
            free.velocity + v_ * (p_ * std::cos(v_ * t) - q_ * std::sin(v_ * t))};
  }
  /// Motion after the base has stopped at `end`, where it has this motion.
  [[nodiscard]] Motion after(const Motion& end, double t) const {
    return free_motion(end.displacement, (end.velocity + z_ * w_ * end.displacement) / wd_, t);
  }

 private:
  [[nodiscard]] Motion free_motion(double c, double d, double t) const {
    const double decay = std::exp(-z_ * w_ * t), cosine = std::cos(wd_ * t), sine = std::sin(wd_ * t);
    const double u = decay * (c * cosine + d * sine);
    return {u, -z_ * w_ * u + decay * wd_ * (d * cosine - c * sine)};
  }
  double v_, w_, z_, wd_, p_, q_, c_, d_;
};

/// Ten waves of 1 m/s^2 and 0.5 s, and oscillators below, at and above their period. The record has 50 rows in a
/// wave: lines between them are up to (2 pi / 50)^2 / 8 = 0.2 % below the sine.
std::vector<VerificationCheck> sine_spectrum() {
  constexpr double wave = 0.5, damping = 0.05, length = 10.0 * wave;
  constexpr int rows_per_wave = 50, looked_at = 20000;
  const double v = 2.0 * std::numbers::pi / wave;
  std::vector<double> times, values;
  for (int k = 0; k <= 10 * rows_per_wave; ++k) {
    times.push_back(k * wave / rows_per_wave);
    values.push_back(std::sin(v * times.back()));
  }
  const auto segments = segments_of_acceleration(times, values);
  std::vector<VerificationCheck> checks;
  for (const double period : {0.05, 0.4, 0.5, 0.7, 3.0}) {
    const double w = 2.0 * std::numbers::pi / period;
    const SineResponse response(1.0, v, w, damping);
    const Motion end = response.at(length);
    double largest = 0.0;
    for (int k = 0; k <= looked_at; ++k) {
      const double share = static_cast<double>(k) / looked_at;
      largest = std::max({largest, std::abs(response.at(share * length).displacement),
                          std::abs(response.after(end, share * period).displacement)});
    }
    const SpectrumPoint found = response_spectrum(segments, {period}, damping).front();
    checks.push_back(check_relative(fmt::format("pseudo-acceleration at {} s, m/s^2", period),
                                    found.pseudo_acceleration, w * w * largest, 3e-3));
  }
  return checks;
}

/// Velocities that grow evenly are one acceleration a from the start: an undamped oscillator moves to 2 a / w^2.
std::vector<VerificationCheck> step_spectrum() {
  const auto segments = segments_of_velocity({0.0, 0.3, 5.0}, {0.0, 0.6, 10.0});
  const SpectrumPoint found = response_spectrum(segments, {1.0}, 0.0).front();
  return {check_relative("pseudo-acceleration of a constant acceleration of 2 m/s^2",
                         found.pseudo_acceleration, 4.0, 1e-4)};
}

constexpr VerificationCase record_case_list[] = {
    {"spectrum-sine", "response spectrum of ten waves of a sine, below, at and above resonance",
     sine_spectrum},
    {"spectrum-step", "response spectrum of a constant acceleration, from velocities", step_spectrum},
};

}  // namespace

std::span<const VerificationCase> record_cases() {
  return record_case_list;
}

}  // namespace ashlar
