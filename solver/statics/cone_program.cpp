#include "solver/statics/cone_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int most_iterations = 120;
constexpr double to_the_boundary = 0.98;
/// Of `rest`, over the square of the loads: v is right to the root of it.
constexpr double gap_of_rest = 1e-12;
constexpr double gap_of_factor = 1e-8;
constexpr double equations = 1e-9;
constexpr double loose_equations = 1e-7;  ///< where a gap is allowed
/// What still counts as solved where rounding ends the iteration.
constexpr double loose = 1e-4;
/// Of `factor`: balance is asked for by a penalty, F + G'p + a F1 = share v.
constexpr double balance_share = 1e-9;

/// Of points in a step: forces that balance does not tell apart would make the matrix as stiff as they are free. What it
/// adds to the equations of a step is gone once steps are small.
constexpr double compliance = 1e-9;
/// Below this number of points several threads take longer than one.
constexpr std::size_t points_worth_a_thread = 5000;

// Algebra of the cone x0 >= |x1, x2|.

double determinant(const Vector3d& x) {
  const double t = x.tail<2>().norm();
  return (x[0] - t) * (x[0] + t);
}

Vector3d product(const Vector3d& x, const Vector3d& y) {
  Vector3d r;
  r[0] = x.dot(y);
  r.tail<2>() = x[0] * y.tail<2>() + y[0] * x.tail<2>();
  return r;
}

/// r of product(x, r) = y.
Vector3d quotient(const Vector3d& x, const Vector3d& y) {
  Vector3d r;
  r[0] = (x[0] * y[0] - x.tail<2>().dot(y.tail<2>())) / determinant(x);
  r.tail<2>() = (y.tail<2>() - r[0] * x.tail<2>()) / x[0];
  return r;
}

/// Largest a <= 1e30 for which x + a d is in the cone that x is inside of.
double longest_way(const Vector3d& x, const Vector3d& d) {
  constexpr double far = 1e30;
  const double a = d[0] * d[0] - d.tail<2>().squaredNorm();
  const double b = x[0] * d[0] - x.tail<2>().dot(d.tail<2>());
  const double c = std::max(determinant(x), 0.0);
  double way = d[0] < 0.0 ? -x[0] / d[0] : far;
  const double root = b * b - a * c;
  if (root < 0.0) return way;
  const double q = -(b + (b >= 0.0 ? std::sqrt(root) : -std::sqrt(root)));
  for (const double t : {a != 0.0 ? q / a : far, q != 0.0 ? c / q : far})
    if (t > 0.0) way = std::min(way, t);
  return way;
}

double longest_way(double x, double d) {
  return d < 0.0 ? -x / d : 1e30;
}

/// W with W z = W^-1 x.
struct Scaling {
  Matrix3d forth = Matrix3d::Identity();  ///< W
  Matrix3d back = Matrix3d::Identity();   ///< W^-1
};

Scaling scaling_of(const Vector3d& x, const Vector3d& z) {
  constexpr double tiny = std::numeric_limits<double>::min();
  const double size_x = std::sqrt(std::max(determinant(x), tiny));
  const double size_z = std::sqrt(std::max(determinant(z), tiny));
  const Vector3d x1 = x / size_x;
  Vector3d z1 = z / size_z;
  const double half = std::sqrt(0.5 * (1.0 + x1.dot(z1)));
  z1.tail<2>() *= -1.0;
  const Vector3d w = (x1 + z1) / (2.0 * half);
  const double eta = std::sqrt(size_x / size_z);
  const auto matrix = [&](double sign) {
    Matrix3d m;
    m(0, 0) = w[0];
    m.block<1, 2>(0, 1) = sign * w.tail<2>().transpose();
    m.block<2, 1>(1, 0) = sign * w.tail<2>();
    m.bottomRightCorner<2, 2>() =
        Eigen::Matrix2d::Identity() + w.tail<2>() * w.tail<2>().transpose() / (1.0 + w[0]);
    return m;
  };
  return {eta * matrix(1.0), matrix(-1.0) / eta};
}

/// A point of an iterate: force, slacks of its bounds and their duals. What a point has no bound for stays 1 and has no
/// part in anything.
struct PointIterate {
  Vector3d p = Vector3d::Zero();
  Vector3d x = Vector3d::UnitX();  ///< (c + mu N, t)
  Vector3d z = Vector3d::UnitX();
  double xc = 1.0;  ///< T + N
  double zc = 1.0;
};

/// Of the equations at an iterate, and the direction.
struct PointStep {
  Scaling w;
  Vector3d lambda = Vector3d::UnitX();
  Vector3d lack_x;  ///< E p + e - x
  double lack_xc = 0.0;
  Vector3d lack_y;   ///< G v + s - E'z
  Matrix3d inverse;  ///< H^-1
  Vector3d right;    ///< b of dp = H^-1 (b - G dv)
  Vector3d q;        ///< W^-1 of what complementarity lacks
  double qc = 0.0;
  Vector3d dp, dx, dz;
  double dxc = 0.0, dzc = 0.0;
};

double scalar_w2(const PointIterate& i) {
  return i.zc / i.xc;
}

/// H^-1, without the loss of digits of an inversion: H = E' W^-2 E + cut along N, E = diag(mu, 1, 1).
Matrix3d inverse_of(const ConeStrength& strength, const Scaling& w, double cut) {
  Matrix3d inverse = Matrix3d::Zero();
  if (!strength.shear()) {
    inverse(0, 0) = 1.0 / cut;
  } else if (strength.friction > 0.0) {
    inverse = w.forth * w.forth;
    inverse.row(0) /= strength.friction;
    inverse.col(0) /= strength.friction;
    const Vector3d along = inverse.col(0);
    // The bound of tension takes away what is along N: by a factor, where a difference would lose its digits.
    const double less = 1.0 / (1.0 + cut * along[0]);
    inverse.row(0) = less * along.transpose();
    inverse.col(0) = less * along;
    inverse.bottomRightCorner<2, 2>() -= cut * less * along.tail<2>() * along.tail<2>().transpose();
  } else {
    // The cone's axis does not depend on the force.
    const Matrix3d m = w.back * w.back;
    inverse(0, 0) = 1.0 / cut;
    inverse.bottomRightCorner<2, 2>() = m.bottomRightCorner<2, 2>().inverse();
  }
  return inverse;
}

/// E'^-1 y, where the first component is of no meaning without friction.
Vector3d divided(const ConeStrength& strength, const Vector3d& y) {
  return {strength.friction > 0.0 ? y[0] / strength.friction : 0.0, y[1], y[2]};
}

}  // namespace

/// One question on its way to an answer.
class ConeIteration {
 public:
  ConeIteration(ConeProgram& program, const ConeQuestion& question)
      : program_(program),
        question_(question),
        grows_(!question.grows.empty()),
        weight_(grows_ ? balance_share : 1.0),
        velocity_(question.load.size(), BodyVelocity::Zero()),
        step_v_(velocity_),
        lack_v_(velocity_),
        points_(program.points_.size()),
        steps_(points_.size()) {
    start();
    keep();
  }

  ConeAnswer run() {
    ConeAnswer answer;
    double before = std::numeric_limits<double>::infinity();
    int stuck = 0;
    double length = 1.0;
    for (answer.iterations = 0; answer.iterations < most_iterations; ++answer.iterations) {
      note_equations();
      if (done(1.0)) {
        keep();
        break;
      }
      const double measure = std::max(gap_ / (gap_allowed() * gap_scale_), equations_ / equations_allowed());
      stuck = measure > 0.9 * before ? stuck + 1 : 0;
      if (!std::isfinite(measure)) break;
      if (measure <= before) keep();
      before = std::min(before, measure);
      if (stuck >= 5) break;
      if (!factorize()) break;
      direction(0.0);
      const double ahead = this->length(1.0);
      const double left =
          std::max(gap_after(ahead), 0.0) / std::max(gap_, std::numeric_limits<double>::min());
      // A step that was cut short has left the iterate near the boundary: back to the middle first.
      const bool centres = length < 0.2;
      direction(std::clamp(std::pow(left, 3), centres ? 0.5 : 1e-8, 1.0), !centres);
      length = this->length(to_the_boundary);
      if (!(length > 1e-9)) break;
      advance(length);
    }
    take_back();
    note_equations();
    answer.status = done(loose / equations) ? ConeStatus::solved : ConeStatus::inaccurate;
    finish(answer);
    return answer;
  }

 private:
  /// The best iterate so far.
  void keep() { best_ = {velocity_, points_, factor_, slack_, slack_dual_}; }
  void take_back() {
    velocity_ = best_.velocity;
    points_ = best_.points;
    factor_ = best_.factor;
    slack_ = best_.slack;
    slack_dual_ = best_.slack_dual;
  }

  [[nodiscard]] const ConeStrength& strength(std::size_t k) const { return program_.points_[k].strength; }

  template <class Work>
  void each_pair(const Work& work) const {
    parallel_for(program_.threads_, program_.pairs_.size(), [&](std::size_t n) {
      const ConePair& pair = program_.pairs_[n];
      for (std::size_t k = pair.begin; k < pair.end; ++k) work(pair, k);
    });
  }
  template <class Work>
  void each_body(const Work& work) const {
    parallel_for(program_.threads_, program_.freedom_.size(), work);
  }

  static Vector3d times(const ConePoint& point, const ConePair& pair, const std::vector<BodyVelocity>& v) {
    Vector3d y = Vector3d::Zero();
    if (pair.bodies[0] >= 0) y += point.first * v[at(pair.bodies[0])];
    if (pair.bodies[1] >= 0) y -= point.second * v[at(pair.bodies[1])];
    return y;
  }

  /// Sum of G' f at a body. @param f of a point
  template <class Force>
  [[nodiscard]] BodyVelocity gathered(std::size_t body, const Force& f) const {
    BodyVelocity sum = BodyVelocity::Zero();
    for (const auto& [pair, side] : program_.pairs_of_body_[body]) {
      const ConePair& of = program_.pairs_[pair];
      for (std::size_t k = of.begin; k < of.end; ++k) {
        const ConePoint& point = program_.points_[k];
        if (side == 0) {
          sum.noalias() += point.first.transpose() * f(k);
        } else {
          sum.noalias() -= point.second.transpose() * f(k);
        }
      }
    }
    return sum;
  }

  void start() {
    double largest = 0.0;
    for (std::size_t b = 0; b < velocity_.size(); ++b) {
      load_square_ += question_.load[b].squaredNorm();
      largest = std::max(largest, question_.load[b].norm());
      if (grows_) largest = std::max(largest, question_.grows[b].norm());
    }
    load_scale_ = std::max(largest, std::numeric_limits<double>::min());
    gap_scale_ = grows_ ? 1.0 : std::max(load_square_, std::numeric_limits<double>::min());
    const double force = load_scale_;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const ConeStrength& s = strength(k);
      PointIterate& i = points_[k];
      i.p[0] = force;
      if (s.shear()) {
        i.x = Vector3d(s.friction * force + s.cohesion + 0.1 * force, 0.0, 0.0);
        i.z = Vector3d(grows_ ? 1.0 : force, 0.0, 0.0);
      }
      if (s.cut_off()) {
        i.xc = force + s.tension;
        i.zc = grows_ ? 1.0 : force;
      }
      bounds_ += static_cast<double>(s.shear()) + static_cast<double>(s.cut_off());
    }
    if (grows_) {
      slack_ = question_.most;
      slack_dual_ = 1.0 / question_.most;
      bounds_ += 1.0;
    }
  }

  void note_equations() {
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
    }
    double largest_v = 0.0;
    for (const BodyVelocity& v : velocity_) largest_v = std::max(largest_v, v.norm());
    const double velocity_scale = grows_ ? std::max(1.0, largest_v) : load_scale_;
    equations_ = std::max({worst_v / load_scale_, worst_x / std::max(load_scale_, largest_p),
                           worst_y / std::max(velocity_scale, largest_z)});
    if (grows_) {
      lack_growth_ = slack_dual_ - 1.0;
      for (std::size_t b = 0; b < velocity_.size(); ++b) lack_growth_ += question_.grows[b].dot(velocity_[b]);
      lack_slack_ = question_.most - factor_ - slack_;
      equations_ = std::max({equations_, std::abs(lack_growth_), std::abs(lack_slack_) / question_.most});
      gap_scale_ = std::max(1.0, std::abs(factor_));
    }
  }

  [[nodiscard]] double gap_allowed() const {
    return grows_ ? gap_of_factor : std::max(gap_of_rest, question_.gap);
  }
  [[nodiscard]] double equations_allowed() const {
    return question_.gap > gap_of_rest ? loose_equations : equations;
  }
  [[nodiscard]] bool done(double looser) const {
    return gap_ <= std::min(1e-3, looser * gap_allowed()) * gap_scale_ &&
           equations_ <= looser * equations_allowed();
  }

  bool factorize() {
    each_pair([&](const ConePair&, std::size_t k) {
      const ConeStrength& s = strength(k);
      const PointIterate& i = points_[k];
      PointStep& d = steps_[k];
      if (s.shear()) {
        d.w = scaling_of(i.x, i.z);
        d.lambda = d.w.forth * i.z;
      }
      const Matrix3d stiff = inverse_of(s, d.w, s.cut_off() ? scalar_w2(i) : 0.0);
      d.inverse = (Matrix3d::Identity() + compliance * stiff).inverse() * stiff;
      d.inverse = 0.5 * (d.inverse + d.inverse.transpose()).eval();
    });
    struct Blocks {
      Eigen::Matrix<double, 6, 6> first, second, both;
    };
    std::vector<Blocks> blocks(program_.pairs_.size());
    parallel_for(program_.threads_, blocks.size(), [&](std::size_t n) {
      const ConePair& pair = program_.pairs_[n];
      Blocks& sum = blocks[n];
      sum.first.setZero();
      sum.second.setZero();
      sum.both.setZero();
      for (std::size_t k = pair.begin; k < pair.end; ++k) {
        const ConePoint& point = program_.points_[k];
        const ConeRows a = steps_[k].inverse * point.first;
        const ConeRows b = steps_[k].inverse * point.second;
        sum.first.noalias() += point.first.transpose() * a;
        sum.second.noalias() += point.second.transpose() * b;
        sum.both.noalias() -= point.first.transpose() * b;
      }
    });
    BlockMatrix& matrix = program_.matrix_;
    matrix.set_zero();
    double largest = 0.0;
    for (std::size_t n = 0; n < blocks.size(); ++n) {
      const auto [a, b] = program_.pairs_[n].bodies;
      const auto size = [&](int body) { return program_.freedom_[at(body)]; };
      if (a >= 0) matrix.add_diagonal(a, blocks[n].first.topLeftCorner(size(a), size(a)));
      if (b >= 0) matrix.add_diagonal(b, blocks[n].second.topLeftCorner(size(b), size(b)));
      if (a >= 0 && b >= 0) {
        if (a < b) {
          matrix.add_pair(a, b, blocks[n].both.topLeftCorner(size(a), size(b)));
        } else {
          matrix.add_pair(b, a, blocks[n].both.topLeftCorner(size(a), size(b)).transpose());
        }
      }
      largest =
          std::max({largest, blocks[n].first.diagonal().maxCoeff(), blocks[n].second.diagonal().maxCoeff()});
    }
    // Rounding of the sum is no less than this.
    const double ground = std::max(weight_, 1e-15 * largest);
    for (std::size_t b = 0; b < velocity_.size(); ++b) matrix.add_to_diagonal(static_cast<int>(b), ground);
    if (program_.factor_.factorize(matrix.matrix()) != FactorStatus::success) return false;
    if (grows_) along_ = solved(question_.grows);
    return true;
  }

  [[nodiscard]] std::vector<BodyVelocity> solved(const std::vector<BodyVelocity>& right) {
    const BlockMatrix& matrix = program_.matrix_;
    Eigen::VectorXd b(matrix.matrix().size);
    for (std::size_t k = 0; k < right.size(); ++k)
      b.segment(matrix.offset(static_cast<int>(k)), program_.freedom_[k]) =
          right[k].head(program_.freedom_[k]);
    const Eigen::VectorXd x = program_.factor_.solve(b);
    std::vector<BodyVelocity> result(right.size(), BodyVelocity::Zero());
    for (std::size_t k = 0; k < right.size(); ++k)
      result[k].head(program_.freedom_[k]) =
          x.segment(matrix.offset(static_cast<int>(k)), program_.freedom_[k]);
    return result;
  }

  /// The direction that takes complementarity to `centring` of what it is. @param corrected by the last direction
  void direction(double centring, bool corrected = false) {
    const double target = centring * gap_ / bounds_;
    each_pair([&](const ConePair&, std::size_t k) {
      const ConeStrength& s = strength(k);
      const PointIterate& i = points_[k];
      PointStep& d = steps_[k];
      d.right = -d.lack_y;
      if (s.shear()) {
        Vector3d r = -product(d.lambda, d.lambda);
        r[0] += target;
        if (corrected) r -= product(d.w.back * d.dx, d.w.forth * d.dz);
        d.q = d.w.back * quotient(d.lambda, r);
        const Vector3d m = d.q - d.w.back * (d.w.back * d.lack_x);
        d.right += Vector3d(s.friction * m[0], m[1], m[2]);
      }
      if (s.cut_off()) {
        d.qc = (target - i.xc * i.zc - (corrected ? d.dxc * d.dzc : 0.0)) / i.xc;
        d.right[0] += d.qc - scalar_w2(i) * d.lack_xc;
      }
      if (!s.shear()) d.right.tail<2>().setZero();
      d.right = d.inverse * d.right;
    });
    std::vector<BodyVelocity> right(velocity_.size());
    each_body([&](std::size_t b) {
      right[b] = -lack_v_[b] + gathered(b, [&](std::size_t k) -> const Vector3d& { return steps_[k].right; });
    });
    step_v_ = solved(right);
    if (grows_) {
      // f1'dv + dz = -lack_growth,  dz = q - (z/x) dx,  dx = lack_slack - da
      const double w2 = slack_dual_ / slack_;
      const double q =
          (target - slack_ * slack_dual_ - (corrected ? step_slack_ * step_dual_ : 0.0)) / slack_;
      double have = 0.0, per = w2;
      for (std::size_t b = 0; b < right.size(); ++b) {
        have += question_.grows[b].dot(step_v_[b]);
        per += question_.grows[b].dot(along_[b]);
      }
      step_factor_ = (-lack_growth_ - q + w2 * lack_slack_ - have) / per;
      for (std::size_t b = 0; b < right.size(); ++b) step_v_[b] += step_factor_ * along_[b];
      step_slack_ = lack_slack_ - step_factor_;
      step_dual_ = q - w2 * step_slack_;
    }
    each_pair([&](const ConePair& pair, std::size_t k) {
      const ConeStrength& s = strength(k);
      PointStep& d = steps_[k];
      const Vector3d y = times(program_.points_[k], pair, step_v_);
      // The duals follow from G dv, which keeps them feasible to rounding whatever W is.
      Vector3d dual = d.lack_y + y;
      if (!s.shear()) dual.tail<2>().setZero();
      d.dp = d.right - d.inverse * y;
      dual += compliance * d.dp;
      if (s.cut_off()) {
        d.dxc = d.lack_xc + d.dp[0];
        d.dzc = s.friction > 0.0 ? d.qc - scalar_w2(points_[k]) * d.dxc : dual[0];
        dual[0] -= d.dzc;
      }
      if (s.shear()) {
        d.dx = d.lack_x + Vector3d(s.friction * d.dp[0], d.dp[1], d.dp[2]);
        d.dz = divided(s, dual);
        if (s.friction == 0.0) d.dz[0] = d.q[0] - (d.w.back * (d.w.back * d.dx))[0];
      }
    });
  }

  [[nodiscard]] double length(double share) const {
    double way = 1e30;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const ConeStrength& s = strength(k);
      const PointIterate& i = points_[k];
      const PointStep& d = steps_[k];
      if (s.shear()) way = std::min({way, longest_way(i.x, d.dx), longest_way(i.z, d.dz)});
      if (s.cut_off()) way = std::min({way, longest_way(i.xc, d.dxc), longest_way(i.zc, d.dzc)});
    }
    if (grows_) way = std::min({way, longest_way(slack_, step_slack_), longest_way(slack_dual_, step_dual_)});
    return std::min(1.0, share * way);
  }

  /// Complementarity after a part of the direction.
  [[nodiscard]] double gap_after(double way) const {
    double gap = 0.0;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const ConeStrength& s = strength(k);
      const PointIterate& i = points_[k];
      const PointStep& d = steps_[k];
      if (way == 0.0) {
        if (s.shear()) gap += i.x.dot(i.z);
        if (s.cut_off()) gap += i.xc * i.zc;
      } else {
        if (s.shear()) gap += (i.x + way * d.dx).dot(i.z + way * d.dz);
        if (s.cut_off()) gap += (i.xc + way * d.dxc) * (i.zc + way * d.dzc);
      }
    }
    if (grows_) gap += (slack_ + way * step_slack_) * (slack_dual_ + way * step_dual_);
    return gap;
  }

  void advance(double way) {
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const ConeStrength& s = strength(k);
      PointIterate& i = points_[k];
      const PointStep& d = steps_[k];
      i.p += way * d.dp;
      if (s.shear()) {
        i.x += way * d.dx;
        i.z += way * d.dz;
      }
      if (s.cut_off()) {
        i.xc += way * d.dxc;
        i.zc += way * d.dzc;
      }
    }
    for (std::size_t b = 0; b < velocity_.size(); ++b) velocity_[b] += way * step_v_[b];
    if (grows_) {
      factor_ += way * step_factor_;
      slack_ += way * step_slack_;
      slack_dual_ += way * step_dual_;
    }
  }

  void finish(ConeAnswer& answer) const {
    answer.velocity = velocity_;
    answer.force.reserve(points_.size());
    answer.opening.reserve(points_.size());
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const ConeStrength& s = strength(k);
      answer.force.push_back(points_[k].p);
      answer.opening.emplace_back(s.shear() ? points_[k].z[0] : 0.0, s.cut_off() ? points_[k].zc : 0.0);
    }
    answer.factor = factor_;
    answer.gap = gap_;
    for (const BodyVelocity& lack : lack_v_)
      answer.lacking = std::max(answer.lacking, lack.norm() / load_scale_);
  }

  ConeProgram& program_;
  const ConeQuestion& question_;
  bool grows_;
  double weight_;  ///< of v in the balance of bodies
  double load_square_ = 0.0;
  double load_scale_ = 0.0;
  double bounds_ = 0.0;
  std::vector<BodyVelocity> velocity_, step_v_, lack_v_, along_;
  std::vector<PointIterate> points_;
  std::vector<PointStep> steps_;
  struct Kept {
    std::vector<BodyVelocity> velocity;
    std::vector<PointIterate> points;
    double factor, slack, slack_dual;
  };
  Kept best_;
  double factor_ = 0.0, step_factor_ = 0.0;
  double slack_ = 0.0, slack_dual_ = 0.0, step_slack_ = 0.0, step_dual_ = 0.0;
  double lack_growth_ = 0.0, lack_slack_ = 0.0;
  double gap_ = 0.0, gap_scale_ = 1.0, equations_ = 0.0;
};

ConeProgram::ConeProgram(std::vector<int> freedom, std::vector<ConePair> pairs, std::vector<ConePoint> points,
                         int threads)
    : freedom_(std::move(freedom)),
      pairs_(std::move(pairs)),
      points_(std::move(points)),
      pairs_of_body_(freedom_.size()),
      threads_(points_.size() < points_worth_a_thread ? 1 : threads),
      matrix_(freedom_, moving_pairs()) {
  for (std::size_t n = 0; n < pairs_.size(); ++n)
    for (const std::size_t side : {0U, 1U})
      if (pairs_[n].bodies[side] >= 0) pairs_of_body_[at(pairs_[n].bodies[side])].push_back({n, side});
}

std::vector<std::array<int, 2>> ConeProgram::moving_pairs() const {
  std::vector<std::array<int, 2>> moving;
  for (const ConePair& pair : pairs_) {
    const auto [a, b] = std::minmax(pair.bodies[0], pair.bodies[1]);
    if (a >= 0) moving.push_back({a, b});
  }
  return moving;
}

ConeAnswer ConeProgram::solve(const ConeQuestion& question) {
  return ConeIteration(*this, question).run();
}

Eigen::Vector3d ConeProgram::relative(std::size_t pair, std::size_t point,
                                      const std::vector<BodyVelocity>& velocity) const {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  const auto [a, b] = pairs_[pair].bodies;
  if (a >= 0) y += points_[point].first * velocity[at(a)];
  if (b >= 0) y -= points_[point].second * velocity[at(b)];
  return y;
}

}  // namespace ashlar
