#include "solver/contact/depth_audit.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"
#include "mechanics/block/material_map.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

Vector3 mean_of(const std::vector<Vector3>& points, const std::vector<int>& corners) {
  Vector3 sum = Vector3::Zero();
  for (const int corner : corners) sum += points[at(corner)];
  return sum / static_cast<double>(corners.size());
}

AuditedBlock placed_block(const BlockSurface& surface, const BlockState& state) {
  AuditedBlock block;
  block.points = surface.points(state);
  for (const SurfaceCell& cell : surface.surface().cells)
    block.cells.push_back(mean_of(block.points, cell.corners));
  block.box = box_of(block.points).grown(surface.bulge(state));
  return block;
}

/// Fewer features are looked at faster one after the other.
constexpr std::size_t few_features = 256;

std::optional<BoxTree> tree_of_many(std::vector<Box> boxes) {
  if (boxes.size() <= few_features) return std::nullopt;
  return BoxTree(std::move(boxes));
}

void place_edges(const BlockSurface& surface, const BlockState& state, AuditedBlock& block) {
  block.middles = surface.edge_middles(state);
  for (const SurfaceEdge& edge : surface.surface().edges) {
    block.edges.push_back(box_of(std::array{block.points[at(edge.ends[0])], block.points[at(edge.ends[1])]}));
    if (!block.middles.empty()) block.edges.back().include(block.middles[block.edges.size() - 1]);
  }
}

/// Trees of a block that is audited at the same place again: a tree costs as much as hundreds of pairs without one.
void add_trees(AuditedBlock& block) {
  block.edge_tree = tree_of_many(block.edges);
  std::vector<Box> places;
  for (const std::vector<Vector3>* points : {&block.points, &block.cells})
    for (const Vector3& point : *points) places.push_back({point, point});
  block.point_tree = tree_of_many(std::move(places));
}

/// Present places of the material points of a depth.
std::array<Vector3, 2> places_of(const PairDepth& pair, const std::vector<BlockModel>& blocks,
                                 const std::vector<BlockState>& states) {
  std::array<Vector3, 2> places;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t block = at(pair.blocks[k]);
    places[k] = states[block].position.transpose() * blocks[block].basis().values(pair.materials[k]);
  }
  return places;
}

/// The depth of the same two points in another state.
PairDepth depth_now(const MeasuredDepth& measured, const std::vector<BlockModel>& blocks,
                    const std::vector<BlockState>& states) {
  const std::array<Vector3, 2> places = places_of(measured.pair, blocks, states);
  PairDepth now = measured.pair;
  const Vector3 moved = places[0] - measured.places[0];
  now.depth -= now.normal.dot(moved - (places[1] - measured.places[1]));
  now.place += moved;
  return now;
}

bool by_blocks(const MeasuredDepth& x, const MeasuredDepth& y) {
  const auto key = [](const PairDepth& depth) {
    const auto [low, high] = key_of(depth.blocks);
    return std::array{low, high, depth.blocks[0]};
  };
  return key(x.pair) < key(y.pair);
}

/// True if a block has not moved since its evaluation, within the tolerance.
bool has_stayed(std::size_t block, const BlockModel& model, const BlockState& state,
                const BlockSurface& surface, const AuditScope& scope, const KnownDepths& known) {
  // Coordinates of an incremental block change in each step.
  if (block >= known.positions.size() || model.incremental() != nullptr) return false;
  const Eigen::MatrixX3d& position = known.positions[block];
  return position.rows() == state.position.rows() &&
         surface.quick_motion_bound(state.position - position) <= scope.unmoved;
}

/// Measures points of one block in another one.
class PairAudit {
 public:
  /// The penetrated block.
  struct Outer {
    const AuditedBlock& block;
    const SolidDepthFinder& finder;
    const MaterialMap& map;
  };

  /// @param clear from the audit before, updated; empty: the outer block is convex
  PairAudit(const AuditedBlock& with_points, const SubFaceSurface& surface, const Outer& outer,
            double resolution, ClearParts& clear)
      : with_points_(with_points),
        surface_(surface),
        outer_(outer.block),
        finder_(outer.finder),
        map_(outer.map),
        resolution_(resolution),
        clear_(clear),
        points_(with_points.points.size() + with_points.cells.size()),
        middles_(with_points.middles.size()) {}

  [[nodiscard]] PairDepth run() {
    const std::size_t corners = with_points_.points.size();
    for_each_near(with_points_.point_tree, corners + with_points_.cells.size(), [&](std::size_t k) {
      if (k < corners)
        check_point(k, with_points_.points[k], surface_.points[k]);
      else
        check_point(k, with_points_.cells[k - corners],
                    mean_of(surface_.points, surface_.cells[k - corners].corners));
    });
    for_each_near(with_points_.edge_tree, surface_.edges.size(), [&](std::size_t k) {
      if (surface_.edges[k].convex && with_points_.edges[k].meets(outer_.box)) check_edge(k);
    });
    return deepest_;
  }

 private:
  /// Place in the outer block, computed on demand.
  struct Preimage {
    bool asked = false;
    std::optional<Vector3> material;
  };
  /// By index of a point: all of a block that has few, those that are asked of another one.
  class Preimages {
   public:
    explicit Preimages(std::size_t count) : few_(count <= few_features ? count : 0) {}
    Preimage& operator[](std::size_t index) { return few_.empty() ? many_[index] : few_[index]; }

   private:
    std::vector<Preimage> few_;
    std::unordered_map<std::size_t, Preimage> many_;
  };

  /// Calls check(index) in ascending order: for those of a tree that meet the outer block's box, or for all.
  template <class Check>
  void for_each_near(const std::optional<BoxTree>& tree, std::size_t count, const Check& check) const {
    if (tree) {
      for (const int index : tree->meeting(outer_.box)) check(at(index));
    } else {
      for (std::size_t k = 0; k < count; ++k) check(k);
    }
  }

  /// An end of a part of an edge.
  struct EdgePlace {
    const Vector3& place;
    Preimage& preimage;
  };

  const std::optional<Vector3>& material_of(Preimage& preimage, const Vector3& place) const {
    if (!preimage.asked) preimage = {true, map_.material(place)};
    return preimage.material;
  }

  /// @param index among points, then cells. @param reference in the block that has it, m
  void check_point(std::size_t index, const Vector3& place, const Vector3& reference) {
    if (!outer_.box.contains(place)) return;
    const auto& material = material_of(points_[index], place);
    if (!material) return;
    ClearBall* known = clear_.points.empty() ? nullptr : &clear_.points[index];
    if (known != nullptr && known->around(*material) > 0.0) return;
    double clearance = 0.0;
    const auto depth = finder_.of_point(*material, &clearance);
    if (known != nullptr) *known = {*material, clearance};
    if (depth) take(*depth, place, reference);
  }

  void check_edge(std::size_t index) {
    const SurfaceEdge& edge = surface_.edges[index];
    const EdgePlace start{with_points_.points[at(edge.ends[0])], points_[at(edge.ends[0])]};
    const EdgePlace end{with_points_.points[at(edge.ends[1])], points_[at(edge.ends[1])]};
    if (with_points_.middles.empty()) {
      check_piece(index, {start, end}, {0.0, 1.0});
    } else {
      const EdgePlace middle{with_points_.middles[index], middles_[index]};
      check_piece(2 * index, {start, middle}, {0.0, 0.5});
      check_piece(2 * index + 1, {middle, end}, {0.5, 1.0});
    }
  }

  /// @param piece part of an edge; @param shares of the edge
  void check_piece(std::size_t piece, const std::array<EdgePlace, 2>& ends,
                   const std::array<double, 2>& shares) {
    const Vector3& start = ends[0].place;
    const Vector3 whole = ends[1].place - start;
    const auto part = part_within(outer_.box, start, ends[1].place);
    if (!part) return;
    const auto at_share = [&](double share) {
      if (share == 0.0) return material_of(ends[0].preimage, start);
      if (share == 1.0) return material_of(ends[1].preimage, ends[1].place);
      return map_.material(start + share * whole);
    };
    const auto first = at_share((*part)[0]);
    const auto last = at_share((*part)[1]);
    if (!first || !last) return;
    ClearSegment* known = clear_.edges.empty() ? nullptr : &clear_.edges[piece];
    if (known != nullptr && known->clears(*first, *last)) return;
    double clearance = 0.0;
    const auto depth = finder_.of_segment(*first, *last, resolution_, deepest_.depth, &clearance);
    if (known != nullptr) *known = {*first, *last, clearance};
    if (!depth) return;
    const Vector3 offset = *last - *first;
    const double within =
        offset.squaredNorm() > 0.0 ? offset.dot(depth->place - *first) / offset.squaredNorm() : 0.0;
    const double along = (*part)[0] + within * ((*part)[1] - (*part)[0]);
    const auto& ends_of_edge = surface_.edges[with_points_.middles.empty() ? piece : piece / 2].ends;
    const Vector3& from = surface_.points[at(ends_of_edge[0])];
    const double share = shares[0] + along * (shares[1] - shares[0]);
    take(*depth, start + along * whole, from + share * (surface_.points[at(ends_of_edge[1])] - from));
  }

  void take(const SolidDepth& found, const Vector3& place, const Vector3& reference) {
    const double depth = found.depth * map_.stretch_across(found.place, found.outward);
    if (!(depth > deepest_.depth)) return;
    deepest_.depth = depth;
    deepest_.place = place;
    deepest_.face = found.face;
    // On both surfaces: the material between them is strained too.
    deepest_.materials = {reference, found.place + found.depth * found.outward};
    deepest_.normal = map_.placed_normal(found.place, found.outward);
  }

  const AuditedBlock& with_points_;
  const SubFaceSurface& surface_;
  const AuditedBlock& outer_;
  const SolidDepthFinder& finder_;
  const MaterialMap& map_;
  double resolution_;
  ClearParts& clear_;
  Preimages points_;
  Preimages middles_;
  PairDepth deepest_{};
};

}  // namespace

void DepthAudit::forget(std::size_t block) {
  finders_[block].reset();
  audited_[block] = {};
  std::erase_if(
      clear_, [&](const auto& entry) { return at(entry.first[0]) == block || at(entry.first[1]) == block; });
}

bool DepthAudit::is_convex(int block, const std::vector<BlockModel>& blocks) {
  std::optional<SolidDepthFinder>& finder = finders_[static_cast<std::size_t>(block)];
  if (!finder) finder.emplace(blocks[static_cast<std::size_t>(block)].solid());
  return finder->convex();
}

void DepthAudit::prepare(const BlockPair& blocks, std::size_t points, std::size_t edges) {
  ClearParts& clear = clear_[blocks];
  const bool convex = finders_[at(blocks[1])]->convex();
  if (clear.points.size() != (convex ? 0 : points)) clear.points.assign(convex ? 0 : points, {});
  if (clear.edges.size() != (convex ? 0 : edges)) clear.edges.assign(convex ? 0 : edges, {});
}

std::vector<MeasuredDepth> DepthAudit::measure(const std::vector<PairKey>& pairs,
                                               const std::vector<BlockModel>& blocks,
                                               const std::vector<BlockState>& states,
                                               const std::vector<BlockSurface>& surfaces,
                                               const AuditScope& scope) {
  std::vector<std::optional<MaterialMap>> maps(blocks.size());
  for (const auto& pair : pairs) {
    for (const int block : pair) {
      if (!maps[at(block)]) maps[at(block)].emplace(blocks[at(block)], states[at(block)]);
      if (!finders_[at(block)]) finders_[at(block)].emplace(blocks[at(block)].solid());
      if (!audited_[at(block)].edges.empty()) continue;
      place_edges(surfaces[at(block)], states[at(block)], audited_[at(block)]);
      if (blocks[at(block)].fixed()) add_trees(audited_[at(block)]);
    }
  }
  for (const auto& [a, b] : pairs) {
    for (const auto& [inner, outer] : {std::array{a, b}, std::array{b, a}}) {
      const AuditedBlock& block = audited_[at(inner)];
      prepare({inner, outer}, block.points.size() + block.cells.size(),
              block.edges.size() + block.middles.size());
    }
  }
  std::vector<std::array<PairDepth, 2>> found(pairs.size());
  parallel_for(scope.threads, pairs.size(), [&](std::size_t k) {
    const auto& [a, b] = pairs[k];
    const auto audit = [&](int inner, int outer) {
      const SubFaceSurface& surface = surfaces[at(inner)].surface();
      PairDepth depth = PairAudit(audited_[at(inner)], surface,
                                  {audited_[at(outer)], *finders_[at(outer)], *maps[at(outer)]},
                                  scope.resolution, clear_.at({inner, outer}))
                            .run();
      depth.blocks = {inner, outer};
      return depth;
    };
    found[k] = {audit(a, b), audit(b, a)};
  });
  std::vector<MeasuredDepth> result;
  for (const auto& both : found) {
    for (const PairDepth& depth : both)
      if (depth.depth > 0.0) result.push_back({depth, places_of(depth, blocks, states)});
  }
  return result;
}

Audit DepthAudit::run(const std::vector<BlockModel>& blocks, const std::vector<BlockState>& states,
                      const std::vector<BlockSurface>& surfaces, const AuditScope& scope,
                      const KnownDepths& known) {
  Audit audit;
  std::vector<bool> moved(blocks.size(), false);
  std::vector<Box> boxes(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (k < scope.absent.size() && scope.absent[k]) continue;
    moved[k] = !has_stayed(k, blocks[k], states[k], surfaces[k], scope, known);
    if (!moved[k]) {
      boxes[k] = known.boxes[k].grown(scope.unmoved);
      continue;
    }
    if (!blocks[k].fixed() || audited_[k].points.empty()) audited_[k] = placed_block(surfaces[k], states[k]);
    boxes[k] = audited_[k].box;
    audit.moved.push_back(static_cast<int>(k));
    audit.positions.push_back(states[k].position);
    audit.boxes.push_back(audited_[k].box);
  }
  const auto is_live = [&](const PairKey& pair) {
    return scope.moving[at(pair[0])] || scope.moving[at(pair[1])];
  };
  const auto is_asked = [&](const PairKey& pair) {
    if (!is_live(pair)) return false;
    if (moved[at(pair[0])] || moved[at(pair[1])]) return true;
    return scope.fine && !(is_convex(pair[0], blocks) && is_convex(pair[1], blocks));
  };
  std::vector<PairKey> pairs;
  if (!audit.moved.empty() || scope.fine) pairs = meeting_boxes(boxes);
  std::erase_if(pairs, [&](const auto& pair) { return !is_asked(pair) || !scope.pairs(pair[0], pair[1]); });
  std::vector<bool> placed = moved;
  for (const auto& pair : pairs) {
    for (const int block : pair) {
      if (placed[at(block)]) continue;
      placed[at(block)] = true;
      if (!blocks[at(block)].fixed() || audited_[at(block)].points.empty())
        audited_[at(block)] = placed_block(surfaces[at(block)], states[at(block)]);
    }
  }
  audit.measured = measure(pairs, blocks, states, surfaces, scope);
  for (const MeasuredDepth& depth : known.depths)
    if (!is_asked(depth.pair.blocks)) audit.measured.push_back(depth);
  std::sort(audit.measured.begin(), audit.measured.end(), by_blocks);
  for (const MeasuredDepth& depth : audit.measured) {
    if (!is_live(depth.pair.blocks)) continue;
    const PairDepth now = depth_now(depth, blocks, states);
    if (now.depth > 0.0) audit.depths.push_back(now);
  }
  return audit;
}

void Audit::take_over(KnownDepths& known) const {
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const std::size_t block = at(moved[k]);
    if (known.positions.size() <= block) known.positions.resize(block + 1);
    if (known.boxes.size() <= block) known.boxes.resize(block + 1);
    known.positions[block] = positions[k];
    known.boxes[block] = boxes[k];
  }
  known.depths = measured;
}

}  // namespace ashlar
