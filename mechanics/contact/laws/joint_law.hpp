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
// Blocks placed in contact, or slid to the friction limit, have g = 0 or |ks s| at the limit but for rounding, which
// must not decide the state. A point is closed up to a gap within rounding error, and locked up to such an excess of
// slip. The forces above are continuous there. (Except for cohesion, whose limit ends at this gap then.)
//
// A joint fails if it opens (by more than rounding), or if it slides and has friction or cohesion to lose: friction,
// cohesion and tensile strength fall to their residual values. Residual cohesion 0 is a brittle joint; residual
// strength equal to the strength is a perfectly plastic one, which never fails. Without cohesion there is no
// resistance to sliding under tension.
//
// In statics residual tensile strength yields: N = -T A beyond the gap T A / kn, at any gap (notes/plastic_tension.md).
// In motion such a point opens, and bonds again when it closes.
//
// With multipliers (augmented contact) N = lambda_n - kn g and the trial shear force is lambda_s - ks s. If the
// forces equal the multipliers, N > 0 implies g = 0, a locked point has s = 0 and the force of a sliding one is along
// -s: rigid contact. The springs serve for convergence only, so that they hold no energy.
//
// Cohesion ends at once when a joint opens. There may be no balance between the two forces, and rounding errors would
// decide the state. A bridged point keeps its cohesion across the gap until a balance shows that it has opened
// (solver/step/solve/open_close.hpp).
//
// Dilation (notes/dilation.md): slip p raises the rest gap of the normal spring by p tan(psi) at once:
//     N = -kn (g - p tan(psi)),    ks (|s| - p) = max(N, 0) tan(phi) + c A,    p >= 0
//
// With fracture energy strength falls gradually instead of failing (softened_point.hpp).
//
// With compressive strength f (notes/crushing.md) the normal force is at most P = f A. Compression beyond it is closure c
// that remains: the rest gap falls,
//     N = min(-kn g, P),    c = max(0, -g - P/kn),
// friction is that under N, and P c is dissipated. Such a point has a spring without multiplier, dashpot or dilation.
//
// A joint that stiffens as it closes (normal_spring.hpp, notes/joint_closure.md) has N(-g) of its curve in place of -kn g. It
// has a spring without multiplier, without tension and without compressive strength.
//
// A rough joint (rough_joint.hpp) has the bound tau(N / A) A in place of N tan(phi), also where N is a mean force.
//
// Damping (notes/joint_damping.md): a dashpot parallel to each spring, before the slider, while the point is closed.
// Without tensile strength it never makes N negative.
//
// With a held limit h the shear force is bounded by h + max(N, 0) tan(psi), also across an open gap: the forces are
// then the gradient of a convex function of (g, s), which does not exist for Coulomb's law.
#pragma once

#include <Eigen/Dense>
#include <limits>
#include <optional>

#include "mechanics/contact/laws/bond_damage.hpp"
#include "mechanics/contact/laws/normal_spring.hpp"
#include "mechanics/contact/laws/rough_joint.hpp"

namespace ashlar {

/// State of a contact point.
enum class ContactState {
  open,     ///< no force
  locked,   ///< normal and shear spring
  sliding,  ///< normal spring and friction force
};

/// Springs or multipliers, which transmit the force of a joint.
enum class Transmission {
  by_scene,     ///< multipliers in a scene that has them (SimulationSettings::augmented), otherwise springs
  springs,      ///< springs in any scene
  multipliers,  ///< rigid contact: as BlockSystem::law() decides, which never leaves it to the scene
};

/// Strength of a joint after failure.
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
  Transmission transmission = Transmission::by_scene;
  double rounding = 0.0;  ///< m, >= 0: rounding error of gaps and slips of the pair
  bool rigid = false;     ///< true: the springs represent rigid contact, not a joint of given stiffness
  double dilation = 0.0;  ///< tan(psi), 0 to the smallest friction: more would generate energy
  double damping = 0.0;   ///< >= 0, share of critical, of springs (ContactPair::damp)
  /// Strength of failed or never bonded surfaces; each value at most that above. Empty: `friction` only
  std::optional<ResidualStrength> residual = std::nullopt;
  /// Of each strength that is not zero, or of none. With it: area springs, without dilation, damping and multipliers,
  /// residual strength by friction only, and springs of more than least_bond_stiffness()
  FractureEnergy fracture = {};
  /// Normal velocity after an impact over that before, 0 to 1 (solver/step/impact/restitution.hpp). Empty: as springs,
  /// dashpots or multipliers have it
  std::optional<double> restitution = std::nullopt;
  /// Pa, > 0: plastic cap of normal pressure. In limit analysis solver/limit/crushing_joints.hpp
  double compressive_strength = std::numeric_limits<double>::infinity();
  /// m, > 0: `normal_stiffness` is that of the joint before it closes (NormalSpring). Without tensile strength,
  /// compressive strength and multipliers
  double largest_closure = std::numeric_limits<double>::infinity();
  /// With it: `friction` and the residual friction are those of the worn joint; area springs, no gradual damage, no
  /// compressive strength
  Roughness roughness = {};

  [[nodiscard]] bool has_multipliers() const { return transmission == Transmission::multipliers; }
  /// True if pressure has a plastic cap.
  [[nodiscard]] bool crushes() const {
    return compressive_strength < std::numeric_limits<double>::infinity();
  }
  /// True if friction is not proportional to pressure.
  [[nodiscard]] bool friction_varies() const { return roughness.given(); }
  [[nodiscard]] NormalSpring normal_spring() const { return {normal_stiffness, largest_closure}; }
  friend bool operator==(const JointLaw&, const JointLaw&) = default;
};

/// Dilation of a sliding point.
struct Dilation {
  double tangent = 0.0;  ///< tan(psi)
  /// Gap above the rest gap at the start of the step of an open point, m: it dilates in the share of the step in
  /// which it is closed, its gap linear in time. 0: it is closed at the start
  double landing_from = 0.0;
};

/// Damping forces over a step.
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
  double tension;                  ///< T A, N; infinity: failure disabled for this iteration
  double rounding = 0.0;           ///< of gaps and slips, m
  double held_limit = -1.0;        ///< N; >= 0: replaces the resistance by friction beyond dilation and by
                                   ///< cohesion
  bool bridged = false;            ///< cohesion acts in shear across an open gap too
  bool augmented = false;          ///< its forces become the next multipliers; its springs hold no energy
  double normal_multiplier = 0.0;  ///< lambda_n, N
  Eigen::Vector2d shear_multiplier = Eigen::Vector2d::Zero();  ///< lambda_s, N
  /// N, any sign: deferred friction of earlier impulses, added to the normal force in the bound of the shear force,
  /// at most doubling it
  double impulse_force = 0.0;
  /// Residual strength: friction tan(phi), cohesion and tension N
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();
  Dilation dilation = {};
  Dashpots dashpots = {};
  BondDamage bond = {};    ///< of a joint with fracture energy
  bool is_static = false;  ///< tensile strength that cannot fail yields instead of opening
  double crushing = std::numeric_limits<double>::infinity();  ///< f A, N: largest normal force
  PointRoughness roughness = {};
  double largest_closure = std::numeric_limits<double>::infinity();  ///< m; infinite: a linear spring

  /// True if tension is bounded by a plateau of the normal force.
  [[nodiscard]] bool yields() const { return is_static && tension > 0.0 && tension <= residual[2]; }
  /// True if pressure has a plastic cap.
  [[nodiscard]] bool crushes() const { return crushing < std::numeric_limits<double>::infinity(); }
  [[nodiscard]] NormalSpring normal_spring() const { return {normal_stiffness, largest_closure}; }
  /// True if its strength can fail.
  [[nodiscard]] bool weakens() const {
    return friction > residual[0] || cohesion > residual[1] || tension > residual[2];
  }
  /// True if sliding reduces its strength: tension alone does not resist sliding and is kept.
  [[nodiscard]] bool weakens_by_sliding() const { return friction > residual[0] || cohesion > residual[1]; }
  /// Sets the strength to its residual value.
  void fail() {
    friction = residual[0];
    cohesion = residual[1];
    tension = residual[2];
    bond = {};
  }
  /// Sets the damage of a bond with fracture energy at the start of a step, and the strength left.
  void set_damage(double damage);
  /// Resistance of the strength to sliding, N. @param normal N
  [[nodiscard]] double shear_strength(double normal) const;
  /// tan(phi) under a normal force, N.
  [[nodiscard]] double friction_at(double normal) const;
};

/// @param area tributary area of the point, m^2. @param intact false: with residual strength
/// @param damage of a joint with fracture energy, or wear of a rough one, at the start of the step, 0 to 1
[[nodiscard]] PointLaw point_law(const JointLaw& law, double area, bool intact, double damage = 0.0);

/// The law of joints that have failed, or have worn.
[[nodiscard]] JointLaw failed_law(JointLaw law);

// Friction that varies (JointLaw::friction_varies()) in limit analysis, whose cones have one coefficient.
/// Sets the coefficient under the present forces. The residual strength of a joint that does not wear has it too.
void set_mean_friction(JointLaw& law, double friction);
/// Force of friction of a part of a joint, N. @param area m^2, > 0. @param normal N, > 0
[[nodiscard]] double friction_of_part(const JointLaw& law, double area, double normal);
/// The least that it may be for a joint, N: where its forces act on an edge. @param normal N
[[nodiscard]] double least_friction(const JointLaw& law, double normal);

/// Unsymmetric part of -d force / d (g, s1, s2), missing from a symmetric tangent: force by'. With dilation
///   -d force / d (g, s) = k (1, -f e) (1, -tan(psi) e)' + rotation of the force,   e = s/|s|, f: derivative of the
///   limit by N
/// and the tangent has  k (1, -m e) (1, -m e)'  with m the smaller of both tangents.
struct Coupling {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N/m
  Eigen::Vector3d by = Eigen::Vector3d::UnitX();
};

/// Force of a point and its derivatives, in the frame (n, t1, t2) of the point. The force acts on a, its opposite on
/// b.
struct PointResponse {
  ContactState state;
  Eigen::Vector3d force;  ///< N
  Eigen::Matrix3d
      tangent;           ///< symmetric part of -d force / d (g, s1, s2), positive semi-definite; see Coupling
  double normal_energy;  ///< of the normal spring, J
  double shear_energy;   ///< of the shear spring, J
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  ///< unit, of the shear force of a sliding point
  Coupling coupling = {};  ///< of a point that slides under Coulomb's law, or softens; otherwise zero
  double dilation =
      0.0;  ///< increase of the rest gap in the step, m; negative: closure of a point that crushes
  double damped = 0.0;  ///< energy dissipated by the dashpots in the step, J
  Eigen::Vector2d shear_damped = Eigen::Vector2d::Zero();  ///< part of `force` due to the shear dashpot, N
  double damage = 0.0;  ///< of a bond with fracture energy at the end of the step, 0 to 1
  double slid = 0.0;    ///< slip of a rough joint in the step that remains, m
  /// Energy dissipated by damage in the step beside that of the shear force on permanent slip, or by crushing, J
  double fractured = 0.0;

  [[nodiscard]] double energy() const { return normal_energy + shear_energy; }
};

/// @param gap m; @param slip trial slip (2), m, as if locked
[[nodiscard]] PointResponse point_response(const PointLaw& law, double gap, const Eigen::Vector2d& slip);

/// Damage of a point at the end of a step, 0 to 1: of a bond with fracture energy, or wear of a rough joint.
/// @param start,end the law at both times: at the end strength may have been lost. @param before wear before the step
[[nodiscard]] double damage_after(const PointLaw& start, const PointLaw& end, const PointResponse& response,
                                  double before);

/// The normal force at a gap without slip, N; may be negative beyond the tensile strength.
[[nodiscard]] double trial_normal(const PointLaw& law, double gap);

/// Force and tangent that act over a step.
struct MeanResponse {
  Eigen::Vector3d force;    ///< N
  Eigen::Matrix3d tangent;  ///< N/m, by the end of the step, symmetric and positive semi-definite
  Coupling coupling;        ///< part of the Jacobian missing from the tangent
  double limit;             ///< force bounded by PointLaw::held_limit: 0 if the point is open
};
/// The response at the end of a step as the force over the step.
/// @param gap of that response, m
[[nodiscard]] MeanResponse end_response(const PointLaw& law, const PointResponse& end, double gap);

/// A step with mean forces.
struct AveragedStep {
  PointResponse end;  ///< tangent: of the normal force only
  MeanResponse mean;
};
/// Mean forces such that the work of contacts does not exceed the decrease of their energy. The work of the normal
/// force N is exactly the change of its spring's energy, also if the point opens or closes in the step (a discrete
/// gradient). The shear force is that of the spring at the middle of the step, s = e0 + (s1 - s0)/2 with e0 the
/// elastic slip at the start. It is bounded by friction under N and by cohesion c for the share w of the step in
/// which the point is closed (its gap linear in time; 1 if it is bridged):
///     F = -ks s  if that is within  L = N tan(phi) + w c,  else  F = -L s/|s|,
/// and the spring ends at e1 with  F = -ks (e0 + e1)/2. The dissipation is
///     -F . (s1 - s0) - ks (e1^2 - e0^2)/2 = -F . (s1 - s0 - e1 + e0) = 2 L (|s| - L/ks) >= 0
/// in sliding and zero in sticking. In full sliding friction is L for any forces at both ends, which alternate in
/// stiff contacts. When a point opens, its shear spring is lost. Augmented points, which have no energy, act with
/// their forces at the end.
/// With dashpots c over the step,  F = -ks (e0 + e1)/2 - c (e1 - e0).  With dilation N is the mean over a gap that
/// ends lower by p tan(psi), p = |s1 - s0 - e1 + e0|, so that its work exceeds that of its spring by N p tan(psi).
/// @param start at the start of the step. @param start_place,end_place gap and trial slip, m
[[nodiscard]] AveragedStep averaged_step(const PointLaw& law, const PointResponse& start,
                                         const Eigen::Vector3d& start_place,
                                         const Eigen::Vector3d& end_place);

/// Elastic slip reduced, in its direction, to what friction and cohesion resist under a normal force. Cohesion acts
/// across an open gap too: rounding must not decide which points at the surface keep their slip.
/// @param normal N, 0 if the gap is open
[[nodiscard]] Eigen::Vector2d borne_slip(const PointLaw& law, double normal, const Eigen::Vector2d& slip);

/// Elastic slip after a step with this trial slip: the spring of a sliding point stays at the limit. Augmented points
/// have none: multipliers hold them in place.
[[nodiscard]] Eigen::Vector2d elastic_slip(const PointLaw& law, const PointResponse& response,
                                           const Eigen::Vector2d& slip);

}  // namespace ashlar
