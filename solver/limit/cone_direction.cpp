#include <algorithm>
#include <cmath>

#include "geometry/index.hpp"
#include "solver/limit/cone_iteration.hpp"

namespace ashlar {

using cone::longest_way;
using cone::PointIterate;
using cone::PointStep;
using cone::Scaling;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Compliance of points in a step: forces that balance does not determine would make the matrix as stiff as they are
/// free. Its contribution to the equations of a step vanishes as steps become small.
constexpr double compliance = 1e-9;
/// Stiffness of a bar without bounds along its axis, relative to the scales of the programme: the least that can be
/// inverted. Smaller values overflow, larger ones resist a motion without bounds.
constexpr double least_cut = 1e-100;
/// Rounding error of a sum of stiffnesses, relative to the largest one: the least diagonal of the matrix. With smaller
/// values a body without resistance has no factor, larger ones change the direction of a step.
constexpr double rounding_of_sum = 1e-15;

double scalar_w2(const PointIterate& i) {
  return i.zc / i.xc;
}
double crushing_w2(const PointIterate& i) {
  return i.zm / i.xm;
}

/// Stiffness along N by the bounds of N. That of a bar without bounds is limited by the compliance of the step.
double cut_of(const ConeStrength& s, const PointIterate& i) {
  const double cut = (s.cut_off() ? scalar_w2(i) : 0.0) + (s.crushes() ? crushing_w2(i) : 0.0);
  return s.friction == 0.0 ? std::max(cut, least_cut) : cut;
}

/// H^-1 without cancellation: H = E' W^-2 E + cut along N, E = diag(mu, 1, 1).
Matrix3d inverse_of(const ConeStrength& strength, const Scaling& w, double cut) {
  Matrix3d inverse = Matrix3d::Zero();
  if (!strength.shear()) {
    inverse(0, 0) = 1.0 / cut;
  } else if (strength.friction > 0.0) {
    inverse = w.forth * w.forth;
    inverse.row(0) /= strength.friction;
    inverse.col(0) /= strength.friction;
    const Vector3d along = inverse.col(0);
    // The bound of tension removes the part along N: by a factor, as a difference would lose digits.
    const double less = 1.0 / (1.0 + cut * along[0]);
    inverse.row(0) = less * along.transpose();
    inverse.col(0) = less * along;
    inverse.bottomRightCorner<2, 2>() -= cut * less * along.tail<2>() * along.tail<2>().transpose();
  } else {
    // The cone's axis is independent of the force.
    const Matrix3d m = w.back * w.back;
    inverse(0, 0) = 1.0 / cut;
    inverse.bottomRightCorner<2, 2>() = m.bottomRightCorner<2, 2>().inverse();
  }
  return inverse;
}

/// E'^-1 y; the first component is meaningless without friction.
Vector3d divided(const ConeStrength& strength, const Vector3d& y) {
  return {strength.friction > 0.0 ? y[0] / strength.friction : 0.0, y[1], y[2]};
}

}  // namespace

bool ConeIteration::factorize() {
  each_pair([&](const ConePair&, std::size_t k) {
    const ConeStrength& s = strength(k);
    const PointIterate& i = points_[k];
    PointStep& d = steps_[k];
    if (s.shear()) {
      d.w = cone::scaling_of(i.x, i.z);
      d.lambda = d.w.forth * i.z;
    }
    const Matrix3d stiff = inverse_of(s, d.w, cut_of(s, i));
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
  // Lower bound by the rounding error of the sum.
  const double ground = std::max(weight_, rounding_of_sum * largest);
  for (std::size_t b = 0; b < velocity_.size(); ++b) matrix.add_to_diagonal(static_cast<int>(b), ground);
  if (program_.factor_.factorize(matrix.matrix()) != FactorStatus::success) return false;
  if (grows_) along_ = solved(question_.grows);
  return true;
}

std::vector<BodyVelocity> ConeIteration::solved(const std::vector<BodyVelocity>& right) {
  const BlockMatrix& matrix = program_.matrix_;
  Eigen::VectorXd b(matrix.matrix().size);
  for (std::size_t k = 0; k < right.size(); ++k)
    b.segment(matrix.offset(static_cast<int>(k)), program_.freedom_[k]) = right[k].head(program_.freedom_[k]);
  const Eigen::VectorXd x = program_.factor_.solve(b);
  std::vector<BodyVelocity> result(right.size(), BodyVelocity::Zero());
  for (std::size_t k = 0; k < right.size(); ++k)
    result[k].head(program_.freedom_[k]) =
        x.segment(matrix.offset(static_cast<int>(k)), program_.freedom_[k]);
  return result;
}

void ConeIteration::direction(double centring, bool corrected) {
  const double target = centring * gap_ / bounds_;
  each_pair([&](const ConePair&, std::size_t k) { note_right_side(k, target, corrected); });
  std::vector<BodyVelocity> right(velocity_.size());
  each_body([&](std::size_t b) {
    right[b] = -lack_v_[b] + gathered(b, [&](std::size_t k) -> const Vector3d& { return steps_[k].right; });
  });
  step_v_ = solved(right);
  if (grows_) note_growth(target, corrected);
  each_pair([&](const ConePair& pair, std::size_t k) { note_step(pair, k); });
}

void ConeIteration::note_right_side(std::size_t k, double target, bool corrected) {
  const ConeStrength& s = strength(k);
  const PointIterate& i = points_[k];
  PointStep& d = steps_[k];
  d.right = -d.lack_y;
  if (s.shear()) {
    Vector3d r = -cone::product(d.lambda, d.lambda);
    r[0] += target;
    if (corrected) r -= cone::product(d.w.back * d.dx, d.w.forth * d.dz);
    d.q = d.w.back * cone::quotient(d.lambda, r);
    const Vector3d m = d.q - d.w.back * (d.w.back * d.lack_x);
    d.right += Vector3d(s.friction * m[0], m[1], m[2]);
  }
  if (s.cut_off()) {
    d.qc = (target - i.xc * i.zc - (corrected ? d.dxc * d.dzc : 0.0)) / i.xc;
    d.right[0] += d.qc - scalar_w2(i) * d.lack_xc;
  }
  if (s.crushes()) {
    d.qm = (target - i.xm * i.zm - (corrected ? d.dxm * d.dzm : 0.0)) / i.xm;
    d.right[0] -= d.qm - crushing_w2(i) * d.lack_xm;
  }
  if (!s.shear()) d.right.tail<2>().setZero();
  d.right = d.inverse * d.right;
}

void ConeIteration::note_growth(double target, bool corrected) {
  // f1'dv + dz = -lack_growth,  dz = q - (z/x) dx,  dx = lack_slack - da
  const double w2 = slack_dual_ / slack_;
  const double q = (target - slack_ * slack_dual_ - (corrected ? step_slack_ * step_dual_ : 0.0)) / slack_;
  double have = 0.0, per = w2;
  for (std::size_t b = 0; b < step_v_.size(); ++b) {
    have += question_.grows[b].dot(step_v_[b]);
    per += question_.grows[b].dot(along_[b]);
  }
  step_factor_ = (-lack_growth_ - q + w2 * lack_slack_ - have) / per;
  for (std::size_t b = 0; b < step_v_.size(); ++b) step_v_[b] += step_factor_ * along_[b];
  step_slack_ = lack_slack_ - step_factor_;
  step_dual_ = q - w2 * step_slack_;
}

void ConeIteration::note_step(const ConePair& pair, std::size_t k) {
  const ConeStrength& s = strength(k);
  PointStep& d = steps_[k];
  const Vector3d y = times(program_.points_[k], pair, step_v_);
  // The duals follow from G dv, which keeps them feasible to rounding for any W.
  Vector3d dual = d.lack_y + y;
  if (!s.shear()) dual.tail<2>().setZero();
  d.dp = d.right - d.inverse * y;
  dual += compliance * d.dp;
  // Without friction one of the bounds of N takes its dual from G dv: the nearer one.
  const bool crushed =
      s.crushes() && s.friction == 0.0 && (!s.cut_off() || crushing_w2(points_[k]) > scalar_w2(points_[k]));
  if (s.crushes()) {
    d.dxm = d.lack_xm - d.dp[0];
    if (!crushed) {
      d.dzm = d.qm - crushing_w2(points_[k]) * d.dxm;
      dual[0] += d.dzm;
    }
  }
  if (s.cut_off()) {
    d.dxc = d.lack_xc + d.dp[0];
    d.dzc = s.friction > 0.0 || crushed ? d.qc - scalar_w2(points_[k]) * d.dxc : dual[0];
    dual[0] -= d.dzc;
  }
  if (crushed) d.dzm = -dual[0];
  if (s.shear()) {
    d.dx = d.lack_x + Vector3d(s.friction * d.dp[0], d.dp[1], d.dp[2]);
    d.dz = divided(s, dual);
    if (s.friction == 0.0) d.dz[0] = d.q[0] - (d.w.back * (d.w.back * d.dx))[0];
  }
}

double ConeIteration::length(double share) const {
  double longest = cone::longest_step;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const ConeStrength& s = strength(k);
    const PointIterate& i = points_[k];
    const PointStep& d = steps_[k];
    if (s.shear()) longest = std::min({longest, longest_way(i.x, d.dx), longest_way(i.z, d.dz)});
    if (s.cut_off()) longest = std::min({longest, longest_way(i.xc, d.dxc), longest_way(i.zc, d.dzc)});
    if (s.crushes()) longest = std::min({longest, longest_way(i.xm, d.dxm), longest_way(i.zm, d.dzm)});
  }
  if (grows_)
    longest = std::min({longest, longest_way(slack_, step_slack_), longest_way(slack_dual_, step_dual_)});
  return std::min(1.0, share * longest);
}

void ConeIteration::advance(double step) {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const ConeStrength& s = strength(k);
    PointIterate& i = points_[k];
    const PointStep& d = steps_[k];
    i.p += step * d.dp;
    if (s.shear()) {
      i.x += step * d.dx;
      i.z += step * d.dz;
    }
    if (s.cut_off()) {
      i.xc += step * d.dxc;
      i.zc += step * d.dzc;
    }
    if (s.crushes()) {
      i.xm += step * d.dxm;
      i.zm += step * d.dzm;
    }
  }
  for (std::size_t b = 0; b < velocity_.size(); ++b) velocity_[b] += step * step_v_[b];
  if (grows_) {
    factor_ += step * step_factor_;
    slack_ += step * step_slack_;
    slack_dual_ += step * step_dual_;
  }
}

}  // namespace ashlar
