#include "solver/contact/surface_continuation.hpp"

#include <algorithm>

namespace ashlar {
namespace {

/// Height of a cell's plane over a place in a frame, m.
double height(const PlacedSurface& surface, int cell, const ViewFrame& frame, const Eigen::Vector2d& place) {
  const Vector3& normal = surface.normal(cell);
  const Vector3 on_plane = surface.corners(cell).front() - frame.origin;
  return (on_plane - place.x() * frame.e1 - place.y() * frame.e2).dot(normal) / normal.dot(frame.w);
}

}  // namespace

SurfaceContinuation::SurfaceContinuation(const std::vector<FoundContacts>& found,
                                         const std::function<const PlacedSurface&(int)>& placed, double reach)
    : reach_(reach) {
  for (const FoundContacts& pair : found) {
    const PairKey& blocks = pair.blocks;
    const PairContacts& contacts = pair.contacts;
    if (contacts.overlaps.empty()) continue;
    const PlacedSurface& a = placed(blocks[0]);
    const PlacedSurface& b = placed(blocks[1]);
    for (const CellOverlap& overlap : contacts.overlaps) {
      const int face_a = a.surface().cells[static_cast<std::size_t>(overlap.cell_a)].face;
      const int face_b = b.surface().cells[static_cast<std::size_t>(overlap.cell_b)].face;
      of_faces_[{blocks[0], face_a}].push_back({blocks[1], &overlap, &a, &b});
      of_faces_[{blocks[1], face_b}].push_back({blocks[0], &overlap, &a, &b});
    }
  }
}

bool SurfaceContinuation::goes_on(const Cover& cover, const RimPlace& rim) const {
  const CellOverlap& overlap = *cover.overlap;
  const Eigen::Vector2d place = overlap.frame.project(rim.place);
  const std::size_t count = overlap.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector2d& start = overlap.corners[k].place;
    const Eigen::Vector2d along = overlap.corners[(k + 1) % count].place - start;
    const Eigen::Vector2d off = place - start;
    if (along.x() * off.y() - along.y() * off.x() < -reach_ * along.norm()) return false;
  }
  const auto gap = [&](const Eigen::Vector2d& seen) {
    return height(*cover.a, overlap.cell_a, overlap.frame, seen) -
           height(*cover.b, overlap.cell_b, overlap.frame, seen);
  };
  // Faces parallel within rounding error do not diverge.
  constexpr double rounding = 1e-9;
  const double rise = gap(overlap.frame.project(rim.place + rim.outward)) - gap(place);
  return gap(place) <= rim.near && rise <= rounding;
}

bool SurfaceContinuation::goes_on(int block, int with_rim, const RimPlace& rim) const {
  const auto covers = of_faces_.find({block, rim.face});
  if (covers == of_faces_.end()) return false;
  return std::any_of(covers->second.begin(), covers->second.end(),
                     [&](const Cover& cover) { return cover.other != with_rim && goes_on(cover, rim); });
}

}  // namespace ashlar
