// The planes of a set of joints. Spacings and orientations are drawn by a generator that the C++ standard
// fixes, and by formulas given here, so that a seed means the same planes everywhere. Which planes there are
// does not depend on the blocks that they are asked for.
#pragma once

#include <random>
#include <utility>
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

/// A plane of a set before it is made.
struct JointHeight {
  int number;     ///< as JointPlane's
  double height;  ///< m over the cut's point; no error adds up where spacings do not deviate
};

/// The heights of a cut's planes in several ranges. Planes are counted before they are listed; spacings that deviate are
/// drawn once for all ranges, and not further than to the number that is allowed.
class JointHeights {
 public:
  /// @param most planes in all ranges together, >= 0
  /// @throws CutError if the ranges are beyond most_drawn_spacings
  JointHeights(const SceneCut& cut, const std::vector<PlaneRange>& ranges, double most);
  /// Planes of all ranges, one of several ranges as often; where too_many() of drawn spacings, as far as they were drawn.
  [[nodiscard]] double count() const { return count_; }
  [[nodiscard]] bool too_many() const { return too_many_; }
  /// From below. @param range one of those that were given. Not if there are too many
  [[nodiscard]] std::vector<JointHeight> in(const PlaneRange& range) const;

 private:
  void draw_side(const std::vector<PlaneRange>& ranges, int way, double most);
  /// Planes that were drawn in a range.
  [[nodiscard]] std::pair<std::size_t, std::size_t> drawn_in(const PlaneRange& range) const;

  const SceneCut& cut_;
  std::vector<JointHeight> drawn_;  ///< from below; of spacings that deviate, in any of the ranges
  double count_ = 0.0;
  bool too_many_ = false;
};

/// Random spacings are drawn one after the other from the cut's point, at most so many to each side.
inline constexpr int most_drawn_spacings = 10000000;

/// One of discs, or of scattered orientation, has its centre as the point, no offset.
[[nodiscard]] JointPlane joint_plane(const SceneCut& cut, const JointHeight& at);

/// The planes of a cut in a range, from below.
[[nodiscard]] std::vector<JointPlane> joint_planes(const SceneCut& cut, const PlaneRange& range);

}  // namespace ashlar
