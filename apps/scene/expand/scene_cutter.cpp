#include "apps/scene/expand/scene_cutter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "apps/scene/expand/piece_blocks.hpp"
#include "apps/scene/expand/piece_names.hpp"
#include "apps/scene/expand/random_points.hpp"
#include "apps/scene/expand/region_blocks.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/read/disc_table.hpp"
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
  alone.block.back().shape_origin = scene.origin;
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

/// m, rounded: largest distance from the point of a plane to the section of a body with it.
double farthest_in_plane(const TriangleMesh& mesh, const CutPlane& plane) {
  double farthest = 0.0;
  const auto height = [&](const Vector3& x) { return plane.normal.dot(x - plane.point) - plane.offset; };
  const Vector3 center = plane.point + plane.offset * plane.normal;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 &a = mesh.points[static_cast<std::size_t>(triangle[k])],
                    &b = mesh.points[static_cast<std::size_t>(triangle[(k + 1) % 3])];
      const double below = height(a), above = height(b);
      if (below == above || below * above > 0.0) continue;
      farthest = std::max(farthest, (a + below / (below - above) * (b - a) - center).norm());
    }
  }
  return farthest;
}

/// Pieces made by a cut belong to it like the initial ones.
template <class Target>
CutSolid::Choice choice_of(const Target& target) {
  return [&target](int piece) {
    return piece > target.newest || std::binary_search(target.pieces.begin(), target.pieces.end(), piece);
  };
}

}  // namespace

SceneCutter::SceneCutter(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                         Diagnostics& diagnostics)
    : scene_(scene), shapes_(solids), diagnostics_(diagnostics) {
  rock_.solids.resize(scene.block.size());
  rock_.glued.assign(scene.cut.size(), 0);
  rock_.extended.assign(scene.cut.size(), 0);
}

void SceneCutter::error(std::size_t cut, const char* key, std::string message) {
  diagnostics_.error(scene_.places.value(fmt::format("cut.{}{}{}", cut, *key == '\0' ? "" : ".", key)),
                     std::move(message));
}

CutSolid& SceneCutter::solid_of(std::size_t block) {
  if (!rock_.solids[block]) rock_.solids[block].emplace(*shapes_[block]);
  return *rock_.solids[block];
}

std::vector<SceneCutter::Target> SceneCutter::targets_of(std::size_t index) {
  const SceneCut& cut = scene_.cut[index];
  std::optional<RegionTest> region;
  if (cut.inside) region.emplace(scene_, *cut.inside, fmt::format("cut.{}.inside", index), diagnostics_);
  // Names of pieces have dots; the others are computed for these alone.
  const bool names_pieces = std::any_of(cut.blocks.begin(), cut.blocks.end(), [](const std::string& pattern) {
    return pattern.find('.') != std::string::npos;
  });
  std::vector<Target> targets;
  for (std::size_t k = 0; k < scene_.block.size(); ++k) {
    if (!shapes_[k]) continue;
    const std::string& name = scene_.block[k].name;
    const bool whole = matches_any(cut.blocks, name);
    if (!whole && !rock_.solids[k]) continue;
    const CutSolid& solid = solid_of(k);
    const std::vector<std::string> names = piece_names(scene_, rock_, k);
    const std::vector<int> pieces = solid.pieces();
    std::vector<std::vector<std::string>> others(pieces.size());
    if (names_pieces) others = other_piece_names(scene_, rock_, k);
    Target target{k, {}, *std::max_element(pieces.begin(), pieces.end())};
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const bool named = whole || matches_any(cut.blocks, names[i]) ||
                         std::any_of(others[i].begin(), others[i].end(), [&](const std::string& other) {
                           return matches_any(cut.blocks, other);
                         });
      if (!named) continue;
      if (!region || region->contains(centroid_of(solid.mesh(pieces[i])))) target.pieces.push_back(pieces[i]);
    }
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
  error(index,
        cut.kind == SceneCut::Kind::voronoi ? "voronoi"
        : cut.kind == SceneCut::Kind::discs ? "file"
                                            : "spacing",
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
      if (cut.radius && !is_met(index, solid, piece, of_plane, *cut.radius)) return false;
      return cut.persistence == 1.0 || random_share(random) < cut.persistence;
    });
  }
}

void SceneCutter::cut_by_discs(std::size_t index, const std::vector<Target>& targets) {
  const auto discs = read_disc_table(scene_.file.parent_path() / scene_.cut[index].file,
                                     scene_.places.value(fmt::format("cut.{}.file", index)), diagnostics_);
  if (!discs) return;
  for (const Target& target : targets) {
    CutSolid& solid = solid_of(target.block);
    const CutSolid::Choice chosen = choice_of(target);
    for (std::size_t k = 0; k < discs->size(); ++k) {
      const auto& [center, dip, dip_direction, radius] = (*discs)[k];
      const CutPlane plane{plane_normal(dip, dip_direction), center - scene_.origin};
      solid.cut(plane, add_mark(index, static_cast<int>(k) + 1), [&, &within = radius](int piece) {
        return chosen(piece) && (!within || is_met(index, solid, piece, plane, *within));
      });
      if (!check_number(index, 0.0)) return;
    }
  }
}

bool SceneCutter::is_met(std::size_t cut, const CutSolid& solid, int piece, const CutPlane& plane,
                         double radius) {
  if (solid.distance_in_plane(piece, plane) > radius) return false;
  if (farthest_in_plane(solid.mesh(piece), plane) > radius) ++rock_.extended[cut];
  return true;
}

void SceneCutter::cut_by_solid(std::size_t index, const std::vector<Target>& targets) {
  const std::optional<Polyhedron> surface = build_cut_solid(scene_, index, diagnostics_);
  if (!surface) return;
  const int mark = add_mark(index, 0);
  for (const Target& target : targets) {
    CutSolid& solid = solid_of(target.block);
    std::set<int> labels;
    for (const int piece : target.pieces) labels.insert(solid.label(piece));
    // Pieces keep the solids that they are inside of: those of each label get a label of their own.
    for (const int label : labels) {
      const int inside = add_inside(index, label);
      const CutSolid::Choice chosen = choice_of(target);
      solid.cut_along(*surface, mark, inside, [&](int piece) {
        return chosen(piece) && (solid.label(piece) == label || solid.label(piece) == inside);
      });
    }
  }
}

int SceneCutter::add_inside(std::size_t cut, int label) {
  std::vector<std::size_t> cuts;
  if (label > 0) cuts = rock_.insides[static_cast<std::size_t>(label) - 1];
  cuts.push_back(cut);
  const auto known = std::find(rock_.insides.begin(), rock_.insides.end(), cuts);
  if (known != rock_.insides.end()) return static_cast<int>(known - rock_.insides.begin()) + 1;
  rock_.insides.push_back(std::move(cuts));
  return static_cast<int>(rock_.insides.size());
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
    const std::vector<Target> targets = targets_of(index);
    if (!diagnostics_.good()) return;
    if (targets.empty() && cut.inside) {
      error(index, "inside",
            "cut has no block or piece of these names with its centroid inside (inside), a region "
            "with one is needed");
      return;
    }
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
    if (cut.kind == SceneCut::Kind::discs) cut_by_discs(index, targets);
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
