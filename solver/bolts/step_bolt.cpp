#include "solver/bolts/step_bolt.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "solver/bolts/bolted_blocks.hpp"

namespace ashlar {
namespace {

using Eigen::Index;

/// Rounding errors of a coordinate of a point: larger values accept larger residuals of bolts.
constexpr double operations_of_coordinate = 4.0;
/// Turn of the rows in a step from which on they are evaluated again, rad: a smaller one turns forces by rounding only.
constexpr double least_turn_of_rows = 1e-8;

/// The points as placed, in blocks that are not deformed.
BoltPlaces as_placed(const BoltShape& shape) {
  BoltPlaces places{Eigen::Matrix3Xd(3, shape.point_count()),
                    std::vector<Eigen::Matrix3d>(shape.pieces().size(), Eigen::Matrix3d::Identity())};
  for (std::size_t k = 0; k < shape.pieces().size(); ++k)
    for (std::size_t j = 0; j < shape.points(k).size(); ++j)
      places.points.col(shape.first_point(k) + static_cast<int>(j)) = shape.points(k)[j];
  return places;
}

Eigen::Matrix3d mean_gradient(const BlockModel& block, const Eigen::MatrixX3d& position) {
  return block.fixed() ? Eigen::Matrix3d::Identity()
                       : Eigen::Matrix3d(position.transpose() * block.parts()->mean_gradients);
}

}  // namespace

StepBolt::StepBolt(const Bolt& bolt, int index, const std::vector<BlockModel>& blocks,
                   const std::vector<BlockState>& states, const BoltMemory& memory)
    : bolt_(&bolt),
      index_(index),
      memory_(&memory),
      blocks_(present_blocks(bolt.chain)),
      absent_(as_placed(bolt.chain.shape())) {
  const BoltShape& shape = bolt.chain.shape();
  for (const int block : blocks_) {
    Part part{&blocks[at(block)], {}, {}, {}};
    std::vector<Vector3> places;
    for (std::size_t k = 0; k < shape.pieces().size(); ++k) {
      if (shape.pieces()[k].block != block) continue;
      for (std::size_t j = 0; j < shape.points(k).size(); ++j) {
        part.points.push_back(shape.first_point(k) + static_cast<int>(j));
        places.push_back(shape.points(k)[j]);
      }
    }
    part.values = part.model->basis().values(places);
    if (!part.model->fixed()) {
      for (int axis = 0; axis < 3; ++axis)
        part.along[at(axis)] = part.model->space().component_values(part.values, axis);
    }
    parts_.push_back(std::move(part));
  }
  const BoltPlaces start = places_at([&](int block) { return states[at(block)].position; });
  size_ = start.points.cwiseAbs().maxCoeff();
  set_rows(start);
  start_deformation_ = known_ = bolt_deformation(shape, start);
  start_ = bolt.chain.respond(start_deformation_, memory, false);
}

BoltPlaces StepBolt::places_at(const PositionOfBlock& position) const {
  BoltPlaces places = absent_;
  const BoltShape& shape = bolt_->chain.shape();
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    const Part& part = parts_[n];
    const Eigen::MatrixX3d at_block = position(blocks_[n]);
    const Eigen::MatrixX3d points = part.values * at_block;
    for (std::size_t j = 0; j < part.points.size(); ++j)
      places.points.col(part.points[j]) = points.row(static_cast<Index>(j)).transpose();
    const Eigen::Matrix3d gradient = mean_gradient(*part.model, at_block);
    for (std::size_t k = 0; k < shape.pieces().size(); ++k)
      if (shape.pieces()[k].block == blocks_[n]) places.gradients[k] = gradient;
  }
  return places;
}

void StepBolt::set_rows(const BoltPlaces& places) {
  to_points_ = bolt_rows(bolt_->chain.shape(), places);
  rows_.resize(parts_.size());
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    const Part& part = parts_[n];
    rows_[n].setZero(to_points_.rows(), part.model->unknowns());
    if (part.model->fixed()) continue;
    Index first = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::MatrixXd& along = part.along[at(axis)];
      for (std::size_t j = 0; j < part.points.size(); ++j) {
        rows_[n].middleCols(first, along.cols()) +=
            to_points_.col(3 * part.points[j] + axis) * along.row(static_cast<Index>(j));
      }
      first += along.cols();
    }
  }
}

void StepBolt::prescribe(const PositionOfBlock& change) {
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, bolt_->chain.shape().point_count());
  bool any = false;
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    const Eigen::MatrixX3d of_block = change(blocks_[n]);
    if (of_block.rows() == 0) continue;
    any = true;
    const Eigen::MatrixX3d points = parts_[n].values * of_block;
    for (std::size_t j = 0; j < parts_[n].points.size(); ++j)
      moved.col(parts_[n].points[j]) = points.row(static_cast<Index>(j)).transpose();
  }
  if (!any) return;
  prescribed_points_ = std::move(moved);
  prescribed_ = to_points_ * prescribed_points_.reshaped();
  known_ = start_deformation_ + prescribed_;
}

Eigen::VectorXd StepBolt::motion(const std::vector<const Eigen::VectorXd*>& changes) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(known_.size());
  for (std::size_t n = 0; n < rows_.size(); ++n)
    if (rows_[n].cols() > 0 && changes[n]->size() > 0) sum += rows_[n] * *changes[n];
  return sum;
}

Eigen::VectorXd StepBolt::deformation(const std::vector<const Eigen::VectorXd*>& changes) const {
  return known_ + motion(changes);
}

Eigen::VectorXd StepBolt::force(const Eigen::VectorXd& deformation, bool averaged) const {
  Eigen::VectorXd force = bolt_->chain.respond(deformation, *memory_, false).force;
  if (averaged) force = 0.5 * (force + start_.force);
  return force;
}

void StepBolt::respond(const std::vector<const Eigen::VectorXd*>& changes, bool averaged,
                       StepBoltResponse& response) const {
  response.deformation = deformation(changes);
  response.end = bolt_->chain.respond(response.deformation, *memory_);
  response.force = response.end.force;
  response.tangent = std::move(response.end.tangent);
  if (averaged) {
    response.force = 0.5 * (response.force + start_.force);
    response.tangent *= 0.5;
  }
  response.on_blocks.resize(rows_.size());
  for (std::size_t n = 0; n < rows_.size(); ++n)
    response.on_blocks[n] = -(rows_[n].transpose() * response.force);
}

double StepBolt::force_rounding(const StepBoltResponse& response) const {
  double longest = 0.0;
  for (const Eigen::MatrixXd& rows : rows_)
    if (rows.cols() > 0) longest = std::max(longest, rows.rowwise().norm().maxCoeff());
  return operations_of_coordinate * std::numeric_limits<double>::epsilon() * size_ * response.tangent.norm() *
         longest;
}

bool StepBolt::needs_following(const PositionOfBlock& middle, const PositionOfBlock& end,
                               const std::vector<const Eigen::VectorXd*>& changes, double tolerance) const {
  const BoltShape& shape = bolt_->chain.shape();
  const double error = (bolt_deformation(shape, places_at(end)) - deformation(changes)).cwiseAbs().maxCoeff();
  return error > tolerance ||
         (bolt_rows(shape, places_at(middle)) - to_points_).cwiseAbs().maxCoeff() > least_turn_of_rows;
}

void StepBolt::follow(const PositionOfBlock& middle, const PositionOfBlock& end,
                      const std::vector<const Eigen::VectorXd*>& changes) {
  set_rows(places_at(middle));
  if (prescribed_.size() > 0) prescribed_ = to_points_ * prescribed_points_.reshaped();
  known_ = bolt_deformation(bolt_->chain.shape(), places_at(end)) - motion(changes);
}

double StepBolt::work(const StepBoltResponse& response,
                      const std::vector<const Eigen::VectorXd*>& changes) const {
  return prescribed_work(response) - response.force.dot(motion(changes));
}

double StepBolt::prescribed_work(const StepBoltResponse& response) const {
  return prescribed_.size() > 0 ? -response.force.dot(prescribed_) : 0.0;
}

std::vector<StepBolt> step_bolts(const std::vector<Bolt>& bolts, const std::vector<BoltState>& bolt_states,
                                 const std::vector<BlockModel>& blocks, const std::vector<BlockState>& states,
                                 const std::vector<bool>& moving) {
  std::vector<StepBolt> result;
  for (std::size_t k = 0; k < bolts.size(); ++k) {
    if (!bolt_states[k].installed()) continue;
    const std::vector<int> held = present_blocks(bolts[k].chain);
    if (std::any_of(held.begin(), held.end(), [&](int block) { return moving[at(block)]; }))
      result.emplace_back(bolts[k], static_cast<int>(k), blocks, states, bolt_states[k].memory);
  }
  return result;
}

Eigen::Matrix3Xd points_in(const Bolt& bolt, const std::vector<BlockModel>& blocks,
                           const std::vector<BlockState>& states) {
  const BoltShape& shape = bolt.chain.shape();
  Eigen::Matrix3Xd points = as_placed(shape).points;
  for (std::size_t k = 0; k < shape.pieces().size(); ++k) {
    if (!bolt.chain.present(k)) continue;
    const int block = shape.pieces()[k].block;
    const Eigen::MatrixX3d places =
        blocks[at(block)].basis().values(shape.points(k)) * states[at(block)].position;
    points.middleCols(shape.first_point(k), places.rows()) = places.transpose();
  }
  return points;
}

Eigen::VectorXd deformation_in(const Bolt& bolt, const std::vector<BlockModel>& blocks,
                               const std::vector<BlockState>& states) {
  const BoltShape& shape = bolt.chain.shape();
  BoltPlaces places = as_placed(shape);
  places.points = points_in(bolt, blocks, states);
  for (std::size_t k = 0; k < shape.pieces().size(); ++k) {
    const int block = shape.pieces()[k].block;
    if (bolt.chain.present(k))
      places.gradients[k] = mean_gradient(blocks[at(block)], states[at(block)].position);
  }
  return bolt_deformation(shape, places);
}

}  // namespace ashlar
