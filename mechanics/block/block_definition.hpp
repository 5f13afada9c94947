// User definition of a block.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geometry/solid/polyhedron.hpp"
#include "mechanics/material/initial_stress.hpp"
#include "mechanics/material/material.hpp"
#include "mechanics/supports/loads.hpp"
#include "mechanics/supports/quiet_faces.hpp"
#include "mechanics/supports/supports.hpp"

namespace ashlar {

/// Coordinates of the polynomials of a block (theory.md section 1).
enum class Formulation {
  total,        ///< reference configuration throughout: rigid motion is exact
  incremental,  ///< configuration at the start of the step, as in the paper: kept as a baseline, see
                ///< incremental_block.hpp
};

/// A block before its model is built.
struct BlockDefinition {
  std::string name;
  std::shared_ptr<const Polyhedron> solid;  ///< placed reference shape, m
  /// The solid before it was translated, m, see block_parts.hpp; null: the solid
  std::shared_ptr<const Polyhedron> shape = nullptr;
  Material material;
  int order = 1;       ///< of the polynomial of its motion; 0: rigid, see rigid_body.hpp
  bool fixed = false;  ///< never moves, has no unknowns; material is not used
  std::vector<BlockSupport> supports;
  std::vector<Load> loads;
  /// Stress in the placed block; empty: none. Rigid and fixed blocks have no stress
  StressField initial_stress = nullptr;
  std::vector<QuietFaces> quiet = {};
  bool released = false;  ///< quiet faces have dashpots; false: they are held

  /// Fixed blocks are total for any value.
  Formulation formulation = Formulation::total;
  // For the incremental formulation only:
  int sub_face_levels = 2;        ///< 0 to 8, uniform levels of the fixed division of a block of order >= 2
  std::vector<Vector3> followed;  ///< material points besides those of the sub-faces whose motion is
                                  ///< requested
};

}  // namespace ashlar
