#include "solver/shared/border_pairs.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/contact/contact_cache.hpp"
#include "solver/shared/shared_step.hpp"

namespace ashlar {
namespace {

/// A recipe as sent: without rows, which the receiver computes, and without cached contacts that it has.
struct PairMessage {
  PairKey blocks = {-1, -1};
  bool kept =
      false;  ///< contacts are those of the cache sent last; besides the blocks only the start is sent
  JointLaw law;
  std::vector<ContactPoint> points;
  std::vector<PressureCut> cuts;
  std::vector<FacePair> turning;
  std::shared_ptr<const ContactCache> cache;
  std::vector<PointMemory> memory;
  PatchStart start;
};

/// Rank of the other block of a pair that this one owns; -1: also this one.
int other_rank(const BlockSystem& system, const PairKey& blocks) {
  if (system.blocks()[at(blocks[0])].fixed() || system.blocks()[at(blocks[1])].fixed()) return -1;
  const BlockShare& share = share_of(system);
  const int rank = share.owner(share.owns(blocks[0]) ? blocks[1] : blocks[0]);
  return rank == share.ranks().own() ? -1 : rank;
}

/// Recipe of a pair whose contacts both ranks have. @param cached of this rank; null: none
PairRecipe kept_again(const BlockSystem& system, const RunState& state, const PairMessage& message,
                      const std::shared_ptr<const ContactCache>& cached, const JointLaw& law) {
  const auto [a, b] = message.blocks;
  const auto any_motion = [](const Eigen::MatrixX3d&) { return 0.0; };
  const std::optional<KeptContacts> kept =
      cached == nullptr
          ? std::nullopt
          : kept_contacts(cached, present_body(system, state, a), present_body(system, state, b), law,
                          {std::numeric_limits<double>::infinity(), 0.0}, {any_motion, any_motion});
  if (!kept) throw std::logic_error("contacts of blocks of two ranks are not the same on both");
  PairRecipe recipe = kept_recipe(state, message.blocks, *kept, law);
  // Only the owner of a pair has its account.
  recipe.start = message.start;
  return recipe;
}

}  // namespace

std::vector<PairRecipe> BorderPairs::exchange(const BlockSystem& system, const RunState& state,
                                              const std::vector<PairRecipe>& recipes,
                                              const std::function<JointLaw(const PairKey&)>& law_of) {
  const auto write = [&](ByteWriter& writer, int rank) {
    for (const PairRecipe& recipe : recipes) {
      if (other_rank(system, recipe.blocks) != rank) continue;
      std::shared_ptr<const ContactCache>& sent = sent_[recipe.blocks];
      const bool kept = recipe.start.continues && sent != nullptr && sent == recipe.patch.cache;
      sent = recipe.patch.cache;
      if (kept) {
        writer(PairMessage{recipe.blocks, true, {}, {}, {}, {}, nullptr, {}, recipe.start});
      } else {
        writer(PairMessage{recipe.blocks, false, recipe.law, recipe.patch.points, recipe.patch.cuts,
                           recipe.patch.turning, recipe.patch.cache, recipe.memory, recipe.start});
      }
    }
  };
  std::vector<PairRecipe> received;
  const auto read = [&](ByteReader& reader, int) {
    while (!reader.at_end()) {
      PairMessage message;
      reader(message);
      if (message.kept) {
        const auto known = received_.find(message.blocks);
        received.push_back(kept_again(system, state, message,
                                      known == received_.end() ? nullptr : known->second,
                                      law_of(message.blocks)));
        continue;
      }
      const BlockModel& a = system.blocks()[at(message.blocks[0])];
      const BlockModel& b = system.blocks()[at(message.blocks[1])];
      ContactPatch patch{std::move(message.points), std::move(message.cuts), std::move(message.turning)};
      std::shared_ptr<const ContactCache>& cached = received_[message.blocks];
      cached.reset();
      if (message.cache != nullptr) {
        ContactCache cache = *message.cache;
        cache.rows = patch.rows = PairRows::values_of(a, b, cache.found.points);
        cached = patch.cache = std::make_shared<const ContactCache>(std::move(cache));
      }
      received.push_back(
          {message.blocks, message.law, std::move(patch), std::move(message.memory), message.start});
    }
  };
  share_of(system).exchange(write, read);
  std::sort(received.begin(), received.end(),
            [](const PairRecipe& x, const PairRecipe& y) { return x.blocks < y.blocks; });
  return received;
}

}  // namespace ashlar
