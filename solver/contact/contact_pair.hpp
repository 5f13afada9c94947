// The contact of two blocks within one step: forces of its points as a function of both blocks' unknowns.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "mechanics/contact/contact_memory.hpp"
#include "mechanics/contact/contact_points.hpp"
#include "mechanics/contact/spring_energy.hpp"
#include "mechanics/contact/tie.hpp"
#include "solver/contact/contact_patch.hpp"
#include "solver/contact/pair_rows.hpp"

namespace ashlar {

/// How points that push are stopped (step/velocity_contact.hpp).
struct Stop {
  double stiffness = 0.0;  ///< of a point against the inertia it feels, without unit
  double inertia_a = 0.0;  ///< density over the step squared, kg/(m^3 s^2); of no use if fixed
  double inertia_b = 0.0;
  double allowed_way = 0.0;  ///< m: points that their force moves by less in a step count for little
};

/// Two blocks, and where they are at the start of a step.
struct PairBodies {
  int a;  ///< index of the block, used by the solver only
  int b;
  ContactBody of_a;
  ContactBody of_b;
};

/// Area of joints with strength to lose, m^2.
struct BondedArea {
  double left = 0.0;  ///< that still has it
  double lost = 0.0;  ///< that has lost it
};

/// Points are linear in the unknowns: with ya, yb the changes of the blocks' unknowns,
///   gap = g0 + b + n . (C_a ya - C_b yb)
/// and likewise the slip (theory.md section 7, where H = rows_a, Q = rows_b). Rows, normals and tangents are
/// those at the start of the step, b = 0, until follow() takes them to the middle of the step, and b to what
/// makes the gap that of the end of the step (notes/contact_at_the_end_of_a_step.md).
class ContactPair {
 public:
  /// @param memory (#points)
  ContactPair(const PairBodies& bodies, const JointLaw& law, ContactPatch patch,
              std::vector<PointMemory> memory, const PatchStart& start = {});

  /// Two tied blocks (tie.hpp): each function of the gap is a point that never opens or slides, its gap and
  /// slip the components of the function's coefficient along x, y and z. @param tie must outlive this
  /// @param stiffness Pa/m
  ContactPair(const PairBodies& bodies, const Tie& tie, double stiffness);
  [[nodiscard]] bool tied() const { return kind_.tied; }
  /// Whether its springs only stand for what does not give way.
  [[nodiscard]] bool rigid() const { return kind_.rigid; }
  /// Whether sliding raises it.
  [[nodiscard]] bool dilates() const { return kind_.dilation > 0.0; }
  /// Size of the rounding errors of the forces, in the norm of a block's unknowns. @param laws of the points
  [[nodiscard]] double force_rounding(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                      const std::vector<PointLaw>& laws) const;
  /// Of points that are closed by rounding only: what their springs would pull across their gaps, in the same
  /// norm. @param response to ya and yb
  [[nodiscard]] double force_in_doubt(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                      const std::vector<PointLaw>& laws, const PairResponse& response) const;

  [[nodiscard]] int a() const { return a_; }
  [[nodiscard]] int b() const { return b_; }
  [[nodiscard]] const std::vector<ContactPoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<PointMemory>& memory() const { return memory_; }
  [[nodiscard]] const std::vector<PressureCut>& cuts() const { return cuts_; }
  /// Faces over which friction turned in the step before.
  [[nodiscard]] const std::vector<FacePair>& turning() const { return turning_; }
  /// What may last of its contacts; null: nothing.
  [[nodiscard]] const std::shared_ptr<const LastingContacts>& lasting() const { return lasting_; }
  /// Whether its springs are those of the last step, not found anew.
  [[nodiscard]] bool goes_on() const { return kind_.goes_on; }

  /// Laws of the points at the start of the step.
  [[nodiscard]] const std::vector<PointLaw>& laws() const { return laws_; }

  /// Takes the place of a response, whose room it uses. @param averaged false: forces are those at the end of the step;
  /// true: see averaged_step. @param laws of the points, as an open-close iteration has them
  void respond(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, bool averaged,
               const std::vector<PointLaw>& laws, PairResponse& response) const;
  [[nodiscard]] PairResponse respond(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, bool averaged,
                                     const std::vector<PointLaw>& laws) const {
    PairResponse response;
    respond(ya, yb, averaged, laws, response);
    return response;
  }
  [[nodiscard]] PairResponse respond(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                     bool averaged) const {
    return respond(ya, yb, averaged, laws_);
  }
  /// Gap over the rest and trial slip of every point at the end of the step, m. @return (3, #points)
  [[nodiscard]] Eigen::Matrix3Xd places(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
    return after(motion(ya, yb));
  }
  /// Response of one point. @param place of places(), m
  [[nodiscard]] AveragedStep respond(std::size_t point, const Eigen::Vector3d& place, bool averaged,
                                     const PointLaw& law) const;
  /// Takes the springs to be at rest where, found anew, they hold no more than this (spring_energy.hpp);
  /// elastic slip shrinks in proportion. Pairs with bonds that can take tension, and tied ones, stay as they
  /// are, and so do pairs with multipliers.
  void hold_at_most(const SpringEnergy& held);
  /// Sets what acts in the coming step beside the contact.
  void begin_step(const BlockModel& a, const BlockModel& b, const StepActions& actions);
  /// By how much the rest of a point's normal spring is above the surface for what has slid before the step, m, >= 0.
  [[nodiscard]] double dilation_before(std::size_t point) const {
    return kind_.counts_slip ? memory_[point].level_dilation : memory_[point].dilation;
  }
  /// Whether any point of a contact has strength to lose.
  [[nodiscard]] bool bonded() const;
  /// PatchStart::frozen, J; 0 without it.
  [[nodiscard]] double taken() const { return taken_; }
  /// Depth of the deepest point that no bond holds, m, >= 0; 0 of tied blocks.
  [[nodiscard]] double depth_found() const;
  /// The pair without friction and forces, for moving blocks apart: points push from a depth on, bonds and
  /// ties hold blocks as they are to each other. @param depth m, >= 0
  [[nodiscard]] ContactPair projected(double depth) const;
  [[nodiscard]] bool can_be_bounded() const;
  /// Takes rows and normals to the middle of the step and gaps to its end, at a guess of the unknowns.
  void follow(const BlockInStep& a, const BlockInStep& b, const Eigen::VectorXd& ya,
              const Eigen::VectorXd& yb);
  /// The pair with rows and normals of the end of the step, for velocities there.
  [[nodiscard]] ContactPair at_end(const BlockInStep& a, const BlockInStep& b) const;
  /// Motion of a relative to b at each point in its frame, m, linear in the changes. @return (3, #points)
  [[nodiscard]] Eigen::Matrix3Xd motion(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
    return rows_.motion(ya, yb);
  }
  /// Work of the contact forces on both blocks, on prescribed motion too, J.
  [[nodiscard]] double work(const PairResponse& response, const Eigen::VectorXd& ya,
                            const Eigen::VectorXd& yb) const;
  /// Its part without that of the shift to common points, J.
  [[nodiscard]] double spring_work(const PairResponse& response, const Eigen::VectorXd& ya,
                                   const Eigen::VectorXd& yb) const;
  /// Its part on prescribed motion, J.
  [[nodiscard]] double prescribed_work(const PairResponse& response) const {
    return rows_.prescribed_work(response);
  }

  /// Spring energy at the start of the step, J.
  [[nodiscard]] double start_energy() const;
  [[nodiscard]] SpringEnergy start_energies() const;

  [[nodiscard]] PairTangent tangent(const PairResponse& response) const { return rows_.tangent(response); }

  [[nodiscard]] const PairRows& rows() const { return rows_; }

  // pair_impulses.cpp
  /// Whether any point pushes, or a bond of a contact holds.
  [[nodiscard]] bool pushes(const PairResponse& end, const std::vector<PointLaw>& laws) const;
  /// Impulses per step, N, that stop points: along the normal where they push, along the surface too where
  /// they are locked, and tied functions.
  /// @param end at the end of the step. @param laws that gave it
  /// @param ya,yb velocities of the unknowns times the step
  /// @param let_go points whose force of the step is taken back
  [[nodiscard]] PairResponse stopping(const PairResponse& end, const std::vector<PointLaw>& laws,
                                      const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, const Stop& stop,
                                      const std::vector<bool>& let_go) const;
  /// Of points with multipliers, the normal impulse that friction has still to count: what it did not in this
  /// step, those at its end first, less what it counted too much. Locked points have nothing left of earlier
  /// ones.
  /// @param impulses of the points in their frames, over the step, N; @param step s
  void remember_impulses(const PairResponse& response, const std::vector<PointLaw>& laws,
                         const std::vector<Eigen::Vector3d>& impulses, double step,
                         std::vector<PointMemory>& memory) const;

  // contact_pair.cpp
  /// The pair as blocks feel it that set off from rest: points that a response has closed are rigid, with
  /// their forces as multipliers, those that it has opened never touch. Ties stay as they are.
  /// @param laws that gave the response
  /// @param reach m, >= 0: points that are found this far apart or less touch, without force
  [[nodiscard]] ContactPair at_rigid_onset(const PairResponse& response, const std::vector<PointLaw>& laws,
                                           double reach) const;
  /// Whether strength is lost in the step anywhere. @param memory after it
  [[nodiscard]] bool fails(const std::vector<PointMemory>& memory) const;
  /// Of points that had strength to lose at the start of the step. @param memory after it
  [[nodiscard]] BondedArea bonded_area(const std::vector<PointMemory>& memory) const;

  /// Gap of each point, m.
  [[nodiscard]] std::vector<double> gaps(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const;
  /// Memory after an accepted step. @param laws that gave the response
  /// @param tearing_gap m, >= 0: cohesion without tensile strength lasts where a point opens no farther: of
  /// points without pressure rounding must not say which have failed
  [[nodiscard]] std::vector<PointMemory> memory_after(const PairResponse& response,
                                                      const std::vector<PointLaw>& laws,
                                                      const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                                      double tearing_gap) const;
  /// Work that sliding takes in the step, J, also of points that have opened in it; with multipliers, which
  /// hold none, all that points take that slide. Less what the normal forces do where they dilate.
  [[nodiscard]] double friction_work(const PairResponse& response, const std::vector<PointLaw>& laws,
                                     const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const;
  /// Energy that the dashpots take in the step, J, >= 0.
  [[nodiscard]] static double damped(const PairResponse& response);
  /// Spring energy at the end of the step, J.
  [[nodiscard]] static SpringEnergy energies(const PairResponse& response);

 private:
  struct Kind {
    bool tied;
    bool rigid;
    bool area_springs;  ///< multipliers are remembered per area
    double dilation;    ///< tan(psi)
    double damping;     ///< share of critical
    bool counts_slip = false;
    bool freezes_failure = false;
    bool goes_on = false;
  };

  ContactPair(const PairBodies& bodies, const JointLaw& law, std::vector<ContactPoint> points,
              std::vector<PointMemory> memory, const Tie* tie);
  /// Of points whose rows are known.
  ContactPair(const PairBodies& bodies, const JointLaw& law, std::vector<ContactPoint> points,
              std::vector<PointMemory> memory, PairRows rows, bool tied);
  // How a patch starts: PatchStart.
  void continue_springs();
  void touch_within(double depth);
  void freeze_at_gap(double taken);
  void count_slip(const std::vector<Vector3>& moved);
  void freeze_failure();
  // StepActions. @param step s, > 0
  /// Dashpots beside the springs (mechanics/notes/joint_damping.md).
  void damp(double step);
  /// Friction of the last step's impulses, which had none.
  void apply_deferred_friction(double step);

  [[nodiscard]] double multiplier_scale(const ContactPoint& point) const {
    return kind_.area_springs ? point.area : 1.0;
  }
  /// Also how points dilate in the step: those that are open at its start have slid nowhere yet.
  void respond_at_start();
  /// Trial slip at the start that no spring holds, of a load level, m.
  [[nodiscard]] Eigen::Vector2d slid_before(std::size_t point) const;
  /// A vector along the surface at a point.
  [[nodiscard]] Vector3 flat(std::size_t point, const Eigen::Vector2d& along) const;
  /// @param rests gap of each point at which its normal spring is at rest, m
  void rest_at(std::vector<double> rests);
  /// places() of a motion that is known. @param moved (3, #points), m
  [[nodiscard]] Eigen::Matrix3Xd after(const Eigen::Matrix3Xd& moved) const;

  int a_;
  int b_;
  std::vector<ContactPoint> points_;
  std::vector<PointMemory> memory_;
  std::vector<PressureCut> cuts_ = {};
  std::vector<FacePair> turning_ = {};
  std::shared_ptr<const LastingContacts> lasting_;
  std::vector<PointLaw> laws_;
  std::vector<PointResponse> start_responses_;
  std::vector<double> rests_;  ///< gap at which each normal spring is at rest, m, <= 0 but of bonds
  double taken_ = 0.0;
  double reduced_mass_;  ///< of both blocks, kg
  Kind kind_;
  Eigen::Matrix3Xd start_;  ///< gap over the rest and slip at the start of the step
  PairRows rows_;
};

}  // namespace ashlar
