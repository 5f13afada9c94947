// A scene as rigid bodies in contact at the corners of the overlaps of their faces: the model of limit analysis.
//
// Blocks of any order are used at their present positions. Blocks tied to each other are one body, whose freedom is
// the rigid motions allowed by all its supports. Pressure acts anywhere in the overlap of two faces. Forces at its
// corners have all resultants of a pressure of one sign, including friction within the cone of its normal force.
// Cohesion and tensile strength are per area and cannot be concentrated in a corner: each part of an overlap
// transmits them at its centroid, with the resultants of a uniform stress on the part. So no division into parts
// makes a joint stronger than it is. Joints with a compressive strength have sub-areas in place of corners
// (crushing_joints.hpp).
//
// Places with gaps up to the contact distance are included: the motion that closes such a gap is negligible.
//
// Bolts, cables and props that are installed add points, and bars with slipping grout bodies (rigid_bolts.hpp).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mechanics/contact/contact_kinematics.hpp"
#include "solver/block_pair.hpp"
#include "solver/limit/cone_program.hpp"
#include "solver/state/run_state.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// A force of a bar: along it where it crosses from one body into another one, of its grout in a body, or across it.
enum class BarPart { axial, bond, dowel };
/// Place and strength of a force of a bar (rigid_bolts.hpp).
struct BarPoint {
  int bolt;   ///< of the run
  int piece;  ///< axial, dowel: before the crossing; bond: the first one in the body
  BarPart part;
  double tension;      ///< N, >= 0, along row 0 of the frame; infinite: no bound
  double compression;  ///< N, the same
  double shear;        ///< N, >= 0, along rows 1 and 2
};

/// A sub-area of a joint that crushes: a triangle, whose pressure acts at the point (crushing_joints.hpp).
struct CrushingPart {
  std::array<Vector3, 3> corners;  ///< m
  Vector3 middle;                  ///< m, of the overlap, towards which friction is moved
  double friction_share = 1.0;     ///< of the distance from there that remains

  /// Place of friction of pressure at a place, as RigidPoint::friction_place.
  [[nodiscard]] Vector3 friction_place(const Vector3& place) const {
    return middle + friction_share * (place - middle);
  }
};

/// Elastic stiffness of a point, of models with springs.
struct PointSpring {
  double normal = 0.0;   ///< N/m, along row 0 of the frame
  double shear = 0.0;    ///< N/m, along rows 1 and 2
  double initial = 0.0;  ///< N, along row 0: pretension of a bar, negative
};

/// A place of contact between two bodies, or of a force of a bar.
struct RigidPoint {
  BlockPair blocks;  ///< the first one's force is that of its ConePoint
  std::array<int, 2> bodies = {
      -1, -1};            ///< of both; -1: fixed. Bars: of the bar instead of its block, where it slips
  Vector3 place;          ///< m
  Eigen::Matrix3d frame;  ///< rows: normal out of the second block, two tangents
  double area = 0.0;      ///< m^2, of a part of an overlap, or tributary area of a spring; 0: a corner, or a
                          ///< single place
  JointLaw law;
  /// m, for FrictionAt::uniform_pressure: moved in the face towards the centroid of the overlap, so that corner
  /// forces resist twisting as uniform pressure does (face_friction.hpp). Equal to `place` except for corners of
  /// faces
  Vector3 friction_place;
  ContactPoint
      contact;  ///< origin of the point; for a part, a corner of its overlap. Normals out of its own second
                ///< block
  std::optional<BarPoint> bar =
      std::nullopt;  ///< of a bar: rows of the frame without a force are zero. Empty: a contact
  PointSpring spring = {};
  std::optional<CrushingPart> part = std::nullopt;  ///< of a joint that crushes; empty: any other point
};

/// Blocks that move as one. The velocity of a material point at x is  t + w x (x - middle)  with  (t, w) = motion y.
struct RigidBody {
  std::vector<int> blocks;           ///< empty: the bar of a bolt, along which it moves
  double mass = 0.0;                 ///< kg
  Vector3 middle = Vector3::Zero();  ///< m, centre of gravity
  Eigen::Matrix<double, 6, 6> motion =
      Eigen::Matrix<double, 6, 6>::Zero();  ///< by each of its coordinates y, m/s
  int freedom = 6;                          ///< 1 to 6: number of nonzero columns of `motion`
};

/// Units of the cone programme for masses, accelerations and forces.
struct RigidUnits {
  double mass = 1.0;
  double acceleration = 1.0;
  [[nodiscard]] double force() const { return mass * acceleration; }
};

struct RigidModel {
  std::vector<RigidBody> bodies;   ///< bars after all others
  std::vector<int> body_of;        ///< by block; -1: fixed
  std::vector<RigidPoint> points;  ///< in the order of the programme's points
  std::vector<ConePair> pairs;     ///< of bodies
  RigidUnits units;
  std::vector<BodyVelocity> steady;      ///< loads without factor, gravity included, in units
  std::vector<BodyVelocity> multiplied;  ///< loads with factor, in units
  bool has_residual_strength = false;    ///< keep_residual_strength() has changed a joint
  std::vector<RigidPoint> areas;         ///< overlaps in triangles, of joints whose points are their corners
};

/// Points of a model.
enum class RigidPointKind {
  limit,  ///< corners of overlaps, and their parts where they have cohesion or tensile strength: for programmes
  springs  ///< quadrature of area springs with the corners included (affine_rule()): for load_path.hpp
};

/// @param end_time of the loads, s. @param multiplied by block: true if its loads get a factor; empty: none
/// @throws std::invalid_argument if a block is incremental
[[nodiscard]] RigidModel rigid_model(const BlockSystem& system, const RunState& state, double end_time,
                                     const std::vector<bool>& multiplied,
                                     RigidPointKind kind = RigidPointKind::limit);

/// Place of friction for corners of faces: that of their pressure, or one that resists twisting as uniform pressure
/// does.
enum class FrictionAt { corners, uniform_pressure };

/// Sets the points of a model, sorted by their two bodies, and its pairs.
void set_points(RigidModel& model, std::vector<RigidPoint> points);

/// Its points in the programme, with the strengths of the joints.
[[nodiscard]] std::vector<ConePoint> cone_points(const RigidModel& model,
                                                 FrictionAt friction = FrictionAt::corners);
/// Its programme, with the strengths of the joints.
[[nodiscard]] ConeProgram program_of(const RigidModel& model, int threads,
                                     FrictionAt friction = FrictionAt::corners);

/// Number of bodies that are blocks, the first ones.
[[nodiscard]] std::size_t loaded_bodies(const RigidModel& model);

/// By point: true if it is no bar, and of a joint of two blocks that is chosen.
[[nodiscard]] std::vector<bool> reduced_points(const RigidModel& model,
                                               const std::function<bool(int, int)>& reduced);

/// Convex part of the law of a joint in a programme (pulled_joints.hpp).
enum class JointUse {
  pressed,  ///< all friction, tension up to cohesion / friction
  pulled,   ///< all tensile strength, friction up to cohesion / tension
  either    ///< a set that contains both, and exceeds the law: not for results
};

/// Strength of a point, with friction, cohesion, tensile and compressive strength of a joint divided by a factor,
/// but not the strength of a bar. Springs have the law of joint_law.hpp. @param factor > 0
[[nodiscard]] ConeStrength strength_of(const RigidModel& model, const RigidPoint& point, double factor,
                                       JointUse use = JointUse::pressed);

/// True if any load on a body is multiplied.
[[nodiscard]] bool multiplies_loads(const RigidModel& model);

/// True if any joint loses strength permanently when it fails, which limit analysis does not represent.
[[nodiscard]] bool loses_strength(const RigidModel& model);

/// Gives joints that lose strength the strength that they keep: limits are then on the safe side.
void keep_residual_strength(RigidModel& model);

/// Forces of points in N. @param force by point, in units of the model
[[nodiscard]] std::vector<Eigen::Vector3d> in_newtons(const RigidModel& model,
                                                      std::vector<Eigen::Vector3d> force);

/// Forces of points as contacts of their pairs of blocks, lower block first. @param force N, by point, in its frame
/// @param divided by point: true if its strength is divided by the factor, which decides what slides; empty: none is
[[nodiscard]] std::vector<PairRecord> contact_records(const RigidModel& model,
                                                      const std::vector<Eigen::Vector3d>& force,
                                                      const std::vector<bool>& divided = {},
                                                      double factor = 1.0);

/// Velocity or acceleration of a body's centroid, and its rotation, from coordinates of the programme times a unit.
struct RigidMotionOf {
  Vector3 translation;
  Vector3 rotation;
};
[[nodiscard]] RigidMotionOf motion_of(const RigidBody& body, const BodyVelocity& coordinates);

}  // namespace ashlar
