#include "apps/program/run/rank_agreement.hpp"

#include <algorithm>
#include <ostream>
#include <vector>

#include "geometry/index.hpp"
#include "solver/ranks/rank_values.hpp"

namespace ashlar {

bool are_several(const RunRanks* ranks) {
  return ranks != nullptr && ranks->several();
}

bool is_first(const RunRanks* ranks) {
  return ranks == nullptr || ranks->first();
}

bool all_go_on(const RunRanks* ranks, bool good, const std::string& messages, std::ostream& err) {
  if (!are_several(ranks)) {
    err << messages;
    return good;
  }
  // The first letter says whether the rank can go on.
  const std::string told = (good ? "+" : "-") + messages;
  const std::vector<Bytes> all = ranks->ranks.gather(bytes_of_values<char>(told));
  const auto bad =
      std::find_if(all.begin(), all.end(), [](const Bytes& one) { return one.front() == std::byte('-'); });
  if (ranks->first()) {
    const std::vector<char> text = values_of_bytes<char>(bad == all.end() ? all.front() : *bad);
    err.write(text.data() + 1, static_cast<std::streamsize>(text.size()) - 1);
  }
  return bad == all.end();
}

}  // namespace ashlar
