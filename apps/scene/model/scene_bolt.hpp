// [[bolt]] and [[prop]]: support of a scene (scene.hpp).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_block.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// [[bolt]]: a bar through any number of blocks, or a row of them.
struct SceneBolt {
  enum class Anchorage {
    grouted,  ///< bonded to every block along its length
    ends,     ///< held at both ends only
  };
  /// pattern = { plane, spacing, length, direction }: bolts NAME.1 ... whose heads are on the faces in a plane
  struct Pattern {
    ScenePlane plane;  ///< its point is a head of a bolt; the normal points out of the rock
    std::array<double, 2> spacing = {
        0, 0};                         ///< m, > 0, horizontally and across that; a horizontal plane: x and y
    double length = 0.0;               ///< m, > 0
    std::optional<Vector3> direction;  ///< from the head on, any length; empty: against the normal
  };

  std::string name;                      ///< unique among bolts and props; required
  Vector3 from = Vector3::Zero();        ///< m, in the placed, undeformed blocks
  Vector3 to = Vector3::Zero();          ///< m, not `from`
  std::optional<Pattern> pattern;        ///< excludes `from` and `to`
  double area = 0.0;                     ///< m^2, > 0; required
  double young_modulus = 2.1e11;         ///< Pa, > 0
  std::optional<double> yield_force;     ///< N, > 0; empty: it does not yield
  std::optional<double> rupture_strain;  ///< > 0; empty: it does not break
  Anchorage anchored = Anchorage::grouted;
  double bond_stiffness = 0.0;  ///< N/m per m of grout, > 0; required if grouted, otherwise not allowed
  std::optional<double> bond_strength;   ///< N/m, > 0; empty: the grout does not slip
  double shear_stiffness = 0.0;          ///< N/m, >= 0, at each joint; only if grouted
  std::optional<double> shear_strength;  ///< N, > 0; empty: no limit
  double pretension = 0.0;               ///< N, >= 0, not above yield_force
  bool installed = true;                 ///< of one stage: false before the stage that installs it
  std::vector<std::string> removed;      ///< of one stage: names or globs removed since it was installed
};

/// [[prop]]: a strut between two points of blocks.
struct SceneProp {
  std::string name;                   ///< unique among bolts and props; required
  Vector3 from = Vector3::Zero();     ///< m, on or in a block as placed
  Vector3 to = Vector3::Zero();       ///< m, the same; not `from`
  double stiffness = 0.0;             ///< N/m, > 0; required
  std::optional<double> yield_force;  ///< N, > 0; empty: it does not yield
  bool tension = false;               ///< true: it also pulls
  bool installed = true;              ///< of one stage
  std::vector<std::string> removed;   ///< of one stage
};

}  // namespace ashlar
