// Hertz's contact: a sphere pressed onto a rigid plane, as graded tied blocks.
//
// By symmetry a quarter of the lower half of the sphere suffices. Boxes around the contact point, in shells of seven
// with about twice the size of the last one, are cut to the sphere: polynomials of low order far from the contact, of
// high order in the one block with the contact patch. The sphere's surface in that block is a polyhedron with corners
// on the sphere; facets of side h are up to h^2/(8 R) inside it.
//
// Formulas (Hertz 1882), E* = E/(1 - nu^2):
//     a^3 = 3 F R/(4 E*)    approach = a^2/R    p(r) = p0 sqrt(1 - (r/a)^2),  p0 = 3 F/(2 pi a^2)
#pragma once

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Parameters of the problem and its division.
struct HertzSphere {
  double radius = 0.1;          ///< m
  double force = 1000.0;        ///< N
  double young_modulus = 70e9;  ///< Pa
  double poisson_ratio = 0.3;

  int shells = 6;
  double inner_size = 1.1e-3;  ///< m, side of the block with the contact patch: a little more than a
  int inner_order = 6;
  int near_order = 5;       ///< of the blocks around it
  int far_order = 3;        ///< of the others
  int facets = 6;           ///< along the sides of the inner block
  double stiffness = 2e15;  ///< Pa/m; compression of the springs p0/stiffness. Point springs: times the inner
                            ///< block's area over the corners of its facets, N/m
  bool area_springs = true;
  bool curved_surface = true;
  bool estimates = false;  ///< the error of the approach by the orders of blocks too

  [[nodiscard]] double contact_radius() const;  ///< a, m
  [[nodiscard]] double approach() const;        ///< m
  [[nodiscard]] double peak_pressure() const;   ///< p0, Pa
};

/// Results, for the whole sphere.
struct HertzContact {
  bool equilibrium = false;
  double force = 0.0;          ///< N, sum of the contact forces
  double radius = 0.0;         ///< m, of a circle of the area under pressure
  double approach = 0.0;       ///< m, of the sphere's center to the plane
  double peak_pressure = 0.0;  ///< Pa, from the force within a third of the formula's radius
  int unknowns = 0;
  double approach_error = 0.0;  ///< relative, estimated (goal_error.hpp)
};

/// The quarter of the sphere, block 0 with the contact patch, and the plane as the last block.
/// @throws std::runtime_error if the blocks cannot be tied
[[nodiscard]] Simulation sphere_on_plane(const HertzSphere& sphere);
/// Displacement of the sphere's center to the plane, m.
[[nodiscard]] double approach_of(const Simulation& simulation, const HertzSphere& sphere);

/// @throws std::runtime_error as sphere_on_plane
[[nodiscard]] HertzContact press(const HertzSphere& sphere);

}  // namespace ashlar
