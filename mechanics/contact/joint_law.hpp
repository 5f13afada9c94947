// The law of one contact point (theory.md sections 7 and 8): a normal spring, a shear spring, Coulomb
// friction, cohesion and tension that are lost once the joint has failed.
//
// With g the gap along the outward normal of block b, s the slip of a relative to b since the point locked
// (elastic part), A the area of the point, kn and ks the stiffnesses of the point (N/m):
//     N = -kn g                       normal force on a along n; compression positive
//     open     g > 0, or N < -T A while the joint is intact
//     locked   |ks s| <= max(N, 0) tan(phi) + c A     shear force on a: -ks s
//     sliding  otherwise                              shear force on a: -(max(N, 0) tan(phi) + c A) s/|s|
//
// Blocks that were placed in touch, or slid to where friction just holds them, have g = 0 or |ks s| = the
// limit but for rounding, which must not choose the state: a point is closed up to a gap that may be a
// rounding error, and locked up to such a slip over the limit. The forces stay those above: there they are
// continuous. (Not so cohesion, whose limit ends at this gap then.)
//
// A joint fails where it opens (by more than rounding), or where it slides and has friction or cohesion to
// lose: friction, cohesion and tensile strength fall to their residual values then. Residual cohesion 0 is a
// brittle joint, residual strength equal to the strength a perfectly plastic one, which never fails. Without
// cohesion there is no resistance to sliding under tension.
//
// With multipliers (augmented contact) N = lambda_n - kn g and the trial shear force is lambda_s - ks s.
// Where the forces repeat the multipliers, N > 0 means g = 0, a locked point has s = 0 and a sliding one has
// its force along -s: contact that does not give way. The springs only lead there, so that they hold no
// energy.
//
// Cohesion ends at once where a joint opens: no balance may lie between the two forces there, and rounding
// would choose the side. A bridged point keeps its cohesion across the gap until a balance shows that it has
// opened (solver/step/open_close.hpp).
//
// Dilation (notes/dilation.md): a point that slides by p raises the rest of its normal spring by p tan(psi) at once:
//     N = -kn (g - p tan(psi)),    ks (|s| - p) = max(N, 0) tan(phi) + c A,    p >= 0
//
// Damping (notes/joint_damping.md): a dashpot beside each spring, before the slider, where the point is closed. Without
// tensile strength it never makes N negative.
//
// With a held limit h the shear force is bounded by h + max(N, 0) tan(psi), also across an open gap: the
// forces are then the gradient of a convex function of (g, s), which Coulomb's law has not.
#pragma once

#include <Eigen/Dense>
#include <optional>

namespace ashlar {

/// What a contact point does.
enum class ContactState {
  open,     ///< no force
  locked,   ///< normal and shear spring
  sliding,  ///< normal spring and friction force
};

/// What a joint that has failed still bears.
struct ResidualStrength {
  double friction = 0.0;          ///< tan(phi)
  double cohesion = 0.0;          ///< Pa
  double tensile_strength = 0.0;  ///< Pa

  friend bool operator==(const ResidualStrength&, const ResidualStrength&) = default;
};

/// Parameters of a pair of blocks.
struct JointLaw {
  double normal_stiffness = 0.0;  ///< Pa/m for area springs, N/m for point springs
  double shear_stiffness = 0.0;   ///< likewise
  double friction = 0.0;          ///< tan(phi)
  double cohesion = 0.0;          ///< Pa
  double tensile_strength = 0.0;  ///< Pa
  bool area_springs = true;
  bool augmented = false;  ///< multipliers take over from springs until penetration is within a tolerance
  double rounding = 0.0;   ///< m, >= 0: what gaps and slips of the pair may be by rounding errors
  bool rigid = false;      ///< its springs only stand for contact that does not give way: they are no joint's
  bool gives_way = false;  ///< springs hold it, also where multipliers hold other joints
  double dilation = 0.0;   ///< tan(psi), 0 to the least friction: more would make energy
  double damping = 0.0;    ///< >= 0, share of critical, of springs (ContactPair::damp)
  /// Of surfaces that have failed, or were never bonded; each value at most that above. Empty: `friction` only
  std::optional<ResidualStrength> residual = std::nullopt;

  friend bool operator==(const JointLaw&, const JointLaw&) = default;
};

/// How a point opens where it slides.
struct Dilation {
  double tangent = 0.0;  ///< tan(psi)
  /// Gap over the rest at the start of the step of a point that is open then, m: it dilates in the share of the step in
  /// which it is closed, its gap linear in time. 0: it is closed at the start
  double landing_from = 0.0;
};

/// What resists motion over a step beside the springs.
struct Dashpots {
  double normal = 0.0;                                   ///< coefficient over the length of the step, N/m
  double shear = 0.0;                                    ///< likewise
  double start_gap = 0.0;                                ///< over the rest, at the start of the step, m
  Eigen::Vector2d start_slip = Eigen::Vector2d::Zero();  ///< elastic slip there, m
};

/// One point's constants within a step.
struct PointLaw {
  double normal_stiffness;         ///< kn, N/m
  double shear_stiffness;          ///< ks, N/m
  double friction;                 ///< tan(phi)
  double cohesion;                 ///< c A, N
  double tension;                  ///< T A, N; infinity: a joint that must not break now
  double rounding = 0.0;           ///< of gaps and slips, m
  double held_limit = -1.0;        ///< N; >= 0: in place of what friction beyond dilation and cohesion bear
  bool bridged = false;            ///< cohesion bears shear across an open gap too
  bool augmented = false;          ///< its forces become the next multipliers; its springs hold no energy
  double normal_multiplier = 0.0;  ///< lambda_n, N
  Eigen::Vector2d shear_multiplier = Eigen::Vector2d::Zero();  ///< lambda_s, N
  /// N, any sign: counts beside the normal force, at most as much as that, in what bounds the shear force,
  /// for impulses that pushed or pulled without friction before
  double impulse_force = 0.0;
  /// What is left once it has failed: friction tan(phi), cohesion and tension N
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();
  Dilation dilation = {};
  Dashpots dashpots = {};

  /// Whether it has strength to lose.
  [[nodiscard]] bool weakens() const {
    return friction > residual[0] || cohesion > residual[1] || tension > residual[2];
  }
  /// Whether sliding takes strength from it: tension alone is no resistance to sliding, and lasts.
  [[nodiscard]] bool weakens_by_sliding() const { return friction > residual[0] || cohesion > residual[1]; }
  /// From now on it has its residual strength.
  void fail() {
    friction = residual[0];
    cohesion = residual[1];
    tension = residual[2];
  }
};

/// @param area tributary area of the point, m^2. @param intact false: with residual strength
[[nodiscard]] PointLaw point_law(const JointLaw& law, double area, bool intact);

/// What a symmetric tangent leaves out of -d force / d (g, s1, s2): force by'. With dilation
///   -d force / d (g, s) = k (1, -f e) (1, -tan(psi) e)' + what turns the force,   e = s/|s|, f: of the limit by N
/// and the tangent has  k (1, -m e) (1, -m e)'  with m the smaller of both tangents.
struct Coupling {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N/m
  Eigen::Vector3d by = Eigen::Vector3d::UnitX();
};

/// Force of a point and how it changes, in the frame (n, t1, t2) of the point; the force acts on a, its
/// opposite on b.
struct PointResponse {
  ContactState state;
  Eigen::Vector3d force;  ///< N
  Eigen::Matrix3d
      tangent;           ///< symmetric part of -d force / d (g, s1, s2), positive semi-definite; see Coupling
  double normal_energy;  ///< of the normal spring, J
  double shear_energy;   ///< of the shear spring, J
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  ///< unit, of the shear force of a point that slides
  Coupling coupling = {};  ///< of a point that slides under Coulomb's law; zero of others
  double dilation = 0.0;   ///< by how much the rest has risen in the step, m
  double damped = 0.0;     ///< what the dashpots have taken in the step, J
  Eigen::Vector2d shear_damped = Eigen::Vector2d::Zero();  ///< what of `force` is the shear dashpot's, N

  [[nodiscard]] double energy() const { return normal_energy + shear_energy; }
};

/// @param gap m; @param slip trial slip (2), m, as if locked
[[nodiscard]] PointResponse point_response(const PointLaw& law, double gap, const Eigen::Vector2d& slip);

/// The normal force at a gap without slip, negative where nothing bears that, N.
[[nodiscard]] double trial_normal(const PointLaw& law, double gap);

/// Force and tangent that act over a step.
struct MeanResponse {
  Eigen::Vector3d force;    ///< N
  Eigen::Matrix3d tangent;  ///< N/m, by the end of the step, symmetric and positive semi-definite
  Coupling coupling;        ///< what the tangent leaves out
  double limit;             ///< what PointLaw::held_limit stands for: 0 where the point is open
};
/// The response at the end of a step as what acts over it.
/// @param gap that gave it, m
[[nodiscard]] MeanResponse end_response(const PointLaw& law, const PointResponse& end, double gap);

/// A step over which mean forces act.
struct AveragedStep {
  PointResponse end;  ///< tangent: of the normal force only
  MeanResponse mean;
};
/// Mean forces such that contacts give no more work than their energy falls. The work of the normal force N
/// is the change of its spring's energy exactly, also when the point opens or closes on the way (a discrete
/// gradient). The shear force is that of the spring at the middle of the step, s = e0 + (s1 - s0)/2 with e0
/// the elastic slip at the start, bounded by friction under N and by cohesion c for the share w of the step
/// in which the point is closed (its gap linear in time; 1 if it is bridged):
///     F = -ks s  if that is within  L = N tan(phi) + w c,  else  F = -L s/|s|,
/// and the spring ends at e1 with  F = -ks (e0 + e1)/2. What is lost is
///     -F . (s1 - s0) - ks (e1^2 - e0^2)/2 = -F . (s1 - s0 - e1 + e0) = 2 L (|s| - L/ks) >= 0
/// where it slides and nothing where it stays locked. In full sliding friction is L whatever the forces at
/// both ends are, which alternate where contacts are stiff. Where a point opens, its shear spring is lost.
/// Augmented points, which have no energy, act with their forces at the end.
/// With dashpots c over the step,  F = -ks (e0 + e1)/2 - c (e1 - e0);  with dilation N is the mean over a gap that ends
/// lower by p tan(psi), p = |s1 - s0 - e1 + e0|, so that it does work N p tan(psi) beside that of its spring.
/// @param start at the start of the step. @param start_place,end_place gap and trial slip, m
[[nodiscard]] AveragedStep averaged_step(const PointLaw& law, const PointResponse& start,
                                         const Eigen::Vector3d& start_place,
                                         const Eigen::Vector3d& end_place);

/// As much of an elastic slip, in its direction, as friction and cohesion bear under a normal force. Across
/// an open gap cohesion bears it too: of points that are found at the surface to rounding, rounding must not
/// say which keep theirs. @param normal N, 0 where the gap is open
[[nodiscard]] Eigen::Vector2d borne_slip(const PointLaw& law, double normal, const Eigen::Vector2d& slip);

/// The elastic slip that is left after a step with this trial slip: the spring of a sliding point stays at
/// the limit. Augmented points keep none: multipliers hold them where they are.
[[nodiscard]] Eigen::Vector2d elastic_slip(const PointLaw& law, const PointResponse& response,
                                           const Eigen::Vector2d& slip);

}  // namespace ashlar
