#include "geometry/cutting/piece_measures.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact/number_triple.hpp"

namespace ashlar {
namespace {

constexpr int fixed_bits = 240;

NumberTriple<Rational> fraction(const CellComplex& complex, int point) {
  const auto [x, y, z] = complex.point(point).place.rational();
  return {x, y, z};
}

/// Six times the volume, as seen from a point. @param place of a point
template <class Number, class Place>
Number six_volumes(const CellComplex& complex, const std::vector<std::pair<int, bool>>& faces, Place place) {
  const NumberTriple<Number> origin = place(complex.face(faces.front().first).points.front());
  Number sum = 0;
  for (const auto& [index, below] : faces) {
    Number of_face = 0;
    for (const std::span<const int> loop : loops_of(complex.face(index))) {
      const NumberTriple<Number> apex = minus(place(loop[0]), origin);
      NumberTriple<Number> last = minus(place(loop[1]), origin);
      for (std::size_t k = 2; k < loop.size(); ++k) {
        NumberTriple<Number> next = minus(place(loop[k]), origin);
        of_face += dot(apex, cross(last, next));
        last = std::move(next);
      }
    }
    if (below)
      sum += of_face;
    else
      sum -= of_face;
  }
  return sum;
}

/// Twice the area, along the normal.
template <class Number, class Place>
NumberTriple<Number> two_areas(const CellComplex& complex, const std::vector<int>& faces, Place place) {
  NumberTriple<Number> sum = {0, 0, 0};
  for (const int index : faces) {
    for (const std::span<const int> loop : loops_of(complex.face(index))) {
      const NumberTriple<Number> apex = place(loop[0]);
      for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
        const auto part = cross(minus(NumberTriple<Number>(place(loop[k])), apex),
                                minus(NumberTriple<Number>(place(loop[k + 1])), apex));
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += part[axis];
      }
    }
  }
  return sum;
}

Rational scaled(const Integer& numerator, const Integer& divisor, long shift) {
  Rational result(numerator, divisor);
  result.canonicalize();
  if (shift >= 0) return result >> static_cast<unsigned long>(shift);
  return result << static_cast<unsigned long>(-shift);
}

double rounded(const Rational& number) {
  return round_to_nearest(number.get_mpq_t());
}

}  // namespace

PieceMeasures::PieceMeasures(const CellComplex& complex) : complex_(complex) {
  double largest = 0.0;
  for (std::size_t k = 0; k < complex.point_count(); ++k)
    largest = std::max(largest, complex.point(static_cast<int>(k)).place.rounded.cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(largest, &exponent);
  shift_ = fixed_bits - exponent;
}

const PieceMeasures::FixedPoint& PieceMeasures::fixed(int point) {
  const auto k = static_cast<std::size_t>(point);
  if (k >= fixed_.size()) fixed_.resize(complex_.point_count());
  if (!fixed_[k]) {
    const ExactPoint& place = complex_.point(point).place;
    const std::array<const Integer*, 3> x = {&place.x, &place.y, &place.z};
    FixedPoint cut_off;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Integer numerator = *x[axis], denominator = place.w;
      if (shift_ >= 0)
        numerator <<= static_cast<unsigned long>(shift_);
      else
        denominator <<= static_cast<unsigned long>(-shift_);
      mpz_fdiv_q(cut_off[axis].get_mpz_t(), numerator.get_mpz_t(), denominator.get_mpz_t());
    }
    fixed_[k] = std::make_unique<const FixedPoint>(std::move(cut_off));
  }
  return *fixed_[k];
}

// The error of a difference is less than a unit. The error of a determinant of differences of at most D is six
// products times 3 D^2 + 3 D + 1, less than 18 (D + 1)^2.
double PieceMeasures::volume(const std::vector<std::pair<int, bool>>& faces) {
  const auto place = [&](int point) -> const FixedPoint& { return fixed(point); };
  const Integer sum = six_volumes<Integer>(complex_, faces, place);
  const FixedPoint& origin = fixed(complex_.face(faces.front().first).points.front());
  Integer widest = 0, triangles = 0;
  for (const auto& [index, below] : faces) {
    triangles += static_cast<unsigned long>(complex_.face(index).points.size());
    for (const int point : complex_.face(index).points)
      for (std::size_t axis = 0; axis < 3; ++axis)
        widest = std::max(widest, Integer(abs(Integer(fixed(point)[axis] - origin[axis]))));
  }
  const Integer error = 18 * triangles * (widest + 1) * (widest + 1);
  const double low = rounded(scaled(sum - error, 6, 3 * shift_));
  if (low == rounded(scaled(sum + error, 6, 3 * shift_))) return low;
  const auto exact = [&](int point) { return fraction(complex_, point); };
  return rounded(Rational(six_volumes<Rational>(complex_, faces, exact) / 6));
}

// The error of a component of a cross product of differences of at most D is two products times 2 D + 1, less than 4
// (D + 1); the error of the length of a vector is less than twice that of its components.
double PieceMeasures::area(const std::vector<int>& faces) {
  const auto place = [&](int point) -> const FixedPoint& { return fixed(point); };
  const NumberTriple<Integer> sum = two_areas<Integer>(complex_, faces, place);
  Integer widest = 0, triangles = 0;
  for (const int index : faces) {
    const std::vector<int>& loop = complex_.face(index).points;
    triangles += static_cast<unsigned long>(loop.size());
    for (const int point : loop)
      for (std::size_t axis = 0; axis < 3; ++axis)
        widest = std::max(widest, Integer(abs(Integer(fixed(point)[axis] - fixed(loop[0])[axis]))));
  }
  const Integer error = 8 * triangles * (widest + 1) + 1, length = sqrt(dot(sum, sum));
  const double low = rounded(scaled(length - error, 2, 2 * shift_));
  if (low == rounded(scaled(length + error, 2, 2 * shift_))) return low;
  const auto exact = [&](int point) { return fraction(complex_, point); };
  const NumberTriple<Rational> whole = two_areas<Rational>(complex_, faces, exact);
  Rational squared = dot(whole, whole) / 4;
  squared.canonicalize();
  return round_square_root(squared.get_mpq_t());
}

}  // namespace ashlar
