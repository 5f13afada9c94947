// Which points of joints with restitution begin an impact, and which take part in it. The points of a face that turns
// down about an edge touch at one moment, near the edge at a small speed. The compression of springs lets some of them
// touch a little earlier than others, and the outline of the compressed part moves outwards: its points follow the motion
// and begin nothing (notes/restitution.md).
#pragma once

#include <vector>

#include "solver/step/impact/rigid_motions.hpp"

namespace ashlar {

/// Gap of the fastest point that takes part in an impact of others, of the largest one, at most: larger values let points
/// take part that are far from touching, smaller ones stop a face at a pivot inside it (notes/restitution.md).
inline constexpr double moment_over_gap = 10.0;

/// Limits of an impact.
struct ImpactLimits {
  double gap;      ///< largest of points that are about to touch, m
  double speed;    ///< that gravity gives in one and a half steps, m/s: slower points are at rest
  double rebound;  ///< that gravity takes in half a step, m/s: slower points do not rebound

  /// Largest gap of the fastest point that takes part in an impact of others, m.
  [[nodiscard]] double moment() const { return moment_over_gap * gap; }
};

[[nodiscard]] ImpactLimits limits_of(const SimulationSettings& settings, double time);

/// Fastest closing points of blocks.
class ClosingSpeeds {
 public:
  /// @param concerned pairs whose blocks matter, by index. Collective
  ClosingSpeeds(const BlockSystem& system, const std::vector<ContactPair>& pairs,
                const std::vector<std::size_t>& concerned, const ImpactLimits& limits, RigidMotions& motions);

  /// True if a point of a joint with restitution begins an impact. @param velocity apart, m/s
  [[nodiscard]] bool begins(const ContactPair& pair, std::size_t point, double velocity) const;
  /// True if a point takes part in an impact that others begin: it is closed, or will be within the moment.
  [[nodiscard]] bool takes_part(const ContactPair& pair, std::size_t point, double velocity) const;

 private:
  /// Of the blocks of a pair, m/s, >= 0.
  [[nodiscard]] double fastest_of(const ContactPair& pair) const;

  const BlockSystem& system_;
  ImpactLimits limits_;
  std::vector<double> fastest_;  ///< by block, m/s
};

}  // namespace ashlar
