// Contacts at seams: a block that slides from one block to the next has sunk into what it rests on, as
// springs must give way to hold it, and so meets the side of the next one by as much. Such a contact is not
// there for blocks that do not sink, and would stop or throw it.
//
// A contact is one of a seam if, when one of the two blocks moves out of what it was in at the end of the
// last step, what touches of the two is on either side of a plane across that way, as an inclined side that
// leads up from the rim of a sole and the edge of the next block are: the block would slide over the other.
// It moves by twice the depth, as depths change within a step. Where what it lies on, or what it comes to,
// has sunk into something else or has been pressed to less than its height, by as much more. Faces across the
// way are what blocks rest on; they are none. A block that goes on beyond what touches, as below a corner at
// the height of the other's rim, pushes.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "geometry/contacts/motion_check.hpp"
#include "solver/contact/contact_finder.hpp"

namespace ashlar {

/// A motion of a block a relative to a block b that takes either of them out of what it had sunk into.
struct Retraction {
  Vector3 direction;          ///< unit
  double height;              ///< m; negative: it has as far to go until it touches
  std::array<int, 2> out_of;  ///< the two blocks that were in each other, the lower number first
  /// Whether they are a and b: only steep sides may then be of a seam, otherwise all that is not across the
  /// way.
  bool own;
};

/// By how much a block is shorter or longer along a unit direction than it is without load, m, >= 0.
using BlockCompression = std::function<double(int block, const Vector3& direction)>;

/// Unit normals across which each contact of a pair touches; only their lines count.
using ContactNormals = std::vector<std::vector<Vector3>>;
[[nodiscard]] ContactNormals normals_of(const PlacedSurface& a, const PlacedSurface& b,
                                        const PairContacts& contacts);
[[nodiscard]] ContactNormals normals_of(const PlacedSurface& a, const PlacedSurface& b, const Touch& touch);

/// Ways out of what each block had sunk into at the end of the last step. A block has one bundle of ways for each
/// direction, however many blocks lie on it: work is proportional to the ways that may matter to a pair.
class Retractions {
 public:
  Retractions() = default;  ///< none
  /// @param moving by block: two blocks that do not move are left out
  Retractions(const PairHistories& histories, const std::vector<bool>& moving);
  /// Two blocks a < b that are in each other or about to touch. @param normal out of b. @param depth m;
  /// negative: the gap between them
  void add(const std::array<int, 2>& blocks, const Vector3& normal, double depth);
  /// The same of all faces and vertices that lie or come to lie on a face.
  void add_touching(const std::array<int, 2>& blocks, const PlacedSurface& a, const PlacedSurface& b,
                    const PairContacts& contacts);
  /// Ways of a pair, less those that are across the faces of all its contacts, which they do not undo.
  /// @param compression_of empty: blocks are rigid
  [[nodiscard]] std::vector<Retraction> of_pair(int a, int b, const ContactNormals& normals,
                                                const BlockCompression& compression_of) const;
  /// Whether a block still lies on what a way leads out of, by a contact that no other way undoes: of two
  /// flanks of a ridge that has hardly gone in, each is beside the way out of the other.
  /// @param found contacts, ordered by blocks, with or without those of seams. @param placed surfaces of
  /// blocks that have contacts
  [[nodiscard]] bool stands(const Retraction& way, const std::vector<FoundContacts>& found,
                            const std::function<const PlacedSurface&(int)>& placed,
                            const BlockCompression& compression_of) const;

 private:
  struct OutOf {
    Vector3 direction;
    double height;
    std::size_t number;  ///< counts ways in the order in which they were added
  };
  struct Highest {
    int other = -1;
    double height = 0.0;  ///< m, >= 0
  };
  /// Ways of a block whose directions differ from that of the first by less than a third of a degree.
  struct Bundle {
    Vector3 direction;                         ///< of the first
    std::map<int, std::vector<OutOf>> out_of;  ///< by what the block was in
    std::array<Highest, 2> highest;            ///< and the highest out of another block
  };
  /// Height of the highest of a block's ways out of any but another one, along a direction or against it, and
  /// twice what the block itself has given way, m.
  [[nodiscard]] double sunk(int block, int but, const Vector3& direction,
                            const BlockCompression& compression_of) const;

  std::map<int, std::vector<Bundle>> ways_;  ///< by block
  std::size_t count_ = 0;
};

/// Removes the contacts of a pair that one of the ways undoes. @param ways as Retractions::of_pair returns
/// @param stands which of them count
void remove_internal_edges(const PlacedSurface& a, const PlacedSurface& b,
                           const std::vector<Retraction>& ways,
                           const std::function<bool(const Retraction&)>& stands, PairContacts& contacts);

/// Whether one of the ways undoes a touch.
[[nodiscard]] bool at_internal_edge(const PlacedSurface& a, const PlacedSurface& b,
                                    const std::vector<Retraction>& ways,
                                    const std::function<bool(const Retraction&)>& stands, const Touch& touch);

}  // namespace ashlar
