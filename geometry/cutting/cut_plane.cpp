#include "geometry/cutting/cut_plane.hpp"

#include "geometry/exact/degree_turn.hpp"

namespace ashlar {

Vector3 plane_normal(double dip, double dip_direction) {
  const DegreeTurn down = degree_turn(dip), around = degree_turn(dip_direction);
  return Vector3(down.sine * around.sine, down.sine * around.cosine, down.cosine) + Vector3::Zero();
}

}  // namespace ashlar
