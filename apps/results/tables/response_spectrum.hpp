// Response spectra: largest motion of damped oscillators of one degree of freedom on a base that moves.
//
//   u'' + 2 z w u' + w^2 u = -a(t),  u(0) = u'(0) = 0      (1)
//
// u displacement relative to the base, w = 2 pi / T, z share of critical damping, a acceleration of the base. Where a
// is linear in time, a0 + s t, the solution is known (Nigam and Jennings 1969, Bull. Seism. Soc. Am. 59, 909-922):
//
//   u = exp(-z w t) (C cos wd t + D sin wd t) - a0 / w^2 + 2 z s / w^3 - s t / w^2,  wd = w sqrt(1 - z^2)   (2)
//
// so that steps have no error of integration, whatever their length. The largest |u| is that of the cubic through
// displacements and velocities at the ends of a step, at most 1/20 of the period long: 2e-5 of it. Motion of the base
// ends with the record; the oscillator is followed for one period more.
#pragma once

#include <vector>

namespace ashlar {

/// Base acceleration that is linear in time, m/s^2.
struct AccelerationSegment {
  double length;  ///< s, > 0
  double start, end;
};

struct SpectrumPoint {
  double period;               ///< s
  double displacement;         ///< m, largest |u|
  double pseudo_velocity;      ///< m/s, w times that
  double pseudo_acceleration;  ///< m/s^2, w^2 times that
};

/// Segments between samples of an acceleration. @param times increasing, as many as values
[[nodiscard]] std::vector<AccelerationSegment> segments_of_acceleration(
    const std::vector<double>& times, const std::vector<double>& accelerations);

/// Segments between samples of a velocity that is linear between them: each has one acceleration.
[[nodiscard]] std::vector<AccelerationSegment> segments_of_velocity(const std::vector<double>& times,
                                                                    const std::vector<double>& velocities);

/// @param periods s, > 0. @param damping z, 0 to less than 1
[[nodiscard]] std::vector<SpectrumPoint> response_spectrum(const std::vector<AccelerationSegment>& segments,
                                                           const std::vector<double>& periods,
                                                           double damping);

/// Periods with equal ratios, the first and the last exactly. @param count at least 2
[[nodiscard]] std::vector<double> spectrum_periods(double first, double last, int count);

}  // namespace ashlar
