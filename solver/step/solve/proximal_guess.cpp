#include "solver/step/solve/proximal_guess.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

constexpr double copy_relaxation = 1.6;
constexpr int passes = 40;
constexpr int passes_between_checks = 5;
/// Residual relative to the largest force on a body, from which Newton's method converges.
constexpr double near_enough = 0.1;

/// Points of a pair, (3, #points) along normals and tangents.
struct SplitPair {
  Eigen::Matrix3Xd first;    ///< places at the initial guess, m
  Eigen::Matrix3Xd places;   ///< of the blocks, m
  Eigen::Matrix3Xd copies;   ///< of the laws, m
  Eigen::Matrix3Xd forces;   ///< of the laws, N
  Eigen::Matrix3Xd penalty;  ///< N/m
};

double normal_stiffness(const PointLaw& law) {
  return law.normal_stiffness + law.dashpots.normal;
}
double shear_stiffness(const PointLaw& law) {
  return law.shear_stiffness + law.dashpots.shear;
}

/// Sums over the points of a pair, so that penalties do not depend on their number.
struct PairStiffness {
  double normal = 0.0;          ///< N/m
  double shear = 0.0;           ///< N/m
  double times_mobility = 0.0;  ///< sum over points of normal stiffness times mobility

  /// Ratio of stiffness to penalty. @param stiffness of the pair, N/m
  [[nodiscard]] double ratio(double stiffness) const {
    constexpr double scale = 10.0;  // notes/hard_steps.md
    return std::sqrt(stiffness * times_mobility / normal) / scale;
  }
};

/// Equilibrium of a law and a penalty spring:  F(v) - f = H (v - y).  Normal forces decrease with the gap, so that one
/// gap solves it. Shear springs are linear up to the limit set by the normal force, as long as the gap does not
/// depend on slip. Dilation is evaluated with the slip of the last pass.
/// @param law_at (place, law of the point) -> MeanResponse
/// @param copy v, on entry that of the last pass. @return F(v)
template <class LawAt>
Eigen::Vector3d proximal_point(const LawAt& law_at, const PointLaw& law, const Eigen::Vector3d& force,
                               const Eigen::Vector3d& penalty, const Eigen::Vector3d& place,
                               Eigen::Vector3d& copy) {
  const auto respond = [&](double gap) { return law_at({gap, copy[1], copy[2]}, law); };
  const auto left = [&](double gap, double normal) {
    return penalty[0] * (gap - place[0]) + force[0] - normal;
  };
  // The gap lies between this place and the one where the penalty spring alone balances the difference. Boost's
  // bracketed Newton throws where bonds fail in tension and no such gap exists.
  const double at_place = left(place[0], respond(place[0]).force[0]);
  auto [low, high] = std::minmax({place[0], place[0] - at_place / penalty[0]});
  double gap = std::clamp(copy[0], low, high);
  constexpr int most = 20;
  constexpr double enough = 1e-6;  // of the forces
  for (int k = 0; k < most; ++k) {
    const MeanResponse mean = respond(gap);
    const double lacks = left(gap, mean.force[0]);
    if (!(std::abs(lacks) > enough * (std::abs(force[0]) + std::abs(mean.force[0])))) break;
    (lacks > 0.0 ? high : low) = gap;
    gap -= lacks / (penalty[0] + mean.tangent(0, 0));
    if (!(gap > low && gap < high)) gap = 0.5 * (low + high);
  }
  copy[0] = gap;
  const Eigen::Vector3d there(copy[0], place[1], place[2]);
  const MeanResponse limited = law_at(there, law);
  PointLaw held = law;
  held.held_limit = std::numeric_limits<double>::max();
  const MeanResponse locked = law_at(there, held);
  const double ratio = locked.tangent(1, 1) / penalty[1];
  Eigen::Vector2d shear = (locked.force.tail<2>() + ratio * force.tail<2>()) / (1.0 + ratio);
  if (const double length = shear.norm(); length > limited.limit) shear *= limited.limit / length;
  copy.tail<2>() = place.tail<2>() + (shear - force.tail<2>()) / penalty[1];
  return {limited.force[0], shear[0], shear[1]};
}

class PairSplitting {
 public:
  PairSplitting(IslandProblem& problem, const Residual& residual)
      : problem_(problem),
        first_guess_(problem.guess()),
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
    std::vector<PairResponse> responses = problem_.responses();
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      for (std::size_t point = 0; point < responses[k].means.size(); ++point) {
        MeanResponse& mean = responses[k].means[point];
        mean.tangent = pairs_[k].penalty.col(static_cast<Eigen::Index>(point)).asDiagonal();
        mean.coupling = {};
      }
    }
    return responses;
  }

  /// Iterates with the factor of the penalties until the guess is close enough.
  void iterate() {
    for (int pass = 1; pass <= passes; ++pass) {
      Eigen::VectorXd right_side = beside_contacts_;
      problem_.add_contact_forces(on_blocks([&](std::size_t k) -> Eigen::Matrix3Xd {
                                    const SplitPair& pair = pairs_[k];
                                    return pair.forces + pair.penalty.cwiseProduct(pair.copies - pair.first);
                                  }),
                                  right_side);
      const Eigen::VectorXd change = problem_.solver().factor->solve(right_side, false);
      if (problem_.sums().any(!change.allFinite())) return;
      const std::vector<Eigen::VectorXd> changes = problem_.changes(change);
      parallel_for(problem_.threads(), pairs_.size(),
                   [&](std::size_t k) { pairs_[k].places = pairs_[k].first + problem_.motion(k, changes); });
      if (pass % passes_between_checks == 0) {
        const double left = largest_part_left(right_side);
        if (left < least_) {
          least_ = left;
          best_ = change;
        }
        if (left <= near_enough) return;
      }
      if (pass < passes) parallel_for(problem_.threads(), pairs_.size(), [&](std::size_t k) { press(k); });
    }
  }

  /// True if a change was found; without bodies of this process it is empty.
  [[nodiscard]] bool found() const { return least_ < std::numeric_limits<double>::infinity(); }
  [[nodiscard]] const Eigen::VectorXd& best() const { return best_; }
  [[nodiscard]] const std::vector<Eigen::VectorXd>& first_guess() const { return first_guess_; }

 private:
  [[nodiscard]] MeanResponse respond(std::size_t k, std::size_t point, const Eigen::Vector3d& place,
                                     const PointLaw& law) const {
    return problem_.pair(k).respond(point, place, problem_.scheme().mean_contacts, law).mean;
  }
  [[nodiscard]] MeanResponse law_at(std::size_t k, std::size_t point, const Eigen::Vector3d& place) const {
    return respond(k, point, place, problem_.laws()[k][point]);
  }

  [[nodiscard]] SplitPair split(std::size_t k) const {
    const ContactPair& pair = problem_.pair(k);
    const std::vector<PointLaw>& laws = problem_.laws()[k];
    const auto inertia = [&](int block) {
      return problem_.block(block).model->material().density * problem_.scheme().inertia;
    };
    SplitPair result;
    result.first = pair.places(problem_.block(pair.a()).change, problem_.block(pair.b()).change);
    result.places = result.copies = result.first;
    result.forces.resize(3, result.first.cols());
    result.penalty.resize(3, result.first.cols());
    PairStiffness pair_stiffness;
    for (std::size_t point = 0; point < laws.size(); ++point) {
      const auto row = 3 * static_cast<Eigen::Index>(point);
      pair_stiffness.normal += normal_stiffness(laws[point]);
      pair_stiffness.shear += shear_stiffness(laws[point]);
      pair_stiffness.times_mobility +=
          normal_stiffness(laws[point]) * pair.rows().mobility(row, 3, inertia(pair.a()), inertia(pair.b()));
    }
    for (std::size_t point = 0; point < laws.size(); ++point) {
      const auto column = static_cast<Eigen::Index>(point);
      const PointLaw& law = laws[point];
      // Ties are as linear as blocks.
      const double along =
          normal_stiffness(law) / (pair.tied() ? 1.0 : pair_stiffness.ratio(pair_stiffness.normal));
      const double across =
          shear_stiffness(law) / (pair.tied() ? 1.0 : pair_stiffness.ratio(pair_stiffness.shear));
      // Without shear stiffness a point transmits no shear force, and its copy follows it.
      result.penalty.col(column) << along, across > 0.0 ? across : along, across > 0.0 ? across : along;
      result.forces.col(column) = law_at(k, point, result.first.col(column)).force;
    }
    return result;
  }

  /// Moves points of a pair to the places given by the blocks.
  void press(std::size_t k) {
    SplitPair& pair = pairs_[k];
    for (Eigen::Index column = 0; column < pair.places.cols(); ++column) {
      const auto point = static_cast<std::size_t>(column);
      const Eigen::Vector3d place =
          copy_relaxation * pair.places.col(column) + (1.0 - copy_relaxation) * pair.copies.col(column);
      Eigen::Vector3d copy = pair.copies.col(column);
      pair.forces.col(column) = proximal_point(
          [&](const Eigen::Vector3d& there, const PointLaw& law) { return respond(k, point, there, law); },
          problem_.laws()[k][point], pair.forces.col(column), pair.penalty.col(column), place, copy);
      pair.copies.col(column) = copy;
    }
  }

  /// Forces of points on the unknowns of their blocks. @param of (pair) -> (3, #points), N
  template <class Forces>
  [[nodiscard]] std::vector<PairResponse> on_blocks(const Forces& of) const {
    std::vector<PairResponse> responses(pairs_.size());
    parallel_for(problem_.threads(), pairs_.size(),
                 [&](std::size_t k) { problem_.pair(k).rows().set_forces(of(k).reshaped(), responses[k]); });
    return responses;
  }

  /// Residual at the places of the points under their laws: largest norm on a body over the largest force on it.
  /// @param right_side of the last solution: A x is that less the forces of the penalty springs
  [[nodiscard]] double largest_part_left(const Eigen::VectorXd& right_side) const {
    Eigen::VectorXd left = beside_contacts_ - right_side;
    problem_.add_contact_forces(on_blocks([&](std::size_t k) -> Eigen::Matrix3Xd {
                                  return pairs_[k].penalty.cwiseProduct(pairs_[k].places - pairs_[k].first);
                                }),
                                left);
    const std::vector<PairResponse> contacts = on_blocks([&](std::size_t k) {
      Eigen::Matrix3Xd forces(3, pairs_[k].places.cols());
      for (Eigen::Index column = 0; column < forces.cols(); ++column)
        forces.col(column) = law_at(k, static_cast<std::size_t>(column), pairs_[k].places.col(column)).force;
      return forces;
    });
    problem_.add_contact_forces(contacts, left);
    std::vector<double> scales = scales_;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const auto& [a, b] = problem_.places(k);
      for (const auto& [body, force] :
           {std::pair(a, contacts[k].force_on_a), std::pair(b, contacts[k].force_on_b)}) {
        if (body < 0) continue;
        double& scale = scales[at(body)];
        scale = std::max(scale, problem_.body(at(body)).in_equations(force).norm());
      }
    }
    double largest = 0.0;
    for (std::size_t k = 0; k < problem_.bodies(); ++k) {
      if (!problem_.sums().owns_body(k)) continue;
      const double part = left.segment(problem_.solver().matrix.offset(static_cast<int>(k)),
                                       problem_.body(k).model->freedom())
                              .norm();
      if (!(part <= largest * scales[k])) largest = part / scales[k];
    }
    return problem_.sums().largest(largest);
  }

  const IslandProblem& problem_;
  std::vector<Eigen::VectorXd> first_guess_;
  Eigen::VectorXd beside_contacts_;  ///< N, in the equations
  std::vector<double> scales_;       ///< external force on each body, N
  std::vector<SplitPair> pairs_;
  Eigen::VectorXd best_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

bool take_proximal_guess(IslandProblem& problem, IslandTangent& tangent) {
  const Residual before = problem.residual();
  Evaluation present = problem.set_aside();
  problem.predict(Predictor::at_rest);
  problem.respond();
  PairSplitting splitting(problem, problem.residual());
  problem.set_responses(splitting.penalties());
  if (tangent.factorize() == FactorStatus::success) splitting.iterate();
  if (splitting.found()) {
    problem.set_guess(splitting.first_guess());
    problem.apply(splitting.best(), 1.0);
    problem.respond();
    if (problem.residual().largest_by_force < before.largest_by_force) return true;
  }
  problem.take_back(std::move(present));
  problem.recall(before);
  return false;
}

}  // namespace ashlar
