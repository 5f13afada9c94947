// The equations of one island within a step at a guess of the changes (time_scheme.hpp): responses, residual and
// update of the guess. island_tangent.hpp linearises and solves them.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "geometry/index.hpp"
#include "solver/step/island/contact_table.hpp"
#include "solver/step/island/island.hpp"
#include "solver/step/island/island_bolts.hpp"
#include "solver/step/island/island_sums.hpp"

namespace ashlar {

/// Residual of the equations of motion at a guess.
struct Residual {
  Eigen::VectorXd force;         ///< N, in the island's equations
  std::vector<double> relative;  ///< norm on each body over its tolerance; 0 of neighbours
  double largest = 0.0;          ///< of `relative`; <= 1: converged
  double sum = 0.0;  ///< of `relative`: decreases from guess to guess where the largest does not yet
  double largest_by_force = 0.0;  ///< largest norm on a body over the largest force on it
  std::vector<double> scales;     ///< norm of the largest force on each body, N
  [[nodiscard]] bool converged() const { return largest <= 1.0; }
};

/// Uncertainty of the contact forces on a body, N.
struct ForceErrors {
  double rounding = 0.0;
  double within_rounding = 0.0;  ///< of points that are closed only within rounding error
};

/// Contacts at a guess.
struct ContactForces {
  std::vector<PairResponse> pairs;   ///< of frequent laws without their points, until these are needed
  std::vector<ContactState> states;  ///< of points
  Eigen::Matrix3Xd places;           ///< ContactPair::places of points of frequent laws, m
  std::vector<double> in_doubt;      ///< by pair: ContactPair::force_in_doubt, N
  bool complete = false;             ///< with all points
  std::vector<char> derived;         ///< by pair: true if its derivatives are known
};

/// A guess with its responses.
struct Evaluation {
  std::vector<Eigen::VectorXd> guess;    ///< by body
  std::vector<ElasticResponse> elastic;  ///< by body
  ContactForces contacts;
  std::vector<StepBoltResponse> bolts;  ///< by bolt
};

/// Motion of a body that the iteration of a step starts from.
enum class Predictor {
  free_motion,  ///< under the external forces, without contacts
  inertial,     ///< without any force
  at_rest,      ///< no motion: a block in contact hardly moves, whichever way it vibrates
};

/// Owns the laws of the island's contact points during a step, where held bounds, failing joints and multipliers
/// change. `pairs` below counts the island's pairs, not those of the step.
class IslandProblem {
 public:
  IslandProblem(const Island& island, std::vector<BodyStep>& bodies, const std::vector<ContactPair>& pairs,
                const TimeScheme& scheme, const SimulationSettings& settings, IslandSolvers::Entry& solver,
                const IslandSums& sums = IslandSums::of_one_process());

  void predict(Predictor guess);
  /// Elastic and contact responses at the present guess.
  void respond();
  /// Sets responses other than those of the laws. @param responses of the island's pairs
  void set_responses(std::vector<PairResponse> responses);
  [[nodiscard]] Residual residual() const;
  /// Sets the residual of the last call of residual() to one computed earlier at the present guess.
  void recall(const Residual& residual) const;
  /// Forces of the last responses alone, N, in the island's equations.
  [[nodiscard]] Eigen::VectorXd contact_forces() const;
  /// Adds forces of pairs in the island's equations, N. @param responses of the island's pairs
  void add_contact_forces(const std::vector<PairResponse>& responses, Eigen::VectorXd& sum) const;
  void apply(const Eigen::VectorXd& change, double share);
  /// Inner product of vectors in the island's equations.
  [[nodiscard]] double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const {
    return sums_.dot(x, y);
  }
  /// A change in the island's equations as one of the unknowns. @return by body
  [[nodiscard]] std::vector<Eigen::VectorXd> changes(const Eigen::VectorXd& change) const;
  /// Motion of a pair's points by changes of the bodies, in their frames, m. @return (3, #points)
  [[nodiscard]] Eigen::Matrix3Xd motion(std::size_t pair, const std::vector<Eigen::VectorXd>& changes) const;

  [[nodiscard]] std::vector<Eigen::VectorXd> guess() const;
  void set_guess(const std::vector<Eigen::VectorXd>& guess);
  /// Moves the present guess with its responses out, so that another one can be evaluated. take_back() restores it,
  /// as long as the laws are unchanged.
  [[nodiscard]] Evaluation set_aside();
  void take_back(Evaluation evaluation);
  /// States of all points at the last responses, in a fixed order.
  [[nodiscard]] const std::vector<ContactState>& states() const { return contacts_.states; }

  [[nodiscard]] std::size_t bodies() const { return island_.bodies.size(); }
  [[nodiscard]] const BodyStep& body(std::size_t place) const { return bodies_[at(island_.bodies[place])]; }
  /// A block of the step, moving or not.
  [[nodiscard]] const BodyStep& block(int index) const { return bodies_[at(index)]; }
  /// Indices of a pair's blocks among the island's bodies; -1: fixed.
  [[nodiscard]] const std::array<int, 2>& places(std::size_t pair) const { return places_[pair]; }
  /// Pairs of a body of the island, in their order.
  [[nodiscard]] const std::vector<std::size_t>& pairs_of(std::size_t body) const { return pairs_of_[body]; }
  /// Position at which the elastic force of a body is evaluated, (p, 3).
  [[nodiscard]] Eigen::MatrixX3d taken_at(const BodyStep& body) const;
  [[nodiscard]] IslandSolvers::Entry& solver() const { return solver_; }
  /// Worker threads for loops over pairs; results are independent of their number.
  [[nodiscard]] int threads() const;

  /// The part of this process in an island that several processes share.
  [[nodiscard]] const IslandSums& sums() const { return sums_; }
  /// Number of pairs of all processes.
  [[nodiscard]] std::size_t all_pairs() const { return all_pairs_; }
  [[nodiscard]] std::size_t pairs() const { return island_.pairs.size(); }
  [[nodiscard]] const ContactPair& pair(std::size_t k) const;
  /// Replaces a pair of the island.
  void replace(std::size_t k, ContactPair pair) { replaced_.insert_or_assign(k, std::move(pair)); }
  /// Gaps of a pair's points at the present guess, m.
  [[nodiscard]] std::vector<double> gaps(std::size_t pair) const;
  /// The last responses with all points: the first call after respond() computes them, outside of loops in parallel.
  [[nodiscard]] const std::vector<PairResponse>& responses() const;
  /// Derivatives of the forces of a pair's points at the last responses, computed by the first call for the pair. Pairs
  /// may be called in parallel.
  [[nodiscard]] std::span<const PointDerivative> derivatives(std::size_t pair) const;
  [[nodiscard]] const IslandBolts& bolts() const { return bolts_; }
  /// Laws that change: respond() has to follow.
  [[nodiscard]] std::vector<std::vector<PointLaw>>& changing_laws() {
    laws_changed_ = true;
    return laws_;
  }
  [[nodiscard]] const std::vector<std::vector<PointLaw>>& laws() const { return laws_; }
  /// Frequent laws of a pair's points as of the last responses; empty: others.
  [[nodiscard]] std::span<const FrequentLaw> frequent_laws(std::size_t pair) const {
    return table_.frequent(pair);
  }
  [[nodiscard]] const TimeScheme& scheme() const { return scheme_; }
  [[nodiscard]] const SimulationSettings& settings() const { return settings_; }
  /// Updates rows to the middle and gaps to the end of the step at the present guess (ContactPair::follow), for pairs
  /// where this changes the gaps. @param tolerance of gaps, m. @return true if any pair was updated
  [[nodiscard]] bool follow_contacts(double tolerance);
  /// Work of a pair's contact on its blocks at the last responses without that of sliding, J.
  [[nodiscard]] double given(std::size_t pair) const;
  /// Moves responses, laws and updated pairs out at the end of the iteration.
  void hand_over(IslandResult& result);

 private:
  /// Changes of a pair's blocks.
  [[nodiscard]] const Eigen::VectorXd& change_a(std::size_t k) const {
    return bodies_[at(pair(k).a())].change;
  }
  [[nodiscard]] const Eigen::VectorXd& change_b(std::size_t k) const {
    return bodies_[at(pair(k).b())].change;
  }
  [[nodiscard]] auto places_of_points(std::size_t pair, std::size_t points) const {
    return contacts_.places.middleCols(static_cast<Eigen::Index>(table_.first_point(pair)),
                                       static_cast<Eigen::Index>(points));
  }
  /// Prepares for new responses.
  void renew_contacts();
  /// Sets states and forces in doubt of a pair from the response of its points.
  void note_points(std::size_t k);
  /// Adds forces of pairs to a residual. @param errors by body: rounding error and force within rounding error, N
  void add_contacts(Residual& residual, std::vector<ForceErrors>& errors) const;
  void add_bolts(Residual& residual, std::vector<ForceErrors>& errors) const;
  /// Adds the force on a body's unknowns to a residual.
  void add_force(Residual& residual, int place, const Eigen::VectorXd& on_unknowns) const;
  /// Residual of each body relative to its tolerance.
  void judge(Residual& residual, const std::vector<ForceErrors>& errors) const;
  /// Updates rigid bodies after each change of the guess.
  void follow_rigid_bodies();
  [[nodiscard]] BlockInStep placed(const BodyStep& body) const;
  /// Largest error of the gaps of a pair's closed points due to rows that are not updated, m.
  [[nodiscard]] double left_out(std::size_t pair) const;

  const Island& island_;
  std::vector<BodyStep>& bodies_;
  const std::vector<ContactPair>& pairs_;
  const SimulationSettings& settings_;
  const TimeScheme& scheme_;
  IslandSolvers::Entry& solver_;
  const IslandSums& sums_;
  std::size_t all_pairs_ = 0;
  /// State at which the rows of a pair were updated.
  struct Followed {
    Eigen::VectorXd change_a;
    Eigen::VectorXd change_b;
    Eigen::Matrix3Xd motion;  ///< of its points at that state
  };

  std::vector<std::array<int, 2>> places_;  ///< by pair
  /// Pairs of each body in their order: sums by body do not depend on threads.
  std::vector<std::vector<std::size_t>> pairs_of_;
  std::map<std::size_t, ContactPair> replaced_;
  std::map<std::size_t, Followed> followed_;
  mutable ContactForces contacts_;
  mutable std::vector<PointDerivative> derivatives_;  ///< by point
  IslandBolts bolts_;
  std::vector<std::vector<PointLaw>> laws_;
  bool laws_changed_ = true;  ///< since the table was made
  ContactTable table_;
};

}  // namespace ashlar
