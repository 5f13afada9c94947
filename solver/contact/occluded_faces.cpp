#include "solver/contact/occluded_faces.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {
namespace {

bool within(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& place) {
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d along = outline[(k + 1) % outline.size()] - outline[k];
    const Eigen::Vector2d off = place - outline[k];
    if (along.x() * off.y() - along.y() * off.x() < 0.0) return false;
  }
  return true;
}

}  // namespace

void OccludedFaces::add(const PairKey& blocks, const std::vector<CellOverlap>& overlaps,
                        const SubFaceSurface& a, const SubFaceSurface& b, double reach) {
  for (const CellOverlap& overlap : overlaps) {
    const bool flush = std::all_of(overlap.gaps.begin(), overlap.gaps.end(),
                                   [reach](double gap) { return std::abs(gap) <= reach; });
    if (!flush) continue;
    std::vector<Eigen::Vector2d> outline;
    for (const OverlapCorner& corner : overlap.corners) outline.push_back(corner.place);
    const int face_a = a.cells[static_cast<std::size_t>(overlap.cell_a)].face;
    const int face_b = b.cells[static_cast<std::size_t>(overlap.cell_b)].face;
    covers_[{blocks[0], face_a}].push_back({blocks[1], overlap.frame, outline});
    covers_[{blocks[1], face_b}].push_back({blocks[0], overlap.frame, std::move(outline)});
  }
}

bool OccludedFaces::hides(int block, int face, int but, const Vector3& place) const {
  const auto covers = covers_.find({block, face});
  return covers != covers_.end() &&
         std::any_of(covers->second.begin(), covers->second.end(), [&](const Cover& cover) {
           return cover.other != but && within(cover.outline, cover.frame.project(place));
         });
}

OccludedPlaces OccludedFaces::of_pair(const PairKey& blocks) const {
  const auto& [a, b] = blocks;
  return {[this, a = a, b = b](int face, const Vector3& place) { return hides(a, face, b, place); },
          [this, a = a, b = b](int face, const Vector3& place) { return hides(b, face, a, place); }};
}

}  // namespace ashlar
