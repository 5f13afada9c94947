#include "mechanics/supports/recorded_motion.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace ashlar {
namespace {

/// Second derivative at the start of an interval of a cubic with these slopes at its ends, and its rate.
/// @param length of the interval. @param rise of the values over it
struct Curvature {
  Vector3 start, rate;
};

Curvature curvature_of(double length, const Vector3& rise, const Vector3& slope, const Vector3& next_slope) {
  const Vector3 mean = rise / length;
  return {(6.0 * mean - 4.0 * slope - 2.0 * next_slope) / length,
          (6.0 * (slope + next_slope) - 12.0 * mean) / length / length};
}

}  // namespace

// With h_k the length of interval k and m_k its mean slope, continuity of the second derivative at point k is
//   d_{k-1}/h_{k-1} + 2 (1/h_{k-1} + 1/h_k) d_k + d_{k+1}/h_k = 3 (m_{k-1}/h_{k-1} + m_k/h_k),
// at natural ends  2 d_0 + d_1 = 3 m_0  and its mirror image. The matrix is diagonally dominant: elimination
// needs no pivots.
std::vector<Vector3> spline_slopes(const std::vector<double>& times, const std::vector<Vector3>& values,
                                   SplineEnds ends) {
  const std::size_t last = times.size() - 1;
  std::vector<double> diagonal(last + 1, 1.0), above(last + 1, 0.0);
  std::vector<Vector3> slopes(last + 1, Vector3::Zero());
  const auto length = [&](std::size_t k) { return times[k + 1] - times[k]; };
  const auto mean = [&](std::size_t k) { return Vector3((values[k + 1] - values[k]) / length(k)); };
  const bool natural = ends == SplineEnds::natural;
  for (std::size_t k = 0; k <= last; ++k) {
    double below = 0.0;
    if (k == 0 || k == last) {
      if (!natural) continue;
      diagonal[k] = 2.0;
      (k == 0 ? above[k] : below) = 1.0;
      slopes[k] = 3.0 * mean(k == 0 ? 0 : last - 1);
    } else {
      // The row times h_k: lengths of very different size stay in range.
      const double ratio = length(k) / length(k - 1);
      below = ratio;
      diagonal[k] = 2.0 * (ratio + 1.0);
      above[k] = 1.0;
      slopes[k] = 3.0 * (ratio * mean(k - 1) + mean(k));
    }
    if (k == 0) continue;
    const double factor = below / diagonal[k - 1];
    diagonal[k] -= factor * above[k - 1];
    slopes[k] -= factor * slopes[k - 1];
  }
  for (std::size_t k = last + 1; k-- > 0;) {
    if (k < last) slopes[k] -= above[k] * slopes[k + 1];
    slopes[k] /= diagonal[k];
  }
  return slopes;
}

Vector3 RecordedMotion::Piece::displacement_after(double s) const {
  return u + s * (v + s * (0.5 * a + s / 6.0 * jerk));
}

Vector3 RecordedMotion::Piece::velocity_after(double s) const {
  return v + s * (a + 0.5 * s * jerk);
}

bool RecordedMotion::Piece::moves() const {
  return !v.isZero(0.0) || !a.isZero(0.0) || !jerk.isZero(0.0);
}

RecordedMotion::RecordedMotion(const SupportHistory& history)
    : smooth_(history.record != MotionRecord::displacement) {
  const auto& [times, values, record] = history;
  const bool of_places = record == MotionRecord::displacement || record == MotionRecord::smooth_displacement;
  pieces_.push_back({-std::numeric_limits<double>::infinity()});
  if (of_places) pieces_.back().u = values.front();
  std::vector<Vector3> slopes;
  if (record == MotionRecord::smooth_displacement && times.size() > 1)
    slopes = spline_slopes(times, values, SplineEnds::at_rest);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const bool is_last = k + 1 == times.size();
    const double length = is_last ? 1.0 : times[k + 1] - times[k];
    const Vector3 rise = is_last ? Vector3::Zero() : Vector3(values[k + 1] - values[k]);
    Piece piece{times[k]};
    if (of_places) {
      piece.u = values[k];
      if (!slopes.empty() && !is_last) {
        const Curvature curvature = curvature_of(length, rise, slopes[k], slopes[k + 1]);
        piece.v = slopes[k];
        piece.a = curvature.start;
        piece.jerk = curvature.rate;
      } else if (slopes.empty()) {
        piece.v = rise / length;
      }
    } else {
      const Piece& before = pieces_.back();
      const double s = k == 0 ? 0.0 : times[k] - before.start;
      if (k > 0) piece.u = before.displacement_after(s);
      if (record == MotionRecord::velocity) {
        piece.v = values[k];
        piece.a = rise / length;
      } else {
        if (k > 0) piece.v = before.velocity_after(s);
        if (!is_last) piece.a = values[k];
        piece.jerk = rise / length;
      }
    }
    if (!piece.u.allFinite() || !piece.v.allFinite() || !piece.a.allFinite() || !piece.jerk.allFinite())
      throw std::domain_error("the history of a support is not finite in double precision");
    pieces_.push_back(piece);
  }
}

const RecordedMotion::Piece& RecordedMotion::piece_at(double time) const {
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time,
                                     [](double t, const Piece& piece) { return t < piece.start; });
  return *(next - 1);
}

Vector3 RecordedMotion::displacement(double time) const {
  const Piece& piece = piece_at(time);
  return piece.moves() ? piece.displacement_after(time - piece.start) : piece.u;
}

Vector3 RecordedMotion::velocity(double time) const {
  const Piece& piece = piece_at(time);
  return piece.moves() ? piece.velocity_after(time - piece.start) : Vector3::Zero();
}

Vector3 RecordedMotion::acceleration(double time) const {
  const Piece& piece = piece_at(time);
  return piece.moves() ? Vector3(piece.a + (time - piece.start) * piece.jerk) : Vector3::Zero();
}

bool RecordedMotion::changes_between(double start, double end) const {
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const double next =
        k + 1 < pieces_.size() ? pieces_[k + 1].start : std::numeric_limits<double>::infinity();
    if (pieces_[k].start < end && next > start && pieces_[k].moves()) return true;
  }
  return false;
}

std::vector<double> RecordedMotion::times() const {
  std::vector<double> result;
  for (std::size_t k = 1; k < pieces_.size(); ++k) result.push_back(pieces_[k].start);
  return result;
}

double RecordedMotion::farthest_until(double time) const {
  double farthest = displacement(time).cwiseAbs().maxCoeff();
  for (std::size_t k = 1; k < pieces_.size() && pieces_[k].start < time; ++k) {
    const double end = k + 1 < pieces_.size() ? std::min(pieces_[k + 1].start, time) : time;
    for (const double share : {0.0, 0.25, 0.5, 0.75}) {
      const Vector3 place = pieces_[k].displacement_after(share * (end - pieces_[k].start));
      farthest = std::max(farthest, place.cwiseAbs().maxCoeff());
    }
  }
  return farthest;
}

}  // namespace ashlar
