#include <gmock/gmock.h>

#include <thread>

#include "solver/ranks/ranks.hpp"
#include "tests/mpi/test_ranks.hpp"

namespace ashlar::mpi_ranks_test {
namespace {

Bytes bytes_of(int value, int count) {
  return Bytes(static_cast<std::size_t>(count), std::byte(value));
}

TEST(MpiRanks, GathersInTheOrderOfRanks) {
  Ranks& ranks = test_ranks();
  const std::vector<Bytes> all = ranks.gather(bytes_of(ranks.own() + 1, ranks.own()));
  ASSERT_EQ(all.size(), static_cast<std::size_t>(ranks.count()));
  // Rank 0 gives nothing.
  for (int rank = 0; rank < ranks.count(); ++rank)
    EXPECT_EQ(all[static_cast<std::size_t>(rank)], bytes_of(rank + 1, rank));
}

TEST(MpiRanks, ExchangesWithNeighboursAndItself) {
  Ranks& ranks = test_ranks();
  const int count = ranks.count(), own = ranks.own();
  const int right = (own + 1) % count, left = (own + count - 1) % count;
  std::vector<Bytes> messages(static_cast<std::size_t>(count));
  messages[static_cast<std::size_t>(right)] = bytes_of(own, 100'000);
  const std::vector<Bytes> received = ranks.exchange(messages);
  for (int rank = 0; rank < count; ++rank) {
    const Bytes expected = rank == left ? bytes_of(left, 100'000) : Bytes{};
    EXPECT_EQ(received[static_cast<std::size_t>(rank)], expected);
  }
}

// A rank that is ahead of the others must not be heard in the round before: each message tells its round.
TEST(MpiRanks, RoundsOfSlowRanksAreNotMixed) {
  Ranks& ranks = test_ranks();
  for (int round = 0; round < 60; ++round) {
    if (round % ranks.count() == ranks.own()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::vector<Bytes> messages(static_cast<std::size_t>(ranks.count()));
    for (int rank = 0; rank < ranks.count(); ++rank)
      if ((rank + round + ranks.own()) % 3 != 0)
        messages[static_cast<std::size_t>(rank)] = bytes_of(round, 8);
    const std::vector<Bytes> received = ranks.exchange(messages);
    for (int rank = 0; rank < ranks.count(); ++rank) {
      const bool sends = (ranks.own() + round + rank) % 3 != 0;
      EXPECT_EQ(received[static_cast<std::size_t>(rank)], sends ? bytes_of(round, 8) : Bytes{});
    }
  }
}

TEST(MpiRanks, SumsAreTheSameOnAllRanks) {
  Ranks& ranks = test_ranks();
  double expected = 0.0;
  for (int rank = 0; rank < ranks.count(); ++rank) expected += 0.1 * (rank + 1);
  EXPECT_EQ(sum_of_ranks(ranks, 0.1 * (ranks.own() + 1)), expected);
  EXPECT_EQ(max_of_ranks(ranks, ranks.own()), ranks.count() - 1);
  EXPECT_TRUE(any_rank(ranks, ranks.own() == ranks.count() - 1));
  EXPECT_FALSE(any_rank(ranks, false));
}

TEST(MpiRanks, CountsMessagesToOthers) {
  Ranks& ranks = test_ranks();
  const RankTraffic before = ranks.traffic();
  std::vector<Bytes> messages(static_cast<std::size_t>(ranks.count()), bytes_of(1, 10));
  (void)ranks.exchange(messages);
  (void)ranks.gather(bytes_of(1, 7));
  const RankTraffic after = ranks.traffic();
  const auto others = static_cast<std::uint64_t>(ranks.count() - 1);
  EXPECT_EQ(after.calls - before.calls, 2u);
  EXPECT_EQ(after.messages - before.messages, 2 * others);
  EXPECT_EQ(after.bytes - before.bytes, 17 * others);
  EXPECT_GT(after.seconds, before.seconds);
}

}  // namespace
}  // namespace ashlar::mpi_ranks_test
