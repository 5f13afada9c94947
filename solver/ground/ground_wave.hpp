// A wave that comes from the ground behind a boundary, as the velocity of its motion over time.
#pragma once

#include <vector>

#include "mechanics/supports/quiet_faces.hpp"

namespace ashlar {

struct GroundWave {
  std::vector<double> times;      ///< s, increasing; empty: no wave
  std::vector<Vector3> velocity;  ///< m/s, at each time

  [[nodiscard]] bool empty() const { return times.empty(); }
};

/// Its components along x, y and z. Without rows if there is no wave.
[[nodiscard]] WaveVelocity components_of(const GroundWave& wave);

/// Its component along a direction, m/s. @param direction unit
[[nodiscard]] History component_along(const GroundWave& wave, const Vector3& direction);

}  // namespace ashlar
