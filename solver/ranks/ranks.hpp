// The processes that share a run, called ranks, seen from one of them.
//
// All functions are collective: each rank calls the same ones in the same order, and none returns before all have called
// it. Results that are said to be the same on all ranks are so to the bit. Sums are taken in the order of the ranks, so
// that they depend on their number, but not on which of them comes first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ashlar {

using Bytes = std::vector<std::byte>;

/// Traffic of one rank so far.
struct RankTraffic {
  std::uint64_t calls = 0;     ///< of collective functions
  std::uint64_t messages = 0;  ///< sent to other ranks
  std::uint64_t bytes = 0;     ///< sent to other ranks
  double seconds = 0.0;        ///< wall time in these calls, waiting included
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

// The same result on all ranks.
[[nodiscard]] double sum_of_ranks(Ranks& ranks, double value);
[[nodiscard]] std::vector<double> sum_of_ranks(Ranks& ranks, const std::vector<double>& values);
[[nodiscard]] double max_of_ranks(Ranks& ranks, double value);
[[nodiscard]] bool any_rank(Ranks& ranks, bool value);

}  // namespace ashlar
