// One source for three headers: directions, predicates and constructions share CGAL's number types, which no
// header exposes.
#include "geometry/exact/direction_predicates.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Mpzf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/exact/direction_constructions.hpp"
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

template <class N>
NumberVector<N> subtract_points(const Vector3& a, const Vector3& b) {
  return {N::difference(a[0], b[0]), N::difference(a[1], b[1]), N::difference(a[2], b[2])};
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

template <class N>
struct Fraction {
  N numerator, denominator;
};

CGAL::Gmpq rational(const Fraction<Exact>& f) {
  return CGAL::Gmpq(static_cast<CGAL::Gmpq>(f.numerator) / static_cast<CGAL::Gmpq>(f.denominator));
}

// Rounds three components: `floating(i)` gives one as an optional DoubleDouble and is asked where `usable`,
// `exact(i)` gives the nearest double and is asked where that leaves a doubt.
template <class Floating, class ExactOf>
Vector3 round_components(PredicateLadder& ladder, bool usable, const Floating& floating,
                         const ExactOf& exact) {
  Vector3 result;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> value = usable ? rounded(floating(i)) : std::nullopt;
    ++(value ? ladder.counts.filter : ladder.counts.exact);
    result[i] = value ? *value : exact(i);
  }
  return result;
}

template <class N>
const N& component(const NumberVector<N>& v, int i) {
  return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

// The point a + (b - a) s / (s - t), rounded; `heights` (a generic function of w) gives s and t.
template <class HeightsOf>
Vector3 round_between(PredicateLadder& ladder, const ContactDirection& w, const Vector3& a, const Vector3& b,
                      const HeightsOf& heights) {
  std::optional<DoubleDouble> ratio;
  if (ladder.floating) {
    const auto [s, t] = heights(w.double_double());
    ratio = quotient(s, s - t);
  }
  return round_components(
      ladder, ratio.has_value(),
      [&](int i) { return DoubleDouble(a[i]) + DoubleDouble::difference(b[i], a[i]) * *ratio; },
      [&](int i) {
        const auto [s, t] = heights(w.exact().value);
        const Exact width = s - t;
        const Exact numerator = Exact(a[i]) * width + Exact::difference(b[i], a[i]) * s;
        return round_to_nearest(rational({numerator, width}).mpq());
      });
}

}  // namespace

// ---- contact_direction.hpp -----------------------------------------------------------------------------------------

template <class N>
NumberVector<N> ContactDirection::evaluate() const {
  NumberVector<N> w = ashlar::evaluate<N>(first_);
  if (kind_ != Kind::difference) {
    const NumberVector<N> e = ashlar::evaluate<N>(second_);
    w = ashlar::cross(w, e);
    if (kind_ == Kind::rejection) w = ashlar::cross(e, w);
  }
  if (!reversed_) return w;
  const N zero(0.0);
  return {zero - w.x, zero - w.y, zero - w.z};
}

ContactDirection::ContactDirection() = default;
ContactDirection::~ContactDirection() = default;
ContactDirection::ContactDirection(ContactDirection&&) noexcept = default;
ContactDirection& ContactDirection::operator=(ContactDirection&&) noexcept = default;

ContactDirection::ContactDirection(Kind kind, const Difference& first, const Difference& second)
    : kind_(kind), first_(first), second_(second) {
  numbers_.tracked = evaluate<TrackedNumber>();
  set_bound();
}

void ContactDirection::set_bound() {
  const auto largest = [&](auto part) {
    return std::max({part(numbers_.tracked.x), part(numbers_.tracked.y), part(numbers_.tracked.z)});
  };
  const double error = largest([](const TrackedNumber& n) { return n.error; });
  const double value = largest([](const TrackedNumber& n) { return std::abs(n.value); });
  numbers_.bound = (error + 8.0 * TrackedNumber::unit_roundoff * value) * (1.0 + 0x1p-20);
}

ContactDirection ContactDirection::along(const Difference& d) {
  return {Kind::difference, d, {}};
}
ContactDirection ContactDirection::cross(const Difference& e1, const Difference& e2) {
  return {Kind::cross, e1, e2};
}
ContactDirection ContactDirection::cross(const Difference& e1, const Difference& e2,
                                         const DirectionNumbers& numbers) {
  ContactDirection w;
  w.kind_ = Kind::cross;
  w.first_ = e1;
  w.second_ = e2;
  w.numbers_ = numbers;
  w.has_double_double_ = true;
  return w;
}
ContactDirection ContactDirection::rejection(const Difference& d, const Difference& e) {
  return {Kind::rejection, d, e};
}

ContactDirection ContactDirection::copy() const {
  ContactDirection result;
  result.kind_ = kind_;
  result.reversed_ = reversed_;
  result.first_ = first_;
  result.second_ = second_;
  result.numbers_ = numbers_;
  result.has_double_double_ = has_double_double_;
  return result;
}

void ContactDirection::reverse() {
  reversed_ = !reversed_;
  exact_.reset();
  if (has_double_double_) {
    NumberVector<DoubleDouble>& d = numbers_.double_double;
    d = {-d.x, -d.y, -d.z};
  }
  for (TrackedNumber* n : {&numbers_.tracked.x, &numbers_.tracked.y, &numbers_.tracked.z})
    n->value = -n->value;
}

void ContactDirection::compute_double_double() const {
  numbers_.double_double = evaluate<DoubleDouble>();
  has_double_double_ = true;
}

const DoubleDouble& ContactDirection::squared_length() const {
  if (!has_squared_length_) {
    squared_length_ = dot(double_double(), double_double());
    has_squared_length_ = true;
  }
  return squared_length_;
}

const ContactDirection::ExactVector& ContactDirection::exact() const {
  if (!exact_) exact_ = std::make_unique<ExactVector>(ExactVector{evaluate<Exact>()});
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

// ---- direction_constructions.hpp -----------------------------------------------------------------------------------

ContactHeight::ContactHeight(const ContactDirection& w, const Difference& d, PredicateLadder& ladder)
    : w_(w), d_(d), ladder_(ladder) {
  if (!ladder.floating) return;
  height_ = dot(w.double_double(), evaluate<DoubleDouble>(d));
  if (const auto ratio = quotient(height_, w.squared_length())) {
    ratio_ = *ratio;
    has_ratio_ = true;
  }
}

double ContactHeight::squared() const {
  if (has_ratio_)
    if (const auto value = rounded(height_ * ratio_)) {
      ++ladder_.counts.filter;
      return *value;
    }
  ++ladder_.counts.exact;
  const NumberVector<Exact>& w = w_.exact().value;
  const Exact height = dot(w, evaluate<Exact>(d_));
  return round_to_nearest(rational({height * height, dot(w, w)}).mpq());
}

double ContactHeight::length() const {
  if (has_ratio_)
    if (const auto root = square_root(height_ * ratio_))
      if (const auto value = rounded(*root)) {
        ++ladder_.counts.filter;
        return *value;
      }
  ++ladder_.counts.exact;
  const NumberVector<Exact>& w = w_.exact().value;
  const Exact height = dot(w, evaluate<Exact>(d_));
  return round_square_root(rational({height * height, dot(w, w)}).mpq());
}

Vector3 ContactHeight::shifted(const Vector3* x, int sign) const {
  return round_components(
      ladder_, has_ratio_,
      [&](int i) {
        const DoubleDouble step = component(w_.double_double(), i) * (sign < 0 ? -ratio_ : ratio_);
        return x != nullptr ? DoubleDouble((*x)[i]) + step : step;
      },
      [&](int i) {
        const NumberVector<Exact>& w = w_.exact().value;
        const Exact squared_length = dot(w, w);
        Exact numerator = component(w, i) * dot(w, evaluate<Exact>(d_)) * Exact(sign);
        if (x != nullptr) numerator = numerator + Exact((*x)[i]) * squared_length;
        return round_to_nearest(rational({numerator, squared_length}).mpq());
      });
}

Vector3 unit_vector(const ContactDirection& w, PredicateLadder& ladder) {
  std::optional<DoubleDouble> inverse;
  if (ladder.floating)
    if (const auto length = square_root(w.squared_length())) inverse = quotient(DoubleDouble(1.0), *length);
  return round_components(
      ladder, inverse.has_value(), [&](int i) { return component(w.double_double(), i) * *inverse; },
      [&](int i) {
        const NumberVector<Exact>& v = w.exact().value;
        const Exact& own = component(v, i);
        return sign_of(own) * round_square_root(rational({own * own, dot(v, v)}).mpq());
      });
}

Vector3 crossing_point(const ContactDirection& w, const Vector3& a, const Vector3& b, const Vector3& c,
                       const Vector3& d, PredicateLadder& ladder) {
  return round_between(ladder, w, a, b, [&]<class N>(const NumberVector<N>& v) {
    const NumberVector<N> across = cross(v, subtract_points<N>(d, c));
    return std::pair<N, N>(dot(across, subtract_points<N>(a, c)), dot(across, subtract_points<N>(b, c)));
  });
}

Vector3 plane_point(const ContactDirection& w, const Vector3& a, const Vector3& b, const Vector3& c,
                    PredicateLadder& ladder) {
  return round_between(ladder, w, a, b, [&]<class N>(const NumberVector<N>& v) {
    return std::pair<N, N>(dot(v, subtract_points<N>(a, c)), dot(v, subtract_points<N>(b, c)));
  });
}

}  // namespace ashlar
