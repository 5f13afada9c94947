// The ground beside a model: a column of layers that a wave moves from below, alone.
//
// Along its axis z the column has the displacement u(z, t) of one component: along the axis (P wave, modulus
// G = lambda + 2 mu) or across it (S wave, G = mu). Its top is free. Its base has a dashpot with the resistance
// Z = sqrt(rho G) of the lowest layer, and a wave of velocity w(t) that enters there (quiet_faces.hpp):
//   integral of (rho u'' phi + G u_z phi_z) dz = Z (2 w - u') phi  at the base.
// A layer is one element: a polynomial of the order of the blocks beside it. The equations are solved by the scheme of
// the run (time_scheme.hpp), its damping of mass and stiffness included, so that model and column have the same errors
// in time.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/material/material.hpp"
#include "mechanics/supports/loads.hpp"
#include "solver/settings.hpp"

namespace ashlar {

/// A layer of the column.
struct GroundLayer {
  double bottom = 0.0;  ///< m, along the axis
  double top = 0.0;     ///< m, > bottom
  Material material;
  int order = 1;  ///< of the polynomial, >= 1
};

/// Direction of motion of a wave along the axis of a column.
enum class ColumnWave {
  along,   ///< P
  across,  ///< S
};

/// Motion of the nodes of a column over time.
struct ColumnMotion {
  std::vector<double> times;     ///< s, from 0 in steps of the run, to its end or beyond
  Eigen::MatrixXd displacement;  ///< (nodes, times), m
  Eigen::MatrixXd velocity;      ///< the same, m/s
};

class FreeFieldColumn {
 public:
  /// @param layers from the base up, each on the one before. @throws std::invalid_argument without layers
  explicit FreeFieldColumn(std::vector<GroundLayer> layers);

  [[nodiscard]] const std::vector<GroundLayer>& layers() const { return layers_; }
  /// Heights of the nodes from the base up, m. Layers share the nodes between them.
  [[nodiscard]] const std::vector<double>& nodes() const { return nodes_; }
  /// First node of a layer, which has `order + 1` nodes.
  [[nodiscard]] int first_node(std::size_t layer) const { return first_[layer]; }
  /// Layer at a height: the nearest of those beside it.
  [[nodiscard]] std::size_t layer_at(double height) const;
  /// Values of the functions of a layer's nodes at a height, and their derivatives, 1/m. @return (order + 1)
  [[nodiscard]] Eigen::VectorXd values(std::size_t layer, double height) const;
  [[nodiscard]] Eigen::VectorXd slopes(std::size_t layer, double height) const;

  /// Motion from rest. @param velocity w(t), m/s. @param settings integrator, time_step and damping
  /// @param end_time s, > 0
  [[nodiscard]] ColumnMotion motion(ColumnWave wave, const History& velocity,
                                    const SimulationSettings& settings, double end_time) const;

 private:
  std::vector<GroundLayer> layers_;
  std::vector<double> nodes_;
  std::vector<int> first_;
};

}  // namespace ashlar
