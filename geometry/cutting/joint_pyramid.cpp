#include "geometry/cutting/joint_pyramid.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact/number_triple.hpp"

namespace ashlar {
namespace {

bool is_zero(const IntegerVector& a) {
  return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0;
}

/// a u - b v
IntegerVector combination(const Integer& a, const IntegerVector& u, const Integer& b,
                          const IntegerVector& v) {
  return {Integer(a * u[0] - b * v[0]), Integer(a * u[1] - b * v[1]), Integer(a * u[2] - b * v[2])};
}

bool leads_away(const IntegerVector& direction, const std::vector<IntegerVector>& normals) {
  return std::all_of(normals.begin(), normals.end(),
                     [&](const IntegerVector& normal) { return sgn(dot(normal, direction)) <= 0; });
}

Vector3 unit(const IntegerVector& v) {
  return round_unit_vector({Rational(v[0]), Rational(v[1]), Rational(v[2])});
}

/// numerator / sqrt(squared), rounded.
double ratio(const Integer& numerator, const Integer& squared) {
  Rational result(numerator * numerator, squared);
  result.canonicalize();
  return sgn(numerator) * round_square_root(result.get_mpq_t());
}

bool slides_on_one(const std::vector<IntegerVector>& held, const IntegerVector& r, KeyBlock& block) {
  for (std::size_t i = 0; i < held.size(); ++i) {
    const IntegerVector& n = held[i];
    const Integer into = dot(n, r), size = dot(n, n);
    if (sgn(into) <= 0) continue;
    const IntegerVector s = combination(size, r, into, n);
    if (is_zero(s) || !leads_away(s, held)) continue;
    block.mode = BlockMode::sliding_on_one;
    block.faces = {static_cast<int>(i), -1};
    block.direction = unit(s);
    block.pressure = {ratio(into, size * dot(r, r)), 0.0};
    // |s| = |n|^2 times the part of r along the face.
    block.thrust = ratio(dot(s, r), dot(s, s) * dot(r, r));
    return true;
  }
  return false;
}

// With c = n_i x n_j, r - (c . r) c / |c|^2 = l_i n_i + l_j n_j and
// l_i |c|^2 = |n_j|^2 (n_i . r) - (n_i . n_j)(n_j . r).
bool slides_on_two(const std::vector<IntegerVector>& held, const IntegerVector& r, KeyBlock& block) {
  for (std::size_t i = 0; i < held.size(); ++i) {
    for (std::size_t j = i + 1; j < held.size(); ++j) {
      const IntegerVector &m = held[i], &n = held[j];
      IntegerVector c = cross(m, n);
      const int sense = sgn(dot(c, r));
      if (sense == 0) continue;
      if (sense < 0) c = cross(n, m);
      const Integer both = dot(m, n), of_m = dot(m, r), of_n = dot(n, r);
      const Integer on_m = dot(n, n) * of_m - both * of_n, on_n = dot(m, m) * of_n - both * of_m;
      if (sgn(on_m) < 0 || sgn(on_n) < 0 || !leads_away(c, held)) continue;
      const Integer size = dot(c, c), force = dot(r, r);
      block.mode = BlockMode::sliding_on_two;
      block.faces = {static_cast<int>(i), static_cast<int>(j)};
      block.direction = unit(c);
      // The normal force on a face is l |n|.
      const auto pressure = [&](const Integer& on, const IntegerVector& normal) {
        Rational squared(on * on * dot(normal, normal), size * size * force);
        squared.canonicalize();
        return round_square_root(squared.get_mpq_t());
      };
      block.pressure = {pressure(on_m, m), pressure(on_n, n)};
      block.thrust = ratio(dot(c, r), size * force);
      return true;
    }
  }
  return false;
}

}  // namespace

IntegerVector in_integers(const Vector3& v) {
  const ExactPoint point = ExactPoint::of(v);
  return {point.x, point.y, point.z};
}

const char* to_string(BlockMode mode) {
  switch (mode) {
    case BlockMode::not_removable:
      return "not removable";
    case BlockMode::stable:
      return "stable";
    case BlockMode::falling:
      return "falling";
    case BlockMode::sliding_on_one:
      return "sliding on one face";
    case BlockMode::sliding_on_two:
      return "sliding on two faces";
  }
  return "";
}

// A cone whose normals span less than space has a line, else its rims are lines of two faces.
bool has_direction(const std::vector<IntegerVector>& normals) {
  bool spans = false;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const IntegerVector line = cross(normals[i], normals[j]);
      if (is_zero(line)) continue;
      if (leads_away(line, normals) || leads_away(cross(normals[j], normals[i]), normals)) return true;
      spans = spans || std::any_of(normals.begin(), normals.end(),
                                   [&](const IntegerVector& normal) { return sgn(dot(normal, line)) != 0; });
    }
  }
  return !spans;
}

KeyBlock find_key_block(const std::vector<IntegerVector>& held, const std::vector<IntegerVector>& free,
                        const Vector3& force) {
  KeyBlock block;
  std::vector<IntegerVector> all = held;
  all.insert(all.end(), free.begin(), free.end());
  block.finite = !has_direction(all);
  block.removable = has_direction(held);
  if (!block.removable) return block;
  const IntegerVector r = in_integers(force);
  if (leads_away(r, held)) {
    block.mode = BlockMode::falling;
    block.direction = unit(r);
    block.thrust = 1.0;
  } else if (!slides_on_one(held, r, block) && !slides_on_two(held, r, block)) {
    block.mode = BlockMode::stable;
  }
  return block;
}

}  // namespace ashlar
