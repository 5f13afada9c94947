#include "mechanics/bolt/bolt_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

constexpr double cells_per_transfer_length = 8.0;
constexpr int fewest_cells = 2;  // of a piece
constexpr int most_cells = 1000;

/// Places 0 to 1, ends included, at which a polynomial of this degree is interpolated well.
std::vector<double> lobatto_places(int order) {
  std::vector<double> places;
  for (int j = 0; j <= order; ++j)
    places.push_back(0.5 - 0.5 * correctly_rounded::cos(std::numbers::pi * j / order));
  return places;
}

/// Values at `x` of the polynomials that are 1 at one place and 0 at the others.
Eigen::RowVectorXd lagrange_values(const std::vector<double>& places, double x) {
  Eigen::RowVectorXd values = Eigen::RowVectorXd::Ones(static_cast<Eigen::Index>(places.size()));
  for (std::size_t j = 0; j < places.size(); ++j)
    for (std::size_t k = 0; k < places.size(); ++k)
      if (k != j) values[static_cast<Eigen::Index>(j)] *= (x - places[k]) / (places[j] - places[k]);
  return values;
}

}  // namespace

BoltShape::BoltShape(const BoltLaw& law, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                     std::vector<BoltSpan> spans, double thickness)
    : from_(from),
      direction_((to - from).normalized()),
      length_((to - from).norm()),
      pieces_(std::move(spans)) {
  across_ = direction_.unitOrthogonal();
  first_points_.push_back(0);
  for (std::size_t k = 0; k < pieces_.size(); ++k) place_points(k, law.anchorage);
  if (law.anchorage == BoltAnchorage::ends) return;
  const double transfer = std::sqrt(law.axial_stiffness / law.bond_stiffness);
  for (std::size_t k = 0; k < pieces_.size(); ++k) place_stations(k, transfer / cells_per_transfer_length);
  for (std::size_t k = 0; k + 1 < pieces_.size(); ++k) {
    const double open = std::max(0.0, pieces_[k + 1].start - pieces_[k].end);
    crossings_.push_back({static_cast<int>(k), open, law.shear_stiffness > 0.0 && open <= thickness});
  }
  interpolation_.setZero(static_cast<Eigen::Index>(stations_.size()), point_count());
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const BoltSpan& piece = pieces_[static_cast<std::size_t>(stations_[i].piece)];
    interpolation_.block(static_cast<Eigen::Index>(i),
                         first_points_[static_cast<std::size_t>(stations_[i].piece)], 1, piece.order + 1) =
        lagrange_values(lobatto_places(piece.order),
                        (stations_[i].place - piece.start) / (piece.end - piece.start));
  }
}

void BoltShape::place_points(std::size_t piece, BoltAnchorage anchorage) {
  const BoltSpan& span = pieces_[piece];
  std::vector<Eigen::Vector3d>& points = points_.emplace_back();
  if (anchorage == BoltAnchorage::ends) {
    points.emplace_back(from_ + (piece == 0 ? 0.0 : length_) * direction_);
  } else {
    for (const double share : lobatto_places(span.order))
      points.emplace_back(from_ + (span.start + share * (span.end - span.start)) * direction_);
  }
  first_points_.push_back(first_points_.back() + static_cast<int>(points.size()));
}

void BoltShape::place_stations(std::size_t piece, double longest_cell) {
  const BoltSpan& span = pieces_[piece];
  const double length = span.end - span.start;
  const double needed = std::ceil(length / longest_cell);
  const int cells = needed < most_cells ? std::max(fewest_cells, static_cast<int>(needed)) : most_cells;
  for (int i = 0; i < cells; ++i)
    stations_.push_back({static_cast<int>(piece), span.start + (i + 0.5) * length / cells, length / cells});
}

}  // namespace ashlar
