// The exchange of ranks in a step (step_exchange.hpp): a run that several processes share.
#pragma once

#include <memory>

#include "solver/shared/border_pairs.hpp"
#include "solver/shared/ghosts.hpp"
#include "solver/state/step_exchange.hpp"

namespace ashlar {

/// The exchange of the blocks of one rank; its neighbours are the ghosts.
class SharedStep final : public StepExchange {
 public:
  /// @param shared must outlive this
  explicit SharedStep(SharedBlocks& shared);

  [[nodiscard]] BlockShare& share() const { return *shared_.share; }
  [[nodiscard]] SharedBlocks& blocks() const { return shared_; }

  [[nodiscard]] bool alone() const override { return share().ranks().alone(); }
  [[nodiscard]] bool owns(int block) const override { return share().owns(block); }
  [[nodiscard]] bool knows(int block) const override { return owns(block) || share().is_ghost(block); }
  [[nodiscard]] bool first() const override { return share().ranks().own() == 0; }
  [[nodiscard]] const PlacesOfRun* placed() const override { return &placed_; }
  [[nodiscard]] std::vector<Bytes> gather(const Bytes& given) const override {
    return share().ranks().gather(given);
  }
  void on_all(const std::function<void()>& work) const override { do_on_all(share().ranks(), work); }

  void before_step(const RunContext& run, double step) override;
  void agree_on_kept(const BlockSystem& system, const std::vector<NearPair>& near,
                     std::vector<std::shared_ptr<const KeptContacts>>& kept) const override;
  void add_recipes_of_others(const BlockSystem& system, const RunState& state,
                             const std::function<JointLaw(const PairKey&)>& law_of,
                             std::vector<PairRecipe>& recipes) override;
  [[nodiscard]] int join_islands(const BlockSystem& system, std::vector<Island>& islands) const override;
  [[nodiscard]] std::map<int, int> first_blocks(const BlockSystem& system, const Island& joined,
                                                const std::vector<ContactPair>& pairs) const override;
  [[nodiscard]] std::unique_ptr<JoinedSystem> joined_system(const BlockSystem& system, const Island& joined,
                                                            const std::vector<BodyStep>& bodies,
                                                            const std::vector<ContactPair>& pairs,
                                                            SharedFactor* kept) const override;
  void tell_neighbours(const std::function<void(ByteWriter& writer, int block)>& write,
                       const std::function<void(ByteReader& reader, int block)>& read) const override;
  void tell_contacts(const BlockSystem& system, RunState& state) const override;

  [[nodiscard]] double travel_beyond(const BlockSystem& system, const ContactFinder& finder,
                                     const std::function<Eigen::MatrixX3d(int block)>& motion) const override;
  void find_neighbours(const RunContext& run, double travel) override;
  void tell_models(BlockSystem& system, RunState& state, StepCaches& caches) const override;
  [[nodiscard]] std::any neighbours() const override { return ghosts_now(shared_); }
  void restore_neighbours(const RunContext& run, const std::any& neighbours) override;
  void restore_start(const RunContext& run, const SimulationSnapshot& start) override;

 private:
  SharedBlocks& shared_;
  PlacesOfRun placed_;
};

/// Blocks that ranks share; null: the run has one process.
[[nodiscard]] SharedBlocks* shared_blocks_of(const BlockSystem& system);
/// The blocks of this rank in a run that several share. @pre it has a SharedStep
[[nodiscard]] BlockShare& share_of(const BlockSystem& system);

}  // namespace ashlar
