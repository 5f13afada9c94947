#include "geometry/exact/direction_predicates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/exact/rational_vector.hpp"
#include "support/exact_numbers.hpp"

namespace ashlar::direction_predicates_test {
namespace {

// Points of a grid of 2^-10 of which coordinates are replaced by the rounding error of a zero cosine, at a
// scale.
class TinyParts : public testing::TestWithParam<int> {
 protected:
  static constexpr double left_of_zero = 6.123233995736766e-17;  // 53 bits from 2^-54 to 2^-106

  void SetUp() override {
    for (int k = 0; k < 8; ++k)
      for (double& c : points_.emplace_back()) {
        c = std::ldexp(static_cast<double>(random_() % 2048) - 1024.0, GetParam() - 10);
        if (random_() % 4 == 0) c = std::ldexp(left_of_zero * (random_() % 2 == 0 ? 1 : -1), GetParam());
      }
    // Some of them in one plane, exactly.
    if (random_() % 2 == 0)
      for (Vector3& p : points_) p.z() = points_[0].z();
    NumericRange range;
    for (const Vector3& p : points_)
      for (const double c : p) range.include(c);
    range.include(std::ldexp(left_of_zero, GetParam()));
    filter_.open(range);
    exact_.floating = false;
  }
  const Vector3& point() { return points_[random_() % points_.size()]; }
  static int sign(const RationalVector& w, const RationalVector& d) { return sgn(dot_product(w, d)); }
  static RationalVector vector(const Vector3& to, const Vector3& from) {
    return difference(to_rational(to), to_rational(from));
  }

  std::mt19937_64 random_{7};
  std::vector<Vector3> points_;
  PredicateLadder filter_, exact_;
};
INSTANTIATE_TEST_SUITE_P(Scales, TinyParts, testing::Values(-90, -30, -2, 0, 30), [](const auto& each) {
  return each.param < 0 ? "down" + std::to_string(-each.param) : "up" + std::to_string(each.param);
});

TEST_P(TinyParts, SignsAreThoseOfRationalNumbers) {
  int zeros = 0;
  for (int trial = 0; trial < 400; ++trial) {
    if (trial % 20 == 0) {
      points_.clear();
      SetUp();
    }
    const Vector3 &a = point(), &b = point(), &c = point(), &d = point(), &e = point();
    const RationalVector u = vector(b, a), v = vector(c, a), n = cross_product(u, v);
    const ContactDirection normal = ContactDirection::cross({&b, &a}, {&c, &a});
    const ContactDirection across = ContactDirection::rejection({&d, &a}, {&b, &a});
    const RationalVector r = cross_product(u, cross_product(vector(d, a), u));
    const Rational squared = dot_product(n, n), height = dot_product(n, vector(d, e));
    const Rational other = dot_product(r, vector(c, e)), other_squared = dot_product(r, r);
    zeros += sign(n, vector(d, a)) == 0;
    for (PredicateLadder* ladder : {&filter_, &exact_}) {
      EXPECT_EQ(sign_volume(d, a, b, c, *ladder),
                sign(vector(a, d), cross_product(vector(b, d), vector(c, d))));
      EXPECT_EQ(sign_along(normal, d, a, *ladder), sign(n, vector(d, a)));
      EXPECT_EQ(sign_along(across, c, e, *ladder), sgn(other));
      EXPECT_EQ(sign_turn(across, a, b, c, *ladder), sign(r, cross_product(u, v)));
      EXPECT_EQ(is_zero(normal, *ladder), sgn(squared) == 0);
      const double bound = std::ldexp(0.5, GetParam());
      EXPECT_EQ(is_within(normal, {&d, &e}, bound, false, *ladder),
                height * height <= Rational(bound) * Rational(bound) * squared);
      EXPECT_EQ(compare_heights(normal, {&d, &e}, normal, {&c, &e}, *ladder),
                sgn(Rational(height * height - dot_product(n, vector(c, e)) * dot_product(n, vector(c, e)))) *
                    (sgn(squared) == 0 ? 0 : 1));
      EXPECT_EQ(compare_heights(normal, {&d, &e}, across, {&c, &e}, *ladder),
                sgn(Rational(height * height * other_squared - other * other * squared)));
    }
  }
  EXPECT_GT(zeros, 100);
}

TEST_P(TinyParts, TheFloatingRungsDecide) {
  const double scale = std::ldexp(1.0, GetParam()), tiny = left_of_zero * scale;
  const Vector3 a(tiny, 0, 0), b(scale, tiny, 0), c(-tiny, scale, 0), d(0.25 * scale, 0.25 * scale, scale);
  const ContactDirection normal = ContactDirection::cross({&b, &a}, {&c, &a});
  EXPECT_EQ(sign_along(normal, d, a, filter_), 1);
  EXPECT_EQ(sign_along(normal, c, a, filter_), 0);
  EXPECT_EQ(sign_turn(normal, a, b, c, filter_), 1);
  EXPECT_EQ(sign_volume(a, d, b, c, filter_), -sign_volume(a, b, d, c, filter_));
  EXPECT_FALSE(is_zero(normal, filter_));
  EXPECT_GT(filter_.counts.filter, 0);
  EXPECT_EQ(filter_.counts.exact, 0);
}

class Ladders : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override { ladder.floating = GetParam(); }
  PredicateLadder ladder;
};
INSTANTIATE_TEST_SUITE_P(FilteredAndExact, Ladders, testing::Bool(),
                         [](const auto& each) { return each.param ? "filtered" : "exact"; });

const Vector3 origin(0, 0, 0), x(1, 0, 0), y(0, 1, 0);

TEST_P(Ladders, SignsOneBitFromThePlane) {
  const ContactDirection w = ContactDirection::cross({&x, &origin}, {&y, &origin});
  const Vector3 above(0.3, 0.7, 0x1p-60), below(0.3, 0.7, -0x1p-60), on(0.3, 0.7, 0.0);
  EXPECT_EQ(sign_along(w, above, origin, ladder), 1);
  EXPECT_EQ(sign_along(w, below, origin, ladder), -1);
  EXPECT_EQ(sign_along(w, on, origin, ladder), 0);
}

TEST_P(Ladders, ThePlaneThroughThreeTiltedPoints) {
  // z = x + y; the last coordinate of the fourth point is changed by an ulp.
  const Vector3 a(0, 0, 0), b(1, 0, 1), c(0, 1, 1);
  const ContactDirection w = ContactDirection::cross({&b, &a}, {&c, &a});
  const double z = 0.1 + 0.25;  // what 0.1 + 0.25 rounds to is not the sum
  const Vector3 p(0.5, 0.25, 0.75), q(0.5, 0.25, std::nextafter(0.75, 1.0)), r(0.1, 0.25, z);
  EXPECT_EQ(sign_along(w, p, a, ladder), 0);
  EXPECT_EQ(sign_along(w, q, a, ladder), 1);
  const double rest = (0.1 - (z - 0.25)) + 0.0;  // exact by Sterbenz: 0.1 + 0.25 - z
  EXPECT_EQ(sign_along(w, r, a, ladder), rest > 0.0 ? -1 : rest < 0.0 ? 1 : 0);
}

TEST_P(Ladders, Bounds) {
  const Vector3 up(0, 0, 3), p(4, 0, 3);
  const ContactDirection w = ContactDirection::along({&up, &origin});
  const Difference d{&p, &origin};
  EXPECT_TRUE(is_within(w, d, 3.0, false, ladder));
  EXPECT_FALSE(is_within(w, d, std::nextafter(3.0, 0.0), false, ladder));
  EXPECT_FALSE(is_within(w, d, 0.59, true, ladder));  // the sine is 3/5
  EXPECT_TRUE(is_within(w, d, 0.61, true, ladder));
}

}  // namespace
}  // namespace ashlar::direction_predicates_test
