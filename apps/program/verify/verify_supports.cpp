// Cases of moving supports: a base that follows a record.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {
namespace {

constexpr double sample_step = 5e-3;  ///< s
constexpr int samples = 201;

/// A record of accelerations like that of an earthquake: three frequencies under an envelope, across and up.
SupportHistory acceleration_record() {
  SupportHistory history;
  history.record = MotionRecord::acceleration;
  const double length = sample_step * (samples - 1);
  for (int k = 0; k < samples; ++k) {
    const double t = sample_step * k;
    const double envelope = std::sin(std::numbers::pi * t / length);
    const auto wave = [&](double frequency, double phase) {
      return envelope * std::sin(2.0 * std::numbers::pi * frequency * t + phase);
    };
    history.times.push_back(t);
    history.values.emplace_back(2.5 * wave(1.3, 0.4) + 1.5 * wave(7.1, 1.9) + 0.6 * wave(23.0, 0.0),
                                1.2 * wave(2.9, 2.2), 0.8 * wave(11.0, 0.7));
  }
  return history;
}

/// The record with linear interpolation between its rows, and its double integral from rest: the integral of (T - t)
/// a(t) over each interval by Simpson's rule, which is exact for it.
Vector3 record_at(const SupportHistory& record, double time) {
  const double place = time / sample_step;
  const auto k = std::min(static_cast<std::size_t>(place), record.values.size() - 2);
  const double share = place - static_cast<double>(k);
  return (1.0 - share) * record.values[k] + share * record.values[k + 1];
}

Vector3 double_integral(const SupportHistory& record, double time) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k + 1 < record.values.size(); ++k) {
    const double start = sample_step * static_cast<double>(k), middle = start + 0.5 * sample_step;
    const Vector3 mean = 0.5 * (record.values[k] + record.values[k + 1]);
    sum += sample_step / 6.0 *
           ((time - start) * record.values[k] + 4.0 * (time - middle) * mean +
            (time - start - sample_step) * record.values[k + 1]);
  }
  return sum;
}

/// A base supported on two faces, so that its whole motion is that of the record. A step's acceleration is (v' - v) /
/// dt, that of the record is its mean over the step: its value at the middle of a step without a row.
std::vector<VerificationCheck> base_record() {
  const SupportHistory record = acceleration_record();
  double peak = 0.0;
  for (const Vector3& value : record.values) peak = std::max(peak, value.cwiseAbs().maxCoeff());
  std::vector<VerificationCheck> checks;
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    for (const double step : {5e-3, 2.5e-3, 1e-3, 5e-4, 2.5e-4}) {
      BlockDefinition base =
          define_block(Polyhedron(make_box({-1, -1, -0.3}, {1, 1, 0})), {2500, 1e10, 0.2}, 2);
      for (const double z : {-0.3, 0.0})
        base.supports.push_back({Plane{{0, 0, z}, Vector3::UnitZ()}, {true, true, true}, record});
      SimulationSettings settings;
      settings.integrator = integrator;
      settings.time_step = step;
      Simulation simulation = lone_block(std::move(base), {}, settings);
      const Vector3 corner(1, 1, 0);
      const auto point = [&] { return simulation.blocks()[0].motion_of(simulation.states()[0], corner); };
      const double end = record.times.back();
      double most = 0.0;
      Vector3 last = Vector3::Zero();
      while (!simulation.reached(end)) {
        const double start = simulation.time();
        take_step(simulation, end);
        const double length = simulation.time() - start;
        const Vector3 velocity = point().velocity;
        // A last step due to rounding has no meaningful acceleration.
        if (length > 0.5 * step)
          most = std::max(
              most,
              ((velocity - last) / length - record_at(record, start + 0.5 * length)).cwiseAbs().maxCoeff());
        last = velocity;
      }
      const Vector3 expected = double_integral(record, end);
      const char* name = integrator == Integrator::dda                    ? "dda"
                         : integrator == Integrator::average_acceleration ? "average-acceleration"
                                                                          : "generalized-alpha";
      const std::string where = fmt::format("{}, step {} s", name, step);
      checks.push_back(
          check_absolute("acceleration off the record's, of its peak, " + where, most / peak, 0.0, 1e-9));
      checks.push_back(check_absolute("end displacement off the double integral, of it, " + where,
                                      (point().displacement - expected).norm() / expected.norm(), 0.0, 1e-9));
    }
  }
  return checks;
}

constexpr VerificationCase support_case_list[] = {
    {"base-record", "a base moved by an acceleration record", base_record},
};

}  // namespace

std::span<const VerificationCase> support_cases() {
  return support_case_list;
}

}  // namespace ashlar
