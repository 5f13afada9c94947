// A scene as rigid bodies that touch at the corners of the overlaps of their faces: what limit analysis looks at.
//
// Blocks of any order are taken as they lie; those that are tied to each other are one body, and what supports leave of
// the rigid motions of its blocks is how it may move. Faces press on each other anywhere in their overlap, and forces
// at the corners of it have all the resultants that pressure of one sign over it can have, friction within the cone of
// its normal force included. Cohesion and tensile strength count by area and cannot gather in a corner: each part of an
// overlap bears them in its middle, with the resultants of a uniform stress on the part, so that no division into parts
// makes a joint stronger than it is.
//
// Places count that are no farther from each other than the contact distance: blocks that far apart come to bear by
// a motion that does not matter.
#pragma once

#include <vector>

#include "mechanics/contact/contact_kinematics.hpp"
#include "solver/state/run_state.hpp"
#include "solver/statics/cone_program.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// A place where two bodies bear on each other.
struct RigidPoint {
  std::array<int, 2> blocks;  ///< the first one's force is that of its ConePoint
  Vector3 place;              ///< m
  Eigen::Matrix3d frame;      ///< rows: normal out of the second block, two tangents
  double area = 0.0;          ///< m^2, of a part of an overlap; 0: a corner, or a single place
  JointLaw law;
  /// m, of FrictionAt::uniform_pressure: in the face, as near to the middle of the overlap as makes forces in its corners
  /// resist twisting as uniform pressure does (face_friction.hpp); of all but corners of faces `place`
  Vector3 friction_place;
  ContactPoint
      contact;  ///< that it comes from: of a part, a corner of its overlap. Normals out of its own second block
};

/// Blocks that move as one. The motion of a material point at x is  t + w x (x - middle)  with  (t, w) = motion y.
struct RigidBody {
  std::vector<int> blocks;
  double mass = 0.0;                 ///< kg
  Vector3 middle = Vector3::Zero();  ///< m, of gravity
  Eigen::Matrix<double, 6, 6> motion =
      Eigen::Matrix<double, 6, 6>::Zero();  ///< of each of its coordinates y, m/s
  int freedom = 6;                          ///< 1 to 6: columns of `motion` that are not zero
};

/// Units of the cone programme: masses, accelerations and forces over these.
struct RigidUnits {
  double mass = 1.0;
  double acceleration = 1.0;
  [[nodiscard]] double force() const { return mass * acceleration; }
};

struct RigidModel {
  std::vector<RigidBody> bodies;
  std::vector<int> body_of;        ///< by block; -1: it does not move
  std::vector<RigidPoint> points;  ///< in the order of the programme's points
  std::vector<ConePair> pairs;     ///< of bodies
  RigidUnits units;
  std::vector<BodyVelocity> steady;      ///< loads that are not multiplied, gravity included, in units
  std::vector<BodyVelocity> multiplied;  ///< the others
};

/// @param end_time of the loads, s. @param multiplied by block: whether its loads are multiplied; empty: none
/// @throws std::invalid_argument if a block is incremental
[[nodiscard]] RigidModel rigid_model(const BlockSystem& system, const RunState& state, double end_time,
                                     const std::vector<bool>& multiplied);

/// Where friction of the corners of faces acts: where their pressure does, or where it resists twisting as uniform pressure.
enum class FrictionAt { corners, uniform_pressure };

/// Its points in the programme, with the strengths of the joints.
[[nodiscard]] std::vector<ConePoint> cone_points(const RigidModel& model,
                                                 FrictionAt friction = FrictionAt::corners);
/// Its programme, with the strengths of the joints.
[[nodiscard]] ConeProgram program_of(const RigidModel& model, int threads,
                                     FrictionAt friction = FrictionAt::corners);

/// Of a point, with friction, cohesion and tensile strength divided by a factor. @param factor > 0
[[nodiscard]] ConeStrength strength_of(const RigidModel& model, const RigidPoint& point, double factor);

/// True if any load on a body is multiplied.
[[nodiscard]] bool multiplies_loads(const RigidModel& model);

/// True if any joint loses strength for good when it fails, which limit analysis knows nothing of.
[[nodiscard]] bool loses_strength(const RigidModel& model);

/// Forces of points as contacts of their pairs of blocks, lower block first. @param force N, by point, in its frame
[[nodiscard]] std::vector<PairRecord> contact_records(const RigidModel& model,
                                                      const std::vector<Eigen::Vector3d>& force);

/// Velocity or acceleration of a body's middle, and its rotation, from coordinates of the programme times a unit.
struct RigidMotionOf {
  Vector3 translation;
  Vector3 rotation;
};
[[nodiscard]] RigidMotionOf motion_of(const RigidBody& body, const BodyVelocity& coordinates);

}  // namespace ashlar
