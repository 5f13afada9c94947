#include "mechanics/bolt/bolt_kinematics.hpp"

#include <array>
#include <cmath>

namespace ashlar {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

bool anchored_at_ends(const BoltShape& shape) {
  return shape.stations().empty();
}

/// Piece of a grouted bolt in some places.
struct Piece {
  Index first;  ///< point
  Index last;
  Vector3d direction;
  double length;  ///< m, of its chord
};

Piece piece_at(const BoltShape& shape, const BoltPlaces& places, std::size_t k) {
  const Index first = shape.first_point(k);
  const Index last = shape.first_point(k + 1) - 1;
  const Vector3d chord = places.points.col(last) - places.points.col(first);
  const double length = chord.norm();
  return {first, last, chord / length, length};
}

/// The frame of a crossing. Where the bar is folded back, t is the direction of the piece before.
struct Crossing {
  Piece before;
  Piece after;
  Vector3d gap;  ///< g, m
  Vector3d t;
  Vector3d n_1;
  Vector3d n_2;
  double sum;   ///< |t_a + t_b|; 0: folded back
  double lean;  ///< tangent of the angle between the direction carried along and the plane across t
};

Crossing crossing_at(const BoltShape& shape, const BoltPlaces& places, std::size_t k) {
  Crossing crossing;
  crossing.before = piece_at(shape, places, k);
  crossing.after = piece_at(shape, places, k + 1);
  crossing.gap = places.points.col(crossing.after.first) - places.points.col(crossing.before.last);
  const Vector3d sum = crossing.before.direction + crossing.after.direction;
  crossing.sum = sum.norm();
  crossing.t = crossing.sum > 0.0 ? Vector3d(sum / crossing.sum) : crossing.before.direction;
  const Vector3d carried = places.gradients[k] * shape.across();
  const Vector3d across = carried - carried.dot(crossing.t) * crossing.t;
  crossing.lean = carried.dot(crossing.t) / across.norm();
  crossing.n_1 = across.normalized();
  crossing.n_2 = crossing.t.cross(crossing.n_1);
  return crossing;
}

/// Adds the row of  vector . d(point).
void add(Eigen::MatrixXd& rows, Index row, Index point, const Vector3d& vector) {
  rows.block<1, 3>(row, 3 * point) += vector.transpose();
}

/// Adds the row of  vector . dt,  dt = (I - t t') (dt_a + dt_b) / sum,  dt_k = (I - t_k t_k') d(chord) / length.
void add_turn(Eigen::MatrixXd& rows, Index row, const Crossing& crossing, const Vector3d& vector) {
  if (crossing.sum == 0.0) return;
  const Vector3d across = (vector - vector.dot(crossing.t) * crossing.t) / crossing.sum;
  for (const Piece& piece : {crossing.before, crossing.after}) {
    const Vector3d part = (across - across.dot(piece.direction) * piece.direction) / piece.length;
    add(rows, row, piece.last, part);
    add(rows, row, piece.first, -part);
  }
}

}  // namespace

int deformation_count(const BoltShape& shape) {
  if (anchored_at_ends(shape)) return 1;
  int count = shape.point_count();
  for (const BoltCrossing& crossing : shape.crossings()) count += crossing.dowelled ? 2 : 0;
  return count;
}

Eigen::VectorXd bolt_deformation(const BoltShape& shape, const BoltPlaces& places) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(deformation_count(shape));
  if (anchored_at_ends(shape)) {
    result[0] = (places.points.col(1) - places.points.col(0)).norm() - shape.length();
    return result;
  }
  Index dowel = shape.point_count();
  double start = 0.0;
  for (std::size_t k = 0; k < shape.pieces().size(); ++k) {
    const Piece piece = piece_at(shape, places, k);
    if (k > 0) {
      const Crossing crossing = crossing_at(shape, places, k - 1);
      start += crossing.t.dot(crossing.gap) - (shape.pieces()[k].start - shape.pieces()[k - 1].end);
      if (shape.crossings()[k - 1].dowelled) {
        result[dowel++] = crossing.n_1.dot(crossing.gap);
        result[dowel++] = crossing.n_2.dot(crossing.gap);
      }
    }
    for (Index point = piece.first; point <= piece.last; ++point) {
      const Vector3d as_placed =
          shape.points(k)[static_cast<std::size_t>(point - piece.first)] - shape.points(k).front();
      result[point] = start + piece.direction.dot(places.points.col(point) - places.points.col(piece.first)) -
                      as_placed.dot(shape.direction());
    }
    start = result[piece.last];
  }
  return result;
}

Eigen::MatrixXd bolt_rows(const BoltShape& shape, const BoltPlaces& places) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(deformation_count(shape), 3 * shape.point_count());
  if (anchored_at_ends(shape)) {
    const Vector3d direction = (places.points.col(1) - places.points.col(0)).normalized();
    add(rows, 0, 0, -direction);
    add(rows, 0, 1, direction);
    return rows;
  }
  Index dowel = shape.point_count();
  for (std::size_t k = 0; k < shape.pieces().size(); ++k) {
    const Piece piece = piece_at(shape, places, k);
    if (k > 0) {
      const Crossing crossing = crossing_at(shape, places, k - 1);
      rows.row(piece.first) = rows.row(crossing.before.last);
      add(rows, piece.first, crossing.before.last, -crossing.t);
      add(rows, piece.first, piece.first, crossing.t);
      add_turn(rows, piece.first, crossing, crossing.gap);
      if (shape.crossings()[k - 1].dowelled) {
        // dn_1 = -t (n_1 . dt) - lean n_2 (n_2 . dt),  dn_2 = -t (n_2 . dt) + lean n_1 (n_2 . dt)
        const double along = crossing.t.dot(crossing.gap);
        const Vector3d lean = crossing.lean * crossing.n_2;
        const std::array<Vector3d, 2> turns = {-along * crossing.n_1 - crossing.n_2.dot(crossing.gap) * lean,
                                               -along * crossing.n_2 + crossing.n_1.dot(crossing.gap) * lean};
        for (const std::size_t axis : {0U, 1U}) {
          const Vector3d& n = axis == 0 ? crossing.n_1 : crossing.n_2;
          add(rows, dowel, crossing.before.last, -n);
          add(rows, dowel, piece.first, n);
          add_turn(rows, dowel, crossing, turns[axis]);
          ++dowel;
        }
      }
    }
    for (Index point = piece.first + 1; point <= piece.last; ++point) {
      rows.row(point) = rows.row(piece.first);
      add(rows, point, piece.first, -piece.direction);
      add(rows, point, point, piece.direction);
    }
  }
  return rows;
}

}  // namespace ashlar
