// A bolt in the blocks as placed: a straight bar, the pieces of it that are inside blocks, and the stations at which
// bar and grout are followed.
//
// The grout of a piece is divided into equal cells of at most an eighth of the transfer length 1/lambda,
// lambda = sqrt(k/EA), with a station in the middle of each; the error of the bar's force is then (lambda h)^2 / 8 =
// 0.2 %. A piece has at most 1000 cells. The bar is a spring between neighbouring stations, across joints too: its
// length there is half a cell on each side and the gap between the blocks.
//
// Along a straight line a block of order p moves as a polynomial of degree p: its motion at the p + 1 points of a piece
// gives that at all stations exactly.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/bolt/bolt_law.hpp"

namespace ashlar {

/// Part of the bar inside one block.
struct BoltSpan {
  int block;     ///< index, used by the solver only
  int order;     ///< >= 1, degree of the block's motion along a line
  double start;  ///< m from the bar's first end
  double end;    ///< m, > start for grouted bolts
};

/// A station: the middle of a cell of grout.
struct BoltStation {
  int piece;
  double place;   ///< m from the bar's first end
  double length;  ///< m, of its cell
};

/// Where the bar crosses from one piece into the next.
struct BoltCrossing {
  int piece;      ///< before; the next one is after
  double open;    ///< m, >= 0, between both
  bool dowelled;  ///< both are nearer than the bar is thick: it resists shear
};

/// Constant after construction.
class BoltShape {
 public:
  /// @param from,to ends of the bar, m
  /// @param spans in order along the bar, at least two. Ends: the blocks at both ends
  /// @param thickness of the bar, m
  BoltShape(const BoltLaw& law, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
            std::vector<BoltSpan> spans, double thickness);

  [[nodiscard]] const Eigen::Vector3d& from() const { return from_; }
  [[nodiscard]] const Eigen::Vector3d& direction() const { return direction_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const std::vector<BoltSpan>& pieces() const { return pieces_; }
  /// Points of a piece, m; the first and last are its ends. One point for each end of a bar anchored there.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& points(std::size_t piece) const { return points_[piece]; }
  /// First point of a piece among the points of all pieces.
  [[nodiscard]] int first_point(std::size_t piece) const { return first_points_[piece]; }
  [[nodiscard]] int point_count() const { return first_points_.back(); }
  [[nodiscard]] const std::vector<BoltStation>& stations() const { return stations_; }
  [[nodiscard]] const std::vector<BoltCrossing>& crossings() const { return crossings_; }
  /// Values of a station from those at all points. (#stations, #points)
  [[nodiscard]] const Eigen::MatrixXd& interpolation() const { return interpolation_; }
  /// A direction across the bar; with the bar's and their product a right-handed frame.
  [[nodiscard]] const Eigen::Vector3d& across() const { return across_; }

 private:
  void place_points(std::size_t piece, BoltAnchorage anchorage);
  void place_stations(std::size_t piece, double longest_cell);

  Eigen::Vector3d from_;
  Eigen::Vector3d direction_;
  Eigen::Vector3d across_;
  double length_;
  std::vector<BoltSpan> pieces_;
  std::vector<std::vector<Eigen::Vector3d>> points_;
  std::vector<int> first_points_;
  std::vector<BoltStation> stations_;
  std::vector<BoltCrossing> crossings_;
  Eigen::MatrixXd interpolation_;
};

}  // namespace ashlar
