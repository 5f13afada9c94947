// Exchange and common decisions, in a step, of the processes that share a run. Steps, static analyses, contacts and
// applications know this interface only. A run of one process has NoExchange, whose functions do nothing;
// shared/shared_step.hpp is the exchange of several.
//
// Each process has its own blocks, and neighbours: blocks of others that may touch its own. All functions but owns(), first()
// and placed() are collective: each process calls the same ones in the same order.
#pragma once

#include <Eigen/Core>
#include <any>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "solver/block_pair.hpp"

namespace ashlar {

class BlockSystem;
class ByteReader;
class ByteWriter;
class ContactFinder;
class ContactPair;
class JoinedSystem;  // step/island/joined_system.hpp
struct BodyStep;     // step/island/island.hpp
struct Island;       // step/island/island.hpp
struct JointLaw;
struct KeptContacts;  // contact/contact_cache.hpp
struct NearPair;      // contact/contact_finder.hpp
struct PairRecipe;    // step/detect/pair_recipe.hpp
struct PlacedVolume;  // contact/placed_volume.hpp
struct RunContext;    // step/run_context.hpp
struct RunState;
struct SharedFactor;        // step/island/factor_cache.hpp
struct SimulationSnapshot;  // step/accept/snapshot.hpp
struct StepCaches;          // step/step_caches.hpp

/// The placed, undeformed blocks of a run of several processes.
struct PlacesOfRun {
  const std::vector<PlacedVolume>& volumes;  ///< by block
  const Eigen::Matrix3d& axes;               ///< along the largest face of all blocks
};

class StepExchange {
 public:
  virtual ~StepExchange() = default;

  /// @name Blocks
  /// @{
  /// True if there is one process only: nothing is exchanged.
  [[nodiscard]] virtual bool alone() const = 0;
  /// True if this process computes the motion of a block.
  [[nodiscard]] virtual bool owns(int block) const = 0;
  /// True if a block is own or a neighbour.
  [[nodiscard]] virtual bool knows(int block) const = 0;
  /// True on the one process that counts what all do together.
  [[nodiscard]] virtual bool first() const = 0;
  /// Null: those of the system.
  [[nodiscard]] virtual const PlacesOfRun* placed() const = 0;
  /// @}

  /// @name Decisions
  /// @{
  /// Bytes of each process, in one order on all.
  [[nodiscard]] virtual std::vector<std::vector<std::byte>> gather(
      const std::vector<std::byte>& given) const = 0;
  /// Does work of each process that needs no other one. If it throws on any, all throw.
  virtual void on_all(const std::function<void()>& work) const = 0;
  /// @}

  /// @name A step
  /// @{
  /// Shares blocks out again if due, and finds the neighbours that may touch in a step. @param step s; 0: an iteration of
  /// a static analysis
  virtual void before_step(const RunContext& run, double step) = 0;
  /// Drops kept contacts of pairs of other processes that these do not keep. @param near pairs of the step
  /// @param kept by near pair; null: to be detected
  virtual void agree_on_kept(const BlockSystem& system, const std::vector<NearPair>& near,
                             std::vector<std::shared_ptr<const KeptContacts>>& kept) const = 0;
  /// Adds the recipes of pairs with an own block that other processes make, in the order of blocks.
  /// @param recipes of pairs that this one makes, in order. @param law_of law of a pair without rounding
  virtual void add_recipes_of_others(const BlockSystem& system, const RunState& state,
                                     const std::function<JointLaw(const PairKey&)>& law_of,
                                     std::vector<PairRecipe>& recipes) = 0;
  /// Joins islands with blocks of several processes to one, the last, and removes those of neighbours alone.
  /// @return its index, also on processes that have none of its bodies; -1: there is none
  [[nodiscard]] virtual int join_islands(const BlockSystem& system, std::vector<Island>& islands) const = 0;
  /// Lowest block of the set of touching or bolted bodies that each body of the joined island belongs to, by body.
  [[nodiscard]] virtual std::map<int, int> first_blocks(const BlockSystem& system, const Island& joined,
                                                        const std::vector<ContactPair>& pairs) const = 0;
  /// The linear system of the joined island or a part of it. The arguments must outlive it.
  /// @param kept factor of an earlier step to go on from, and to leave for later ones; null: none
  [[nodiscard]] virtual std::unique_ptr<JoinedSystem> joined_system(const BlockSystem& system,
                                                                    const Island& joined,
                                                                    const std::vector<BodyStep>& bodies,
                                                                    const std::vector<ContactPair>& pairs,
                                                                    SharedFactor* kept) const = 0;
  /// Tells values of own blocks to the processes whose neighbours they are. @param write value of an own block; nothing
  /// written: none is told. @param read value of a neighbour
  virtual void tell_neighbours(const std::function<void(ByteWriter& writer, int block)>& write,
                               const std::function<void(ByteReader& reader, int block)>& read) const = 0;
  /// Tells the memory of contacts of neighbours with other blocks, which decides on contacts at internal edges.
  virtual void tell_contacts(const BlockSystem& system, RunState& state) const = 0;
  /// @}

  /// @name Neighbours
  /// @{
  /// Path of a block of any process, m, if blocks that its process does not know may be there; 0: all that blocks may
  /// meet are known. @param motion by block: change of its position, (p, 3); empty: none since the last step
  [[nodiscard]] virtual double travel_beyond(
      const BlockSystem& system, const ContactFinder& finder,
      const std::function<Eigen::MatrixX3d(int block)>& motion) const = 0;
  /// Finds neighbours again, for paths of blocks up to a length. @param travel m; 0: as before
  virtual void find_neighbours(const RunContext& run, double travel) = 0;
  /// Tells neighbours the models of blocks that a run has changed.
  virtual void tell_models(BlockSystem& system, RunState& state, StepCaches& caches) const = 0;
  /// Neighbours as they are, to be restored with a snapshot of this process.
  [[nodiscard]] virtual std::any neighbours() const = 0;
  virtual void restore_neighbours(const RunContext& run, const std::any& neighbours) = 0;
  /// Restores a snapshot of the start of a run that this process took itself, and finds neighbours.
  virtual void restore_start(const RunContext& run, const SimulationSnapshot& start) = 0;
  /// @}
};

}  // namespace ashlar
