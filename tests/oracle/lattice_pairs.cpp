#include "oracle/lattice_pairs.hpp"

#include <algorithm>
#include <iterator>

namespace ashlar::oracle {
namespace {

// All coordinates are multiples of this, so that points at quarters of edges and triangles are whole.
constexpr std::int64_t kSpacing = 4;

bool collinear(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return lattice_cross(lattice_add(b, a, -1), lattice_add(c, a, -1)) == LatticePoint{};
}

void move(LatticeBody& body, const LatticePoint& by) {
  for (LatticePoint& point : body.points) point = lattice_add(point, by);
}

LatticePoint random_point(Random& random, std::int64_t reach) {
  return {kSpacing * pick(random, -reach, reach), kSpacing * pick(random, -reach, reach),
          kSpacing * pick(random, -reach, reach)};
}

/// `count` points of the plane z = 0, no two equal, not all collinear; along `direction` where one is given.
std::vector<LatticePoint> flat_points(Random& random, int count, const LatticePoint& direction) {
  for (;;) {
    std::vector<LatticePoint> points;
    for (int i = 0; i < count; ++i) {
      LatticePoint point = random_point(random, 3);
      point[2] = 0;
      points.push_back(point);
    }
    if (count >= 2 && direction != LatticePoint{}) {
      points[1] = lattice_add(points[0], direction, pick(random, 0, 1) == 0 ? 1 : pick(random, -2, 2));
    }
    if (count >= 2 && points[0] == points[1]) continue;
    const bool flat = count < 3 || std::any_of(points.begin() + 2, points.end(), [&](const LatticePoint& p) {
                        return !collinear(points[0], points[1], p);
                      });
    if (flat) return points;
  }
}

std::vector<LatticePoint> upper_points(Random& random, const std::vector<LatticePoint>& base) {
  const std::int64_t height = kSpacing * pick(random, 1, 3);
  std::vector<LatticePoint> points;
  const auto style = pick(random, 0, 3);
  if (base.size() >= 3 && style < 2) {
    LatticePoint shift = style == 0 ? LatticePoint{} : random_point(random, 2);
    shift[2] = height;
    for (const LatticePoint& point : base) points.push_back(lattice_add(point, shift));
    return points;
  }
  const std::int64_t count = base.size() >= 3 ? pick(random, 1, 3) : pick(random, 2, 5);
  for (std::int64_t i = 0; i < count; ++i) {
    LatticePoint point = random_point(random, 3);
    point[2] = style == 2 ? height : kSpacing * pick(random, 1, 3);
    points.push_back(point);
  }
  return points;
}

LatticeBody body_of(const LatticeSolid& solid) {
  return {solid.points, solid.triangles};
}

/// A body in z >= 0 whose points at z = 0 span a vertex, edge or facet (dimension 0, 1, 2).
LatticeBody make_upper_body(Random& random, bool solid, std::int64_t dimension,
                            const LatticePoint& direction) {
  for (;;) {
    const bool polygon = dimension == 2 && solid;
    const int count = polygon ? static_cast<int>(pick(random, 3, 7)) : static_cast<int>(dimension) + 1;
    std::vector<LatticePoint> points = flat_points(random, count, direction);
    if (!solid) {
      while (points.size() < 3) {
        LatticePoint point = random_point(random, 3);
        point[2] = kSpacing * pick(random, 1, 3);
        points.push_back(point);
      }
      if (collinear(points[0], points[1], points[2])) continue;
      return {points, {{0, 1, 2}}};
    }
    const std::vector<LatticePoint> upper = upper_points(random, points);
    points.insert(points.end(), upper.begin(), upper.end());
    const LatticeSolid hull = lattice_hull(points, random);
    if (!hull.triangles.empty()) return body_of(hull);
  }
}

/// Turns a body in z >= 0 into one in z <= 0 (half turn about the x axis; triangles stay outward).
void turn_down(LatticeBody& body) {
  for (LatticePoint& point : body.points) point = {point[0], -point[1], -point[2]};
}

std::vector<LatticePoint> support(const LatticeBody& body, const LatticePoint& direction) {
  std::vector<LatticePoint> found;
  for (const LatticePoint& point : body.points) {
    const std::int64_t excess =
        found.empty() ? 0 : lattice_dot(direction, point) - lattice_dot(direction, found.front());
    if (excess > 0) found.clear();
    if (excess >= 0) found.push_back(point);
  }
  return found;
}

/// A random one of the points, or a point at quarters between up to three of them.
LatticePoint choose_anchor(Random& random, std::vector<LatticePoint> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::swap(points[i],
              points[static_cast<std::size_t>(
                  pick(random, static_cast<std::int64_t>(i), static_cast<std::int64_t>(points.size()) - 1))]);
  }
  const auto used = std::min(static_cast<std::int64_t>(points.size()), pick(random, 1, 3));
  if (used == 1) return points[0];
  const std::int64_t first = used == 2 ? pick(random, 1, 3) : 2;
  LatticePoint sum{};
  sum = lattice_add(sum, points[0], first);
  sum = lattice_add(sum, points[1], used == 2 ? 4 - first : 1);
  if (used == 3) sum = lattice_add(sum, points[2]);
  return {sum[0] / 4, sum[1] / 4, sum[2] / 4};
}

LatticePoint negated(const LatticePoint& a) {
  return {-a[0], -a[1], -a[2]};
}

LatticeSolid make_box(Random& random, bool turned) {
  const auto rotation = random_rotation(random);
  const bool cube = pick(random, 0, 1) == 0;
  const std::int64_t side = kSpacing * pick(random, 1, 3);
  LatticePoint sides{side, side, side};
  if (!cube) {
    for (std::int64_t& length : sides) length = kSpacing * pick(random, 1, 3);
  }
  std::vector<LatticePoint> points;
  for (unsigned corner = 0; corner < 8; ++corner) {
    LatticePoint point{};
    for (std::size_t k = 0; k < 3; ++k) point[k] = ((corner >> k) & 1U) != 0 ? sides[k] : 0;
    if (turned) {
      point = {lattice_dot(rotation[0], point), lattice_dot(rotation[1], point),
               lattice_dot(rotation[2], point)};
    }
    points.push_back(point);
  }
  return lattice_hull(points, random);
}

LatticeSolid make_random_hull(Random& random, std::int64_t reach) {
  for (;;) {
    std::vector<LatticePoint> points;
    const std::int64_t count = pick(random, 0, 7) == 0 ? pick(random, 12, 20) : pick(random, 4, 8);
    points.reserve(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) points.push_back(random_point(random, reach));
    LatticeSolid hull = lattice_hull(points, random);
    if (!hull.triangles.empty()) return hull;
  }
}

LatticeSolid make_solid(Random& random) {
  switch (pick(random, 0, 5)) {
    case 0:
      return make_box(random, false);
    case 1:
    case 2:
    case 3:
      return make_box(random, true);
    default:
      return make_random_hull(random, 2);
  }
}

LatticePoint random_side(Random& random, const LatticeSolid& solid) {
  const auto& t = solid.triangles[static_cast<std::size_t>(
      pick(random, 0, static_cast<std::int64_t>(solid.triangles.size()) - 1))];
  return lattice_add(solid.points[static_cast<std::size_t>(t[0])],
                     solid.points[static_cast<std::size_t>(t[1])], -1);
}

LatticePoint random_normal(Random& random, const LatticeSolid& solid) {
  return solid.normals[static_cast<std::size_t>(
      pick(random, 0, static_cast<std::int64_t>(solid.normals.size()) - 1))];
}

/// From q towards p.
LatticePoint choose_direction(Random& random, const LatticeSolid& p, const LatticeSolid& q) {
  for (;;) {
    LatticePoint direction{};
    switch (pick(random, 0, 6)) {
      case 0:
      case 1:
        direction = random_normal(random, q);
        break;
      case 2:
        direction = negated(random_normal(random, p));
        break;
      case 3:
      case 4:
      case 5: {
        const LatticePoint p_side = random_side(random, p);
        direction = lattice_cross(p_side, random_side(random, q));
        if (pick(random, 0, 1) == 0) direction = negated(direction);
        break;
      }
      default:
        direction = random_point(random, 3);
    }
    if (direction != LatticePoint{}) return direction;
  }
}

}  // namespace

std::array<LatticePoint, 3> random_rotation(Random& random) {
  for (;;) {
    const std::int64_t w = pick(random, -3, 3);
    const std::int64_t x = pick(random, -3, 3);
    const std::int64_t y = pick(random, -3, 3);
    const std::int64_t z = pick(random, -3, 3);
    if (w == 0 && x == 0 && y == 0 && z == 0) continue;
    return {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
             {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
             {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
  }
}

LatticePair make_resting_pair(Random& random, bool solids) {
  // Wider features more often: many of them touch in less than they could.
  constexpr std::array<std::array<int, 2>, 15> kDimensions{{{0, 0},
                                                            {0, 1},
                                                            {0, 2},
                                                            {0, 2},
                                                            {0, 2},
                                                            {1, 1},
                                                            {1, 1},
                                                            {1, 1},
                                                            {1, 2},
                                                            {1, 2},
                                                            {1, 2},
                                                            {2, 2},
                                                            {2, 2},
                                                            {2, 2},
                                                            {2, 2}}};
  const auto [p_dimension, q_dimension] =
      kDimensions[static_cast<std::size_t>(pick(random, 0, std::ssize(kDimensions) - 1))];
  LatticePoint direction{};
  if (p_dimension >= 1 && q_dimension >= 1 && pick(random, 0, 2) != 0) {
    direction = flat_points(random, 2, {})[0];
  }
  LatticePair pair;
  pair.normal = {0, 0, 1};
  pair.p = make_upper_body(random, solids, p_dimension, direction);
  const LatticePoint turned_direction{direction[0], -direction[1], 0};
  pair.q = make_upper_body(random, solids, q_dimension, turned_direction);
  turn_down(pair.q);
  const std::string letters = "VEF";
  pair.family = std::string("resting ") + letters[static_cast<std::size_t>(p_dimension)] +
                letters[static_cast<std::size_t>(q_dimension)];
  pair.anchor = choose_anchor(random, support(pair.q, pair.normal));
  move(pair.p, lattice_add(pair.anchor, choose_anchor(random, support(pair.p, negated(pair.normal))), -1));
  if (pick(random, 0, 7) == 0) {
    LatticePoint aside = random_point(random, 5);
    aside[2] = 0;
    move(pair.p, aside);
    pair.family += " aside";
  }
  return pair;
}

LatticePair make_supported_pair(Random& random) {
  const LatticeSolid p = make_solid(random);
  const LatticeSolid q = make_solid(random);
  LatticePair pair{body_of(p), body_of(q), choose_direction(random, p, q), {}, "supported"};
  pair.anchor = choose_anchor(random, support(pair.q, pair.normal));
  move(pair.p, lattice_add(pair.anchor, choose_anchor(random, support(pair.p, negated(pair.normal))), -1));
  return pair;
}

LatticePair make_twin_pair(Random& random, bool solids) {
  LatticePair pair = make_grid_pair(random, solids);
  pair.family = "twin";
  pair.p = pair.q;
  const std::vector<LatticePoint> corners = pair.q.points;
  const LatticePoint to = choose_anchor(random, corners);
  pair.anchor = to;
  if (pick(random, 0, 1) == 0) {
    move(pair.p, lattice_add(to, choose_anchor(random, corners), -1));
    return pair;
  }
  // Mirrored in a point of itself; the triangles turn over.
  for (LatticePoint& point : pair.p.points) point = lattice_add(lattice_add(to, to), point, -1);
  for (auto& triangle : pair.p.triangles) std::swap(triangle[0], triangle[1]);
  return pair;
}

LatticePair make_grid_pair(Random& random, bool solids) {
  LatticePair pair;
  pair.family = "grid";
  for (LatticeBody* body : {&pair.p, &pair.q}) {
    if (solids) {
      *body = body_of(make_random_hull(random, 1));
      continue;
    }
    do {
      *body = {{random_point(random, 1), random_point(random, 1), random_point(random, 1)}, {{0, 1, 2}}};
    } while (collinear(body->points[0], body->points[1], body->points[2]));
  }
  if (solids) move(pair.p, random_point(random, 2));
  pair.anchor = pair.q.points[0];
  do {
    pair.normal = random_point(random, 1);
  } while (pair.normal == LatticePoint{});
  return pair;
}

}  // namespace ashlar::oracle
