#include "apps/scene/expand/scene_cutter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/expand/random_points.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "geometry/cutting/small_pieces.hpp"

namespace ashlar {
namespace {

/// Planes are numbered in double and stored as int.
constexpr double largest_plane_number = 1e9;
/// Each plane is examined, also if it cuts nothing by chance. This many are always allowed; in a scene that may have
/// more blocks as many as blocks, up to a list of 160 MB.
constexpr double least_plane_limit = 1e5, greatest_plane_limit = 1e7;

double most_planes(const SceneCut& cut) {
  return std::clamp(static_cast<double>(cut.most_blocks), least_plane_limit, greatest_plane_limit);
}

bool matches_any(const std::vector<std::string>& patterns, const std::string& name) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return pattern_matches(pattern, name); });
}

/// The solid of a cut, placed.
std::optional<Polyhedron> build_cut_solid(const Scene& scene, std::size_t index, Diagnostics& diagnostics) {
  Scene alone;
  alone.file = scene.file;
  alone.block.emplace_back().shape = scene.cut[index].solid;
  const std::string prefix = fmt::format("cut.{}.solid", index);
  for (const auto& [key, places] : scene.places.all())
    if (key.starts_with(prefix)) alone.places.record("block.0" + key.substr(prefix.size()), places);
  return std::move(build_solids(alone, diagnostics).front());
}

/// Half the diagonal of the pieces: extent of tilted planes.
double reach_of(const CutSolid& solid, const std::vector<int>& pieces) {
  Vector3 low = Vector3::Zero(), high = low;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::numeric_limits<double>::infinity();
    high[axis] = -low[axis];
    for (const int piece : pieces) {
      const auto [least, most] = solid.extent(piece, {Vector3::Unit(axis), Vector3::Zero()});
      low[axis] = std::min(low[axis], least);
      high[axis] = std::max(high[axis], most);
    }
  }
  return 0.5 * (high - low).norm();
}

/// Pieces made by a cut belong to it like the initial ones.
template <class Target>
CutSolid::Choice choice_of(const Target& target) {
  return [&target](int piece) {
    return piece > target.newest || std::binary_search(target.pieces.begin(), target.pieces.end(), piece);
  };
}

}  // namespace

std::vector<std::string> piece_names(const std::string& block, const CutSolid& solid) {
  const std::vector<int> pieces = solid.pieces();
  if (pieces.size() == 1 && solid.label(pieces[0]) == 0) return {block};
  std::vector<std::string> names;
  int outside = 0, inside = 0;
  for (const int piece : pieces)
    names.push_back(solid.label(piece) == 0 ? fmt::format("{}.{}", block, ++outside)
                                            : fmt::format("{}.inside.{}", block, ++inside));
  return names;
}

SceneCutter::SceneCutter(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                         Diagnostics& diagnostics)
    : scene_(scene), shapes_(solids), diagnostics_(diagnostics) {
  rock_.solids.resize(scene.block.size());
  rock_.glued.assign(scene.cut.size(), 0);
}

void SceneCutter::error(std::size_t cut, const char* key, std::string message) {
  diagnostics_.error(scene_.places.value(fmt::format("cut.{}{}{}", cut, *key == '\0' ? "" : ".", key)),
                     std::move(message));
}

CutSolid& SceneCutter::solid_of(std::size_t block) {
  if (!rock_.solids[block]) rock_.solids[block].emplace(*shapes_[block]);
  return *rock_.solids[block];
}

std::vector<SceneCutter::Target> SceneCutter::targets_of(const SceneCut& cut) {
  std::vector<Target> targets;
  for (std::size_t k = 0; k < scene_.block.size(); ++k) {
    if (!shapes_[k]) continue;
    const std::string& name = scene_.block[k].name;
    const bool whole = matches_any(cut.blocks, name);
    if (!whole && !rock_.solids[k]) continue;
    const CutSolid& solid = solid_of(k);
    const std::vector<std::string> names = piece_names(name, solid);
    const std::vector<int> pieces = solid.pieces();
    Target target{k, {}, *std::max_element(pieces.begin(), pieces.end())};
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (whole || matches_any(cut.blocks, names[i])) target.pieces.push_back(pieces[i]);
    std::sort(target.pieces.begin(), target.pieces.end());
    if (!target.pieces.empty()) targets.push_back(std::move(target));
  }
  return targets;
}

int SceneCutter::add_mark(std::size_t cut, int plane) {
  rock_.marks.push_back({cut, plane});
  return static_cast<int>(rock_.marks.size()) - 1;
}

bool SceneCutter::check_number(std::size_t index, double added) {
  double blocks = added;
  for (const auto& solid : rock_.solids) blocks += solid ? static_cast<double>(solid->pieces().size()) : 1.0;
  const SceneCut& cut = scene_.cut[index];
  if (blocks <= cut.most_blocks) return true;
  error(index, cut.kind == SceneCut::Kind::voronoi ? "voronoi" : "spacing",
        fmt::format(
            "cut \"{}\" makes too many blocks (about {:.3g} in the scene), at most most_blocks = {} are "
            "allowed",
            cut.name, blocks, cut.most_blocks));
  return false;
}

PlaneRange SceneCutter::range_of(const SceneCut& cut, const Target& target) {
  const CutPlane base{plane_normal(cut.dip, cut.dip_direction), cut.point};
  PlaneRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const CutSolid& solid = solid_of(target.block);
  for (const int piece : target.pieces) {
    const auto [least, most] = solid.extent(piece, base);
    range = {std::min(range.low, least), std::max(range.high, most)};
  }
  const double reach = cut.fisher > 0.0 ? reach_of(solid, target.pieces) : 0.0;
  return {range.low - reach, range.high + reach};
}

void SceneCutter::cut_by_set(std::size_t index, const std::vector<Target>& targets) {
  const SceneCut& cut = scene_.cut[index];
  const CutPlane base{plane_normal(cut.dip, cut.dip_direction), cut.point};
  double added = 0.0;
  std::vector<PlaneRange> ranges;
  for (const Target& target : targets) {
    ranges.push_back(range_of(cut, target));
    for (const int piece : target.pieces) {
      const auto [low, high] = solid_of(target.block).extent(piece, base);
      added += cut.persistence * estimate_planes(cut, {low, high});
    }
  }
  if (!check_number(index, added)) return;
  if (!check_distance(index, ranges)) return;
  const JointHeights heights(cut, ranges, most_planes(cut));
  if (!check_planes(index, heights)) return;
  for (std::size_t k = 0; k < targets.size(); ++k) cut_by_planes(index, targets[k], heights.in(ranges[k]));
}

bool SceneCutter::check_distance(std::size_t index, const std::vector<PlaneRange>& ranges) {
  const SceneCut& cut = scene_.cut[index];
  const bool drawn = cut.deviation > 0.0;
  const double most = drawn ? most_drawn_spacings : largest_plane_number;
  if (!cut.spacing || (drawn ? cut.number.value_or(most) < most : cut.number.has_value())) return true;
  for (const PlaneRange& range : ranges) {
    const double farthest = std::max(std::abs(range.low), std::abs(range.high));
    if (farthest / *cut.spacing < most) continue;
    error(
        index, "point",
        fmt::format("point is too far from the blocks for this spacing ({:.3g} m), less than {:.0e} spacings "
                    "are allowed",
                    farthest, most));
    return false;
  }
  return true;
}

bool SceneCutter::check_planes(std::size_t index, const JointHeights& heights) {
  if (!heights.too_many()) return true;
  const SceneCut& cut = scene_.cut[index];
  error(
      index, "spacing",
      fmt::format("cut \"{}\" has too many planes ({} {:.6g}), at most {:.0f} are allowed, or most_blocks if "
                  "that is more, up to {:.0f}; a larger spacing is needed",
                  cut.name, cut.deviation > 0.0 ? "at least" : "about", heights.count(), most_planes(cut),
                  greatest_plane_limit));
  return false;
}

void SceneCutter::cut_by_planes(std::size_t index, const Target& target,
                                const std::vector<JointHeight>& heights) {
  const SceneCut& cut = scene_.cut[index];
  CutSolid& solid = solid_of(target.block);
  const CutSolid::Choice chosen = choice_of(target);
  for (const JointHeight& at : heights) {
    const auto& [number, plane] = joint_plane(cut, at);
    std::mt19937_64 random =
        random_stream(cut.seed, RandomStream::persistence, number, static_cast<int>(target.block));
    solid.cut(plane, add_mark(index, number), [&, &of_plane = plane](int piece) {
      if (!chosen(piece)) return false;
      if (cut.radius && solid.distance_in_plane(piece, of_plane) > *cut.radius) return false;
      return cut.persistence == 1.0 || random_share(random) < cut.persistence;
    });
  }
}

void SceneCutter::cut_by_solid(std::size_t index, const std::vector<Target>& targets) {
  const std::optional<Polyhedron> surface = build_cut_solid(scene_, index, diagnostics_);
  if (!surface) return;
  const int mark = add_mark(index, 0);
  for (const Target& target : targets) solid_of(target.block).cut_along(*surface, mark, 1, choice_of(target));
}

void SceneCutter::cut_by_points(std::size_t index, const std::vector<Target>& targets) {
  const SceneCut& cut = scene_.cut[index];
  if (!check_number(index, static_cast<double>(targets.size()) * (cut.count - 1.0))) return;
  for (const Target& target : targets) {
    solid_of(target.block).require_cells();
    std::mt19937_64 random = random_stream(cut.seed, RandomStream::points, 0, static_cast<int>(target.block));
    const std::vector<Vector3> points = random_points(*shapes_[target.block], cut.count, random);
    solid_of(target.block).cut_into_cells(points, add_mark(index, 0));
  }
}

void SceneCutter::make_cut(std::size_t index) {
  const SceneCut& cut = scene_.cut[index];
  try {
    const std::vector<Target> targets = targets_of(cut);
    if (targets.empty()) {
      std::vector<std::string> names;
      for (const SceneBlock& block : scene_.block) names.push_back(block.name);
      const std::string first = cut.blocks.empty() ? "" : cut.blocks.front();
      error(
          index, "blocks",
          fmt::format("cut names no block (\"{}\"), {}the name of a [[block]] or a glob that matches one is "
                      "needed",
                      first, guess(first, names, "\"")));
      return;
    }
    if (cut.kind == SceneCut::Kind::planes) cut_by_set(index, targets);
    if (cut.kind == SceneCut::Kind::solid) cut_by_solid(index, targets);
    if (cut.kind == SceneCut::Kind::voronoi) cut_by_points(index, targets);
    if (cut.min_volume == 0.0) return;
    for (const Target& target : targets)
      rock_.glued[index] += glue_small_pieces(solid_of(target.block), cut.min_volume, choice_of(target));
  } catch (const CutError& fault) {
    error(index, "", fmt::format("cut \"{}\" cannot be made: {}", cut.name, fault.what()));
  }
}

}  // namespace ashlar
