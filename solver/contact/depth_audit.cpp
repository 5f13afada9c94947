#include "solver/contact/depth_audit.hpp"

#include <algorithm>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"
#include "mechanics/block/material_map.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

AuditedBlock placed_block(const BlockSurface& surface, const BlockState& state) {
  AuditedBlock block;
  block.points = surface.points(state);
  block.box = box_of(block.points).grown(surface.bulge(state));
  return block;
}

void place_edges(const BlockSurface& surface, const BlockState& state, AuditedBlock& block) {
  block.middles = surface.edge_middles(state);
  for (const SurfaceEdge& edge : surface.surface().edges) {
    block.edges.push_back(box_of(std::array{block.points[at(edge.ends[0])], block.points[at(edge.ends[1])]}));
    if (!block.middles.empty()) block.edges.back().include(block.middles[block.edges.size() - 1]);
  }
}

bool contains(const Box& box, const Vector3& point) {
  return (box.low.array() <= point.array()).all() && (point.array() <= box.high.array()).all();
}

/// The share of a segment within a box; none if it misses the box.
std::optional<std::array<double, 2>> clipped(const Box& box, const Vector3& start, const Vector3& end) {
  double low = 0.0, high = 1.0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double rise = end[k] - start[k];
    double enter = box.low[k] - start[k], leave = box.high[k] - start[k];
    if (rise == 0.0) {
      if (enter > 0.0 || leave < 0.0) return std::nullopt;
      continue;
    }
    enter /= rise;
    leave /= rise;
    if (enter > leave) std::swap(enter, leave);
    low = std::max(low, enter);
    high = std::min(high, leave);
  }
  if (low > high) return std::nullopt;
  return std::array{low, high};
}

/// Asks for the points of one block in another one.
class PairAudit {
 public:
  /// The block that is asked where a place is in it.
  struct Outer {
    const AuditedBlock& block;
    const SolidDepthFinder& finder;
    const MaterialMap& map;
  };

  /// @param clear from the audit before, written; empty: the outer block is convex
  PairAudit(const AuditedBlock& with_points, const SubFaceSurface& surface, const Outer& outer,
            double resolution, ClearParts& clear)
      : with_points_(with_points),
        surface_(surface),
        outer_(outer.block),
        finder_(outer.finder),
        map_(outer.map),
        resolution_(resolution),
        clear_(clear),
        points_(with_points.points.size()),
        middles_(with_points.middles.size()) {}

  [[nodiscard]] PairDepth run() {
    for (std::size_t k = 0; k < with_points_.points.size(); ++k) check_point(static_cast<int>(k));
    for (std::size_t k = 0; k < surface_.edges.size(); ++k) {
      if (surface_.edges[k].convex && with_points_.edges[k].meets(outer_.box)) check_edge(k);
    }
    return deepest_;
  }

 private:
  /// Where a place is in the outer block: asked for once.
  struct Preimage {
    bool asked = false;
    std::optional<Vector3> material;
  };
  /// An end of a piece of an edge.
  struct EdgePlace {
    const Vector3& place;
    Preimage& preimage;
  };

  const std::optional<Vector3>& material_of(Preimage& preimage, const Vector3& place) const {
    if (!preimage.asked) preimage = {true, map_.material(place)};
    return preimage.material;
  }

  void check_point(int point) {
    const Vector3& place = with_points_.points[at(point)];
    if (!contains(outer_.box, place)) return;
    const auto& material = material_of(points_[at(point)], place);
    if (!material) return;
    if (!clear_.points.empty()) {
      ClearBall& ball = clear_.points[at(point)];
      if (ball.around(*material) > 0.0) return;
      ball = {*material, finder_.clear_radius(*material)};
      if (ball.radius > 0.0) return;
    }
    if (const auto depth = finder_.of_point(*material)) take(*depth, place, {point, point}, 0.0);
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

  /// @param piece of an edge; @param shares of the edge
  void check_piece(std::size_t piece, const std::array<EdgePlace, 2>& ends,
                   const std::array<double, 2>& shares) {
    const Vector3& start = ends[0].place;
    const Vector3 whole = ends[1].place - start;
    const auto part = clipped(outer_.box, start, ends[1].place);
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
    const Vector3 way = *last - *first;
    const double within = way.squaredNorm() > 0.0 ? way.dot(depth->place - *first) / way.squaredNorm() : 0.0;
    const double along = (*part)[0] + within * ((*part)[1] - (*part)[0]);
    const std::size_t edge = with_points_.middles.empty() ? piece : piece / 2;
    take(*depth, start + along * whole, surface_.edges[edge].ends,
         shares[0] + along * (shares[1] - shares[0]));
  }

  void take(const SolidDepth& found, const Vector3& place, const std::array<int, 2>& points, double along) {
    const double depth = found.depth * map_.stretch_across(found.place, found.way_out);
    if (!(depth > deepest_.depth)) return;
    deepest_.depth = depth;
    deepest_.place = place;
    deepest_.points = points;
    deepest_.along = along;
    deepest_.face = found.face;
    deepest_.normal = map_.placed_normal(found.place, found.way_out);
  }

  const AuditedBlock& with_points_;
  const SubFaceSurface& surface_;
  const AuditedBlock& outer_;
  const SolidDepthFinder& finder_;
  const MaterialMap& map_;
  double resolution_;
  ClearParts& clear_;
  std::vector<Preimage> points_;
  std::vector<Preimage> middles_;
  PairDepth deepest_{};
};

}  // namespace

void DepthAudit::forget(std::size_t block) {
  finders_[block].reset();
  audited_[block] = {};
  std::erase_if(
      clear_, [&](const auto& entry) { return at(entry.first[0]) == block || at(entry.first[1]) == block; });
}

void DepthAudit::prepare(const std::array<int, 2>& blocks, std::size_t points, std::size_t edges) {
  ClearParts& clear = clear_[blocks];
  const bool convex = finders_[at(blocks[1])]->convex();
  if (clear.points.size() != (convex ? 0 : points)) clear.points.assign(convex ? 0 : points, {});
  if (clear.edges.size() != (convex ? 0 : edges)) clear.edges.assign(convex ? 0 : edges, {});
}

std::vector<PairDepth> DepthAudit::run(const std::vector<BlockModel>& blocks,
                                       const std::vector<BlockState>& states,
                                       const std::vector<BlockSurface>& surfaces, const AuditScope& scope) {
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (scope.moving[k] || audited_[k].points.empty()) audited_[k] = placed_block(surfaces[k], states[k]);
    boxes.push_back(audited_[k].box);
  }
  std::vector<std::array<int, 2>> pairs = meeting_boxes(boxes);
  std::erase_if(pairs, [&](const auto& pair) {
    return (!scope.moving[at(pair[0])] && !scope.moving[at(pair[1])]) || !scope.pairs(pair[0], pair[1]);
  });
  std::vector<std::optional<MaterialMap>> maps(blocks.size());
  for (const auto& pair : pairs) {
    for (const int block : pair) {
      if (!maps[at(block)]) maps[at(block)].emplace(blocks[at(block)], states[at(block)]);
      if (!finders_[at(block)]) finders_[at(block)].emplace(blocks[at(block)].solid());
      if (audited_[at(block)].edges.empty())
        place_edges(surfaces[at(block)], states[at(block)], audited_[at(block)]);
    }
  }
  std::vector<std::array<PairDepth, 2>> found(pairs.size());
  for (const auto& [a, b] : pairs) {
    for (const auto& [inner, outer] : {std::array{a, b}, std::array{b, a}}) {
      const AuditedBlock& block = audited_[at(inner)];
      prepare({inner, outer}, block.points.size(), block.edges.size() + block.middles.size());
    }
  }
  parallel_for(scope.threads, pairs.size(), [&](std::size_t k) {
    const auto& [a, b] = pairs[k];
    const auto audit = [&](int inner, int outer) {
      PairDepth depth = PairAudit(audited_[at(inner)], surfaces[at(inner)].surface(),
                                  {audited_[at(outer)], *finders_[at(outer)], *maps[at(outer)]},
                                  scope.resolution, clear_.at({inner, outer}))
                            .run();
      depth.blocks = {inner, outer};
      return depth;
    };
    found[k] = {audit(a, b), audit(b, a)};
  });
  std::vector<PairDepth> result;
  for (const auto& both : found) {
    for (const PairDepth& depth : both)
      if (depth.depth > 0.0) result.push_back(depth);
  }
  return result;
}

}  // namespace ashlar
