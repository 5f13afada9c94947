// The exact rung of directions, predicates and constructions is here too: it is in CGAL's numbers, which no header
// exposes.
#include "geometry/exact/direction_predicates.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Mpzf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/exact/exact_constructions.hpp"
#include "geometry/exact/exact_rounding.hpp"

namespace ashlar {

// Third rung: a dyadic number of any size. CGAL declares its moves noexcept although they may allocate.
// NOLINTNEXTLINE(bugprone-exception-escape)
struct Exact : CGAL::Mpzf {
  Exact(double a = 0.0) : CGAL::Mpzf(a) {}
  Exact(CGAL::Mpzf a) : CGAL::Mpzf(std::move(a)) {}
  static Exact difference(double a, double b) { return Exact(CGAL::Mpzf(a) - CGAL::Mpzf(b)); }
};

// NOLINTNEXTLINE(bugprone-exception-escape)
struct ContactDirection::ExactVector {
  NumberVector<Exact> value;
};

namespace {

int sign_of(const Exact& a) {
  return static_cast<int>(a.sign());
}

template <class N>
NumberVector<N> of_point(const Vector3& p) {
  return {N(p[0]), N(p[1]), N(p[2])};
}

template <class N>
NumberVector<N> sum(const NumberVector<N>& a, const NumberVector<N>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

// Evaluates `polynomial` (a generic function of the vectors of the directions) rung by rung. `degree` is that
// in the coordinates.
template <class Polynomial, class... Directions>
int decide(PredicateLadder& ladder, int degree, const Polynomial& polynomial, const Directions&... w) {
  if (ladder.allows(degree)) {
    int sign = sign_of(polynomial(w.tracked()...));
    if (sign == unknown_sign) sign = sign_of(polynomial(w.double_double()...));
    if (sign != unknown_sign) {
      ++ladder.counts.filter;
      return sign;
    }
  }
  ++ladder.counts.exact;
  return sign_of(polynomial(w.exact().value...));
}

}  // namespace

// ---- contact_direction.hpp -----------------------------------------------------------------------------------------

void ContactDirection::ExactDeleter::operator()(ExactVector* vector) const {
  delete vector;
}

const ContactDirection::ExactVector& ContactDirection::exact() const {
  if (!exact_) exact_.reset(new ExactVector{evaluate<Exact>()});
  return *exact_;
}

// ---- direction_predicates.hpp --------------------------------------------------------------------------------------

int sign_along(const ContactDirection& w, const Difference& d, PredicateLadder& ladder) {
  return decide(
      ladder, w.degree() + 1, [&]<class N>(const NumberVector<N>& v) { return dot(v, evaluate<N>(d)); }, w);
}

int sign_volume(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                PredicateLadder& ladder) {
  if (ladder.allows(3)) {
    // The static filter of Shewchuk (1997): the error of the determinant is below (7 + 56 u) u times the same
    // sum with absolute values; 9 u covers the rounding of that sum.
    const double b0 = b[0] - a[0], b1 = b[1] - a[1], b2 = b[2] - a[2];
    const double c0 = c[0] - a[0], c1 = c[1] - a[1], c2 = c[2] - a[2];
    const double d0 = d[0] - a[0], d1 = d[1] - a[1], d2 = d[2] - a[2];
    const double p01 = c0 * d1, p10 = c1 * d0, p12 = c1 * d2, p21 = c2 * d1, p20 = c2 * d0, p02 = c0 * d2;
    const double value = b0 * (p12 - p21) + b1 * (p20 - p02) + b2 * (p01 - p10);
    const double size = std::abs(b0) * (std::abs(p12) + std::abs(p21)) +
                        std::abs(b1) * (std::abs(p20) + std::abs(p02)) +
                        std::abs(b2) * (std::abs(p01) + std::abs(p10));
    const double bound = 9.0 * TrackedNumber::unit_roundoff * size;
    if (value > bound || value < -bound) {
      ++ladder.counts.filter;
      return value > bound ? 1 : -1;
    }
  }
  return sign_triple(ContactDirection::along({&b, &a}), {&c, &a}, {&d, &a}, ladder);
}

int sign_triple(const ContactDirection& w, const Difference& d1, const Difference& d2,
                PredicateLadder& ladder) {
  return decide(
      ladder, w.degree() + 2,
      [&]<class N>(const NumberVector<N>& v) { return dot(v, cross(evaluate<N>(d1), evaluate<N>(d2))); }, w);
}

SideOfLine::SideOfLine(const ContactDirection& w, const Vector3& a, const Vector3& b)
    : w_(w), a_(a), b_(b), tracked_(cross(w.tracked(), subtract_points<TrackedNumber>(b, a))) {}

int SideOfLine::sign(const Vector3& x, PredicateLadder& ladder) const {
  if (ladder.allows(w_.degree() + 2)) {
    const int sign = sign_of(dot(tracked_, subtract_points<TrackedNumber>(x, a_)));
    if (sign != unknown_sign) {
      ++ladder.counts.filter;
      return sign;
    }
  }
  return sign_turn(w_, a_, b_, x, ladder);
}

CoordinatePlane coordinate_plane(const ContactDirection& w, PredicateLadder& ladder) {
  const NumberVector<TrackedNumber>& v = w.tracked();
  const std::array<double, 3> size{std::abs(v.x.value), std::abs(v.y.value), std::abs(v.z.value)};
  const int largest = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  for (const int axis : {largest, (largest + 1) % 3, (largest + 2) % 3}) {
    const int sign = decide(
        ladder, w.degree(),
        [&]<class N>(const NumberVector<N>& u) { return axis == 0   ? u.x
                                                        : axis == 1 ? u.y
                                                                    : u.z; }, w);
    if (sign != 0) return {axis, sign};
  }
  return {0, 0};
}

int sign_turn(const CoordinatePlane& plane, const Vector3& a, const Vector3& b, const Vector3& c,
              PredicateLadder& ladder) {
  const int i = (plane.dropped + 1) % 3, j = (plane.dropped + 2) % 3;
  const auto determinant = [&]<class N>(const N&) {
    return N::difference(b[i], a[i]) * N::difference(c[j], a[j]) -
           N::difference(b[j], a[j]) * N::difference(c[i], a[i]);
  };
  if (ladder.allows(2)) {
    int sign = sign_of(determinant(TrackedNumber()));
    if (sign == unknown_sign) sign = sign_of(determinant(DoubleDouble()));
    if (sign != unknown_sign) {
      ++ladder.counts.filter;
      return plane.orientation * sign;
    }
  }
  ++ladder.counts.exact;
  return plane.orientation * sign_of(determinant(Exact(0)));
}

int sign_projected_dot(const ContactDirection& w, const Difference& d1, const Difference& d2,
                       PredicateLadder& ladder) {
  return decide(
      ladder, 2 * w.degree() + 2,
      [&]<class N>(const NumberVector<N>& v) {
        return dot(cross(v, evaluate<N>(d1)), cross(v, evaluate<N>(d2)));
      },
      w);
}

bool is_parallel(const ContactDirection& w, const Difference& d, PredicateLadder& ladder) {
  const auto component = [&](auto pick) {
    return decide(
        ladder, w.degree() + 1,
        [&]<class N>(const NumberVector<N>& v) { return pick(cross(v, evaluate<N>(d))); }, w);
  };
  return component([](const auto& c) { return c.x; }) == 0 &&
         component([](const auto& c) { return c.y; }) == 0 &&
         component([](const auto& c) { return c.z; }) == 0;
}

bool is_zero(const ContactDirection& w, PredicateLadder& ladder) {
  return decide(
             ladder, w.degree(), []<class N>(const NumberVector<N>& v) { return v.x; }, w) == 0 &&
         decide(
             ladder, w.degree(), []<class N>(const NumberVector<N>& v) { return v.y; }, w) == 0 &&
         decide(
             ladder, w.degree(), []<class N>(const NumberVector<N>& v) { return v.z; }, w) == 0;
}

bool is_within(const ContactDirection& w, const Difference& d, double bound, bool with_length,
               PredicateLadder& ladder) {
  return decide(
             ladder, 2 * w.degree() + (with_length ? 4 : 2),
             [&]<class N>(const NumberVector<N>& v) {
               const NumberVector<N> e = evaluate<N>(d);
               const N height = dot(v, e);
               const N reach = N(bound) * N(bound) * dot(v, v);
               return height * height - (with_length ? N(reach * dot(e, e)) : reach);
             },
             w) <= 0;
}

int compare_heights(const ContactDirection& w1, const Difference& d1, const ContactDirection& w2,
                    const Difference& d2, PredicateLadder& ladder) {
  return decide(
      ladder, 2 * w1.degree() + 2 * w2.degree() + 2,
      [&]<class N>(const NumberVector<N>& v1, const NumberVector<N>& v2) {
        const N h1 = dot(v1, evaluate<N>(d1)), h2 = dot(v2, evaluate<N>(d2));
        return h1 * h1 * dot(v2, v2) - h2 * h2 * dot(v1, v1);
      },
      w1, w2);
}

template <class N>
NumberVector<N> MeanDifference::evaluate() const {
  const auto total = [](std::span<const Vector3> points, double weight) {
    NumberVector<N> sum_of_points = of_point<N>(points[0]);
    for (const Vector3& p : points.subspan(1)) sum_of_points = sum(sum_of_points, of_point<N>(p));
    return scale(sum_of_points, N(weight));
  };
  return total(a_, static_cast<double>(b_.size())) - total(b_, static_cast<double>(a_.size()));
}

MeanDifference::MeanDifference(std::span<const Vector3> a, std::span<const Vector3> b)
    : a_(a), b_(b), tracked_(evaluate<TrackedNumber>()), double_double_(evaluate<DoubleDouble>()) {}

int MeanDifference::compare_alignment(const ContactDirection& w1, const ContactDirection& w2,
                                      PredicateLadder& ladder) const {
  // |h1| h1 / |w1|^2 against |h2| h2 / |w2|^2, h = w . c.
  const auto compare = []<class N>(const NumberVector<N>& c, const NumberVector<N>& v1,
                                   const NumberVector<N>& v2) {
    const N h1 = dot(v1, c), h2 = dot(v2, c);
    const int sign = sign_of(h1), other = sign_of(h2);
    if (sign == unknown_sign || other == unknown_sign) return unknown_sign;
    if (sign != other || sign == 0) return sign > other ? 1 : sign < other ? -1 : 0;
    const int larger = sign_of(N(h1 * h1 * dot(v2, v2) - h2 * h2 * dot(v1, v1)));
    return larger == unknown_sign ? unknown_sign : sign * larger;
  };
  if (ladder.allows(2 * w1.degree() + 2 * w2.degree() + 2)) {
    int sign = compare(tracked_, w1.tracked(), w2.tracked());
    if (sign == unknown_sign) sign = compare(double_double_, w1.double_double(), w2.double_double());
    if (sign != unknown_sign) {
      ++ladder.counts.filter;
      return sign;
    }
  }
  ++ladder.counts.exact;
  return compare(evaluate<Exact>(), w1.exact().value, w2.exact().value);
}

bool same_direction(const ContactDirection& v, const ContactDirection& w, PredicateLadder& ladder) {
  const auto component = [&](auto pick) {
    return decide(
        ladder, v.degree() + w.degree(),
        [&]<class N>(const NumberVector<N>& a, const NumberVector<N>& b) { return pick(cross(a, b)); }, v, w);
  };
  const auto cosine = []<class N>(const NumberVector<N>& a, const NumberVector<N>& b) { return dot(a, b); };
  return decide(ladder, v.degree() + w.degree(), cosine, v, w) > 0 &&
         component([](const auto& c) { return c.x; }) == 0 &&
         component([](const auto& c) { return c.y; }) == 0 &&
         component([](const auto& c) { return c.z; }) == 0;
}

// ---- exact_constructions.hpp ---------------------------------------------------------------------------------------

namespace {

CGAL::Gmpq quotient_of(const Exact& numerator, const Exact& denominator) {
  return CGAL::Gmpq(static_cast<CGAL::Gmpq>(numerator) / static_cast<CGAL::Gmpq>(denominator));
}

template <class HeightsOf>
double rounded_point_between(const ContactDirection& w, double a, double b, const HeightsOf& heights) {
  const auto [s, t] = heights(w.exact().value);
  const Exact width = s - t;
  const Exact numerator = Exact(a) * width + Exact::difference(b, a) * s;
  return round_to_nearest(quotient_of(numerator, width).mpq());
}

}  // namespace

double exact_squared_height(const ContactDirection& w, const Difference& d) {
  const NumberVector<Exact>& v = w.exact().value;
  const Exact height = dot(v, evaluate<Exact>(d));
  return round_to_nearest(quotient_of(height * height, dot(v, v)).mpq());
}

double exact_height(const ContactDirection& w, const Difference& d) {
  const NumberVector<Exact>& v = w.exact().value;
  const Exact height = dot(v, evaluate<Exact>(d));
  return round_square_root(quotient_of(height * height, dot(v, v)).mpq());
}

double exact_shifted(const ContactDirection& w, const Difference& d, const Vector3* x, int sign, int i) {
  const NumberVector<Exact>& v = w.exact().value;
  const Exact squared_length = dot(v, v);
  Exact numerator = component(v, i) * dot(v, evaluate<Exact>(d)) * Exact(sign);
  if (x != nullptr) numerator = numerator + Exact((*x)[i]) * squared_length;
  return round_to_nearest(quotient_of(numerator, squared_length).mpq());
}

double exact_unit_component(const ContactDirection& w, int i) {
  const NumberVector<Exact>& v = w.exact().value;
  const Exact& own = component(v, i);
  return sign_of(own) * round_square_root(quotient_of(own * own, dot(v, v)).mpq());
}

double exact_point_between(const ContactDirection& w, const Vector3& a, const Vector3& b,
                           const HeightsOverLine& heights, int i) {
  return rounded_point_between(w, a[i], b[i], heights);
}

double exact_point_between(const ContactDirection& w, const Vector3& a, const Vector3& b,
                           const HeightsOverPlane& heights, int i) {
  return rounded_point_between(w, a[i], b[i], heights);
}

}  // namespace ashlar
