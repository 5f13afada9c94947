// Bonds in tension, whose openings exceed the distance within which contacts are searched, on one and on several ranks.
#include <random>

#include "support/shared_runs.hpp"

namespace ashlar::shared_bonds_test {
namespace {

using test_support::block_of;
using test_support::distance;
using test_support::End;
using test_support::fixed_box;
using test_support::owners_of;
using test_support::run_alone;
using test_support::run_shared;
using test_support::Scene;

/// A row of four bonded cubes of 2 t in flight at up to 1 m/s each: kn A / m is (158/s)^2, so that joints open by some
/// millimetres.
Scene row_of_cubes(unsigned seed, double contact_distance) {
  std::mt19937 random(seed);
  const auto number = [&] { return 2.0 * std::generate_canonical<double, 53>(random) - 1.0; };
  Scene scene;
  scene.law = {5e7, 2e7, 0.5, 0.0, 0.0, true};
  scene.law.cohesion = scene.law.tensile_strength = 1e12;
  scene.settings.gravity = Vector3::Zero();
  scene.settings.time_step = 5e-4;
  scene.settings.contact_distance = contact_distance;
  scene.blocks.push_back(fixed_box({-9, -9, -9}, {-8, -8, -8}));
  scene.motions.emplace_back();
  for (int k = 0; k < 4; ++k) {
    const Vector3 low(k, 0.0, 0.0);
    scene.blocks.push_back(block_of("cube", Polyhedron(make_box(low, low + Vector3::Ones())),
                                    {2000, 1e10, 0.2}, static_cast<int>(seed % 2)));
    scene.motions.push_back({{number(), 0.3 * number(), 0.3 * number()}, Vector3::Zero()});
  }
  return scene;
}

double widest_gap(const End& end) {
  double widest = 0.0;
  for (const PairRecord& pair : end.contacts)
    for (const ContactPoint& point : pair.points) widest = std::max(widest, point.gap);
  return widest;
}

TEST(SharedBonds, HoldBeyondTheContactDistanceOnAnyNumberOfRanks) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Scene scene = row_of_cubes(seed, 1e-4);
    const End wide = run_alone(row_of_cubes(seed, 2e-2), 60);
    const End alone = run_alone(scene, 60);
    EXPECT_GT(widest_gap(alone), 1e-3) << seed;
    // The distance of the search is no part of the law.
    EXPECT_LT(distance(wide, alone), 1e-7) << seed;
    for (const int ranks : {2, 3})
      EXPECT_LT(distance(alone, run_shared(scene, owners_of(scene, ranks), ranks, 60)), 1e-8) << seed;
  }
}

}  // namespace
}  // namespace ashlar::shared_bonds_test
