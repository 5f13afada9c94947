#include "solver/contact/contact_accounts.hpp"

#include <gtest/gtest.h>

namespace ashlar::contact_accounts_test {
namespace {

using Accounts = std::map<PairKey, double>;

/// Histories of pairs that have taken so much, J.
PairHistories that_took(const Accounts& accounts) {
  PairHistories histories;
  for (const auto& [pair, spent] : accounts) histories[pair].spent = spent;
  return histories;
}

Accounts taken_in(const PairHistories& histories) {
  Accounts accounts;
  for (const auto& [pair, history] : histories) accounts[pair] = history.spent;
  return accounts;
}

TEST(ContactAccounts, APairGivesBackWhatItTook) {
  double account = 0.0;
  EXPECT_EQ(book(5.0, account), 0.0);
  EXPECT_EQ(book(-2.0, account), 0.0);
  EXPECT_EQ(account, 3.0);
  EXPECT_EQ(book(-4.0, account), 1.0);
  EXPECT_EQ(account, 0.0);
}

TEST(IslandFunds, AnIslandUsesItsOwnFirstAndThenWhatNoIslandHas) {
  const PairHistories accounts =
      that_took({{{0, 1}, 3.0}, {{0, 2}, 1.0}, {{3, 4}, 2.0}, {{5, 6}, 6.0}, {{5, 7}, 2.0}});
  IslandFunds funds(accounts, {{{0, 1}, {0, 2}}, {{3, 4}}});
  EXPECT_EQ(funds.available(0), 4.0 + 8.0);
  EXPECT_EQ(funds.available(1), 2.0 + 8.0);
  funds.use(0, 2.0);
  EXPECT_EQ(funds.available(1), 10.0);
  funds.use(0, 6.0);  // 2 of its own, 4 of the others'
  EXPECT_EQ(funds.available(0), 4.0);
  EXPECT_EQ(funds.available(1), 2.0 + 4.0);
  funds.use(1, 1.0);

  PairHistories left = accounts;
  funds.spend_from(left);
  EXPECT_EQ(taken_in(left),
            (Accounts{{{0, 1}, 0.0}, {{0, 2}, 0.0}, {{3, 4}, 1.0}, {{5, 6}, 3.0}, {{5, 7}, 1.0}}));
}

TEST(IslandFunds, WhatIsUsedComesFromPairsInProportion) {
  PairHistories accounts = that_took({{{0, 1}, 3.0}, {{0, 2}, 1.0}, {{5, 6}, 6.0}});
  IslandFunds funds(accounts, {{{0, 1}, {0, 2}}});
  funds.use(0, 2.0);
  funds.spend_from(accounts);
  EXPECT_EQ(taken_in(accounts), (Accounts{{{0, 1}, 1.5}, {{0, 2}, 0.5}, {{5, 6}, 6.0}}));
}

TEST(IslandFunds, WhatAMotionSetsFreeStaysWithTheIsland) {
  // Pairs that have no account yet share it.
  PairHistories accounts = that_took({{{5, 6}, 6.0}});
  IslandFunds funds(accounts, {{{0, 1}, {0, 2}}});
  funds.use(0, -4.0);
  EXPECT_EQ(funds.available(0), 10.0);
  funds.spend_from(accounts);
  EXPECT_EQ(taken_in(accounts), (Accounts{{{0, 1}, 2.0}, {{0, 2}, 2.0}, {{5, 6}, 6.0}}));
}

/// Another rank has a pair of the island with 1 J, and one in no island with 2 J.
TEST(IslandFunds, RanksKeepTheAccountsOfTheirOwnPairs) {
  PairHistories accounts = that_took({{{0, 1}, 3.0}, {{5, 6}, 6.0}, {{8, 9}, 100.0}});
  const SharedAccounts shared{[](const PairKey& pair) {
                                return pair != PairKey{8, 9};
                              },
                              [](const std::vector<double>& values) {
                                const std::vector<double> there = {2.0, 1.0, 1.0, 1.0};
                                std::vector<double> sum = values;
                                for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += there.at(k);
                                return sum;
                              }};
  IslandFunds funds(accounts, {{{0, 1}}}, &shared);
  EXPECT_EQ(funds.available(0), 4.0 + 8.0);
  funds.use(0, 6.0);  // 4 of the island, 2 of the others
  funds.spend_from(accounts);
  EXPECT_EQ(taken_in(accounts), (Accounts{{{0, 1}, 0.0}, {{5, 6}, 4.5}, {{8, 9}, 100.0}}));
}

}  // namespace
}  // namespace ashlar::contact_accounts_test
