// The contact of two blocks within one step: forces of its points as a function of both blocks' unknowns.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mechanics/contact/contact_memory.hpp"
#include "mechanics/contact/contact_points.hpp"
#include "mechanics/contact/laws/spring_energy.hpp"
#include "mechanics/contact/laws/tie.hpp"
#include "solver/contact/contact_patch.hpp"
#include "solver/contact/pair_rows.hpp"

namespace ashlar {

/// Rule that stops approaching points (step/accept/velocity_contact.hpp).
struct Stop {
  double stiffness = 0.0;  ///< of a point relative to its effective inertia, dimensionless
  double inertia_a = 0.0;  ///< density over the step squared, kg/(m^3 s^2); unused if fixed
  double inertia_b = 0.0;
  double allowed_way = 0.0;  ///< m: points that their force moves by less in a step have little weight
};

/// Two blocks and their states at the start of a step.
struct PairBodies {
  int a;  ///< index of the block, used by the solver only
  int b;
  ContactBody of_a;
  ContactBody of_b;
};

/// Area of joints with strength that can fail, m^2.
struct BondedArea {
  double left = 0.0;  ///< intact
  double lost = 0.0;  ///< failed
};

/// Points are linear in the unknowns: with ya, yb the changes of the blocks' unknowns,
///   gap = g0 + b + n . (C_a ya - C_b yb)
/// and likewise the slip (theory.md section 7, where H = rows_a, Q = rows_b). Rows, normals and tangents are those at
/// the start of the step, b = 0, until follow() updates them to the middle of the step, and b so that the gap is that
/// of the end of the step (notes/contact_at_the_end_of_a_step.md).
class ContactPair {
 public:
  /// @param memory (#points)
  ContactPair(const PairBodies& bodies, const JointLaw& law, ContactPatch patch,
              std::vector<PointMemory> memory, const PatchStart& start = {});

  /// Two tied blocks (tie.hpp): each function of the gap is a point that never opens or slides. Its gap and slip are
  /// the components of the function's coefficient along x, y and z. @param tie not null
  /// @param stiffness Pa/m
  ContactPair(const PairBodies& bodies, const std::shared_ptr<const Tie>& tie, double stiffness);
  [[nodiscard]] bool tied() const { return kind_.tied; }
  /// True if its springs represent rigid contact.
  [[nodiscard]] bool rigid() const { return kind_.rigid; }
  /// Of joints with a coefficient of restitution (step/impact/restitution.hpp).
  [[nodiscard]] const std::optional<double>& restitution() const { return kind_.restitution; }
  /// Gap of a point relative to its rest gap at the start of the step, m.
  [[nodiscard]] double start_gap(std::size_t point) const {
    return start_(0, static_cast<Eigen::Index>(point));
  }
  /// True if a point is under compression at the start of the step.
  [[nodiscard]] bool loaded(std::size_t point) const { return start_responses_[point].force[0] > 0.0; }
  /// True if a point is tied, or bonded with tensile strength.
  [[nodiscard]] bool holds(std::size_t point) const { return tied() || laws_[point].tension > 0.0; }
  /// True if sliding causes dilation.
  [[nodiscard]] bool dilates() const { return kind_.dilation > 0.0; }
  /// Size of the rounding errors of the forces, in the norm of a block's unknowns. @param stiffness largest of a
  /// spring, N/m. @param change_a,change_b norms of the changes
  [[nodiscard]] double force_rounding(double stiffness, double change_a, double change_b) const;
  /// Spurious tension at points closed only within rounding error, in the same norm. @param response to ya and yb
  [[nodiscard]] double force_in_doubt(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                      const std::vector<PointLaw>& laws, const PairResponse& response) const;

  [[nodiscard]] int a() const { return a_; }
  [[nodiscard]] int b() const { return b_; }
  [[nodiscard]] const std::vector<ContactPoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<PointMemory>& memory() const { return memory_; }
  [[nodiscard]] const std::vector<PressureCut>& cuts() const { return cuts_; }
  /// Faces with friction torque in the step before.
  [[nodiscard]] const std::vector<FacePair>& turning() const { return turning_; }
  /// Data of its contacts for the contact cache; null: none.
  [[nodiscard]] const std::shared_ptr<const ContactCache>& cache() const { return cache_; }
  /// True if its springs continue from the last step, false if they were detected again.
  [[nodiscard]] bool continues() const { return kind_.continues; }

  /// Laws of the points at the start of the step.
  [[nodiscard]] const std::vector<PointLaw>& laws() const { return laws_; }

  /// Overwrites a response and reuses its memory. @param averaged false: forces are those at the end of the step;
  /// true: see averaged_step. @param laws of the points, as changed by an open-close iteration
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
  /// Forces of the response alone, of frequent laws at the end of the step; `points` and `means` are empty after it.
  /// @param laws (#points). @param states of the points (#points) and places(), are set. @return force_in_doubt()
  double press(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, std::span<const FrequentLaw> laws,
               std::span<ContactState> states, Eigen::Ref<Eigen::Matrix3Xd> places,
               PairResponse& response) const;
  /// Gap relative to the rest gap and trial slip of every point at the end of the step, m. @return (3, #points)
  [[nodiscard]] Eigen::Matrix3Xd places(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
    return after(motion(ya, yb));
  }
  /// Response of one point. @param place of places(), m
  [[nodiscard]] AveragedStep respond(std::size_t point, const Eigen::Vector3d& place, bool averaged,
                                     const PointLaw& law) const;
  /// Sets the rest gaps so that re-detected springs hold at most this energy (spring_energy.hpp). Elastic slip is
  /// reduced in proportion. No effect on pairs with bonds that can take tension, tied pairs and pairs with
  /// multipliers.
  void hold_at_most(const SpringEnergy& held);
  /// Sets what acts in the coming step beside the contact.
  void begin_step(const BlockModel& a, const BlockModel& b, const StepActions& actions);
  /// Dilation of a point by slip before the step: height of its rest gap above the surface, m, >= 0.
  [[nodiscard]] double dilation_before(std::size_t point) const {
    return kind_.counts_slip ? memory_[point].level_dilation : memory_[point].dilation;
  }
  /// True if any point of a contact has strength that can fail.
  [[nodiscard]] bool bonded() const;
  /// PatchStart::frozen, J; 0 without it.
  [[nodiscard]] double spent() const { return spent_; }
  /// Largest depth of points without bond, m, >= 0; 0 for tied blocks.
  [[nodiscard]] double depth_found() const;
  /// The same of points that multipliers hold, m, >= 0. A depth under springs is their compliance.
  [[nodiscard]] double depth_of_multipliers() const;
  /// The pair without friction and forces, for the separation of blocks: points resist penetration beyond a depth;
  /// bonds and ties keep the blocks' relative position. @param depth m, >= 0
  [[nodiscard]] ContactPair projected(double depth) const;
  [[nodiscard]] bool can_be_bounded() const;
  /// Updates rows and normals to the middle of the step and gaps to its end, at a guess of the unknowns.
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
  /// Part of work() without the shift to common points, J.
  [[nodiscard]] double spring_work(const PairResponse& response, const Eigen::VectorXd& ya,
                                   const Eigen::VectorXd& yb) const;
  /// Part of work() on prescribed motion, J.
  [[nodiscard]] double prescribed_work(const PairResponse& response) const {
    return rows_.prescribed_work(response);
  }

  /// Spring energy at the start of the step, J.
  [[nodiscard]] double start_energy() const;
  [[nodiscard]] SpringEnergy start_energies() const;

  [[nodiscard]] PairTangent tangent(const PairResponse& response) const {
    return rows_.tangent(derivatives_of(response));
  }

  [[nodiscard]] const PairRows& rows() const { return rows_; }

  // pair_impulses.cpp
  /// True if any point is under compression or a bond of a contact holds.
  [[nodiscard]] bool pushes(const PairResponse& end, const std::vector<PointLaw>& laws) const;
  /// Impulses per step, N, that stop points: along the normal under compression, in shear too if locked, and in all
  /// directions for tied functions.
  /// @param end response at the end of the step. @param laws of that response
  /// @param ya,yb velocities of the unknowns times the step
  /// @param let_go points whose force of the step is removed
  [[nodiscard]] PairResponse stopping(const PairResponse& end, const std::vector<PointLaw>& laws,
                                      const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, const Stop& stop,
                                      const std::vector<bool>& let_go) const;
  /// Stores deferred friction: the normal impulse of points with multipliers that friction has not counted yet, those
  /// at the end of the step included; negative if it has counted too much. Locked points keep at most their last
  /// impulse.
  /// @param impulses of the points in their frames, over the step, N; @param step s
  void remember_impulses(const PairResponse& response, const std::vector<PointLaw>& laws,
                         const std::vector<Eigen::Vector3d>& impulses, double step,
                         std::vector<PointMemory>& memory) const;

  // contact_pair.cpp
  /// The pair at rigid onset: points closed by a response are rigid with their forces as multipliers, points opened
  /// by it never touch. Ties are unchanged.
  /// @param laws of the response
  /// @param reach m, >= 0: points with at most this gap touch, without force
  [[nodiscard]] ContactPair at_rigid_onset(const PairResponse& response, const std::vector<PointLaw>& laws,
                                           double reach) const;
  /// True if any strength fails in the step. @param memory after it
  [[nodiscard]] bool fails(const std::vector<PointMemory>& memory) const;
  /// Area of points that had strength at the start of the step. @param memory after it
  [[nodiscard]] BondedArea bonded_area(const std::vector<PointMemory>& memory) const;

  /// Gap of each point, m.
  [[nodiscard]] std::vector<double> gaps(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const;
  /// Memory after an accepted step. @param laws of the response
  /// @param tearing_gap m, >= 0: cohesion without tensile strength survives an opening up to it, since rounding
  /// errors must not decide which points without pressure have failed
  [[nodiscard]] std::vector<PointMemory> memory_after(const PairResponse& response,
                                                      const std::vector<PointLaw>& laws,
                                                      const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                                      double tearing_gap) const;
  /// Energy dissipated by sliding in the step, J, also of points that have opened in it. With multipliers, which
  /// store no energy, all work of sliding points. Less the work of normal forces on dilation.
  [[nodiscard]] double friction_work(const PairResponse& response, const std::vector<PointLaw>& laws,
                                     const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const;
  /// Energy dissipated by damage of bonds in the step, J, beside friction_work(). In statics since the last iteration.
  [[nodiscard]] double fracture_work(const PairResponse& response) const;
  /// Energy dissipated by dashpots in the step, J, >= 0.
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
    bool continues = false;
    std::optional<double> restitution = std::nullopt;
  };

  ContactPair(const PairBodies& bodies, const JointLaw& law, const std::vector<ContactPoint>& points,
              std::vector<PointMemory> memory, const std::shared_ptr<const Tie>& tie);
  /// From points whose rows are known.
  ContactPair(const PairBodies& bodies, const JointLaw& law, std::vector<ContactPoint> points,
              std::vector<PointMemory> memory, PairRows rows, bool tied);
  // Start of a patch: PatchStart.
  void continue_springs();
  void touch_within(double depth);
  void freeze_at_gap(double spent);
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
  /// Responses and dilation of points at the start of the step: points that are open then have no slip yet.
  void respond_at_start();
  /// Trial slip at the start without spring force, of a load level, m.
  [[nodiscard]] Eigen::Vector2d slid_before(std::size_t point) const;
  /// A vector along the surface at a point.
  [[nodiscard]] Vector3 flat(std::size_t point, const Eigen::Vector2d& along) const;
  /// @param rests rest gap of each point's normal spring, m
  void rest_at(std::vector<double> rests);
  /// places() for a given motion. @param moved (3, #points), m
  [[nodiscard]] Eigen::Matrix3Xd after(const Eigen::Matrix3Xd& moved) const;

  int a_;
  int b_;
  std::vector<ContactPoint> points_;
  std::vector<PointMemory> memory_;
  std::vector<PressureCut> cuts_ = {};
  std::vector<FacePair> turning_ = {};
  std::shared_ptr<const ContactCache> cache_;
  std::vector<PointLaw> laws_;
  std::vector<PointResponse> start_responses_;
  std::vector<double> rests_;  ///< rest gap of each normal spring, m, <= 0 except for bonds
  double spent_ = 0.0;
  double reduced_mass_;  ///< of both blocks, kg
  Kind kind_;
  Eigen::Matrix3Xd start_;  ///< gap relative to the rest gap and slip at the start of the step
  PairRows rows_;
};

}  // namespace ashlar
