// [contact] and [[joint]]: the laws between blocks of a scene (scene.hpp), and how contacts are found.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace ashlar {

/// The law between the faces of two blocks. Strengths default to none: a joint's strength has to be stated.
struct SceneJointLaw {
  std::optional<double> normal_stiffness;  ///< Pa/m (area springs) or N/m (point springs), > 0; empty: auto
  std::optional<double> shear_stiffness;   ///< as normal_stiffness
  double friction_angle = 0.0;             ///< deg, 0 to less than 90
  double cohesion = 0.0;                   ///< Pa, >= 0
  double tensile_strength = 0.0;           ///< Pa, >= 0
  /// Of what has failed, or touches later; at most the values above. Empty: friction_angle, no cohesion, none
  std::optional<double> friction_angle_residual, cohesion_residual, tensile_strength_residual;
  double dilation_angle = 0.0;  ///< deg, 0 to friction_angle and its residual value
  double damping = 0.0;         ///< share of critical, of the joint's springs, 0 to 1
  bool tied = false;            ///< bonded over the common face; a key of [[joint]] only

  [[nodiscard]] bool gives_stiffness() const { return normal_stiffness || shear_stiffness; }
};

/// [contact]
struct SceneContact {
  enum class Springs { area, point };
  enum class Surface { curved, flat };

  Springs springs = Springs::area;
  Surface surface = Surface::curved;
  SceneJointLaw law;                      ///< keys of the same names, for every pair without a [[joint]]
  std::optional<double> distance;         ///< m, > 0; empty: auto
  std::optional<double> angle;            ///< deg, 0 to 45; empty: auto
  std::optional<double> chord_tolerance;  ///< m, > 0; empty: auto, or subdivisions
  std::optional<int> subdivisions;        ///< uniform levels, 0 to 8; excludes chord_tolerance
  std::optional<bool> augmented;          ///< multipliers: no deeper than penetration_tolerance; empty: auto
  std::optional<double> penetration_tolerance;  ///< m, > 0; empty: auto
  std::optional<double> allowed_depth;          ///< m, > 0; empty: auto, 1e-2 of the smaller block
  double allowed_overlap = 0.0;  ///< m, >= 0: blocks that are placed so deep in each other start force-free
};

/// [[joint]]: what differs from [contact] between two blocks; the last entry that matches a pair wins, key by
/// key.
struct SceneJoint {
  std::array<std::string, 2> blocks;  ///< names or globs (* ? [...]), in any order; match at least one pair
  std::string cut;  ///< if not empty, only pairs that this [[cut]] has parted; blocks are then "*" by default
  bool of_glued_cut = false;  ///< it stands in no scene: a [[cut]] with `glued` ties what it has parted
  /// An outer empty optional: not given here. An inner empty one: given as "auto".
  std::optional<std::optional<double>> normal_stiffness;
  std::optional<std::optional<double>> shear_stiffness;
  std::optional<double> friction_angle;
  std::optional<double> cohesion;
  std::optional<double> tensile_strength;
  std::optional<double> friction_angle_residual, cohesion_residual, tensile_strength_residual;
  std::optional<double> dilation_angle, damping;
  std::optional<bool> tied;
};

}  // namespace ashlar
