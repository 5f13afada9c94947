// The planes of a set of joints. Spacings and orientations are drawn by a generator defined by the C++ standard, and
// by formulas given here, so that a seed gives the same planes everywhere. The planes do not depend on the blocks for
// which they are requested.
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "geometry/cutting/cut_plane.hpp"

namespace ashlar {

/// Each random quantity of a seed has its own stream, independent of the others.
enum class RandomStream { spacing_above, spacing_below, orientation, persistence, points };

/// std::mt19937_64 seeded by std::seed_seq of the four numbers. @param number of a plane @param block its
/// index
[[nodiscard]] std::mt19937_64 random_stream(int seed, RandomStream stream, int number = 0, int block = 0);

/// A number between 0 and 1, both excluded: the upper 53 bits and a half.
[[nodiscard]] double random_share(std::mt19937_64& random);

/// A spacing, m, > 0. Normal (by Box and Muller; values <= 0 are drawn again), lognormal (with this mean and
/// deviation), uniform (of the width 2 sqrt(3) deviation) or exponential.
[[nodiscard]] double random_spacing(const SceneCut& cut, std::mt19937_64& random);

/// A direction scattered about a unit vector by Fisher's law: the angle t from it has
/// cos t = 1 + ln(u + (1 - u) exp(-2 k)) / k for a random share u.
[[nodiscard]] Vector3 scattered(const Vector3& mean, double fisher, std::mt19937_64& random);

struct JointPlane {
  int number;  ///< 0 goes through the cut's point; positive ones are above it, negative ones below
  CutPlane plane;
};

/// Range of heights above the cut's point, along its mean normal, for which planes are requested.
struct PlaneRange {
  double low = 0.0;   ///< m
  double high = 0.0;  ///< m
};

/// Number of planes in a range before they are computed; for random spacings the mean number.
[[nodiscard]] double estimate_planes(const SceneCut& cut, const PlaneRange& range);

/// A plane of a set before it is computed.
struct JointHeight {
  int number;     ///< as JointPlane's
  double height;  ///< m above the cut's point; without accumulated error for constant spacings
};

/// The heights of a cut's planes in several ranges. Planes are counted before they are listed. Random spacings are
/// drawn once for all ranges, up to the allowed number of planes.
class JointHeights {
 public:
  /// @param most planes in all ranges together, >= 0
  /// @throws CutError if the ranges are beyond most_drawn_spacings
  JointHeights(const SceneCut& cut, const std::vector<PlaneRange>& ranges, double most);
  /// Number of planes in all ranges; those in several ranges count several times. If too_many() random spacings, the
  /// number drawn so far.
  [[nodiscard]] double count() const { return count_; }
  [[nodiscard]] bool too_many() const { return too_many_; }
  /// Heights in increasing order. @param range one of the given ones. @pre not too_many()
  [[nodiscard]] std::vector<JointHeight> in(const PlaneRange& range) const;

 private:
  void draw_side(const std::vector<PlaneRange>& ranges, int sense, double most);
  /// Range of indices of planes drawn in a range.
  [[nodiscard]] std::pair<std::size_t, std::size_t> drawn_in(const PlaneRange& range) const;

  const SceneCut& cut_;
  std::vector<JointHeight> drawn_;  ///< increasing; for random spacings, in any of the ranges
  double count_ = 0.0;
  bool too_many_ = false;
};

/// Largest number of random spacings drawn successively from the cut's point to each side.
inline constexpr int most_drawn_spacings = 10000000;

/// A plane of discs, or of scattered orientation, has its centre as the point, without offset.
[[nodiscard]] JointPlane joint_plane(const SceneCut& cut, const JointHeight& at);

/// The planes of a cut in a range, in increasing order of height.
[[nodiscard]] std::vector<JointPlane> joint_planes(const SceneCut& cut, const PlaneRange& range);

}  // namespace ashlar
