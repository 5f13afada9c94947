// Whether rigid blocks can stand, and by which factor on strengths or loads they no longer do (limit analysis). Seconds
// where an elastic analysis takes minutes, and with a proof of each answer: forces within the strengths that balance the
// loads, or a motion that no such forces can prevent.
//
// Joints that slide do not open as much as their friction angle asks for (or by their dilation angle), and such joints
// have two limits (notes/limit_analysis.md):
//   associated  the largest factor for which forces in balance exist at all. Nothing stands above it. Where blocks wedge
//               each other it counts on forces that nothing may have put there.
//   released    the least factor for which a motion exists that starts from rest and obeys Coulomb's law, each joint
//               with the friction that its normal force gives it in that motion. Below it nothing moves. It is the one
//               to sign.
// Both are found by cone programmes (cone_program.hpp). Released motion is a fixed point: with the shift
// s = (mu - tan psi) |v_t| of each point, a joint that slides by v_t opens by tan psi |v_t|; each programme gives the
// next shift, from the motion without friction on. A fixed point is a motion, whatever led to it. (De Saxce and Feng,
// Math. Comput. Model. 28 (1998) 225; Acary et al., ZAMM 91 (2011) 155.)
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/statics/rigid_model.hpp"

namespace ashlar {

/// Strengths of chosen joints are divided by one, loads that are multiplied are multiplied by the other.
struct LimitFactors {
  double strength = 1.0;
  double load = 1.0;
};

enum class LimitOutcome {
  stands,  ///< forces within the strengths balance all bodies; released: and the motion without them comes to rest
  moves,    ///< a motion that is proven, or obeys Coulomb's law
  unknown,  ///< rounding, or a fixed point that was not found
};

/// What one pair of factors gives.
struct LimitTrial {
  LimitFactors factors;
  bool released = false;  ///< which of the two limits it is of
  LimitOutcome outcome = LimitOutcome::unknown;
  std::vector<BodyVelocity> acceleration;  ///< by body, from rest, in coordinates and units of the model
  std::vector<Eigen::Vector3d> force;      ///< by point, in units of the model
  double estimate =
      0.0;  ///< of a trial that moves: the factor at which its motion would be in balance; 0: none
  int programmes = 0;
  int iterations = 0;  ///< of all its programmes
};

/// Where to look for a factor, and how well it is to be known.
struct LimitSearch {
  double lower = 0.1;       ///< > 0
  double upper = 10.0;      ///< > lower
  double tolerance = 0.01;  ///< > 0: relative width of the bracket
};

/// What is known of one of the two limits.
struct LimitBracket {
  std::optional<double> lower;       ///< the largest factor that stands; empty: even the least moves
  std::optional<double> upper;       ///< the least factor that moves; empty: even the largest stands
  bool resolved = false;             ///< upper / lower - 1 is within the tolerance, or one of them is empty
  std::optional<LimitTrial> motion;  ///< of `upper`
  std::optional<LimitTrial> rest;    ///< of `lower`
};

struct LimitAnswer {
  LimitBracket associated;
  LimitBracket released;
  bool interrupted = false;
  std::vector<LimitTrial> trials;  ///< in order, without motions and forces
};

/// What a joint between two blocks does in a motion.
enum class JointMotion { sticks, slides, opens };
struct MovingJoint {
  std::array<int, 2> blocks;
  JointMotion motion;
};

/// How blocks set off.
struct LimitMotion {
  struct Block {
    int block;
    Vector3 about;                 ///< m, centre of gravity of the blocks that move as one with it
    Vector3 acceleration;          ///< of that, m/s^2
    Vector3 angular_acceleration;  ///< rad/s^2
  };
  std::vector<Block> blocks;        ///< by block number
  std::vector<MovingJoint> joints;  ///< with a moving block on either side
  std::string mode;  ///< in words, of the block that sets off fastest: "slides on one plane", "topples", ...
};

class LimitAnalysis {
 public:
  using Chosen = std::function<bool(int, int)>;

  /// @param reduced whether the joint of two blocks is one of those whose strength is divided. @param threads >= 1
  LimitAnalysis(RigidModel model, const Chosen& reduced, int threads);

  [[nodiscard]] const RigidModel& model() const { return model_; }

  /// Whether forces within the strengths exist that balance the loads.
  [[nodiscard]] LimitTrial associated(const LimitFactors& factors);
  /// Whether there is a motion from rest and from no contact forces that obeys Coulomb's law.
  /// @param tolerance of the factor: how near to the limit it is to tell
  /// @param known a motion under other factors, which is followed first; null: none
  [[nodiscard]] LimitTrial released(const LimitFactors& factors, double tolerance = 1e-3,
                                    const LimitTrial* known = nullptr);
  /// The same where loads that are multiplied come after the others: from the forces that those have built up.
  [[nodiscard]] LimitTrial released_after_steady(const LimitFactors& factors, double tolerance = 1e-3,
                                                 const LimitTrial* known = nullptr);

  /// The factor by which strengths of the chosen joints may be divided. @param goes_on asked before each trial
  [[nodiscard]] LimitAnswer strength_factor(const LimitSearch& search, const std::function<bool()>& goes_on);
  /// The factor by which loads may be multiplied, the others as they are.
  [[nodiscard]] LimitAnswer load_factor(const LimitSearch& search, const std::function<bool()>& goes_on);

  /// What a trial that moves shows.
  [[nodiscard]] LimitMotion motion_of(const LimitTrial& trial) const;

 private:
  enum class Sought { strength, load };
  using Attempt = std::function<LimitTrial(double)>;

  void set_factors(const LimitFactors& factors);
  [[nodiscard]] std::vector<BodyVelocity> without_friction(const LimitFactors& factors, LimitTrial& trial);
  /// Of each body, its released motion while all others are held; zero where it stands.
  [[nodiscard]] std::vector<BodyVelocity> alone(const LimitFactors& factors, double tolerance);
  /// The same in a few sets, of bodies that do not touch each other, the fastest first.
  [[nodiscard]] std::vector<std::vector<BodyVelocity>> apart(std::vector<BodyVelocity> velocity) const;
  [[nodiscard]] std::unique_ptr<LimitAnalysis> with_others_held(std::size_t body) const;
  [[nodiscard]] LimitOutcome follow(const std::vector<BodyVelocity>& start, double at_rest,
                                    LimitTrial& trial);
  [[nodiscard]] LimitTrial with_bounds(const LimitFactors& factors, std::vector<double>& normal);
  [[nodiscard]] ConeQuestion question(double load) const;
  [[nodiscard]] double fastest(const std::vector<BodyVelocity>& acceleration, double load) const;
  [[nodiscard]] double most_that_stands(const LimitSearch& search);
  [[nodiscard]] LimitAnswer answer(Sought sought, const LimitSearch& search,
                                   const std::function<bool()>& goes_on);
  [[nodiscard]] double estimate(const LimitFactors& factors, const std::vector<BodyVelocity>& acceleration,
                                const std::vector<Eigen::Vector3d>& force) const;

  RigidModel model_;
  std::vector<bool> reduced_;  ///< by point
  ConeProgram program_;
  std::vector<std::unique_ptr<LimitAnalysis>> alone_;  ///< by body, once it was asked for
  std::optional<std::vector<double>>
      steady_normal_;  ///< by point, normal forces of the loads that are not multiplied
};

/// "slides", "sticks", "opens"
[[nodiscard]] const char* to_string(JointMotion motion);
/// "stands", "moves", "unknown"
[[nodiscard]] const char* to_string(LimitOutcome outcome);

}  // namespace ashlar
