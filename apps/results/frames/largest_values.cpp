#include "apps/results/frames/largest_values.hpp"

#include <Eigen/Eigenvalues>

namespace ashlar {
namespace {

void take(std::optional<PlacedValue>& largest, double value, int block, const Vector3& place) {
  if (value > (largest ? largest->value : 0.0)) largest = PlacedValue{value, block, place};
}

/// Largest magnitude of a principal strain of Hooke's law. @param principal stresses, Pa
double largest_strain(const Material& material, const Vector3& principal) {
  const Vector3 stress = (1.0 + material.poisson_ratio) * principal -
                         Vector3::Constant(material.poisson_ratio * principal.sum());
  return stress.cwiseAbs().maxCoeff() / material.young_modulus;
}

}  // namespace

LargestValues largest_values(const Simulation& simulation, const std::vector<DrawnSurface>& surfaces,
                             const std::vector<std::vector<Vector3>>& origin) {
  LargestValues largest;
  for (int b = 0; b < simulation.system().count(); ++b) {
    const auto index = static_cast<std::size_t>(b);
    const BlockModel& block = simulation.blocks()[index];
    if (block.fixed() || !simulation.system().present(b)) continue;
    const std::vector<PointMotion> motions =
        block.motions_of(simulation.states()[index], surfaces[index].points);
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const PointMotion& motion = motions[k];
      const Vector3 displacement =
          origin.empty() ? motion.displacement : Vector3(motion.displacement - origin[index][k]);
      take(largest.displacement, displacement.norm(), b, motion.place);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(motion.stress, Eigen::EigenvaluesOnly);
      take(largest.compression, -principal.eigenvalues()[0], b, motion.place);
      take(largest.tension, principal.eigenvalues()[2], b, motion.place);
      take(largest.strain, largest_strain(block.material(), principal.eigenvalues()), b, motion.place);
    }
  }
  return largest;
}

}  // namespace ashlar
