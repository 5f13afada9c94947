#include "apps/scene/joint_planes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

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

JointPlane make_plane(const SceneCut& cut, int number, double height) {
  const Vector3 normal = plane_normal(cut.dip, cut.dip_direction);
  if (cut.fisher == 0.0 && !cut.radius) return {number, {normal, cut.point, height}};
  const Vector3 centre = cut.point + height * normal;
  if (cut.fisher == 0.0) return {number, {normal, centre}};
  std::mt19937_64 random = random_stream(cut.seed, RandomStream::orientation, number);
  return {number, {scattered(normal, cut.fisher, random), centre}};
}

/// Planes on one side at random distances from each other.
void add_side(const SceneCut& cut, const PlaneRange& range, int way, std::vector<JointPlane>& planes) {
  std::mt19937_64 random =
      random_stream(cut.seed, way > 0 ? RandomStream::spacing_above : RandomStream::spacing_below);
  const int limit = cut.number.value_or(std::numeric_limits<int>::max());
  double height = 0.0;
  for (int k = 1; k <= limit; ++k) {
    height += way * random_spacing(cut, random);
    if (way > 0 ? height > range.high : height < range.low) return;
    if (height >= range.low && height <= range.high) planes.push_back(make_plane(cut, way * k, height));
  }
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
    const double length = std::sqrt(-2.0 * std::log(random_share(random)));
    return length * std::cos(2.0 * std::numbers::pi * random_share(random));
  };
  switch (cut.law) {
    case SceneCut::Spacing::normal:
      for (;;) {
        const double spacing = mean + deviation * normal();
        if (spacing > 0.0) return spacing;
      }
    case SceneCut::Spacing::lognormal: {
      const double variance = std::log1p(deviation * deviation / (mean * mean));
      return mean * std::exp(std::sqrt(variance) * normal() - 0.5 * variance);
    }
    case SceneCut::Spacing::uniform:
      return mean + std::sqrt(3.0) * deviation * (2.0 * random_share(random) - 1.0);
    case SceneCut::Spacing::exponential:
      return -mean * std::log(random_share(random));
  }
  return mean;
}

Vector3 scattered(const Vector3& mean, double fisher, std::mt19937_64& random) {
  const double share = random_share(random);
  const double cosine =
      std::clamp(1.0 + std::log(share + (1.0 - share) * std::exp(-2.0 * fisher)) / fisher, -1.0, 1.0);
  const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
  const double turn = 2.0 * std::numbers::pi * random_share(random);
  const Vector3 across = mean.unitOrthogonal();
  return cosine * mean + sine * (std::cos(turn) * across + std::sin(turn) * mean.cross(across));
}

double estimate_planes(const SceneCut& cut, const PlaneRange& range) {
  const auto [first, last] = regular_numbers(cut, range);
  return std::max(0.0, last - first + 1.0);
}

std::vector<JointPlane> joint_planes(const SceneCut& cut, const PlaneRange& range) {
  std::vector<JointPlane> planes;
  if (cut.deviation == 0.0) {
    const auto [first, last] = regular_numbers(cut, range);
    for (double k = first; k <= last; ++k)
      planes.push_back(make_plane(cut, static_cast<int>(k), k * cut.spacing.value_or(0.0)));
    return planes;
  }
  add_side(cut, range, -1, planes);
  std::reverse(planes.begin(), planes.end());
  if (range.low <= 0.0 && range.high >= 0.0) planes.push_back(make_plane(cut, 0, 0.0));
  add_side(cut, range, 1, planes);
  return planes;
}

}  // namespace ashlar
