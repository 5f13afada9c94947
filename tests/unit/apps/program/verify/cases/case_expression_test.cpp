#include "apps/program/verify/cases/case_expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ashlar::case_expression_test {
namespace {

/// Eleven rows from 0 to 1 s: x = (t - 0.25)^2, 'a b.v' = cos(2 pi t), gap without value in the first rows.
CaseResults results() {
  CaseResults all;
  all.columns = {"time", "p.x", "a b.v", "pair.opening"};
  for (int k = 0; k <= 10; ++k) {
    const double t = 0.1 * k;
    all.rows.push_back(
        {t, (t - 0.25) * (t - 0.25), std::cos(2.0 * std::numbers::pi * t), k < 3 ? std::nan("") : 2.0 * t});
  }
  all.summary = {{"bracket", {{"lower", 4.0}, {"upper", 9.0}}},
                 {"open", {{"lower", 4.0}, {"upper", nullptr}}},
                 {"right", true},
                 {"status", "moving"},
                 {"bolts", {{{"name", "one"}, {"force", 7.0}, {"parts", {1.0, 2.0}}}}}};
  return all;
}

double value(const std::string& text) {
  Formulas names;
  names.define("h", 3.0);
  names.define("k2", 2.0);
  return value_of(text, names, results());
}

TEST(CaseExpression, ColumnsHaveTheirLastValue) {
  EXPECT_DOUBLE_EQ(value("p.x"), 0.5625);
  EXPECT_DOUBLE_EQ(value("h*p.x - time"), 3 * 0.5625 - 1.0);
  EXPECT_NEAR(value("'a b.v'"), 1.0, 1e-15);
  EXPECT_DOUBLE_EQ(value("1e-1 + 2.5E+2"), 250.1);
  EXPECT_DOUBLE_EQ(value("sqrt(h^2 + 16)"), 5.0);
}

TEST(CaseExpression, Rows) {
  EXPECT_DOUBLE_EQ(value("first(p.x)"), 0.0625);
  EXPECT_NEAR(value("smallest(p.x)"), 0.0025, 1e-15);
  EXPECT_DOUBLE_EQ(value("largest(p.x, 0, 0.5) + last(k2)"), 0.0625 + 2.0);
  EXPECT_NEAR(value("largest(abs(p.x - (time - 0.25)^2))"), 0.0, 1e-15);
  EXPECT_NEAR(value("at(p.x, 0.05)"), 0.5 * (0.0625 + 0.0225), 1e-15);
  EXPECT_NEAR(value("mean(time, 0.2, 0.8)"), 0.5, 1e-14);
  EXPECT_NEAR(value("hann('a b.v')"), -0.5, 1e-12) << "the window is 1 - cos";
  // Zeros of a line between rows: 1 - 2 t is zero in the row at 0.5, cos(2 pi t) at 0.25 and 0.75.
  EXPECT_NEAR(value("crossing('a b.v', 1)"), 0.25, 1e-12);
  EXPECT_NEAR(value("crossing('a b.v', 2)"), 0.75, 1e-12);
  EXPECT_NEAR(value("largest(time - before(time))"), 0.1, 1e-15);
  EXPECT_NEAR(value("rising(time, 'a b.v', 1)"), 0.8, 1e-12);
  EXPECT_TRUE(std::isnan(value("crossing('a b.v', 3)")));
  // A start at zero is no crossing; a row at zero is where it crosses.
  EXPECT_TRUE(std::isnan(value("crossing(time, 1)")));
  EXPECT_NEAR(value("crossing(time - 0.5, 1)"), 0.5, 1e-12);
}

TEST(CaseExpression, RowsWithoutValueAreLeftOut) {
  EXPECT_DOUBLE_EQ(value("smallest(pair.opening)"), 2.0 * (0.1 * 3));
  EXPECT_TRUE(std::isnan(value("first(pair.opening)")));
  EXPECT_TRUE(std::isnan(value("largest(pair.opening, 0, 0.2)")));
}

TEST(CaseExpression, Summary) {
  EXPECT_DOUBLE_EQ(value("middle(summary.bracket)"), 6.0);
  EXPECT_TRUE(std::isnan(value("middle(summary.open)")));
  EXPECT_EQ(value("known(summary.open.upper) + 2*known(summary.open.lower) + 4*known(h)"), 6.0);
  EXPECT_DOUBLE_EQ(value("summary.right + summary.bolts.one.force"), 8.0);
  EXPECT_DOUBLE_EQ(value("summary.bolts.0.force - summary.bolts.one.parts.1"), 5.0);
}

TEST(CaseExpression, FaultsSayWhatIsNeeded) {
  const auto fault = [](const std::string& text) -> std::string {
    try {
      (void)value(text);
    } catch (const FormulaError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault("p.y"), "unknown result (p.y), a column of history.csv or summary.PATH is needed");
  EXPECT_EQ(fault("summary.status"),
            "result is no number (summary.status), a number in summary.json is needed");
  EXPECT_EQ(fault("summary.no"), "unknown result (summary.no), a path in summary.json is needed");
  EXPECT_EQ(fault("at(p.x, 3)"), "time is outside the run (3 s), one of its times is needed");
  EXPECT_EQ(fault("at(p.x)"), "at has 1 arguments, 2 are needed");
  EXPECT_EQ(fault("middle(summary.bolts)"), "no bracket (summary.bolts), lower and upper are needed");
  EXPECT_NE(fault("heigh*2"), "");
  EXPECT_EQ(fault("largest(p.x"), "a bracket is not closed, ) is needed");
}

}  // namespace
}  // namespace ashlar::case_expression_test
