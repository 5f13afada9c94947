#include "solver/step/solve/proximal_guess.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "solver/linear/splitting.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Newton's method converges from a residual of a tenth of the largest force on a body.
constexpr SplittingLimits guess_limits{.passes = 40, .between_checks = 5, .enough = 0.1};

/// Stiffness along the normal and along tangents, N/m.
Eigen::Vector2d stiffness_of(const PointLaw& law) {
  return {law.normal_stiffness + law.dashpots.normal, law.shear_stiffness + law.dashpots.shear};
}

/// Force of a point under its law. The stiffness in shear is that of a point that does not slide.
struct LawForce {
  Vector3d force;           ///< N
  double normal_stiffness;  ///< N/m
  double shear_stiffness;
  double limit;  ///< MeanResponse::limit
};

LawForce frequent_force(const FrequentLaw& law, const Vector3d& place) {
  const PointForce at = point_force(law, place[0], place.tail<2>());
  return {at.force, at.parted ? 0.0 : law.normal_stiffness, law.shear_stiffness,
          limit_at(law, at.state, at.force[0], 0.0)};
}

/// Equilibrium of a law and a penalty spring:  F(v) - f = H (v - y).  Normal forces decrease with the gap, so that one
/// gap solves it. Shear springs are linear up to the limit set by the normal force, as long as the gap does not
/// depend on slip. Dilation is evaluated with the slip of the last pass.
/// @param law_at (place, law of the point) -> LawForce
/// @param place y. @param point its force and copy are updated
template <class LawAt, class Law>
void project_on_law(const LawAt& law_at, const Law& law, const Vector3d& place, SplitPoint& point) {
  const Vector3d &force = point.force, &penalty = point.penalty;
  Vector3d& copy = point.copy;
  const auto respond = [&](double gap) { return law_at({gap, copy[1], copy[2]}, law); };
  const auto left = [&](double x, double normal) { return penalty[0] * (x - place[0]) + force[0] - normal; };
  // The gap lies between this place and the one where the penalty spring alone balances the difference. Boost's
  // bracketed Newton throws where bonds fail in tension and no such gap exists.
  const double at_place = left(place[0], respond(place[0]).force[0]);
  auto [low, high] = std::minmax({place[0], place[0] - at_place / penalty[0]});
  double gap = std::clamp(copy[0], low, high);
  constexpr int most = 20;
  constexpr double enough = 1e-6;  // of the forces
  for (int k = 0; k < most; ++k) {
    const LawForce mean = respond(gap);
    const double rest = left(gap, mean.force[0]);
    if (!(std::abs(rest) > enough * (std::abs(force[0]) + std::abs(mean.force[0])))) break;
    (rest > 0.0 ? high : low) = gap;
    gap -= rest / (penalty[0] + mean.normal_stiffness);
    if (!(gap > low && gap < high)) gap = 0.5 * (low + high);
  }
  copy[0] = gap;
  const Vector3d there(copy[0], place[1], place[2]);
  const LawForce limited = law_at(there, law);
  Law held = law;
  held.held_limit = std::numeric_limits<double>::max();
  const LawForce locked = law_at(there, held);
  const double ratio = locked.shear_stiffness / penalty[1];
  Eigen::Vector2d shear = (locked.force.tail<2>() + ratio * force.tail<2>()) / (1.0 + ratio);
  if (const double length = shear.norm(); length > limited.limit) shear *= limited.limit / length;
  copy.tail<2>() = place.tail<2>() + (shear - force.tail<2>()) / penalty[1];
  point.force << limited.force[0], shear;
}

class PairSplitting {
 public:
  PairSplitting(IslandProblem& problem, const Residual& residual)
      : problem_(problem),
        beside_contacts_(residual.force - problem.contact_forces()),
        pairs_(problem.pairs()) {
    for (std::size_t k = 0; k < problem.bodies(); ++k) {
      const BodyStep& body = problem.body(k);
      scales_.push_back((problem.scheme().force_weight * body.in_equations(body.external_force)).norm());
    }
    parallel_for(problem.threads(), pairs_.size(), [&](std::size_t k) { pairs_[k] = split(k); });
  }

  /// Responses whose stiffnesses are the penalties.
  [[nodiscard]] std::vector<PairResponse> penalties() const {
    std::vector<PairResponse> responses(pairs_.size());
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      for (const SplitPoint& point : pairs_[k])
        responses[k].means.push_back({Vector3d::Zero(), point.penalty.asDiagonal(), {}, 0.0});
    return responses;
  }

  bool solve_bodies() {
    right_side_ = beside_contacts_;
    add_forces([this](std::size_t k, std::size_t n) { return pairs_[k][n].load(); }, right_side_);
    change_ = problem_.solver().factor->solve(right_side_, false);
    if (problem_.sums().any(!change_.allFinite())) return false;
    const std::vector<VectorXd> changes = problem_.changes(change_);
    parallel_for(problem_.threads(), pairs_.size(), [&](std::size_t k) {
      const Eigen::Matrix3Xd motion = problem_.motion(k, changes);
      for (std::size_t n = 0; n < pairs_[k].size(); ++n)
        pairs_[k][n].place = pairs_[k][n].first + motion.col(static_cast<Eigen::Index>(n));
    });
    return true;
  }
  void project_points() {
    parallel_for(problem_.threads(), pairs_.size(), [&](std::size_t k) {
      const std::span<const FrequentLaw> frequent = problem_.frequent_laws(k);
      relax_and_project(pairs_[k], [&](std::size_t n, const Vector3d& place, SplitPoint& point) {
        if (frequent.empty())
          project_on_law(
              [&](const Vector3d& there, const PointLaw& law) { return respond(k, n, there, law); },
              problem_.laws()[k][n], place, point);
        else
          project_on_law(
              [](const Vector3d& there, const FrequentLaw& law) { return frequent_force(law, there); },
              frequent[n], place, point);
      });
    });
  }
  /// Change of the guess; without bodies of this process it is empty.
  [[nodiscard]] const VectorXd& answer() const { return change_; }
  /// Residual at the places of the points under their laws: largest norm on a body over the largest force on it.
  [[nodiscard]] double residual() const {
    // A x is the right side of the last solution less the forces of the penalty springs.
    VectorXd left = beside_contacts_ - right_side_;
    add_forces([this](std::size_t k, std::size_t n) { return pairs_[k][n].resistance(); }, left);
    const std::vector<PairResponse> contacts =
        add_forces([this](std::size_t k, std::size_t n) { return force_at(k, n, pairs_[k][n].place); }, left);
    std::vector<double> scales = scales_;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const auto& [a, b] = problem_.places(k);
      for (const auto& [body, force] :
           {std::pair(a, contacts[k].force_on_a), std::pair(b, contacts[k].force_on_b)}) {
        if (body < 0) continue;
        scales[at(body)] = std::max(scales[at(body)], problem_.body(at(body)).in_equations(force).norm());
      }
    }
    double largest = 0.0;
    for (std::size_t k = 0; k < problem_.bodies(); ++k) {
      if (!problem_.sums().owns_body(k)) continue;
      const int begin = problem_.solver().matrix.offset(static_cast<int>(k));
      const double part = left.segment(begin, problem_.body(k).model->freedom()).norm();
      if (!(part <= largest * scales[k])) largest = part / scales[k];
    }
    return problem_.sums().largest(largest);
  }

 private:
  [[nodiscard]] LawForce respond(std::size_t k, std::size_t n, const Vector3d& place,
                                 const PointLaw& law) const {
    const MeanResponse mean = problem_.pair(k).respond(n, place, problem_.scheme().mean_contacts, law).mean;
    return {mean.force, mean.tangent(0, 0), mean.tangent(1, 1), mean.limit};
  }
  [[nodiscard]] Vector3d force_at(std::size_t k, std::size_t n, const Vector3d& place) const {
    const std::span<const FrequentLaw> frequent = problem_.frequent_laws(k);
    return frequent.empty() ? respond(k, n, place, problem_.laws()[k][n]).force
                            : point_force(frequent[n], place[0], place.tail<2>()).force;
  }
  [[nodiscard]] std::vector<SplitPoint> split(std::size_t k) const {
    const ContactPair& pair = problem_.pair(k);
    const std::vector<PointLaw>& laws = problem_.laws()[k];
    const auto inertia = [&](int block) {
      return problem_.block(block).model->material().density * problem_.scheme().inertia;
    };
    const auto first = pair.places(problem_.block(pair.a()).change, problem_.block(pair.b()).change);
    // Sums over points, so that penalties do not depend on their number.
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double times_mobility = 0.0;
    for (std::size_t n = 0; n < laws.size(); ++n) {
      const Eigen::Vector2d stiffness = stiffness_of(laws[n]);
      const auto row = 3 * static_cast<Eigen::Index>(n);
      sum += stiffness;
      times_mobility += stiffness[0] * pair.rows().mobility(row, 3, inertia(pair.a()), inertia(pair.b()));
    }
    // Ratio of stiffness to penalty (notes/hard_steps.md). Ties are as linear as blocks.
    constexpr double scale = 10.0;
    Eigen::Vector2d ratio = Eigen::Vector2d::Ones();
    if (!pair.tied()) ratio = (sum * times_mobility / sum[0]).cwiseSqrt() / scale;
    std::vector<SplitPoint> result(laws.size());
    for (std::size_t n = 0; n < laws.size(); ++n) {
      result[n].first = result[n].place = result[n].copy = first.col(static_cast<Eigen::Index>(n));
      const Eigen::Vector2d penalty = stiffness_of(laws[n]).cwiseQuotient(ratio);
      // Without shear stiffness a point transmits no shear force, and its copy follows it.
      const double across = penalty[1] > 0.0 ? penalty[1] : penalty[0];
      result[n].penalty << penalty[0], across, across;
      result[n].force = force_at(k, n, result[n].first);
    }
    return result;
  }

  /// Adds forces of points. @param of (pair, point) -> Vector3d, N
  template <class Force>
  std::vector<PairResponse> add_forces(const Force& of, VectorXd& sum) const {
    std::vector<PairResponse> responses(pairs_.size());
    parallel_for(problem_.threads(), pairs_.size(), [&](std::size_t k) {
      VectorXd forces(3 * pairs_[k].size());
      for (std::size_t n = 0; n < pairs_[k].size(); ++n)
        forces.segment<3>(3 * static_cast<Eigen::Index>(n)) = of(k, n);
      problem_.pair(k).rows().set_forces(forces, responses[k]);
    });
    problem_.add_contact_forces(responses, sum);
    return responses;
  }

  const IslandProblem& problem_;
  VectorXd beside_contacts_;    ///< N, in the equations
  std::vector<double> scales_;  ///< external force on each body, N
  std::vector<std::vector<SplitPoint>> pairs_;
  VectorXd right_side_, change_;  ///< of the last solution
};

}  // namespace

bool take_proximal_guess(IslandProblem& problem, IslandTangent& tangent) {
  const Residual before = problem.residual();
  Evaluation present = problem.set_aside();
  problem.predict(Predictor::at_rest);
  problem.respond();
  const std::vector<VectorXd> first_guess = problem.guess();
  PairSplitting splitting(problem, problem.residual());
  problem.set_responses(splitting.penalties());
  SplitAnswer<VectorXd> found;
  if (tangent.factorize() == FactorStatus::success)
    found = solve_by_splitting<VectorXd>(splitting, guess_limits);
  if (std::isfinite(found.residual)) {
    problem.set_guess(first_guess);
    problem.apply(found.best, 1.0);
    problem.respond();
    if (problem.residual().largest_by_force < before.largest_by_force) return true;
  }
  problem.take_back(std::move(present));
  problem.recall(before);
  return false;
}

}  // namespace ashlar
