#include "solver/limit/cone_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"

namespace ashlar {

using cone::PointIterate;
using cone::PointStep;
using Eigen::Vector3d;

namespace {

constexpr int most_iterations = 120;
/// Iterations in a row without progress that end it.
constexpr int most_stuck_crushing = 20, most_stuck_else = 5;
/// Largest error of an iterate that made progress, relative to the least one before: larger values go on longer where
/// rounding errors prevail, smaller ones end slow iterations too early.
constexpr double progress = 0.9;
/// Length of a step relative to the one that reaches the boundary of the cones: nearer to 1 is faster, and loses digits.
constexpr double to_the_boundary = 0.98;
/// Centring of a step, of the gap: least, and least after a step shorter than this share of the full one, whose end is
/// near the boundary. More centring needs more iterations, less makes the following steps short.
constexpr double least_centring = 1e-8, centring_when_short = 0.5, short_step = 0.2;
/// Share of the full step below which an iteration has stopped: smaller ones change no digits.
constexpr double least_step = 1e-9;
/// Distance of the starting forces from the boundary of the cones, of the normal force: smaller values make first steps
/// short, larger ones begin farther from the solution.
constexpr double start_inside = 0.1;
/// For `rest`, relative to the square of the loads: the error of v is its square root.
constexpr double gap_of_rest = 1e-12;
constexpr double gap_of_factor = 1e-8;
constexpr double equations = 1e-9;
constexpr double loose_equations = 1e-7;  ///< where a gap is allowed
/// Tolerances of a solved answer if rounding ends the iteration, and its largest gap: larger values call inaccurate
/// answers solved.
constexpr double loose = 1e-4, most_gap = 1e-3;
/// For `factor` and `slow`: balance is enforced by a penalty, F + G'p + a F1 = share v.
constexpr double balance_share = 1e-9;

}  // namespace

ConeIteration::ConeIteration(ConeProgram& program, const ConeQuestion& question)
    : program_(program),
      question_(question),
      grows_(!question.grows.empty()),
      slow_(question.balanced),
      weight_(grows_ || slow_ ? balance_share : 1.0),
      velocity_(question.load.size(), BodyVelocity::Zero()),
      step_v_(velocity_),
      lack_v_(velocity_),
      points_(program.points_.size()),
      steps_(points_.size()) {
  start();
  keep();
}

ConeAnswer ConeIteration::run() {
  ConeAnswer answer;
  double before = std::numeric_limits<double>::infinity();
  // Joints that crush are far from the centre at first.
  const bool crush =
      std::any_of(program_.points_.begin(), program_.points_.end(),
                  [](const ConePoint& point) { return point.strength.shear() && point.strength.crushes(); });
  const int most_stuck = crush ? most_stuck_crushing : most_stuck_else;
  int stuck = 0;
  double length = 1.0;
  for (answer.iterations = 0; answer.iterations < most_iterations; ++answer.iterations) {
    note_equations();
    if (done(1.0)) {
      keep();
      break;
    }
    const double measure = std::max(gap_ / (gap_allowed() * gap_scale_), equations_ / equations_allowed());
    stuck = measure > progress * before ? stuck + 1 : 0;
    if (!std::isfinite(measure)) break;
    if (measure <= before) keep();
    before = std::min(before, measure);
    if (stuck >= most_stuck) break;
    if (!factorize()) break;
    direction(0.0);
    const double ahead = this->length(1.0);
    const double left = std::max(gap_after(ahead), 0.0) / std::max(gap_, std::numeric_limits<double>::min());
    // After a shortened step the iterate is near the boundary: return to the centre first.
    const bool centres = length < short_step;
    direction(std::clamp(left * left * left, centres ? centring_when_short : least_centring, 1.0), !centres);
    length = this->length(to_the_boundary);
    if (!(length > least_step)) break;
    advance(length);
  }
  take_back();
  note_equations();
  answer.status = done(loose / equations) ? ConeStatus::solved : ConeStatus::inaccurate;
  finish(answer);
  return answer;
}

void ConeIteration::keep() {
  best_ = {velocity_, points_, factor_, slack_, slack_dual_};
}

void ConeIteration::take_back() {
  velocity_ = best_.velocity;
  points_ = best_.points;
  factor_ = best_.factor;
  slack_ = best_.slack;
  slack_dual_ = best_.slack_dual;
}

Eigen::Vector3d ConeIteration::times(const ConePoint& point, const ConePair& pair,
                                     const std::vector<BodyVelocity>& v) {
  Vector3d y = Vector3d::Zero();
  if (pair.bodies[0] >= 0) y += point.first * v[at(pair.bodies[0])];
  if (pair.bodies[1] >= 0) y -= point.second * v[at(pair.bodies[1])];
  return y;
}

void ConeIteration::start() {
  double largest = 0.0;
  for (std::size_t b = 0; b < velocity_.size(); ++b) {
    load_square_ += question_.load[b].squaredNorm();
    largest = std::max(largest, question_.load[b].norm());
    if (grows_) largest = std::max(largest, question_.grows[b].norm());
  }
  load_scale_ = std::max(largest, std::numeric_limits<double>::min());
  gap_scale_ = grows_ ? 1.0 : std::max(load_square_, std::numeric_limits<double>::min());
  if (slow_) gap_scale_ = load_scale_;
  const double force = load_scale_, velocity = velocity_scale();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const ConeStrength& s = strength(k);
    PointIterate& i = points_[k];
    i.p[0] = force;
    if (s.shear()) {
      i.x = Vector3d(s.friction * force + s.cohesion + start_inside * force, 0.0, 0.0);
      i.z = Vector3d(velocity, 0.0, 0.0);
    }
    if (s.cut_off()) {
      i.xc = force + s.tension;
      i.zc = velocity;
    }
    if (s.crushes() || !std::isfinite(s.tension)) start_bounded(s, i);
    bounds_ +=
        static_cast<double>(s.shear()) + static_cast<double>(s.cut_off()) + static_cast<double>(s.crushes());
  }
  if (grows_) {
    slack_ = question_.most;
    slack_dual_ = 1.0;
    bounds_ += 1.0;
  }
}

void ConeIteration::start_bounded(const ConeStrength& s, PointIterate& i) const {
  const double force = load_scale_;
  // A joint that crushes is far stronger than its force, or not.
  const bool joint = s.shear() && std::isfinite(s.tension) && s.crushes();
  i.p[0] = joint                        ? std::min(force, 0.5 * (s.compression - s.tension))
           : s.cut_off() && s.crushes() ? 0.5 * (s.compression - s.tension)
           : s.crushes()                ? s.compression - force
           : s.cut_off()                ? force - s.tension
                                        : 0.0;
  if (joint) i.x[0] = s.friction * i.p[0] + s.cohesion + start_inside * std::abs(i.p[0]);
  i.xc = s.cut_off() ? s.tension + i.p[0] : 1.0;
  i.xm = s.crushes() ? s.compression - i.p[0] : 1.0;
  i.zc = i.zm = velocity_scale();
}

void ConeIteration::note_equations() {
  each_pair([&](const ConePair& pair, std::size_t k) {
    const ConeStrength& s = strength(k);
    const PointIterate& i = points_[k];
    PointStep& d = steps_[k];
    d.lack_y = times(program_.points_[k], pair, velocity_);
    if (!question_.shift.empty()) d.lack_y[0] += question_.shift[k];
    if (s.shear()) {
      d.lack_x = Vector3d(s.friction * i.p[0] + s.cohesion, i.p[1], i.p[2]) - i.x;
      d.lack_y -= Vector3d(s.friction * i.z[0], i.z[1], i.z[2]);
    } else {
      d.lack_y.tail<2>().setZero();
    }
    if (s.cut_off()) {
      d.lack_xc = i.p[0] + s.tension - i.xc;
      d.lack_y[0] -= i.zc;
    }
    if (s.crushes()) {
      d.lack_xm = s.compression - i.p[0] - i.xm;
      d.lack_y[0] += i.zm;
    }
  });
  each_body([&](std::size_t b) {
    lack_v_[b] = weight_ * velocity_[b] - question_.load[b] -
                 gathered(b, [&](std::size_t k) -> const Vector3d& { return points_[k].p; });
    if (grows_) lack_v_[b] -= factor_ * question_.grows[b];
  });
  gap_ = gap_after(0.0);
  double worst_v = 0.0, worst_x = 0.0, worst_y = 0.0, largest_p = 0.0, largest_z = 0.0;
  for (const BodyVelocity& lack : lack_v_) worst_v = std::max(worst_v, lack.norm());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const ConeStrength& s = strength(k);
    worst_y = std::max(worst_y, steps_[k].lack_y.norm());
    largest_p = std::max(largest_p, points_[k].p.norm());
    if (s.shear()) {
      worst_x = std::max(worst_x, steps_[k].lack_x.norm());
      largest_z = std::max(largest_z, points_[k].z.norm());
    }
    if (s.cut_off()) {
      worst_x = std::max(worst_x, std::abs(steps_[k].lack_xc));
      largest_z = std::max(largest_z, points_[k].zc);
    }
    if (s.crushes()) {
      worst_x = std::max(worst_x, std::abs(steps_[k].lack_xm));
      largest_z = std::max(largest_z, points_[k].zm);
    }
  }
  double largest_v = 0.0;
  for (const BodyVelocity& v : velocity_) largest_v = std::max(largest_v, v.norm());
  const double size_of_v = std::max(grows_ || slow_ ? largest_v : 0.0, velocity_scale());
  equations_ = std::max({worst_v / load_scale_, worst_x / std::max(load_scale_, largest_p),
                         worst_y / std::max(size_of_v, largest_z)});
  if (grows_) {
    lack_growth_ = slack_dual_ - 1.0;
    for (std::size_t b = 0; b < velocity_.size(); ++b) lack_growth_ += question_.grows[b].dot(velocity_[b]);
    lack_slack_ = question_.most - factor_ - slack_;
    equations_ = std::max({equations_, std::abs(lack_growth_), std::abs(lack_slack_) / question_.most});
    gap_scale_ = std::max(1.0, std::abs(factor_));
  }
}

double ConeIteration::gap_allowed() const {
  return grows_ || slow_ ? gap_of_factor : std::max(gap_of_rest, question_.gap);
}

double ConeIteration::equations_allowed() const {
  return question_.gap > gap_of_rest ? loose_equations : equations;
}

double ConeIteration::velocity_scale() const {
  return grows_ || slow_ ? 1.0 : load_scale_;
}

bool ConeIteration::done(double looser) const {
  return gap_ <= std::min(most_gap, looser * gap_allowed()) * gap_scale_ &&
         equations_ <= looser * equations_allowed();
}

double ConeIteration::gap_after(double step) const {
  double gap = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const ConeStrength& s = strength(k);
    const PointIterate& i = points_[k];
    const PointStep& d = steps_[k];
    if (step == 0.0) {
      if (s.shear()) gap += i.x.dot(i.z);
      if (s.cut_off()) gap += i.xc * i.zc;
      if (s.crushes()) gap += i.xm * i.zm;
    } else {
      if (s.shear()) gap += (i.x + step * d.dx).dot(i.z + step * d.dz);
      if (s.cut_off()) gap += (i.xc + step * d.dxc) * (i.zc + step * d.dzc);
      if (s.crushes()) gap += (i.xm + step * d.dxm) * (i.zm + step * d.dzm);
    }
  }
  if (grows_) gap += (slack_ + step * step_slack_) * (slack_dual_ + step * step_dual_);
  return gap;
}

void ConeIteration::finish(ConeAnswer& answer) const {
  answer.velocity = velocity_;
  answer.force.reserve(points_.size());
  answer.opening.reserve(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const ConeStrength& s = strength(k);
    answer.force.push_back(points_[k].p);
    answer.opening.emplace_back(s.shear() ? points_[k].z[0] : 0.0, s.cut_off() ? points_[k].zc : 0.0,
                                s.crushes() ? points_[k].zm : 0.0);
  }
  answer.factor = factor_;
  answer.gap = gap_;
  for (const BodyVelocity& lack : lack_v_)
    answer.residual = std::max(answer.residual, lack.norm() / load_scale_);
}

}  // namespace ashlar
