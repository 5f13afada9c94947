#include "apps/scene/toml/formulas.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

namespace ashlar::formulas_test {
namespace {

double value_of(const std::string& text) {
  Formulas formulas;
  formulas.define("h", 0.25);
  formulas.define("none", 0.0);
  return formulas.value(text);
}

std::string fault_of(const std::string& text) {
  try {
    (void)value_of(text);
  } catch (const FormulaError& error) {
    return std::to_string(error.offset()) + ": " + error.what();
  }
  return "none";
}

TEST(Formulas, ComputeAsWritten) {
  EXPECT_EQ(value_of("= 2*h + 0.1"), 0.6);
  EXPECT_EQ(value_of("=h"), 0.25);
  EXPECT_EQ(value_of("= -h^2"), -0.0625);
  EXPECT_EQ(value_of("= 2^3^2"), 512.0);
  EXPECT_EQ(value_of("= 1e-3 + 2.5E+2 - 10/4"), 0.001 + 250.0 - 2.5);
  EXPECT_NEAR(value_of("= sin(30*deg)"), 0.5, 1e-16);
  EXPECT_EQ(value_of("= atan2(1, 1)*4"), value_of("= pi"));
  EXPECT_EQ(value_of("= max(1, h, 3) + min(h, 2)"), 3.25);
  EXPECT_EQ(value_of("= ln(exp(2)) + log10(100) + cbrt(27)"), 7.0);
  EXPECT_EQ(value_of("= sqrt(16) + abs(-3) + floor(1.9) + ceil(1.1) + round(2.5)"), 13.0);
  EXPECT_EQ(value_of("= h > 0.2 && h <= 0.25 ? 7 : 8"), 7.0);
}

TEST(Formulas, WhatIsNotReachedIsNotEvaluated) {
  EXPECT_EQ(value_of("= none > 0 ? 1/none : 5"), 5.0);
}

TEST(Formulas, DecimalPointsDoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    EXPECT_EQ(value_of("= 1.5 + 2.25"), 3.75) << name;
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Formulas, FaultsHaveTheirPlace) {
  EXPECT_EQ(fault_of("= 2*heigth").substr(0, 40), "4: unknown name in a formula (heigth), a");
  EXPECT_EQ(fault_of("= 2*hh").substr(0, 36), "4: unknown name in a formula (hh), a");
  EXPECT_EQ(fault_of("= 2*(h + 1").substr(0, 31), "10: formula cannot be read (a p");
  EXPECT_EQ(fault_of("= 2 h").substr(0, 31), "4: formula cannot be read (a na");
  EXPECT_EQ(fault_of("= 2 *").substr(0, 44), "5: formula cannot be read (it ends too early");
  EXPECT_EQ(fault_of("=").substr(0, 31), "1: formula cannot be read (the ");
  EXPECT_EQ(fault_of("= h = 2"), "4: = within a formula; use == to compare");
  EXPECT_EQ(fault_of("= 1, 2"), "0: formula has several values (a comma), one is needed");
  EXPECT_EQ(fault_of("= sin()").substr(0, 30), "6: formula cannot be read (a f");
  EXPECT_EQ(fault_of("= max()").substr(0, 30), "7: formula cannot be read (a f");
  EXPECT_EQ(fault_of("= 2\xc3\xa4").substr(0, 49), "3: formula has a character that it cannot have, n");
  EXPECT_EQ(fault_of("=" + std::string(1000, '(')).substr(0, 22), "0: formula is too long");
}

TEST(Formulas, OnlyFiniteNumbersCount) {
  EXPECT_EQ(fault_of("= 1/none"), "0: formula divides by zero, another divisor is needed");
  EXPECT_EQ(fault_of("= 1/(1/none)"), "0: formula divides by zero, another divisor is needed");
  EXPECT_EQ(fault_of("= none^-1"), "0: formula divides by zero, another divisor is needed");
  EXPECT_EQ(fault_of("= sqrt(-h)"), "0: formula has no finite value (not a number), a number is needed");
  EXPECT_EQ(fault_of("= none/none"), "0: formula has no finite value (not a number), a number is needed");
  EXPECT_EQ(fault_of("= exp(1e6)"), "0: formula has no finite value (too large), a number is needed");
  EXPECT_EQ(fault_of("= 1/exp(1e6)"), "0: formula has no finite value (too large), a number is needed");
  EXPECT_EQ(fault_of("= 1/ln(0)"), "0: formula divides by zero, another divisor is needed");
  EXPECT_EQ(fault_of("= 1e300*1e300"), "0: formula has no finite value (too large), a number is needed");
}

TEST(Formulas, NamesThatParametersCannotHave) {
  EXPECT_EQ(Formulas::fault_of_name("h_2"), "");
  EXPECT_NE(Formulas::fault_of_name("2h"), "");
  EXPECT_NE(Formulas::fault_of_name("a-b"), "");
  EXPECT_NE(Formulas::fault_of_name(""), "");
  EXPECT_NE(Formulas::fault_of_name("h\xe9"), "");
  const std::string longest(100, 'h');
  EXPECT_EQ(Formulas::fault_of_name(longest), "");
  Formulas formulas;
  formulas.define(longest, 2.0);
  EXPECT_EQ(formulas.value("= 2*" + longest), 4.0);
  EXPECT_EQ(Formulas::fault_of_name(longest + "h"),
            "parameter has too long a name (101 characters), at most 100 are allowed");
  EXPECT_EQ(Formulas::fault_of_name("sin"),
            "parameter has a name that is taken (sin), formulas know it as a function");
  EXPECT_EQ(Formulas::fault_of_name("deg"),
            "parameter has a name that is taken (deg), formulas know it as a constant");
}

TEST(Formulas, NamesAreTakenApartFromNumbers) {
  const auto names = Formulas::parameters_in("= 1e5*e5 + sin(x1) - .5e-3");
  ASSERT_EQ(names.size(), 2U);
  EXPECT_EQ(names[0].text, "e5");
  EXPECT_EQ(names[0].offset, 6U);
  EXPECT_EQ(names[1].text, "x1");
}

}  // namespace
}  // namespace ashlar::formulas_test
