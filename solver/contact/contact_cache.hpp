// Contact cache: the contacts of two blocks are not detected again while their relative motion is small
// (notes/contact_cache.md).
//
// Material points, normals, areas and rows are those of the detection. Gaps are those of the present state along
// these normals:
//
//   g = g0 + n . (u_a - u_b)        u: displacement of a material point since the detection
//
// For blocks with flat faces this is the exact gap but for the square of the motion. It is linear in the unknowns, so
// that springs keep their energy.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/contacts/contact_search.hpp"
#include "mechanics/block/block_surface.hpp"
#include "mechanics/contact/contact_points.hpp"
#include "mechanics/contact/laws/joint_law.hpp"
#include "solver/contact/pair_rows.hpp"

namespace ashlar {

/// Result of a search for two blocks. Constant, so that it can be shared.
struct ContactCache {
  PairContacts contacts;                      ///< without those at internal edges; empty: no contact
  std::array<Eigen::MatrixX3d, 2> positions;  ///< of both blocks at the detection, (p, 3)
  /// Divisions of both surfaces (BlockSurface::wanted).
  std::array<std::vector<std::uint64_t>, 2> divisions;
  double reach = 0.0;                            ///< m, largest gap searched
  JointLaw law;                                  ///< at the detection, with the rounding of the pair's
                                                 ///< coordinates
  ContactPoints found;                           ///< points of the contacts
  std::shared_ptr<const PairRows::Values> rows;  ///< of the points; null: not computed yet (from a
                                                 ///< checkpoint)
};

/// Lists what a checkpoint stores (byte_archive.hpp); rows follow from it, see with_rows().
template <class Archive>
void visit_members(Archive& archive, ContactCache& cache) {
  auto& [contacts, positions, divisions, reach, law, found, rows] = cache;
  archive(contacts, positions, divisions, reach, law, found);
}

/// Contacts evaluated at a later state.
struct KeptContacts {
  std::shared_ptr<const ContactCache> cache;
  Vector3 shift;                     ///< common translation of both blocks since the detection, m
  std::vector<ContactPoint> points;  ///< with the present places and gaps
};

/// Motion of a and of b since the detection of their contacts.
struct RelativeMotion {
  std::array<Eigen::MatrixX3d, 2> changes;  ///< of the positions, (p, 3)
  Vector3 shift = Vector3::Zero();          ///< mean translation of both centroids, m; 0 if a block is fixed
};
[[nodiscard]] RelativeMotion motion_since(const ContactCache& cache, const ContactBody& a,
                                          const ContactBody& b);

/// Limits of validity of cached contacts.
struct LastingLimits {
  double motion = 0.0;  ///< m, of the fastest points of both blocks together, without their common shift
  double reach = 0.0;   ///< m, largest gap up to which contacts must be known
};

/// The cached contacts at the present state if they are valid: motion since the detection plus missing reach is
/// within the limit, the law is the same and the ends of pressure are unchanged.
/// @param bounds of the motion of each block's points when its position changes, m
/// @param law of the pair at present, without rounding
[[nodiscard]] std::optional<KeptContacts> kept_contacts(
    const std::shared_ptr<const ContactCache>& cache, const ContactBody& a, const ContactBody& b,
    const JointLaw& law, const LastingLimits& limits,
    const std::array<std::function<double(const Eigen::MatrixX3d&)>, 2>& bounds);

/// Adds the rows of its points, which a checkpoint does not store.
/// @throws std::invalid_argument if it does not belong to two such blocks, or has cells that their surfaces lack
[[nodiscard]] std::shared_ptr<const ContactCache> with_rows(const ContactCache& cache, const BlockModel& a,
                                                            const BlockModel& b,
                                                            const BlockSurface& surface_a,
                                                            const BlockSurface& surface_b);

/// Contacts moved by a shift of both blocks.
[[nodiscard]] PairContacts shifted(PairContacts contacts, const Vector3& shift);

}  // namespace ashlar
