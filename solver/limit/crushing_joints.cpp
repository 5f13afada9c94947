#include "solver/limit/crushing_joints.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Divisions of each triangle of an overlap at first.
constexpr int first_divisions = 2;
/// Share of the differences of both bounds that remains after a refinement.
constexpr double left_share = 0.1;
/// Parts added by a refinement, over those there are or at least a number, and parts of a model.
constexpr double most_added = 1.0;
constexpr std::size_t least_added = 2000, most_parts = 100000;

/// A triangle of a part.
struct Piece {
  std::array<Vector3, 3> corners;
  std::array<Eigen::Vector3d, 3> velocity = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                             Eigen::Vector3d::Zero()};
  double share = 1.0;  ///< of the area
};

/// Halves at the middle of the side opposite to a corner.
std::array<Piece, 2> halves(const Piece& piece, std::size_t corner) {
  const std::size_t a = (corner + 1) % 3, b = (corner + 2) % 3;
  std::array<Piece, 2> two = {piece, piece};
  two[0].corners[b] = two[1].corners[a] = 0.5 * (piece.corners[a] + piece.corners[b]);
  two[0].velocity[b] = two[1].velocity[a] = 0.5 * (piece.velocity[a] + piece.velocity[b]);
  two[0].share = two[1].share = 0.5 * piece.share;
  return two;
}

/// The corner opposite to the side with the largest value.
template <class Value>
std::size_t opposite_to_most(const Value& value) {
  std::array<double, 3> of_side{};
  for (std::size_t k = 0; k < 3; ++k) of_side[k] = value((k + 1) % 3, (k + 2) % 3);
  return static_cast<std::size_t>(std::max_element(of_side.begin(), of_side.end()) - of_side.begin());
}

std::size_t opposite_to_longest(const Piece& piece) {
  return opposite_to_most(
      [&](std::size_t a, std::size_t b) { return (piece.corners[a] - piece.corners[b]).squaredNorm(); });
}

double difference(const ConeStrength& strength, const Piece& piece) {
  double corners = 0.0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : piece.velocity) {
    corners += dissipation(strength, v) / 3.0;
    middle += v / 3.0;
  }
  return piece.share * std::max(0.0, corners - dissipation(strength, middle));
}

/// The corner opposite to the side along which (strength) bends most.
std::size_t opposite_to_bent(const ConeStrength& strength, const Piece& piece) {
  const auto bend = [&](std::size_t a, std::size_t b) {
    const Eigen::Vector3d middle = 0.5 * (piece.velocity[a] + piece.velocity[b]);
    return dissipation(strength, piece.velocity[a]) + dissipation(strength, piece.velocity[b]) -
           2.0 * dissipation(strength, middle);
  };
  return opposite_to_most(bend);
}

Vector3 centroid_of(const std::array<Vector3, 3>& corners) {
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

void put(RigidPoint& point, const Vector3& place, double area) {
  ContactPoint& contact = point.contact;
  for (Vector3* material : {&contact.material_a, &contact.material_b}) *material += place - contact.place_a;
  contact.place_a = contact.place_b = point.place = place;
  contact.area = point.area = area;
  point.friction_place = point.part->friction_place(place);
}

RigidPoint part_of(const RigidPoint& whole, const Piece& piece) {
  RigidPoint point = whole;
  point.part->corners = piece.corners;
  put(point, centroid_of(piece.corners), whole.area * piece.share);
  return point;
}

/// A piece that waits for its division.
struct Waiting {
  double difference;
  std::size_t point, number;
  bool operator<(const Waiting& other) const {
    return std::tie(difference, other.point, other.number) < std::tie(other.difference, point, number);
  }
};

/// Pieces of the parts of a model.
class Refinement {
 public:
  Refinement(const RigidModel& model, const std::vector<ConeStrength>& strength,
             const CornerVelocities& velocity)
      : strength_(strength), pieces_(model.points.size()) {
    for (std::size_t k = 0; k < model.points.size(); ++k) {
      if (!model.points[k].part) continue;
      add(k, Piece{model.points[k].part->corners, velocity[k], 1.0});
      ++parts_;
    }
  }

  /// @return false if nothing was divided
  bool run() {
    const double first = sum_;
    const auto most = std::min(
        most_parts, parts_ + std::max(least_added, static_cast<std::size_t>(most_added * double(parts_))));
    bool any = false;
    while (parts_ < most && !waiting_.empty() && sum_ > left_share * first &&
           waiting_.top().difference > 0.0) {
      const Waiting next = waiting_.top();
      waiting_.pop();
      const Piece piece = pieces_[next.point][next.number];
      const auto two = halves(piece, opposite_to_bent(strength_[next.point], piece));
      sum_ -= next.difference;
      pieces_[next.point][next.number] = two[0];
      wait(next.point, next.number);
      add(next.point, two[1]);
      ++parts_;
      any = true;
    }
    return any;
  }

  [[nodiscard]] const std::vector<Piece>& pieces(std::size_t point) const { return pieces_[point]; }

 private:
  void add(std::size_t point, const Piece& piece) {
    pieces_[point].push_back(piece);
    wait(point, pieces_[point].size() - 1);
  }
  void wait(std::size_t point, std::size_t number) {
    const double own = difference(strength_[point], pieces_[point][number]);
    sum_ += own;
    waiting_.push({own, point, number});
  }

  const std::vector<ConeStrength>& strength_;
  std::vector<std::vector<Piece>> pieces_;  ///< by point
  std::priority_queue<Waiting> waiting_;
  double sum_ = 0.0;
  std::size_t parts_ = 0;
};

/// Replaces points, in their order. @param made the new points of a point
template <class Made>
std::vector<std::size_t> replace_points(RigidModel& model, const Made& made) {
  std::vector<RigidPoint> points;
  std::vector<std::size_t> source;
  for (ConePair& pair : model.pairs) {
    const std::size_t begin = points.size();
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      for (RigidPoint& point : made(k)) points.push_back(std::move(point));
      source.resize(points.size(), k);
    }
    pair.begin = begin;
    pair.end = points.size();
  }
  model.points = std::move(points);
  return source;
}

}  // namespace

bool crushes(const RigidPoint& point) {
  return !point.bar && std::isfinite(point.law.compressive_strength);
}

bool has_parts(const RigidModel& model) {
  return std::any_of(model.points.begin(), model.points.end(),
                     [](const RigidPoint& point) { return point.part.has_value(); });
}

void divide_joints(RigidModel& model, const std::function<bool(const RigidPoint&)>& chosen) {
  std::set<PairKey> divided;
  std::vector<RigidPoint> left, parts;
  for (const RigidPoint& area : model.areas) {
    if (!chosen(area)) {
      left.push_back(area);
      continue;
    }
    divided.insert(key_of(area.blocks));
    std::vector<Piece> pieces = {Piece{area.part->corners}};
    for (int n = 0; n < first_divisions; ++n) {
      std::vector<Piece> smaller;
      for (const Piece& piece : pieces)
        for (const Piece& half : halves(piece, opposite_to_longest(piece))) smaller.push_back(half);
      pieces = std::move(smaller);
    }
    for (const Piece& piece : pieces) parts.push_back(part_of(area, piece));
  }
  if (divided.empty()) return;
  std::vector<RigidPoint> points;
  for (RigidPoint& point : model.points)
    if (point.bar || point.part || !divided.contains(key_of(point.blocks)))
      points.push_back(std::move(point));
  points.insert(points.end(), parts.begin(), parts.end());
  model.areas = std::move(left);
  set_points(model, std::move(points));
}

CornerModel corner_model(const RigidModel& divided) {
  using Key = std::tuple<PairKey, int, int, std::array<double, 3>>;
  CornerModel result;
  result.model = divided;
  result.model.areas.clear();
  result.corners.resize(divided.points.size());
  std::map<Key, std::size_t> known;
  std::vector<RigidPoint> points;
  for (ConePair& pair : result.model.pairs) {
    const std::size_t begin = points.size();
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      const RigidPoint& whole = divided.points[k];
      if (!whole.part) {
        result.corners[k].fill(points.size());
        points.push_back(whole);
        result.source.push_back(k);
        continue;
      }
      for (std::size_t n = 0; n < 3; ++n) {
        const Vector3& place = whole.part->corners[n];
        const Key key{key_of(whole.blocks),
                      whole.contact.face_a,
                      whole.contact.face_b,
                      {place.x(), place.y(), place.z()}};
        const auto [found, added] = known.try_emplace(key, points.size());
        result.corners[k][n] = found->second;
        if (added) {
          points.push_back(whole);
          put(points.back(), place, 0.0);
          points.back().part.reset();
          result.source.push_back(k);
        }
        points[found->second].area += whole.area / 3.0;
      }
    }
    pair.begin = begin;
    pair.end = points.size();
  }
  result.model.points = std::move(points);
  return result;
}

CornerVelocities corner_velocities(const CornerModel& corners, const ConeProgram& program,
                                   const std::vector<BodyVelocity>& velocity) {
  std::vector<Eigen::Vector3d> at_point(program.points().size());
  for (std::size_t n = 0; n < program.pairs().size(); ++n)
    for (std::size_t k = program.pairs()[n].begin; k < program.pairs()[n].end; ++k)
      at_point[k] = program.relative(n, k, velocity);
  CornerVelocities result(corners.corners.size());
  for (std::size_t k = 0; k < result.size(); ++k)
    for (std::size_t n = 0; n < 3; ++n) result[k][n] = at_point[corners.corners[k][n]];
  return result;
}

double dissipation(const ConeStrength& strength, const Eigen::Vector3d& velocity) {
  const double slip = velocity.tail<2>().norm();
  const double closing = strength.friction * slip - velocity[0];
  double normal = 0.0;
  if (closing > 0.0) normal = strength.compression * closing;
  if (closing < 0.0 && std::isfinite(strength.tension)) normal = -strength.tension * closing;
  return strength.cohesion * slip + normal;
}

double bound_difference(const RigidModel& divided, const std::vector<ConeStrength>& strength,
                        const CornerVelocities& velocity) {
  double sum = 0.0;
  for (std::size_t k = 0; k < divided.points.size(); ++k)
    if (divided.points[k].part)
      sum += difference(strength[k], Piece{divided.points[k].part->corners, velocity[k], 1.0});
  return sum;
}

std::vector<std::size_t> refine_parts(RigidModel& divided, const std::vector<ConeStrength>& strength,
                                      const CornerVelocities& velocity) {
  Refinement refinement(divided, strength, velocity);
  if (!refinement.run()) return {};
  return replace_points(divided, [&](std::size_t k) {
    std::vector<RigidPoint> points;
    if (!divided.points[k].part) points.push_back(divided.points[k]);
    for (const Piece& piece : refinement.pieces(k)) points.push_back(part_of(divided.points[k], piece));
    return points;
  });
}

std::vector<ConeStrength> strengths_of(const ConeProgram& program) {
  std::vector<ConeStrength> strength;
  strength.reserve(program.points().size());
  for (const ConePoint& point : program.points()) strength.push_back(point.strength);
  return strength;
}

}  // namespace ashlar
