// [contact] and [[joint]]: the laws between blocks of a scene (scene.hpp), and contact detection.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apps/scene/model/scene_region.hpp"
#include "mechanics/contact/laws/bond_damage.hpp"

namespace ashlar {

/// Strength of a tie that breaks: the cohesion and the tensile strength of a bond with the springs of a tie.
struct SceneTie {
  double tension = 0.0;  ///< Pa, > 0
  double shear = 0.0;    ///< Pa, > 0
};

/// Strength of the faces that a cut makes: a tie that breaks, with the springs of a tie.
struct SceneBond {
  double tensile_strength = 0.0;                  ///< Pa, > 0; required
  double cohesion = 0.0;                          ///< Pa, > 0; required
  std::optional<double> friction_angle;           ///< deg, of the bond and after it; empty: that of [contact]
  std::optional<FractureEnergy> fracture_energy;  ///< J/m^2, both > 0; empty: strength is lost at once
};

/// Roughness of a joint, whose friction_angle is that of the worn joint.
struct SceneRoughness {
  double jrc = 0.0;              ///< degrees, > 0, at most 20; required
  double jcs = 0.0;              ///< Pa, > 0; required
  std::optional<double> length;  ///< m, > 0: of the wall; empty: roughness does not wear
};

/// The law between the faces of two blocks. Default strengths are zero: a joint's strength must be stated.
struct SceneJointLaw {
  std::optional<double> normal_stiffness;  ///< Pa/m (area springs) or N/m (point springs), > 0; empty: auto
  std::optional<double> shear_stiffness;   ///< as normal_stiffness
  /// m, > 0: the joint stiffens from normal_stiffness on as it closes; empty: linear
  std::optional<double> maximum_closure;
  double friction_angle = 0.0;                 ///< deg, 0 to less than 90
  double cohesion = 0.0;                       ///< Pa, >= 0
  double tensile_strength = 0.0;               ///< Pa, >= 0
  std::optional<double> compressive_strength;  ///< Pa, > 0; empty: unlimited
  /// Strength of failed or later contacts; at most the values above. Empty: friction_angle, no cohesion, no tensile strength
  std::optional<double> friction_angle_residual, cohesion_residual, tensile_strength_residual;
  double dilation_angle = 0.0;  ///< deg, 0 to friction_angle and its residual value
  double damping = 0.0;         ///< share of critical, of the joint's springs, 0 to 1
  /// Outer optional empty: chosen by the program. Inner optional empty: as "springs" rebound. 0 to 1
  std::optional<std::optional<double>> restitution;
  std::optional<FractureEnergy> fracture_energy;  ///< J/m^2
  std::optional<SceneRoughness> roughness;        ///< empty: plane, Coulomb friction
  bool tied = false;            ///< bonded without limit over the common face; a key of [[joint]] only
  std::optional<SceneTie> tie;  ///< bonded up to a strength, which cohesion and tensile_strength hold too

  [[nodiscard]] bool gives_stiffness() const { return normal_stiffness || shear_stiffness; }
  /// True if springs transmit the force of the joint in a scene with multipliers too: the law has a given stiffness, or is
  /// one without multipliers. @param asked multipliers are asked for, in place of given stiffness
  [[nodiscard]] bool keeps_springs(bool asked) const {
    return tie || fracture_energy || compressive_strength || maximum_closure || (gives_stiffness() && !asked);
  }
};

/// [contact]
struct SceneContact {
  enum class Springs { area, point };
  enum class Surface { curved, flat };

  Springs springs = Springs::area;        ///< point with formulation = "paper"
  Surface surface = Surface::curved;      ///< flat with formulation = "incremental" or "paper"
  SceneJointLaw law;                      ///< keys of the same names, for pairs without a [[joint]]
  std::optional<double> distance;         ///< m, > 0; empty: auto
  std::optional<double> angle;            ///< deg, 0 to 45; empty: auto
  std::optional<double> chord_tolerance;  ///< m, > 0; empty: auto, or subdivisions
  std::optional<int> subdivisions;        ///< uniform levels, 0 to 8; excludes chord_tolerance
  std::optional<bool> augmented;          ///< multipliers: penetration up to penetration_tolerance; empty:
                                          ///< auto
  std::optional<double> penetration_tolerance;  ///< m, > 0; empty: auto
  std::optional<double> allowed_depth;          ///< m, > 0; empty: auto, 1e-2 of the smaller block
  double allowed_overlap = 0.0;  ///< m, >= 0: blocks with an initial overlap up to this start without force
};

/// [[joint]]: differences from [contact] between two blocks; the last matching entry has priority, key by key.
struct SceneJoint {
  std::array<std::string, 2> blocks;  ///< names or globs (* ? [...]), in any order; match at least one pair
  std::string cut;  ///< if not empty, only pairs divided by this [[cut]]; blocks are then "*" by default
  std::optional<SceneRegion> inside;  ///< only pairs with both blocks inside; blocks are then "*" by default
  bool made_by_cut = false;           ///< by the program, not by the scene: `glued` or `bonded` of a [[cut]]
  /// Outer optional empty: not given. Inner optional empty: given as "auto".
  std::optional<std::optional<double>> normal_stiffness;
  std::optional<std::optional<double>> shear_stiffness;
  std::optional<double> maximum_closure;
  std::optional<double> friction_angle;
  std::optional<double> cohesion;
  std::optional<double> tensile_strength;
  std::optional<double> compressive_strength;
  std::optional<double> friction_angle_residual, cohesion_residual, tensile_strength_residual;
  std::optional<double> dilation_angle, damping;
  std::optional<std::optional<double>> restitution;  ///< as of SceneJointLaw
  std::optional<FractureEnergy> fracture_energy;
  std::optional<SceneRoughness> roughness;
  std::optional<bool> tied;
  std::optional<SceneTie> tie;  ///< `tied` given as a table
};

}  // namespace ashlar
