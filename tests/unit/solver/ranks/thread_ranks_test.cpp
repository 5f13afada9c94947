#include "solver/ranks/thread_ranks.hpp"

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/ranks/block_share.hpp"

namespace ashlar::thread_ranks_test {
namespace {

Bytes bytes(int value) {
  return {std::byte(value)};
}

TEST(ThreadRanks, GatherHandsAllValuesToAllByRank) {
  std::atomic<int> right = 0;
  run_on_threads(4, [&](Ranks& ranks) {
    const std::vector<Bytes> all = ranks.gather(bytes(10 + ranks.own()));
    right += all == std::vector{bytes(10), bytes(11), bytes(12), bytes(13)} ? 1 : 0;
  });
  EXPECT_EQ(right, 4);
}

TEST(ThreadRanks, MessagesReachTheirReceiver) {
  std::atomic<int> right = 0;
  std::atomic<std::uint64_t> sent = 0;
  run_on_threads(3, [&](Ranks& ranks) {
    std::vector<Bytes> messages(3);
    messages[(static_cast<std::size_t>(ranks.own()) + 1) % 3] = bytes(ranks.own());
    const std::vector<Bytes> received = ranks.exchange(messages);
    const int before = (ranks.own() + 2) % 3;
    for (int sender = 0; sender < 3; ++sender)
      right +=
          received[static_cast<std::size_t>(sender)] == (sender == before ? bytes(before) : Bytes()) ? 1 : 0;
    sent += ranks.traffic().bytes;
  });
  EXPECT_EQ(right, 9);
  EXPECT_EQ(sent, 3u);
}

TEST(ThreadRanks, SumsAndMaximaAreThoseOfAll) {
  run_on_threads(3, [](Ranks& ranks) {
    const double own = ranks.own();
    EXPECT_EQ(sum_of_ranks(ranks, 1.0 + own), 6.0);
    EXPECT_EQ(max_of_ranks(ranks, own), 2.0);
    EXPECT_EQ(min_of_ranks(ranks, own), 0.0);
    EXPECT_TRUE(any_rank(ranks, ranks.own() == 1));
    EXPECT_FALSE(any_rank(ranks, false));
    EXPECT_EQ(max_of_ranks(ranks, std::vector{own, -own}), (std::vector{2.0, 0.0}));
    EXPECT_TRUE(std::isinf(max_of_ranks(ranks, ranks.own() == 1 ? std::nan("") : 0.0)));
  });
}

TEST(ThreadRanks, NoRankWaitsForOneThatFailed) {
  std::atomic<int> heard = 0;
  const auto program = [&](Ranks& ranks) {
    if (ranks.own() == 1) throw std::invalid_argument("one failed");
    try {
      (void)ranks.gather({});
    } catch (const OtherRankFailed&) {
      ++heard;
      throw;
    }
  };
  EXPECT_THROW(run_on_threads(3, program), std::invalid_argument);
  EXPECT_EQ(heard, 2);
}

TEST(ThreadRanks, AnErrorOfLocalWorkIsThrownOnAll) {
  std::atomic<int> texts = 0;
  run_on_threads(3, [&](Ranks& ranks) {
    try {
      do_on_all(ranks, [&] {
        if (ranks.own() == 2) throw std::invalid_argument("block 7 is open");
      });
    } catch (const std::invalid_argument& error) {
      texts += error.what() == std::string("block 7 is open") ? 1 : 0;
    }
  });
  EXPECT_EQ(texts, 3);
}

TEST(ThreadRanks, BlocksAreLentToTheRanksWhoseGhostsTheyAre) {
  run_on_threads(2, [](Ranks& ranks) {
    BlockShare share(ranks, {0, 1, 0, 1});
    share.set_ghosts(ranks.own() == 0 ? std::vector{1} : std::vector{0, 2});
    EXPECT_EQ(share.lent_to(1 - ranks.own()), ranks.own() == 0 ? (std::vector{0, 2}) : std::vector{1});
    std::vector<double> got;
    const Eigen::VectorXd own = Eigen::VectorXd::Constant(1, 5.0 + ranks.own());
    share.to_ghosts([&](int block) { return block == 2 ? nullptr : &own; },
                    [&](int block, const Eigen::VectorXd& value) {
                      got.push_back(block);
                      got.push_back(value[0]);
                    });
    EXPECT_EQ(got, ranks.own() == 0 ? (std::vector{1.0, 6.0}) : (std::vector{0.0, 5.0}));
  });
  EXPECT_THROW(run_on_threads(1, [](Ranks& ranks) { BlockShare(ranks, {0, 1}); }), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::thread_ranks_test
