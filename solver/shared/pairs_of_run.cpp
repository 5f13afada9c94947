#include "solver/shared/pairs_of_run.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/ranks/block_share.hpp"
#include "solver/ranks/rank_messages.hpp"
#include "solver/shared/shared_step.hpp"

namespace ashlar {
namespace {

/// Pairs of all ranks in one exchange.
constexpr std::size_t pairs_at_a_time = 512;

PairKey key_of(const PairRecord& record) {
  return {record.a, record.b};
}

/// Calls a function, and keeps its first exception for later: other ranks wait for this one.
class LaterFailure {
 public:
  template <class Call>
  void during(const Call& call) {
    if (thrown_) return;
    try {
      call();
    } catch (...) {
      thrown_ = std::current_exception();
    }
  }
  void raise() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::exception_ptr thrown_;
};

/// Keys of the pairs of all ranks on the first one, increasing, each once. Collective
std::vector<PairKey> keys_of_run(Ranks& ranks, const std::vector<PairKey>& own) {
  std::vector<PairKey> keys = ranks.own() == 0 ? own : std::vector<PairKey>();
  send_to_first(
      ranks, [&](ByteWriter& writer) { writer(own); },
      [&](ByteReader& reader, int) {
        std::vector<PairKey> others;
        reader(others);
        keys.insert(keys.end(), others.begin(), others.end());
      });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

/// How pairs are sent.
struct Messages {
  std::size_t pairs = 0;       ///< of all ranks
  std::vector<PairKey> first;  ///< key of each message but the first one
};

/// The same on all ranks. Collective. @param keys of all pairs, on the first rank
Messages messages_of_run(Ranks& ranks, const std::vector<PairKey>& keys) {
  Messages messages{keys.size(), {}};
  for (std::size_t k = pairs_at_a_time; k < keys.size(); k += pairs_at_a_time)
    messages.first.push_back(keys[k]);
  return values_of_ranks(ranks, messages).front();
}

/// Sends values to all other ranks, or to the first one, each of which reads those of the others.
template <class Write, class Read>
void send(Ranks& ranks, PairVisitors visitors, const Write& write, const Read& read) {
  if (visitors == PairVisitors::first)
    return send_to_first(ranks, write, [&](ByteReader& reader, int) { read(reader); });
  ByteWriter writer;
  write(writer);
  const std::vector<Bytes> all = ranks.gather(message_of(writer));
  for (int rank = 0; rank < ranks.count(); ++rank) {
    if (rank == ranks.own()) continue;
    ByteReader reader(text_of_message(all[at(rank)]));
    read(reader);
  }
}

/// Sends own pairs to the ranks that visit them, message by message. Collective.
/// @param own keys of this rank, increasing. @param write (archive, keys): own pairs of a message
/// @param read (archive): pairs of another rank. @param use (keys): those of all ranks have come; keys are own ones
/// @param begin on ranks that visit
template <class Write, class Read, class Use>
void send_in_messages(Ranks& ranks, PairVisitors visitors, const std::vector<PairKey>& own,
                      const PairsOfRun::Begin& begin, const Write& write, const Read& read, const Use& use) {
  const bool visits = visitors == PairVisitors::all || ranks.own() == 0;
  LaterFailure failure;
  const Messages messages = messages_of_run(ranks, keys_of_run(ranks, own));
  if (visits) failure.during([&] { begin(messages.pairs); });
  auto from = own.begin();
  for (std::size_t k = 0; k <= messages.first.size(); ++k) {
    const auto to =
        k < messages.first.size() ? std::lower_bound(from, own.end(), messages.first[k]) : own.end();
    const std::span<const PairKey> keys(std::to_address(from), std::to_address(to));
    send(
        ranks, visitors, [&](ByteWriter& writer) { write(writer, keys); },
        [&](ByteReader& reader) { failure.during([&] { read(reader); }); });
    if (visits) failure.during([&] { use(keys); });
    from = to;
  }
  failure.raise();
}

void require_first(bool& visited) {
  if (std::exchange(visited, true)) throw std::logic_error("pairs of a run are visited once");
}

}  // namespace

/// Null: traffic is not counted.
std::unique_ptr<CountedTraffic> PairsOfRun::counted_traffic() const {
  return sent_ == nullptr ? nullptr : std::make_unique<CountedTraffic>(share_of(system_).ranks(), *sent_);
}

void PairsOfRun::visit_histories(const Begin& begin,
                                 const std::function<void(const PairKey&, const PairHistory&)>& visit) {
  require_first(histories_visited_);
  const PairHistories& pairs = state_.pairs;
  if (system_.exchange().alone()) {
    begin(pairs.size());
    for (const auto& [blocks, history] : pairs) visit(blocks, history);
    return;
  }
  const auto counted = counted_traffic();
  std::vector<PairKey> own;
  for (const auto& [blocks, history] : pairs)
    if (system_.owns_pair(blocks[0], blocks[1])) own.push_back(blocks);
  PairHistories others;
  // A rank with one of two blocks may know their overlap alone.
  const auto is_overlap_alone = [](const PairHistory& known) {
    return known.memory.empty() && known.work == 0.0;
  };
  send_in_messages(
      share_of(system_).ranks(), visitors_, own, begin,
      [&](ByteWriter& writer, std::span<const PairKey> keys) {
        for (const PairKey& blocks : keys) writer(blocks, pairs.at(blocks));
      },
      [&](ByteReader& reader) {
        while (!reader.at_end()) {
          PairKey blocks;
          PairHistory history;
          reader(blocks, history);
          PairHistory& known = others[blocks];
          if (is_overlap_alone(known)) known = std::move(history);
        }
      },
      [&](std::span<const PairKey> keys) {
        auto other = others.cbegin();
        for (const PairKey& blocks : keys) {
          for (; other != others.cend() && other->first < blocks; ++other) visit(other->first, other->second);
          const bool known = other != others.cend() && other->first == blocks;
          const PairHistory& here = pairs.at(blocks);
          visit(blocks, known && is_overlap_alone(here) ? other->second : here);
          if (known) ++other;
        }
        for (; other != others.cend(); ++other) visit(other->first, other->second);
        others.clear();
      });
}

void PairsOfRun::visit_records(const Begin& begin, const std::function<void(const PairRecord&)>& visit) {
  require_first(records_visited_);
  const std::vector<PairRecord>& records = state_.records;
  if (system_.exchange().alone()) {
    begin(records.size());
    for (const PairRecord& record : records) visit(record);
    return;
  }
  const auto counted = counted_traffic();
  std::vector<const PairRecord*> sorted;
  for (const PairRecord& record : records)
    if (system_.owns_pair(record.a, record.b)) sorted.push_back(&record);
  std::sort(sorted.begin(), sorted.end(),
            [](const PairRecord* x, const PairRecord* y) { return key_of(*x) < key_of(*y); });
  std::vector<PairKey> own;
  own.reserve(sorted.size());
  for (const PairRecord* record : sorted) own.push_back(key_of(*record));
  const auto record_of = [&](const PairKey& key) -> const PairRecord& {
    return *sorted[static_cast<std::size_t>(std::lower_bound(own.begin(), own.end(), key) - own.begin())];
  };
  std::vector<PairRecord> others;
  send_in_messages(
      share_of(system_).ranks(), visitors_, own, begin,
      [&](ByteWriter& writer, std::span<const PairKey> keys) {
        for (const PairKey& key : keys) writer(record_of(key));
      },
      [&](ByteReader& reader) {
        while (!reader.at_end()) reader(others.emplace_back());
      },
      [&](std::span<const PairKey> keys) {
        std::map<PairKey, const PairRecord*> all;
        for (const PairKey& key : keys) all.emplace(key, &record_of(key));
        for (const PairRecord& record : others) all.emplace(key_of(record), &record);
        for (const auto& [key, record] : all) visit(*record);
        others.clear();
      });
}

void PairsOfRun::finish() {
  const auto ignore_count = [](std::size_t) {};
  if (!histories_visited_) visit_histories(ignore_count, [](const PairKey&, const PairHistory&) {});
  if (!records_visited_) visit_records(ignore_count, [](const PairRecord&) {});
}

}  // namespace ashlar
