// The exchange of a run of one process: there is nothing to exchange.
#include "solver/contact/contact_cache.hpp"
#include "solver/contact/contact_pair.hpp"
#include "solver/state/step_exchange.hpp"
#include "solver/step/accept/snapshot.hpp"
#include "solver/step/detect/pair_recipe.hpp"
#include "solver/step/island/joined_system.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {
namespace {

class NoExchange final : public StepExchange {
 public:
  [[nodiscard]] bool alone() const override { return true; }
  [[nodiscard]] bool owns(int) const override { return true; }
  [[nodiscard]] bool knows(int) const override { return true; }
  [[nodiscard]] bool first() const override { return true; }
  [[nodiscard]] const PlacesOfRun* placed() const override { return nullptr; }
  [[nodiscard]] std::vector<std::vector<std::byte>> gather(
      const std::vector<std::byte>& given) const override {
    return {given};
  }
  void on_all(const std::function<void()>& work) const override { work(); }

  void before_step(const RunContext&, double) override {}
  void agree_on_kept(const BlockSystem&, const std::vector<NearPair>&,
                     std::vector<std::shared_ptr<const KeptContacts>>&) const override {}
  void add_recipes_of_others(const BlockSystem&, const RunState&,
                             const std::function<JointLaw(const PairKey&)>&,
                             std::vector<PairRecipe>&) override {}
  [[nodiscard]] int join_islands(const BlockSystem&, std::vector<Island>&) const override { return -1; }
  [[nodiscard]] std::map<int, int> first_blocks(const BlockSystem&, const Island&,
                                                const std::vector<ContactPair>&) const override {
    return {};
  }
  [[nodiscard]] std::unique_ptr<JoinedSystem> joined_system(const BlockSystem&, const Island&,
                                                            const std::vector<BodyStep>&,
                                                            const std::vector<ContactPair>&,
                                                            SharedFactor*) const override {
    return nullptr;
  }
  void tell_neighbours(const std::function<void(ByteWriter&, int)>&,
                       const std::function<void(ByteReader&, int)>&) const override {}
  void tell_contacts(const BlockSystem&, RunState&) const override {}

  [[nodiscard]] double travel_beyond(const BlockSystem&, const ContactFinder&,
                                     const std::function<Eigen::MatrixX3d(int)>&) const override {
    return 0.0;
  }
  void find_neighbours(const RunContext&, double) override {}
  void tell_models(BlockSystem&, RunState&, StepCaches&) const override {}
  [[nodiscard]] std::any neighbours() const override { return {}; }
  void restore_neighbours(const RunContext&, const std::any&) override {}
  void restore_start(const RunContext& run, const SimulationSnapshot& start) override {
    restore(run.system, run.state, run.caches, start);
  }
};

}  // namespace

StepExchange& no_exchange() {
  static NoExchange none;
  return none;
}

}  // namespace ashlar
