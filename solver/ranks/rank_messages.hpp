// Values of any kind (byte_archive.hpp) in the messages of ranks. Plain ones: rank_values.hpp.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/index.hpp"
#include "solver/byte_archive.hpp"
#include "solver/ranks/rank_values.hpp"
#include "solver/ranks/ranks.hpp"

namespace ashlar {

[[nodiscard]] inline Bytes message_of(ByteWriter& writer) {
  return bytes_of_values<char>(writer.take());
}

/// @param message must outlive the text
[[nodiscard]] inline std::string_view text_of_message(const Bytes& message) {
  return {reinterpret_cast<const char*>(message.data()), message.size()};
}

/// A value of each rank, by rank. Collective.
template <class Value>
[[nodiscard]] std::vector<Value> values_of_ranks(Ranks& ranks, const Value& value) {
  ByteWriter writer;
  writer(value);
  std::vector<Value> values;
  for (const Bytes& given : ranks.gather(message_of(writer))) {
    ByteReader reader(text_of_message(given));
    Value of_rank{};
    reader(of_rank);
    values.push_back(std::move(of_rank));
  }
  return values;
}

/// The result of work of the first rank, on all ranks. If it throws, all ranks throw as in do_on_all(). Collective.
/// @param work called on the first rank only, not collective
template <class Work>
[[nodiscard]] std::invoke_result_t<Work> value_of_first(Ranks& ranks, const Work& work) {
  if (ranks.alone()) return work();
  std::invoke_result_t<Work> value{};
  do_on_all(ranks, [&] {
    if (ranks.own() == 0) value = work();
  });
  std::vector<std::invoke_result_t<Work>> values = values_of_ranks(ranks, value);
  return std::move(values.front());
}

/// Sends values of all other ranks to the first one. Collective. @param write (archive), not on the first rank
/// @param read (archive, rank), on the first one, once for each other rank, of messages that are not empty
template <class Write, class Read>
void send_to_first(Ranks& ranks, const Write& write, const Read& read) {
  std::vector<Bytes> messages(at(ranks.count()));
  if (ranks.own() > 0) {
    ByteWriter writer;
    write(writer);
    messages[0] = message_of(writer);
  }
  const std::vector<Bytes> received = ranks.exchange(std::move(messages));
  if (ranks.own() > 0) return;
  for (int rank = 1; rank < ranks.count(); ++rank) {
    if (received[at(rank)].empty()) continue;
    ByteReader reader(text_of_message(received[at(rank)]));
    read(reader, rank);
  }
}

}  // namespace ashlar
