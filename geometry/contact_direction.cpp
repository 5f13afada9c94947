#include "geometry/contact_direction.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Mpzf.h>

#include <array>

#include "geometry/exact_rounding.hpp"

namespace ashlar {

using Exact = CGAL::Mpzf;

struct ContactDirection::ExactVector {
  NumberVector<Exact> value;
};

namespace {

int sign_of(const Exact& a) {
  return static_cast<int>(a.sign());
}

template <class N>
N subtract(double a, double b) {
  return N::difference(a, b);
}
template <>
Exact subtract<Exact>(double a, double b) {
  return Exact(a) - Exact(b);
}

template <class N>
NumberVector<N> of_point(const Vector3& p) {
  return {N(p[0]), N(p[1]), N(p[2])};
}

template <class N>
NumberVector<N> subtract_points(const Vector3& a, const Vector3& b) {
  return {subtract<N>(a[0], b[0]), subtract<N>(a[1], b[1]), subtract<N>(a[2], b[2])};
}

template <class N>
NumberVector<N> sum(const NumberVector<N>& a, const NumberVector<N>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

// Evaluates `polynomial` (a generic function of the vectors of the directions) rung by rung.
template <class Polynomial, class... Directions>
int decide(PredicateLadder& ladder, const Polynomial& polynomial, const Directions&... w) {
  if (ladder.floating) {
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

// Rounds the ratio that `fraction` (a generic function of w) returns.
template <class FractionOf>
double round_fraction(PredicateLadder& ladder, const ContactDirection& w, const FractionOf& fraction) {
  if (ladder.floating) {
    const Fraction<DoubleDouble> f = fraction(w.double_double());
    if (const auto q = quotient(f.numerator, f.denominator))
      if (const auto result = rounded(*q)) {
        ++ladder.counts.filter;
        return *result;
      }
  }
  ++ladder.counts.exact;
  return round_to_nearest(rational(fraction(w.exact().value)).mpq());
}

// The same for three ratios with one denominator; `fractions` returns numerators and denominator.
template <class N>
struct VectorFraction {
  NumberVector<N> numerator;
  N denominator;
};

template <class FractionsOf>
Vector3 round_fractions(PredicateLadder& ladder, const ContactDirection& w, const FractionsOf& fractions) {
  Vector3 result;
  std::array<bool, 3> known{false, false, false};
  if (ladder.floating) {
    const VectorFraction<DoubleDouble> f = fractions(w.double_double());
    const std::array<DoubleDouble, 3> numerators{f.numerator.x, f.numerator.y, f.numerator.z};
    for (int i = 0; i < 3; ++i) {
      const auto q = quotient(numerators[i], f.denominator);
      const auto value = q ? rounded(*q) : std::nullopt;
      if (!value) continue;
      result[i] = *value;
      known[i] = true;
      ++ladder.counts.filter;
    }
  }
  if (known[0] && known[1] && known[2]) return result;
  const VectorFraction<Exact> f = fractions(w.exact().value);
  const std::array<const Exact*, 3> numerators{&f.numerator.x, &f.numerator.y, &f.numerator.z};
  for (int i = 0; i < 3; ++i) {
    if (known[i]) continue;
    ++ladder.counts.exact;
    result[i] = round_to_nearest(rational({*numerators[i], f.denominator}).mpq());
  }
  return result;
}

// a + (b - a) s / (s - t) for points with the opposite heights s, t.
template <class N>
VectorFraction<N> between(const Vector3& a, const Vector3& b, const N& s, const N& t) {
  const N width = s - t;
  return {sum(scale(of_point<N>(a), width), scale(subtract_points<N>(b, a), s)), width};
}

}  // namespace

void NumericRange::include(double coordinate) {
  if (coordinate == 0.0) return;
  int exponent = 0;
  double mantissa = std::frexp(std::abs(coordinate), &exponent);
  highest_bit = std::max(highest_bit, exponent);
  const auto digits = static_cast<unsigned long long>(mantissa * 0x1p53);
  lowest_bit = std::min(lowest_bit, exponent - 53 + __builtin_ctzll(digits));
}

void NumericRange::include(const NumericRange& other) {
  lowest_bit = std::min(lowest_bit, other.lowest_bit);
  highest_bit = std::max(highest_bit, other.highest_bit);
}

template <class N>
NumberVector<N> evaluate(const Difference& d) {
  NumberVector<N> first = d.minus != nullptr ? subtract_points<N>(*d.plus, *d.minus) : of_point<N>(*d.plus);
  return d.plus2 == nullptr ? first : sum(first, subtract_points<N>(*d.plus2, *d.minus2));
}

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
    : kind_(kind), first_(first), second_(second), tracked_(evaluate<TrackedNumber>()) {}

ContactDirection ContactDirection::along(const Difference& d) {
  return {Kind::difference, d, {}};
}
ContactDirection ContactDirection::cross(const Difference& e1, const Difference& e2) {
  return {Kind::cross, e1, e2};
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
  result.tracked_ = tracked_;
  return result;
}

ContactDirection ContactDirection::reversed() const {
  ContactDirection result = copy();
  result.reverse();
  return result;
}

void ContactDirection::reverse() {
  reversed_ = !reversed_;
  has_double_double_ = false;
  exact_.reset();
  for (TrackedNumber* n : {&tracked_.x, &tracked_.y, &tracked_.z}) n->value = -n->value;
}

const NumberVector<DoubleDouble>& ContactDirection::double_double() const {
  if (!has_double_double_) {
    double_double_ = evaluate<DoubleDouble>();
    has_double_double_ = true;
  }
  return double_double_;
}

const ContactDirection::ExactVector& ContactDirection::exact() const {
  if (!exact_) exact_ = std::make_unique<ExactVector>(ExactVector{evaluate<Exact>()});
  return *exact_;
}

int sign_along(const ContactDirection& w, const Difference& d, PredicateLadder& ladder) {
  return decide(
      ladder, [&]<class N>(const NumberVector<N>& v) { return dot(v, evaluate<N>(d)); }, w);
}

int sign_triple(const ContactDirection& w, const Difference& d1, const Difference& d2,
                PredicateLadder& ladder) {
  return decide(
      ladder,
      [&]<class N>(const NumberVector<N>& v) { return dot(v, cross(evaluate<N>(d1), evaluate<N>(d2))); }, w);
}

int sign_projected_dot(const ContactDirection& w, const Difference& d1, const Difference& d2,
                       PredicateLadder& ladder) {
  return decide(
      ladder,
      [&]<class N>(const NumberVector<N>& v) {
        return dot(cross(v, evaluate<N>(d1)), cross(v, evaluate<N>(d2)));
      },
      w);
}

bool is_parallel(const ContactDirection& w, const Difference& d, PredicateLadder& ladder) {
  const auto component = [&](auto pick) {
    return decide(
        ladder, [&]<class N>(const NumberVector<N>& v) { return pick(cross(v, evaluate<N>(d))); }, w);
  };
  return component([](const auto& c) { return c.x; }) == 0 &&
         component([](const auto& c) { return c.y; }) == 0 &&
         component([](const auto& c) { return c.z; }) == 0;
}

bool is_zero(const ContactDirection& w, PredicateLadder& ladder) {
  return decide(
             ladder, []<class N>(const NumberVector<N>& v) { return v.x; }, w) == 0 &&
         decide(
             ladder, []<class N>(const NumberVector<N>& v) { return v.y; }, w) == 0 &&
         decide(
             ladder, []<class N>(const NumberVector<N>& v) { return v.z; }, w) == 0;
}

bool is_within(const ContactDirection& w, const Difference& d, double bound, bool with_length,
               PredicateLadder& ladder) {
  return decide(
             ladder,
             [&]<class N>(const NumberVector<N>& v) {
               const NumberVector<N> e = evaluate<N>(d);
               const N height = dot(v, e);
               const N reach = N(bound) * N(bound) * dot(v, v);
               return height * height - (with_length ? reach * dot(e, e) : reach);
             },
             w) <= 0;
}

int compare_heights(const ContactDirection& w1, const Difference& d1, const ContactDirection& w2,
                    const Difference& d2, PredicateLadder& ladder) {
  return decide(
      ladder,
      [&]<class N>(const NumberVector<N>& v1, const NumberVector<N>& v2) {
        const N h1 = dot(v1, evaluate<N>(d1)), h2 = dot(v2, evaluate<N>(d2));
        return h1 * h1 * dot(v2, v2) - h2 * h2 * dot(v1, v1);
      },
      w1, w2);
}

int compare_alignment(const ContactDirection& w1, const ContactDirection& w2, std::span<const Vector3> a,
                      std::span<const Vector3> b, PredicateLadder& ladder) {
  const auto along_means = [&]<class N>(const NumberVector<N>& v) {  // w . c, times the numbers of points
    N sum_a(0.0), sum_b(0.0);
    for (const Vector3& p : a) sum_a = sum_a + dot(v, of_point<N>(p));
    for (const Vector3& p : b) sum_b = sum_b + dot(v, of_point<N>(p));
    return N(sum_a * N(static_cast<double>(b.size())) - sum_b * N(static_cast<double>(a.size())));
  };
  const int sign = decide(ladder, along_means, w1);
  const int other_sign = decide(ladder, along_means, w2);
  if (sign != other_sign) return sign > other_sign ? 1 : -1;
  return sign * decide(
                    ladder,
                    [&]<class N>(const NumberVector<N>& v1, const NumberVector<N>& v2) {
                      const N h1 = along_means(v1), h2 = along_means(v2);
                      return h1 * h1 * dot(v2, v2) - h2 * h2 * dot(v1, v1);
                    },
                    w1, w2);
}

bool same_direction(const ContactDirection& v, const ContactDirection& w, PredicateLadder& ladder) {
  const auto component = [&](auto pick) {
    return decide(
        ladder,
        [&]<class N>(const NumberVector<N>& a, const NumberVector<N>& b) { return pick(cross(a, b)); }, v, w);
  };
  const auto cosine = []<class N>(const NumberVector<N>& a, const NumberVector<N>& b) { return dot(a, b); };
  return decide(ladder, cosine, v, w) > 0 && component([](const auto& c) { return c.x; }) == 0 &&
         component([](const auto& c) { return c.y; }) == 0 &&
         component([](const auto& c) { return c.z; }) == 0;
}

double squared_height(const ContactDirection& w, const Difference& d, PredicateLadder& ladder) {
  return round_fraction(ladder, w, [&]<class N>(const NumberVector<N>& v) {
    const N height = dot(v, evaluate<N>(d));
    return Fraction<N>{height * height, dot(v, v)};
  });
}

Vector3 shifted(const Vector3* x, const ContactDirection& w, const Difference& d, PredicateLadder& ladder) {
  return round_fractions(ladder, w, [&]<class N>(const NumberVector<N>& v) {
    const N squared_length = dot(v, v);
    const NumberVector<N> step = scale(v, N(dot(v, evaluate<N>(d))));
    if (x == nullptr) return VectorFraction<N>{step, squared_length};
    return VectorFraction<N>{sum(step, scale(of_point<N>(*x), squared_length)), squared_length};
  });
}

Vector3 unit_vector(const ContactDirection& w, PredicateLadder& ladder) {
  Vector3 result;
  const auto component = [&](int i, auto pick) {
    const int sign = decide(
        ladder, [&]<class N>(const NumberVector<N>& v) { return pick(v); }, w);
    const auto square = [&]<class N>(const NumberVector<N>& v) {
      return Fraction<N>{pick(v) * pick(v), dot(v, v)};
    };
    if (ladder.floating) {
      const Fraction<DoubleDouble> f = square(w.double_double());
      const auto q = quotient(f.numerator, f.denominator);
      const auto root = q ? square_root(*q) : std::nullopt;
      if (const auto value = root ? rounded(*root) : std::nullopt) {
        ++ladder.counts.filter;
        result[i] = sign * *value;
        return;
      }
    }
    ++ladder.counts.exact;
    result[i] = sign * round_square_root(rational(square(w.exact().value)).mpq());
  };
  component(0, [](const auto& v) { return v.x; });
  component(1, [](const auto& v) { return v.y; });
  component(2, [](const auto& v) { return v.z; });
  return result;
}

Vector3 crossing_point(const ContactDirection& w, const Vector3& a, const Vector3& b, const Vector3& c,
                       const Vector3& d, PredicateLadder& ladder) {
  return round_fractions(ladder, w, [&]<class N>(const NumberVector<N>& v) {
    const NumberVector<N> across = cross(v, subtract_points<N>(d, c));
    return between<N>(a, b, dot(across, subtract_points<N>(a, c)), dot(across, subtract_points<N>(b, c)));
  });
}

Vector3 plane_point(const ContactDirection& w, const Vector3& a, const Vector3& b, const Vector3& c,
                    PredicateLadder& ladder) {
  return round_fractions(ladder, w, [&]<class N>(const NumberVector<N>& v) {
    return between<N>(a, b, dot(v, subtract_points<N>(a, c)), dot(v, subtract_points<N>(b, c)));
  });
}

}  // namespace ashlar
