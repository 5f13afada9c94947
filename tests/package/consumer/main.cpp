// Uses something of each installed layer, so that every library they need must be found and linked.
#include <cstdlib>
#include <iostream>

#include "geometry/polyhedron.hpp"
#include "geometry/shapes.hpp"
#include "mechanics/moments.hpp"

int main() {
  const ashlar::Polyhedron box(ashlar::make_box({0, 0, 0}, {1, 2, 3}));
  const double volume = ashlar::moments(box.mesh(), 0).front();
  std::cout << box.faces().size() << " faces, volume " << box.volume() << ", zeroth moment " << volume
            << '\n';
  const bool right = box.faces().size() == 6 && box.volume() == 6.0 && volume == 6.0;
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
