#include "solver/contact/contact_accounts.hpp"

#include <gtest/gtest.h>

namespace ashlar {
namespace {

TEST(ContactAccounts, APairGivesBackWhatItTook) {
  double account = 0.0;
  EXPECT_EQ(book(5.0, account), 0.0);
  EXPECT_EQ(book(-2.0, account), 0.0);
  EXPECT_EQ(account, 3.0);
  EXPECT_EQ(book(-4.0, account), 1.0);
  EXPECT_EQ(account, 0.0);
}

TEST(IslandFunds, AnIslandUsesItsOwnFirstAndThenWhatNoIslandHas) {
  const ContactAccounts accounts = {
      {{0, 1}, 3.0}, {{0, 2}, 1.0}, {{3, 4}, 2.0}, {{5, 6}, 6.0}, {{5, 7}, 2.0}};
  IslandFunds funds(accounts, {{{0, 1}, {0, 2}}, {{3, 4}}});
  EXPECT_EQ(funds.available(0), 4.0 + 8.0);
  EXPECT_EQ(funds.available(1), 2.0 + 8.0);
  funds.use(0, 2.0);
  EXPECT_EQ(funds.available(1), 10.0);
  funds.use(0, 6.0);  // 2 of its own, 4 of the others'
  EXPECT_EQ(funds.available(0), 4.0);
  EXPECT_EQ(funds.available(1), 2.0 + 4.0);
  funds.use(1, 1.0);

  ContactAccounts left = accounts;
  funds.spend_from(left);
  EXPECT_EQ(left,
            (ContactAccounts{{{0, 1}, 0.0}, {{0, 2}, 0.0}, {{3, 4}, 1.0}, {{5, 6}, 3.0}, {{5, 7}, 1.0}}));
}

TEST(IslandFunds, WhatIsUsedComesFromPairsInProportion) {
  ContactAccounts accounts = {{{0, 1}, 3.0}, {{0, 2}, 1.0}, {{5, 6}, 6.0}};
  IslandFunds funds(accounts, {{{0, 1}, {0, 2}}});
  funds.use(0, 2.0);
  funds.spend_from(accounts);
  EXPECT_EQ(accounts, (ContactAccounts{{{0, 1}, 1.5}, {{0, 2}, 0.5}, {{5, 6}, 6.0}}));
}

TEST(IslandFunds, WhatAMotionSetsFreeStaysWithTheIsland) {
  // Pairs that have no account yet share it.
  ContactAccounts accounts = {{{5, 6}, 6.0}};
  IslandFunds funds(accounts, {{{0, 1}, {0, 2}}});
  funds.use(0, -4.0);
  EXPECT_EQ(funds.available(0), 10.0);
  funds.spend_from(accounts);
  EXPECT_EQ(accounts, (ContactAccounts{{{0, 1}, 2.0}, {{0, 2}, 2.0}, {{5, 6}, 6.0}}));
}

}  // namespace
}  // namespace ashlar
