// Faces of blocks and the polygons in which other blocks lie on them:
// - Occluded faces cannot be entered or left through. With penalty springs a corner penetrates its support. Where that
//   block ends and a neighbour begins, the corner passes through the common side into the neighbour without ever having
//   been outside of it. The side is the nearest face, but the surface of the neighbour supports the corner
//   (geometry/contacts/contact_search.hpp, OccludedPlaces).
// - Continuation of supporting surfaces: a block that spans several others lies on one surface, and edges between flush
//   blocks do not bound it (mechanics/contact/reference_face.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/contacts/contact_search.hpp"
#include "geometry/contacts/motion_check.hpp"
#include "geometry/index.hpp"
#include "mechanics/block/block_surface.hpp"
#include "mechanics/contact/reference_face.hpp"
#include "solver/block_pair.hpp"
#include "solver/settings.hpp"

namespace ashlar {

/// Polygons by block and face. @tparam Polygon copied to both faces
template <class Polygon>
class CoveredFaces {
 public:
  /// Adds a polygon in which faces of two blocks lie on each other.
  void add(const PairKey& blocks, const CellOverlap& overlap, const SubFaceSurface& a,
           const SubFaceSurface& b, const Polygon& polygon) {
    of_faces_[{blocks[0], a.cells[at(overlap.cell_a)].face}].emplace_back(blocks[1], polygon);
    of_faces_[{blocks[1], b.cells[at(overlap.cell_b)].face}].emplace_back(blocks[0], polygon);
  }
  [[nodiscard]] bool empty() const { return of_faces_.empty(); }
  /// True if a polygon of any block other than `but` on a face satisfies a condition.
  template <class Condition>
  [[nodiscard]] bool any(int block, int face, int but, const Condition& condition) const {
    const auto found = of_faces_.find({block, face});
    return found != of_faces_.end() &&
           std::any_of(found->second.begin(), found->second.end(), [&](const auto& of_block) {
             return of_block.first != but && condition(of_block.second);
           });
  }

 private:
  std::map<std::array<int, 2>, std::vector<std::pair<int, Polygon>>> of_faces_;
};

class OccludedFaces {
 public:
  /// Adds the faces of two blocks that lie on each other.
  /// @param reach m, largest gap of such faces
  void add(const PairKey& blocks, const std::vector<CellOverlap>& overlaps, const SubFaceSurface& a,
           const SubFaceSurface& b, double reach);
  [[nodiscard]] bool empty() const { return covers_.empty(); }
  /// True if a face of a block lies on any block other than `but` at a place in its plane.
  [[nodiscard]] bool hides(int block, int face, int but, const Vector3& place) const;
  /// Occluded places of a pair of blocks. This must outlive the result.
  [[nodiscard]] OccludedPlaces of_pair(const PairKey& blocks) const;

 private:
  CoveredFaces<std::shared_ptr<const CellOverlap>> covers_;
};

/// A vertex that enters a block through an occluded side has entered below one of the adjacent faces: the one where
/// it ends least deep. A touch with an occluded side is replaced by one with that face, without duplicates, or
/// removed if the vertex ends outside.
void turn_to_open_faces(const MovingSurface& a, const MovingSurface& b, const OccludedPlaces& hidden,
                        std::vector<Touch>& touches);

/// The contacts of a pair of blocks (a < b).
using PairOfContacts = std::pair<PairKey, const PairContacts*>;

/// Occluded faces of a step: those between fixed blocks, found once, and those of the step's contacts.
class OccludedFacesOfStep {
 public:
  /// @param fixed by block; false for absent blocks
  OccludedFacesOfStep(std::vector<bool> fixed, const SimulationSettings& settings);

  /// Makes a block one of the fixed ones, or removes it.
  void set_fixed(int block, bool fixed) {
    fixed_[at(block)] = fixed;
    of_fixed_.reset();
  }
  /// Begins a step without occluded faces.
  void begin() { of_step_.reset(); }
  [[nodiscard]] bool noted() const { return of_step_.has_value(); }
  /// Adds the faces that lie on each other, if any vertex is inside a block. @param surfaces of all blocks
  void note(const std::vector<PairOfContacts>& contacts, const std::vector<BlockSurface>& surfaces);
  /// Empty if no vertex is inside a block. @pre noted
  [[nodiscard]] const OccludedFaces& hidden() const { return *of_step_; }

 private:
  [[nodiscard]] OccludedFaces between_fixed_blocks(const std::vector<BlockSurface>& surfaces) const;

  std::vector<bool> fixed_;
  ContactLimits flush_;  ///< limits for faces that lie on each other
  std::optional<OccludedFaces> of_fixed_, of_step_;
};

class SurfaceContinuation {
 public:
  /// @param reach m, largest distance of blocks that form one surface
  explicit SurfaceContinuation(double reach) : reach_(reach) {}
  /// Adds the faces of two blocks in contact. @param overlaps, a, b must outlive this
  void add(const PairKey& blocks, const std::vector<CellOverlap>& overlaps, const PlacedSurface& a,
           const PlacedSurface& b);
  /// True if a block other than the one with the rim continues the surface behind it.
  /// @param block that lies on the rim. @param with_rim the other one
  [[nodiscard]] bool continues(int block, int with_rim, const RimPlace& rim) const;

 private:
  struct Cover {
    const CellOverlap* overlap;
    const PlacedSurface* a;
    const PlacedSurface* b;
  };
  [[nodiscard]] bool continues(const Cover& cover, const RimPlace& rim) const;

  CoveredFaces<Cover> covers_;
  double reach_;
};

}  // namespace ashlar
