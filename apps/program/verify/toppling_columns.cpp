#include "apps/program/verify/toppling_columns.hpp"

namespace ashlar {

void add_toppling_columns(ContactScene& scene) {
  // A face that rises towards positive x'.
  const Placement raised{slope(-30)};
  double height = 0.0;
  for (int n = 1; n <= 16; ++n) {
    height += n <= 10 ? 4.0 : -6.2;
    const double x = 10.0 * (n - 1), base = n - 1.0;
    scene.add_fixed(placed(Polyhedron(make_box({x, -5, base - 5}, {x + 10, 15, base})), raised));
    scene.add(define_block(placed(Polyhedron(make_box({x, 0, base}, {x + 10, 10, base + height})), raised),
                           {25e3 / 9.81, 1e10, 0.2}, 1));
  }
}

}  // namespace ashlar
