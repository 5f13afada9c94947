#include "geometry/solid/solid_location.hpp"

#include <optional>

#include "geometry/exact/direction_predicates.hpp"
#include "geometry/exact/rational_vector.hpp"

namespace ashlar {

namespace {

// By the parity of the crossings of the ray from p; empty if the ray meets an edge. Triangles with p on them are not
// crossed: the ray leaves them.
std::optional<bool> is_inside_along(const TriangleMesh& solid, const Vector3& p, const Vector3& direction,
                                    PredicateLadder& ladder) {
  const ContactDirection ray = ContactDirection::along({&direction});
  bool inside = false;
  for (const auto& [i, j, k] : solid.triangles) {
    const Vector3 &x = solid.points[i], &y = solid.points[j], &z = solid.points[k];
    // Seen along the ray, p is at the left or right of each side.
    int left = 0, right = 0;
    for (const auto& [from, to] : {std::pair(&x, &y), std::pair(&y, &z), std::pair(&z, &x)}) {
      const int turn = sign_turn(ray, *from, *to, p, ladder);
      left += turn > 0;
      right += turn < 0;
      if (left > 0 && right > 0) break;
    }
    if (left > 0 && right > 0) continue;
    if (left + right == 0) return std::nullopt;
    // The triangle is ahead if its plane is: p is on the side of the plane that the ray leaves.
    const int below = -sign_volume(x, p, y, z, ladder);
    if (below == 0) continue;
    if (left + right < 3) return std::nullopt;
    if (below == (left > 0 ? 1 : -1)) inside = !inside;
  }
  return inside;
}

}  // namespace

bool is_inside(const TriangleMesh& solid, const Vector3& p) {
  NumericRange range;
  for (const Vector3& x : solid.points)
    for (int i = 0; i < 3; ++i) range.include(x[i]);
  for (int i = 0; i < 3; ++i) range.include(p[i]);
  PredicateLadder ladder;
  ladder.open(range);
  // Directions (1, m, m^2) lie in few planes with any one edge, so that one that meets none is found soon.
  for (double m = 3.0;; ++m)
    if (const auto inside = is_inside_along(solid, p, {1.0, m, m * m}, ladder)) return *inside;
}

}  // namespace ashlar
