#include "solver/shared/shared_bolts.hpp"

#include <algorithm>
#include <iterator>

#include "solver/archived_geometry.hpp"
#include "solver/bolts/bolted_blocks.hpp"
#include "solver/shared/shared_step.hpp"
#include "solver/step/island/bolts_of_run.hpp"

namespace ashlar {
namespace {

bool owns_any(const BlockShare& share, const std::vector<int>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [&](int block) { return share.owns(block); });
}

}  // namespace

std::vector<int> with_bolted(const BlockSystem& system, std::vector<int> ghosts) {
  if (system.bolts().empty()) return ghosts;
  for (const Bolt& bolt : system.bolts()) {
    const std::vector<int> blocks = present_blocks(bolt.chain);
    if (!owns_any(share_of(system), blocks)) continue;
    std::copy_if(blocks.begin(), blocks.end(), std::back_inserter(ghosts),
                 [&](int block) { return !system.owns(block); });
  }
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  return ghosts;
}

void send_bolts_to_first(const BlockSystem& system, RunState& state) {
  if (system.exchange().alone() || system.bolts().empty()) return;
  send_to_first(
      share_of(system).ranks(),
      [&](ByteWriter& writer) {
        if (const std::vector<ToldBolt> own = own_bolts(system, state); !own.empty()) writer(own);
      },
      [&](ByteReader& reader, int) {
        std::vector<ToldBolt> told;
        reader(told);
        take_told(std::move(told), state);
      });
}

}  // namespace ashlar
