// Contacts at internal edges. A block that slides from one block to the next penetrates its support by the
// deformation of the springs, and so meets the side of the next block by the same depth. Such a contact is spurious:
// it would not exist without penetration, and would stop the block or throw it up.
//
// A contact is at an internal edge if it vanishes when one of the two blocks is retracted from a penetration of the
// last step: the touching features are then on either side of a plane normal to the retraction, and the block would
// slide over the other one. An example is an inclined side that rises from the rim of a sole, against the edge of the
// next block. The retraction is twice the depth, as depths change within a step. It is increased by the penetration
// and by the compression of the supporting block and of the block that is met. Contacts with normals along the
// retraction support the block and are kept. So are contacts of a block that extends beyond the touching features,
// e.g. below a corner at the height of the other's rim.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "geometry/contacts/motion_check.hpp"
#include "solver/block_pair.hpp"
#include "solver/contact/contact_finder.hpp"

namespace ashlar {

/// A motion of a block a relative to a block b that takes either of them out of its penetration.
struct Retraction {
  Vector3 direction;  ///< unit
  double height;      ///< m; negative: remaining gap until contact
  PairKey out_of;     ///< the two penetrating blocks, the lower number first
  /// True if they are a and b: only steep sides may then be at an internal edge, otherwise all sides that are not
  /// normal to the direction.
  bool own;
};

/// Shortening of a block along a unit direction relative to its unloaded length, m, >= 0.
using BlockCompression = std::function<double(int block, const Vector3& direction)>;

/// Unit normals of each contact of a pair; their signs are irrelevant.
using ContactNormals = std::vector<std::vector<Vector3>>;
[[nodiscard]] ContactNormals normals_of(const PlacedSurface& a, const PlacedSurface& b,
                                        const PairContacts& contacts);
[[nodiscard]] ContactNormals normals_of(const PlacedSurface& a, const PlacedSurface& b, const Touch& touch);

/// Retractions of each block from its penetrations at the end of the last step. A block has one bundle of retractions
/// per direction, for any number of blocks that lie on it: work is proportional to the retractions relevant to a
/// pair.
class Retractions {
 public:
  Retractions() = default;  ///< none
  /// @param moving by block: pairs of two fixed blocks are ignored
  Retractions(const PairHistories& histories, const std::vector<bool>& moving);
  /// Adds two blocks a < b that penetrate or are about to touch. @param normal out of b. @param depth m;
  /// negative: the gap between them
  void add(const PairKey& blocks, const Vector3& normal, double depth);
  /// Adds all faces and vertices that lie or come to lie on a face.
  void add_touching(const PairKey& blocks, const PlacedSurface& a, const PlacedSurface& b,
                    const PairContacts& contacts);
  /// Retractions of a pair, without those along the normals of all its contacts, which they cannot undo.
  /// @param compression_of empty: blocks are rigid
  [[nodiscard]] std::vector<Retraction> of_pair(int a, int b, const ContactNormals& normals,
                                                const BlockCompression& compression_of) const;
  /// True if a block still lies on the block of a retraction by a contact that no other retraction undoes. For two
  /// flanks of a ridge with little penetration, for example, each is beside the retraction from the other.
  /// @param found contacts, ordered by blocks, with or without those at internal edges. @param placed surfaces of
  /// blocks that have contacts
  [[nodiscard]] bool stands(const Retraction& retraction, const std::vector<FoundContacts>& found,
                            const std::function<const PlacedSurface&(int)>& placed,
                            const BlockCompression& compression_of) const;

 private:
  struct OutOf {
    Vector3 direction;
    double height;
    std::size_t number;  ///< counts retractions in the order in which they were added
  };
  struct Highest {
    int other = -1;
    double height = 0.0;  ///< m, >= 0
  };
  /// Retractions of a block whose directions differ from that of the first by less than a third of a degree.
  struct Bundle {
    Vector3 direction;                         ///< of the first
    std::map<int, std::vector<OutOf>> out_of;  ///< by the penetrated block
    std::array<Highest, 2> highest;            ///< the highest, and the highest from another block
  };
  /// Largest height of a block's retractions along a direction or against it, excluding those from one block, plus
  /// twice its compression, m.
  [[nodiscard]] double sunk(int block, int but, const Vector3& direction,
                            const BlockCompression& compression_of) const;

  std::map<int, std::vector<Bundle>> bundles_;  ///< by block
  std::size_t count_ = 0;
};

/// Removes the contacts of a pair that one of the retractions undoes. @param retractions as Retractions::of_pair returns
/// @param stands selects the valid ones
void remove_internal_edges(const PlacedSurface& a, const PlacedSurface& b,
                           const std::vector<Retraction>& retractions,
                           const std::function<bool(const Retraction&)>& stands, PairContacts& contacts);

/// True if one of the retractions undoes a touch.
[[nodiscard]] bool at_internal_edge(const PlacedSurface& a, const PlacedSurface& b,
                                    const std::vector<Retraction>& retractions,
                                    const std::function<bool(const Retraction&)>& stands, const Touch& touch);

}  // namespace ashlar
