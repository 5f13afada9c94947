// The processes that share a run, called ranks, seen from one of them.
//
// All functions are collective: each rank calls the same ones in the same order, and none returns before all have called
// it. Results that are said to be the same on all ranks are so to the bit. Sums are taken in the order of the ranks, so
// that they depend on their number, but not on which of them comes first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

namespace ashlar {

using Bytes = std::vector<std::byte>;

/// Traffic of one rank so far.
struct RankTraffic {
  std::uint64_t calls = 0;     ///< of collective functions
  std::uint64_t messages = 0;  ///< sent to other ranks
  std::uint64_t bytes = 0;     ///< sent to other ranks
  double seconds = 0.0;        ///< wall time in these calls, waiting included
  double processor = 0.0;      ///< s, processor time of the calling thread in them; waiting may take some

  RankTraffic& operator+=(const RankTraffic& other) {
    calls += other.calls;
    messages += other.messages;
    bytes += other.bytes;
    seconds += other.seconds;
    processor += other.processor;
    return *this;
  }
  /// Since an earlier time.
  [[nodiscard]] RankTraffic since(const RankTraffic& before) const {
    return {calls - before.calls, messages - before.messages, bytes - before.bytes, seconds - before.seconds,
            processor - before.processor};
  }
};

class Ranks {
 public:
  virtual ~Ranks() = default;

  [[nodiscard]] virtual int count() const = 0;
  /// Number of this rank, 0 to count() - 1.
  [[nodiscard]] virtual int own() const = 0;
  /// Hands the same bytes to all ranks. @return those of each rank, by rank; the same on all ranks
  [[nodiscard]] virtual std::vector<Bytes> gather(const Bytes& given) = 0;
  /// Sends messages. @param messages by receiver, empty: none; one to itself is returned
  /// @return messages by sender
  [[nodiscard]] virtual std::vector<Bytes> exchange(std::vector<Bytes> messages) = 0;
  [[nodiscard]] virtual RankTraffic traffic() const = 0;

  [[nodiscard]] bool alone() const { return count() == 1; }
};

/// The only rank.
class SingleRank final : public Ranks {
 public:
  [[nodiscard]] int count() const override { return 1; }
  [[nodiscard]] int own() const override { return 0; }
  [[nodiscard]] std::vector<Bytes> gather(const Bytes& given) override { return {given}; }
  [[nodiscard]] std::vector<Bytes> exchange(std::vector<Bytes> messages) override { return messages; }
  [[nodiscard]] RankTraffic traffic() const override { return {}; }
};

/// Thrown by a collective function because another rank has ended with an error.
class OtherRankFailed final : public std::runtime_error {
 public:
  OtherRankFailed() : std::runtime_error("another rank has failed") {}
};

// The same result on all ranks. Values that are not numbers are infinite in maxima and minima.
[[nodiscard]] double sum_of_ranks(Ranks& ranks, double value);
/// @param values as many on each rank
[[nodiscard]] std::vector<double> sum_of_ranks(Ranks& ranks, const std::vector<double>& values);
[[nodiscard]] double max_of_ranks(Ranks& ranks, double value);
[[nodiscard]] std::vector<double> max_of_ranks(Ranks& ranks, const std::vector<double>& values);
[[nodiscard]] double min_of_ranks(Ranks& ranks, double value);
[[nodiscard]] bool any_rank(Ranks& ranks, bool value);

/// Does work of each rank that needs no other rank. If it throws on any, all throw: those ranks their own exception, the
/// others a std::invalid_argument (if it was one) or std::runtime_error with the text of the lowest one. @param work not
/// collective
void do_on_all(Ranks& ranks, const std::function<void()>& work);

}  // namespace ashlar
