// Contacts that last: what a search has found of two blocks is not found again while they have hardly moved
// relative to each other (notes/lasting_contacts.md).
//
// Material points, normals, areas and rows stay as they were found. Gaps are those of the present state, along
// these normals:
//
//   g = g0 + n . (u_a - u_b)        u: displacement of a material point since it was found
//
// which for blocks whose faces are flat is the gap itself but for the square of the motion, and linear in the
// unknowns, so that springs keep the energy that they hold.
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
#include "mechanics/contact/joint_law.hpp"
#include "solver/contact/pair_rows.hpp"

namespace ashlar {

/// What was found of two blocks. Constant, so that all that keep it share it.
struct LastingContacts {
  PairContacts contacts;                      ///< less those of seams; empty: they were apart
  std::array<Eigen::MatrixX3d, 2> positions;  ///< of both blocks when they were found, (p, 3)
  /// How both surfaces were divided (BlockSurface::wanted).
  std::array<std::vector<std::uint64_t>, 2> divisions;
  double reach = 0.0;                            ///< m, up to which gap contacts were looked for
  JointLaw law;                                  ///< as it was, with the rounding of the pair's coordinates
  ContactPoints found;                           ///< what was made of the contacts
  std::shared_ptr<const PairRows::Values> rows;  ///< of the points; null: not made yet (a checkpoint's)
};

/// Lists what a checkpoint stores (run/byte_archive.hpp); rows follow from it, see with_rows().
template <class Archive>
void visit_members(Archive& archive, LastingContacts& lasting) {
  auto& [contacts, positions, divisions, reach, law, found, rows] = lasting;
  archive(contacts, positions, divisions, reach, law, found);
}

/// Contacts as they are at a later state.
struct KeptContacts {
  std::shared_ptr<const LastingContacts> lasting;
  Vector3 shift;                     ///< of both blocks alike since they were found, m
  std::vector<ContactPoint> points;  ///< with the present places and gaps
};

/// The motion of a and of b since their contacts were found.
struct RelativeMotion {
  std::array<Eigen::MatrixX3d, 2> changes;  ///< of the positions, (p, 3)
  Vector3 shift = Vector3::Zero();          ///< mean translation of both centroids, m; 0 if a block is fixed
};
[[nodiscard]] RelativeMotion motion_since(const LastingContacts& lasting, const ContactBody& a,
                                          const ContactBody& b);

/// Bounds what the contacts of a pair may have become since they were found.
struct LastingLimits {
  double motion = 0.0;  ///< m, of the fastest points of both blocks together, less their common shift
  double reach = 0.0;   ///< m, up to which gap contacts have to be known
};

/// The contacts at the present state, if they need not be found anew: motion since they were found and what
/// their reach lacks are within the limit, the law is the same and pressure ends where it did.
/// @param bounds of the motion of each block's points when its position changes, m
/// @param law of the pair now, without rounding
[[nodiscard]] std::optional<KeptContacts> kept_contacts(
    const std::shared_ptr<const LastingContacts>& lasting, const ContactBody& a, const ContactBody& b,
    const JointLaw& law, const LastingLimits& limits,
    const std::array<std::function<double(const Eigen::MatrixX3d&)>, 2>& bounds);

/// With the rows of its points, which a checkpoint has not.
/// @throws std::invalid_argument if it is not of two such blocks, or has cells that their surfaces have not
[[nodiscard]] std::shared_ptr<const LastingContacts> with_rows(const LastingContacts& lasting,
                                                               const BlockModel& a, const BlockModel& b,
                                                               const BlockSurface& surface_a,
                                                               const BlockSurface& surface_b);

/// Contacts moved by a shift of both blocks.
[[nodiscard]] PairContacts shifted(PairContacts contacts, const Vector3& shift);

}  // namespace ashlar
