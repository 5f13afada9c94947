// The planes of a set of joints. Spacings and orientations are drawn by a generator that the C++ standard
// fixes, and by formulas given here, so that a seed means the same planes everywhere. Which planes there are
// does not depend on the blocks that they are asked for.
#pragma once

#include <random>
#include <vector>

#include "apps/scene/scene.hpp"
#include "geometry/cutting/cut_plane.hpp"

namespace ashlar {

/// What is drawn from a seed has a stream of its own, which nothing else that is drawn disturbs.
enum class RandomStream { spacing_above, spacing_below, orientation, persistence, points };

/// std::mt19937_64 seeded by std::seed_seq of the four numbers. @param number of a plane @param block its
/// index
[[nodiscard]] std::mt19937_64 random_stream(int seed, RandomStream stream, int number = 0, int block = 0);

/// A number between 0 and 1, both excluded: the upper 53 bits and a half.
[[nodiscard]] double random_share(std::mt19937_64& random);

/// A spacing, m, > 0. Normal (by Box and Muller; those <= 0 are drawn anew), lognormal (of this mean and
/// deviation), uniform (of the width 2 sqrt(3) deviation) or exponential.
[[nodiscard]] double random_spacing(const SceneCut& cut, std::mt19937_64& random);

/// A direction scattered about a unit vector by Fisher's law: the angle t from it has
/// cos t = 1 + ln(u + (1 - u) exp(-2 k)) / k for a random share u.
[[nodiscard]] Vector3 scattered(const Vector3& mean, double fisher, std::mt19937_64& random);

struct JointPlane {
  int number;  ///< 0 goes through the cut's point; positive ones are above it, negative ones below
  CutPlane plane;
};

/// Heights over the cut's point, along its mean normal, between which planes are wanted.
struct PlaneRange {
  double low = 0.0;   ///< m
  double high = 0.0;  ///< m
};

/// Number of planes in a range, before they are made; of drawn spacings the mean number.
[[nodiscard]] double estimate_planes(const SceneCut& cut, const PlaneRange& range);

/// The planes of a cut in a range, from below. Those of discs and of scattered orientation have their centre
/// as the point, no offset.
[[nodiscard]] std::vector<JointPlane> joint_planes(const SceneCut& cut, const PlaneRange& range);

}  // namespace ashlar
