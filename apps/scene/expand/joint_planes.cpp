#include "apps/scene/expand/joint_planes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "geometry/cutting/cut_error.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

/// Numbers of planes from one to another; none if the first is larger.
struct NumberSpan {
  double first, last;
};

NumberSpan regular_numbers(const SceneCut& cut, const PlaneRange& range) {
  const double limit = cut.number ? *cut.number : std::numeric_limits<double>::infinity();
  if (!cut.spacing) return {range.low <= 0.0 ? 0.0 : 1.0, range.high >= 0.0 ? 0.0 : -1.0};
  return {std::max(-limit, std::ceil(range.low / *cut.spacing)),
          std::min(limit, std::floor(range.high / *cut.spacing))};
}

/// Ranges in increasing order, overlapping ones joined.
std::vector<PlaneRange> joined(std::vector<PlaneRange> ranges) {
  std::sort(ranges.begin(), ranges.end(),
            [](const PlaneRange& a, const PlaneRange& b) { return a.low < b.low; });
  std::vector<PlaneRange> result;
  for (const PlaneRange& range : ranges) {
    if (result.empty() || range.low > result.back().high)
      result.push_back(range);
    else
      result.back().high = std::max(result.back().high, range.high);
  }
  return result;
}

/// Ranges of reversed heights: planes to the other side increase too.
std::vector<PlaneRange> reversed(const std::vector<PlaneRange>& ranges) {
  std::vector<PlaneRange> result;
  for (auto range = ranges.rbegin(); range != ranges.rend(); ++range)
    result.push_back({-range->high, -range->low});
  return result;
}

}  // namespace

std::mt19937_64 random_stream(int seed, RandomStream stream, int number, int block) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(stream),
                         static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(block)};
  return std::mt19937_64(sequence);
}

double random_share(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 11U) + 0.5) * 0x1p-53;
}

double random_spacing(const SceneCut& cut, std::mt19937_64& random) {
  const double mean = *cut.spacing, deviation = cut.deviation;
  const auto normal = [&] {
    const double length = std::sqrt(-2.0 * correctly_rounded::log(random_share(random)));
    return length * correctly_rounded::cos(2.0 * std::numbers::pi * random_share(random));
  };
  switch (cut.law) {
    case SceneCut::Spacing::normal:
      for (;;) {
        const double spacing = mean + deviation * normal();
        if (spacing > 0.0) return spacing;
      }
    case SceneCut::Spacing::lognormal: {
      const double variance = correctly_rounded::log1p(deviation * deviation / (mean * mean));
      return mean * correctly_rounded::exp(std::sqrt(variance) * normal() - 0.5 * variance);
    }
    case SceneCut::Spacing::uniform:
      return mean + std::sqrt(3.0) * deviation * (2.0 * random_share(random) - 1.0);
    case SceneCut::Spacing::exponential:
      return -mean * correctly_rounded::log(random_share(random));
  }
  return mean;
}

Vector3 scattered(const Vector3& mean, double fisher, std::mt19937_64& random) {
  const double share = random_share(random);
  const double cosine = std::clamp(
      1.0 + correctly_rounded::log(share + (1.0 - share) * correctly_rounded::exp(-2.0 * fisher)) / fisher,
      -1.0, 1.0);
  const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
  const double turn = 2.0 * std::numbers::pi * random_share(random);
  const Vector3 across = mean.unitOrthogonal();
  return cosine * mean +
         sine * (correctly_rounded::cos(turn) * across + correctly_rounded::sin(turn) * mean.cross(across));
}

double estimate_planes(const SceneCut& cut, const PlaneRange& range) {
  const auto [first, last] = regular_numbers(cut, range);
  return std::max(0.0, last - first + 1.0);
}

JointHeights::JointHeights(const SceneCut& cut, const std::vector<PlaneRange>& ranges, double most)
    : cut_(cut) {
  if (cut.deviation == 0.0) {
    for (const PlaneRange& range : ranges) count_ += estimate_planes(cut, range);
    too_many_ = count_ > most;
    return;
  }
  const std::vector<PlaneRange> all = joined(ranges);
  draw_side(reversed(all), -1, most);
  std::reverse(drawn_.begin(), drawn_.end());
  if (!too_many_ && std::any_of(all.begin(), all.end(), [](const PlaneRange& range) {
        return range.low <= 0.0 && range.high >= 0.0;
      }))
    drawn_.push_back({0, 0.0});
  draw_side(all, 1, most);
  for (const PlaneRange& range : ranges) {
    const auto [first, end] = drawn_in(range);
    count_ += static_cast<double>(end - first);
  }
  too_many_ = too_many_ || count_ > most;
}

void JointHeights::draw_side(const std::vector<PlaneRange>& ranges, int sense, double most) {
  std::mt19937_64 random =
      random_stream(cut_.seed, sense > 0 ? RandomStream::spacing_above : RandomStream::spacing_below);
  const int limit = cut_.number.value_or(std::numeric_limits<int>::max());
  double height = 0.0;
  auto range = ranges.begin();
  for (int k = 1; k <= limit && !too_many_; ++k) {
    height += random_spacing(cut_, random);
    while (range != ranges.end() && height > range->high) ++range;
    if (range == ranges.end()) return;
    if (k > most_drawn_spacings)
      throw CutError(
          fmt::format("more than {} spacings lie between its point and the blocks, a point that is "
                      "nearer to them, or a larger spacing, is needed",
                      most_drawn_spacings));
    if (height >= range->low) drawn_.push_back({sense * k, sense * height});
    too_many_ = static_cast<double>(drawn_.size()) > most;
  }
}

std::pair<std::size_t, std::size_t> JointHeights::drawn_in(const PlaneRange& range) const {
  const auto first = std::lower_bound(drawn_.begin(), drawn_.end(), range.low,
                                      [](const JointHeight& at, double low) { return at.height < low; });
  const auto end = std::upper_bound(first, drawn_.end(), range.high,
                                    [](double high, const JointHeight& at) { return high < at.height; });
  return {static_cast<std::size_t>(first - drawn_.begin()), static_cast<std::size_t>(end - drawn_.begin())};
}

std::vector<JointHeight> JointHeights::in(const PlaneRange& range) const {
  std::vector<JointHeight> heights;
  if (cut_.deviation > 0.0) {
    const auto [first, end] = drawn_in(range);
    for (std::size_t k = first; k < end; ++k) heights.push_back(drawn_[k]);
    return heights;
  }
  const auto [first, last] = regular_numbers(cut_, range);
  for (double k = first; k <= last; ++k)
    heights.push_back({static_cast<int>(k), k * cut_.spacing.value_or(0.0)});
  return heights;
}

JointPlane joint_plane(const SceneCut& cut, const JointHeight& at) {
  const Vector3 normal = plane_normal(cut.dip, cut.dip_direction);
  if (cut.fisher == 0.0 && !cut.radius) return {at.number, {normal, cut.point, at.height}};
  const Vector3 centre = cut.point + at.height * normal;
  if (cut.fisher == 0.0) return {at.number, {normal, centre}};
  std::mt19937_64 random = random_stream(cut.seed, RandomStream::orientation, at.number);
  return {at.number, {scattered(normal, cut.fisher, random), centre}};
}

std::vector<JointPlane> joint_planes(const SceneCut& cut, const PlaneRange& range) {
  std::vector<JointPlane> planes;
  const JointHeights heights(cut, {range}, std::numeric_limits<double>::infinity());
  for (const JointHeight& at : heights.in(range)) planes.push_back(joint_plane(cut, at));
  return planes;
}

}  // namespace ashlar
