#include "oracle/degenerate_pairs.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>

#include "oracle/exact_oracle.hpp"
#include "oracle/lattice_pairs.hpp"

namespace ashlar::oracle {
namespace {

// Coordinates are whole multiples of 2^-kFractionBits until they become doubles: room for a gap of 2^-60
// squeezed by 2^-30.
constexpr unsigned long kFractionBits = 120;

/// x -> linear x + offset, then times 2^scale.
struct Transformation {
  std::array<IntegerVector, 3> linear;  ///< rows, unit 2^-kFractionBits
  IntegerVector offset;                 ///< unit 2^-kFractionBits
  int scale = 0;
  std::string name;
};

/// Motion of P after contact: each point by 2^-bits times its step.
struct Displacement {
  std::vector<LatticePoint> steps;
  int bits = 0;  ///< kSmallest: as many as the doubles can hold
  std::string name;
};
constexpr int kSmallest = -1;
constexpr int kMostBits = 90;

mpz_class whole(std::int64_t value) {
  return mpz_class(std::to_string(value));  // long has 32 bits on some systems
}

IntegerVector apply(const std::array<IntegerVector, 3>& rows, const LatticePoint& x) {
  const IntegerVector point{whole(x[0]), whole(x[1]), whole(x[2])};
  return {dot(rows[0], point), dot(rows[1], point), dot(rows[2], point)};
}

std::array<LatticePoint, 3> identity() {
  return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

/// Product of three elementary shears: determinant 1, small entries.
std::array<LatticePoint, 3> random_shear(Random& random) {
  auto rows = identity();
  for (int i = 0; i < 3; ++i) {
    const auto target = static_cast<std::size_t>(pick(random, 0, 2));
    const std::size_t other = (target + static_cast<std::size_t>(pick(random, 1, 2))) % 3;
    rows[target] = lattice_add(rows[target], rows[other], pick(random, -2, 2));
  }
  return rows;
}

Transformation random_transformation(Random& random) {
  Transformation result;
  std::array<LatticePoint, 3> rows = identity();
  const auto turn = pick(random, 0, 5);
  if (turn <= 1) {
    rows = random_rotation(random);
    result.name += " rotated";
  } else if (turn == 2) {
    rows = random_shear(random);
    result.name += " sheared";
  }
  // Stretched before rotation, by up to 2^30 or 2^-30 along one axis.
  std::array<int, 3> stretch{};
  if (pick(random, 0, 2) == 0) {
    const int power = static_cast<int>(10 * pick(random, 1, 3));
    const bool needle = pick(random, 0, 1) == 0;
    stretch[static_cast<std::size_t>(pick(random, 0, 2))] = needle ? power : -power;
    result.name += (needle ? " needle 2^" : " sliver 2^-") + std::to_string(power);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result.linear[i][j] = whole(rows[i][j]) << (kFractionBits + 30);
      result.linear[i][j] >>= static_cast<unsigned long>(30 - stretch[j]);
    }
  }
  if (pick(random, 0, 4) == 0) {
    for (mpz_class& component : result.offset) component = whole(pick(random, -1, 1)) << (kFractionBits + 20);
    result.name += " offset 2^20";
  }
  if (pick(random, 0, 4) == 0) {
    result.scale = pick(random, 0, 1) == 0 ? 30 : -30;
    result.name += " scale 2^" + std::to_string(result.scale);
  }
  return result;
}

Transformation plain() {
  Transformation result;
  for (std::size_t i = 0; i < 3; ++i) result.linear[i][i] = mpz_class(1) << kFractionBits;
  return result;
}

Displacement random_displacement(Random& random, const LatticePair& pair) {
  Displacement result;
  const auto kind = pick(random, 0, 99);
  std::int64_t sign = pick(random, 0, 2) == 0 ? -1 : 1;
  if (kind < 45) {
    result.steps.assign(pair.p.points.size(), {});
    return {result.steps, 0, " touch"};
  }
  const std::array<int, 3> sizes{kSmallest, 40, 20};
  result.bits = sizes[static_cast<std::size_t>(pick(random, 0, 2))];
  if (kind < 55) {
    // A plane through the contact is tilted up or down by the smallest amount: no longer parallel.
    LatticePoint slope{pick(random, -1, 1), pick(random, -1, 1), pick(random, -1, 1)};
    // The map 1 + 2^-bits normal slope' must not turn the body inside out.
    if (lattice_dot(slope, pair.normal) < 0) slope = lattice_add({}, slope, -1);
    for (const LatticePoint& point : pair.p.points) {
      const std::int64_t height = lattice_dot(slope, lattice_add(point, pair.anchor, -1));
      result.steps.push_back(lattice_add({}, pair.normal, height));
    }
    result.name = " tilt";
  } else {
    if (kind >= 82) {
      result.bits = 0;
      sign *= pick(random, 1, 3);
    }
    result.steps.assign(pair.p.points.size(), lattice_add({}, pair.normal, sign));
    result.name = sign > 0 ? " gap" : " overlap";
  }
  if (result.bits != 0) {
    result.name += result.bits == kSmallest ? " ulp" : " 2^-" + std::to_string(result.bits);
  }
  return result;
}

bool is_double(const mpz_class& value) {
  if (sgn(value) == 0) return true;
  const auto bits = mpz_sizeinbase(value.get_mpz_t(), 2) - mpz_scan1(value.get_mpz_t(), 0);
  return bits <= static_cast<std::size_t>(std::numeric_limits<double>::digits);
}

bool are_doubles(const IntegerVector& a) {
  return is_double(a[0]) && is_double(a[1]) && is_double(a[2]);
}

std::optional<Shape> to_shape(const std::vector<IntegerVector>& points,
                              const std::vector<std::array<int, 3>>& triangles, int scale) {
  Shape shape{{}, triangles};
  for (const IntegerVector& point : points) {
    if (!are_doubles(point)) return std::nullopt;
    Point& rounded = shape.points.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      rounded[k] = std::ldexp(point[k].get_d(), scale - static_cast<int>(kFractionBits));
    }
  }
  return shape;
}

std::vector<IntegerVector> transformed(const LatticeBody& body, const Transformation& t) {
  std::vector<IntegerVector> points;
  for (const LatticePoint& point : body.points)
    points.push_back(scale_add(1, apply(t.linear, point), t.offset));
  return points;
}

/// base + 2^-bits step for every point, if that is exact on the grid 2^-kFractionBits.
std::optional<std::vector<IntegerVector>> displaced(const std::vector<IntegerVector>& base,
                                                    const std::vector<IntegerVector>& steps, int bits) {
  std::vector<IntegerVector> points = base;
  for (std::size_t i = 0; i < base.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (sgn(steps[i][k]) == 0) continue;
      if (mpz_scan1(steps[i][k].get_mpz_t(), 0) < static_cast<unsigned long>(bits)) return std::nullopt;
      points[i][k] += steps[i][k] >> static_cast<unsigned long>(bits);
    }
    if (!are_doubles(points[i])) return std::nullopt;
  }
  return points;
}

std::optional<DegeneratePair> realise(const LatticePair& pair, const Displacement& displacement,
                                      const Transformation& t) {
  const std::vector<IntegerVector> base = transformed(pair.p, t);
  std::vector<IntegerVector> steps;
  for (const LatticePoint& step : displacement.steps) steps.push_back(apply(t.linear, step));
  std::optional<std::vector<IntegerVector>> points;
  if (displacement.bits == kSmallest) {
    for (int bits = kMostBits; bits > 0 && !points; --bits) points = displaced(base, steps, bits);
  } else {
    points = displaced(base, steps, displacement.bits);
  }
  if (!points) return std::nullopt;
  const auto p = to_shape(*points, pair.p.triangles, t.scale);
  const auto q = to_shape(transformed(pair.q, t), pair.q.triangles, t.scale);
  if (!p || !q) return std::nullopt;
  return DegeneratePair{*p, *q, pair.family + displacement.name + t.name};
}

bool is_simplex(const Shape& shape) {
  return shape.points.size() <= 4;
}

bool is_valid(const Shape& shape) {
  try {
    (void)make_body(shape, common_exponent(shape, shape));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// One ulp more or less in one coordinate: a simplex stays convex unless a sliver turns inside out.
/// @return whether the shape changed.
bool nudge(Random& random, Shape& shape) {
  const Shape before = shape;
  Point& point = shape.points[static_cast<std::size_t>(pick(random, 0, std::ssize(shape.points) - 1))];
  double& value = point[static_cast<std::size_t>(pick(random, 0, 2))];
  const double infinity = std::numeric_limits<double>::infinity();
  const double target = pick(random, 0, 1) == 0 ? infinity : -infinity;
  if (value != 0.0) value = std::nextafter(value, target);
  if (value != 0.0 && is_valid(shape)) return true;
  shape = before;
  return false;
}

/// The image under a linear map with entries that are no doubles, every coordinate rounded: exact contact, parallelism
/// and flatness become approximate, in coordinates with all their bits.
/// @return whether both shapes are still valid; they are unchanged if not.
bool round_off(Random& random, Shape& p, Shape& q) {
  constexpr int kDenominator = 997;
  std::array<std::array<mpq_class, 3>, 3> rows;
  for (auto& row : rows) {
    for (mpq_class& entry : row) {
      entry = mpq_class(whole(pick(random, -kDenominator, kDenominator)), kDenominator);
      entry.canonicalize();
    }
  }
  std::array<Shape, 2> images{p, q};
  for (Shape& image : images) {
    for (Point& point : image.points) {
      const Point x = point;
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] = round_to_double(rows[k][0] * mpq_class(x[0]) + rows[k][1] * mpq_class(x[1]) +
                                   rows[k][2] * mpq_class(x[2]));
      }
    }
  }
  // A map of negative determinant turns solids inside out.
  for (Shape& image : images) {
    if (is_valid(image)) continue;
    for (auto& triangle : image.triangles) std::swap(triangle[0], triangle[1]);
    if (!is_valid(image)) return false;
  }
  p = images[0];
  q = images[1];
  return true;
}

LatticePair random_lattice_pair(Random& random, bool solids) {
  const auto family = pick(random, 0, 19);
  if (family >= 17) return make_grid_pair(random, solids);
  if (family >= 16) return make_twin_pair(random, solids);
  if (family >= 10 && solids) return make_supported_pair(random);
  return make_resting_pair(random, solids);
}

}  // namespace

DegeneratePair DegeneratePairs::next() {
  solids_ = !solids_;
  const LatticePair pair = random_lattice_pair(random_, solids_);
  const Displacement displacement = random_displacement(random_, pair);
  std::optional<DegeneratePair> made;
  for (int attempt = 0; attempt < 3 && !made; ++attempt) {
    made = realise(pair, displacement, random_transformation(random_));
  }
  if (!made) made = realise(pair, displacement, plain());
  // Coordinates of the lattice are small, so the pair in its plain place and just touching is always exact.
  if (!made) made = realise(pair, {std::vector<LatticePoint>(pair.p.points.size()), 0, " touch"}, plain());
  for (Shape* shape : {&made->p, &made->q}) {
    if (is_simplex(*shape) && pick(random_, 0, 9) == 0 && nudge(random_, *shape)) made->family += " nudged";
  }
  const bool simplices = is_simplex(made->p) && is_simplex(made->q);
  if (simplices && pick(random_, 0, 11) == 0 && round_off(random_, made->p, made->q))
    made->family += " rounded";
  if (pick(random_, 0, 1) == 0) std::swap(made->p, made->q);
  return *made;
}

}  // namespace ashlar::oracle
