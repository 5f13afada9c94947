#include "solver/ground/ground_wave.hpp"

namespace ashlar {

WaveVelocity components_of(const GroundWave& wave) {
  WaveVelocity result;
  for (std::size_t n = 0; n < wave.times.size(); ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result[axis].times.push_back(wave.times[n]);
      result[axis].values.push_back(wave.velocity[n][static_cast<Eigen::Index>(axis)]);
    }
  }
  return result;
}

History component_along(const GroundWave& wave, const Vector3& direction) {
  History history;
  for (std::size_t n = 0; n < wave.times.size(); ++n) {
    history.times.push_back(wave.times[n]);
    history.values.push_back(direction.dot(wave.velocity[n]));
  }
  return history;
}

}  // namespace ashlar
