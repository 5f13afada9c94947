#include "solver/shared/known_contacts.hpp"

#include <algorithm>
#include <set>

#include "geometry/index.hpp"
#include "solver/ranks/block_share.hpp"
#include "solver/shared/shared_step.hpp"

namespace ashlar {

void drop_unknown_elsewhere(const BlockSystem& system, const std::vector<NearPair>& near,
                            std::vector<std::shared_ptr<const KeptContacts>>& kept) {
  const BlockShare& share = share_of(system);
  std::set<PairKey> unknown;
  share.exchange(
      [&](ByteWriter& writer, int rank) {
        const std::vector<int>& lent = share.lent_to(rank);
        const auto is_lent = [&](int block) { return std::binary_search(lent.begin(), lent.end(), block); };
        for (std::size_t n = 0; n < near.size(); ++n) {
          const auto& [a, b] = near[n].blocks;
          if (kept[n] == nullptr && system.owns_pair(a, b) && (is_lent(a) || is_lent(b)))
            writer(near[n].blocks);
        }
      },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          PairKey blocks;
          reader(blocks);
          unknown.insert(blocks);
        }
      });
  for (std::size_t n = 0; n < near.size(); ++n)
    if (unknown.count(near[n].blocks) > 0) kept[n].reset();
}

}  // namespace ashlar
