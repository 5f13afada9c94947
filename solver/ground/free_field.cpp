#include "solver/ground/free_field.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "mechanics/basis/quadrature.hpp"
#include "solver/step/island/time_scheme.hpp"

namespace ashlar {
namespace {

double modulus(const Material& material, ColumnWave wave) {
  const double across = material.lame_mu();
  return wave == ColumnWave::across ? across : material.lame_lambda() + 2.0 * across;
}

/// Mass and stiffness of a column.
struct ColumnMatrices {
  Eigen::MatrixXd mass;       ///< kg/m^2
  Eigen::MatrixXd stiffness;  ///< Pa/m
};

ColumnMatrices matrices_of(const FreeFieldColumn& column, ColumnWave wave) {
  const auto size = static_cast<Eigen::Index>(column.nodes().size());
  ColumnMatrices result{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size)};
  for (std::size_t k = 0; k < column.layers().size(); ++k) {
    const GroundLayer& layer = column.layers()[k];
    const double thickness = layer.top - layer.bottom;
    const SegmentRule rule = gauss_legendre(layer.order + 1);
    const Eigen::Index count = layer.order + 1, first = column.first_node(k);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double height = layer.bottom + thickness * rule.points[q], weight = thickness * rule.weights[q];
      const Eigen::VectorXd values = column.values(k, height), slopes = column.slopes(k, height);
      result.mass.block(first, first, count, count) +=
          weight * layer.material.density * values * values.transpose();
      result.stiffness.block(first, first, count, count) +=
          weight * modulus(layer.material, wave) * slopes * slopes.transpose();
    }
  }
  return result;
}

/// State of a column.
struct ColumnState {
  Eigen::VectorXd displacement, velocity, acceleration;
};

/// One step after the other: the equation of time_scheme.hpp with w, m, D_free and v_d.
class ColumnSteps {
 public:
  /// @param resistance of the dashpot at the base, Pa s/m
  ColumnSteps(ColumnMatrices matrices, double resistance, const TimeScheme& scheme, bool carries_acceleration)
      : matrices_(std::move(matrices)),
        resistance_(resistance),
        scheme_(scheme),
        carries_acceleration_(carries_acceleration) {
    Eigen::MatrixXd system = scheme.inertia * matrices_.mass + scheme.force_weight * scheme.end_share *
                                                                   (1.0 + scheme.stiffness_share) *
                                                                   matrices_.stiffness;
    system(0, 0) += scheme.force_weight * scheme.dashpot_velocity.change * resistance;
    factor_.compute(system);
    if (carries_acceleration) mass_factor_.compute(matrices_.mass);
  }

  /// @param force (time) on the base, Pa
  template <class Force>
  void step(const Force& force, double start, double end, ColumnState& state) const {
    const auto& [u, v, a] = state;
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(u.size());
    const Eigen::VectorXd free = scheme_.free_change(still, v, a);
    const double carried = scheme_.dashpot_velocity(still, v, a)[0];
    Eigen::VectorXd smooth = -(matrices_.stiffness * u);
    smooth[0] += scheme_.smooth_force(force, start, end) - resistance_ * carried;
    const Eigen::VectorXd change =
        factor_.solve(scheme_.force_weight * smooth + scheme_.inertia * (matrices_.mass * free));
    const Eigen::VectorXd end_velocity = scheme_.end_velocity(change, v, a);
    if (carries_acceleration_) {
      smooth -= scheme_.end_share * (1.0 + scheme_.stiffness_share) * (matrices_.stiffness * change);
      smooth[0] -= resistance_ * scheme_.dashpot_velocity.change * change[0];
      const Eigen::VectorXd damped = scheme_.mass_damping * scheme_.damped_velocity(change, v, a);
      state.acceleration = scheme_.end_acceleration<Eigen::VectorXd>(mass_factor_.solve(smooth) - damped, a);
    }
    state.displacement += change;
    state.velocity = end_velocity;
  }

 private:
  ColumnMatrices matrices_;
  double resistance_;
  TimeScheme scheme_;
  bool carries_acceleration_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::LLT<Eigen::MatrixXd> mass_factor_;
};

}  // namespace

FreeFieldColumn::FreeFieldColumn(std::vector<GroundLayer> layers) : layers_(std::move(layers)) {
  if (layers_.empty()) throw std::invalid_argument("a column needs a layer");
  nodes_.push_back(layers_.front().bottom);
  for (const GroundLayer& layer : layers_) {
    first_.push_back(static_cast<int>(nodes_.size()) - 1);
    const SegmentRule rule = gauss_lobatto(layer.order + 1);
    for (std::size_t k = 1; k < rule.points.size(); ++k)
      nodes_.push_back(layer.bottom + (layer.top - layer.bottom) * rule.points[k]);
  }
}

std::size_t FreeFieldColumn::layer_at(double height) const {
  const auto above = std::find_if(layers_.begin(), layers_.end(),
                                  [&](const GroundLayer& layer) { return height < layer.top; });
  return above == layers_.end() ? layers_.size() - 1 : static_cast<std::size_t>(above - layers_.begin());
}

Eigen::VectorXd FreeFieldColumn::values(std::size_t layer, double height) const {
  const Eigen::Index count = layers_[layer].order + 1;
  const double* nodes = nodes_.data() + first_[layer];
  Eigen::VectorXd result = Eigen::VectorXd::Ones(count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      if (j != i) result[i] *= (height - nodes[j]) / (nodes[i] - nodes[j]);
  return result;
}

Eigen::VectorXd FreeFieldColumn::slopes(std::size_t layer, double height) const {
  const Eigen::Index count = layers_[layer].order + 1;
  const double* nodes = nodes_.data() + first_[layer];
  Eigen::VectorXd result = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index k = 0; k < count; ++k) {
      if (k == i) continue;
      double product = 1.0 / (nodes[i] - nodes[k]);
      for (Eigen::Index j = 0; j < count; ++j)
        if (j != i && j != k) product *= (height - nodes[j]) / (nodes[i] - nodes[j]);
      result[i] += product;
    }
  }
  return result;
}

ColumnMotion FreeFieldColumn::motion(ColumnWave wave, const History& velocity,
                                     const SimulationSettings& settings, double end_time) const {
  const Material& lowest = layers_.front().material;
  const double resistance = std::sqrt(lowest.density * modulus(lowest, wave));
  const double step = settings.time_step;
  const bool carries = settings.integrator == Integrator::generalized_alpha;
  const auto force = [&](double time) { return 2.0 * resistance * velocity.at(time); };
  const ColumnMatrices matrices = matrices_of(*this, wave);
  const auto size = static_cast<Eigen::Index>(nodes_.size());
  ColumnState state{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size)};
  if (carries) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(size);
    start[0] = force(0.0);
    state.acceleration = matrices.mass.llt().solve(start);
  }
  const ColumnSteps steps(matrices, resistance, time_scheme(settings, step), carries);
  const auto count = static_cast<Eigen::Index>(std::ceil(end_time / step)) + 1;
  ColumnMotion motion{{}, Eigen::MatrixXd::Zero(size, count), Eigen::MatrixXd::Zero(size, count)};
  for (Eigen::Index n = 0; n < count; ++n) {
    const double time = static_cast<double>(n) * step;
    if (n > 0) steps.step(force, static_cast<double>(n - 1) * step, time, state);
    motion.times.push_back(time);
    motion.displacement.col(n) = state.displacement;
    motion.velocity.col(n) = state.velocity;
  }
  return motion;
}

}  // namespace ashlar
