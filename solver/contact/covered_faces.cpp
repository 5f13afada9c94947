#include "solver/contact/covered_faces.hpp"

#include <cmath>
#include <limits>

#include "geometry/boxes/box_pairs.hpp"

namespace ashlar {
namespace {

/// True if a place in the overlap's frame is in its polygon, or no farther outside than the reach, m.
bool is_on(const CellOverlap& overlap, const Eigen::Vector2d& place, double reach) {
  const std::size_t count = overlap.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector2d& start = overlap.corners[k].place;
    const Eigen::Vector2d along = overlap.corners[(k + 1) % count].place - start;
    const Eigen::Vector2d off = place - start;
    if (along.x() * off.y() - along.y() * off.x() < -reach * along.norm()) return false;
  }
  return true;
}

/// Height of a cell's plane over a place in a frame, m.
double height(const PlacedSurface& surface, int cell, const ViewFrame& frame, const Eigen::Vector2d& place) {
  const Vector3& normal = surface.normal(cell);
  const Vector3 on_plane = surface.corners(cell).front() - frame.origin;
  return (on_plane - place.x() * frame.e1 - place.y() * frame.e2).dot(normal) / normal.dot(frame.w);
}

/// A vertex of one block and the cells of another one in a step.
struct EnteringVertex {
  const MovingSurface& with_vertex;
  const MovingSurface& with_cells;
  const OccludedPlaces::Hides& hides;
  int point;

  [[nodiscard]] const PlacedSurface& cells(bool at_end) const {
    return at_end ? *with_cells.end : *with_cells.start;
  }
  [[nodiscard]] const Vector3& place(bool at_end) const {
    return (at_end ? with_vertex.end : with_vertex.start)->point(point);
  }
  [[nodiscard]] double gap(int cell, bool at_end) const {
    const Vector3& in_plane = cells(at_end).point(cells(at_end).surface().cells[at(cell)].corners[0]);
    return cells(at_end).normal(cell).dot(place(at_end) - in_plane);
  }
  [[nodiscard]] Vector3 foot(int cell, bool at_end) const {
    return place(at_end) - gap(cell, at_end) * cells(at_end).normal(cell);
  }
  /// True if it passes through an occluded side, or ends beside it: it may start above.
  [[nodiscard]] bool is_hidden(int cell) const {
    const int face = cells(false).surface().cells[at(cell)].face;
    return hides(face, foot(cell, false)) || hides(face, foot(cell, true));
  }
  /// Replaces the cell of a touch. @return false if the vertex ends outside of the block
  [[nodiscard]] bool turn(VertexContact& touch) const {
    const SubFaceSurface& surface = cells(false).surface();
    const auto& beside = surface.convex_neighbours[at(surface.cells[at(touch.cell)].face)];
    double least = -std::numeric_limits<double>::infinity();
    for (int cell = 0; cell < static_cast<int>(surface.cells.size()); ++cell) {
      if (!std::binary_search(beside.begin(), beside.end(), surface.cells[at(cell)].face)) continue;
      const double end = gap(cell, true);
      if (end <= least) continue;
      least = end;
      touch.cell = cell;
    }
    touch.gap = gap(touch.cell, false);
    return least < 0.0;
  }
};

/// True if two touches are of the same vertex and cell.
bool are_same(const Touch& first, const Touch& second) {
  const auto* one = std::get_if<VertexContact>(&first.contact);
  const auto* other = std::get_if<VertexContact>(&second.contact);
  return one != nullptr && other != nullptr && one->vertex_of_a == other->vertex_of_a &&
         one->point == other->point && one->cell == other->cell;
}

}  // namespace

void OccludedFaces::add(const PairKey& blocks, const std::vector<CellOverlap>& overlaps,
                        const SubFaceSurface& a, const SubFaceSurface& b, double reach) {
  for (const CellOverlap& overlap : overlaps)
    if (std::all_of(overlap.gaps.begin(), overlap.gaps.end(),
                    [reach](double gap) { return std::abs(gap) <= reach; }))
      covers_.add(blocks, overlap, a, b, std::make_shared<const CellOverlap>(overlap));
}

bool OccludedFaces::hides(int block, int face, int but, const Vector3& place) const {
  return covers_.any(block, face, but, [&](const auto& overlap) {
    return is_on(*overlap, overlap->frame.project(place), 0.0);
  });
}

OccludedPlaces OccludedFaces::of_pair(const PairKey& blocks) const {
  const auto& [a, b] = blocks;
  return {[this, a = a, b = b](int face, const Vector3& place) { return hides(a, face, b, place); },
          [this, a = a, b = b](int face, const Vector3& place) { return hides(b, face, a, place); }};
}

void turn_to_open_faces(const MovingSurface& a, const MovingSurface& b, const OccludedPlaces& hidden,
                        std::vector<Touch>& touches) {
  std::erase_if(touches, [&](Touch& touch) {
    auto* of = std::get_if<VertexContact>(&touch.contact);
    if (of == nullptr) return false;
    const EnteringVertex vertex = of->vertex_of_a ? EnteringVertex{a, b, hidden.of_b, of->point}
                                                  : EnteringVertex{b, a, hidden.of_a, of->point};
    return vertex.is_hidden(of->cell) && !vertex.turn(*of);
  });
  // A vertex that passes the occluded side and the adjacent face in one step touches that face once.
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const auto rest = touches.begin() + static_cast<std::ptrdiff_t>(k) + 1;
    touches.erase(
        std::remove_if(rest, touches.end(), [&](const Touch& other) { return are_same(touches[k], other); }),
        touches.end());
  }
}

OccludedFacesOfStep::OccludedFacesOfStep(std::vector<bool> fixed, const SimulationSettings& settings)
    : fixed_(std::move(fixed)),
      flush_{settings.contact_distance, settings.contact_distance, settings.search.contact_angle} {}

OccludedFaces OccludedFacesOfStep::between_fixed_blocks(const std::vector<BlockSurface>& surfaces) const {
  OccludedFaces sides;
  std::vector<Box> boxes(surfaces.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (fixed_[k]) boxes[k] = box_of(surfaces[k].surface().points).grown(flush_.reach);
  }
  for (const PairKey& pair : meeting_boxes(boxes)) {
    const SubFaceSurface& a = surfaces[at(pair[0])].surface();
    const SubFaceSurface& b = surfaces[at(pair[1])].surface();
    const PairContacts contacts =
        find_contacts(PlacedSurface(a, a.points), PlacedSurface(b, b.points), flush_);
    sides.add(pair, contacts.overlaps, a, b, flush_.reach);
  }
  return sides;
}

void OccludedFacesOfStep::note(const std::vector<PairOfContacts>& contacts,
                               const std::vector<BlockSurface>& surfaces) {
  of_step_.emplace();
  const bool any_inside = std::any_of(contacts.begin(), contacts.end(), [](const PairOfContacts& pair) {
    return std::any_of(pair.second->vertices.begin(), pair.second->vertices.end(),
                       [](const VertexContact& contact) { return contact.gap < 0.0; });
  });
  if (!any_inside) return;
  if (!of_fixed_) of_fixed_ = between_fixed_blocks(surfaces);
  of_step_ = *of_fixed_;
  for (const auto& [blocks, of_pair] : contacts) {
    of_step_->add(blocks, of_pair->overlaps, surfaces[at(blocks[0])].surface(),
                  surfaces[at(blocks[1])].surface(), flush_.reach);
  }
}

void SurfaceContinuation::add(const PairKey& blocks, const std::vector<CellOverlap>& overlaps,
                              const PlacedSurface& a, const PlacedSurface& b) {
  for (const CellOverlap& overlap : overlaps)
    covers_.add(blocks, overlap, a.surface(), b.surface(), {&overlap, &a, &b});
}

bool SurfaceContinuation::continues(const Cover& cover, const RimPlace& rim) const {
  const CellOverlap& overlap = *cover.overlap;
  const Eigen::Vector2d place = overlap.frame.project(rim.place);
  if (!is_on(overlap, place, reach_)) return false;
  const auto gap = [&](const Eigen::Vector2d& seen) {
    return height(*cover.a, overlap.cell_a, overlap.frame, seen) -
           height(*cover.b, overlap.cell_b, overlap.frame, seen);
  };
  // Faces parallel within rounding error do not diverge.
  constexpr double rounding = 1e-9;
  const double rise = gap(overlap.frame.project(rim.place + rim.outward)) - gap(place);
  return gap(place) <= rim.near && rise <= rounding;
}

bool SurfaceContinuation::continues(int block, int with_rim, const RimPlace& rim) const {
  return covers_.any(block, rim.face, with_rim, [&](const Cover& cover) { return continues(cover, rim); });
}

}  // namespace ashlar
