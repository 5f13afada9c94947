#include "mechanics/block/block_surface.hpp"

namespace ashlar {
namespace {

Eigen::MatrixXd values_at_middles(const BlockModel& model, const SubFaceSurface& surface) {
  std::vector<Vector3> middles;
  middles.reserve(surface.edges.size());
  for (const SurfaceEdge& edge : surface.edges) {
    middles.emplace_back(0.5 * (surface.points[static_cast<std::size_t>(edge.ends[0])] +
                                surface.points[static_cast<std::size_t>(edge.ends[1])]));
  }
  return model.basis().values(middles);
}

/// Current positions of points. @param phi values of the functions there, (#, p)
std::vector<Vector3> placed_points(const Eigen::MatrixXd& phi, const BlockState& state) {
  const Eigen::MatrixX3d places = phi * state.position;
  std::vector<Vector3> points;
  points.reserve(static_cast<std::size_t>(places.rows()));
  for (Eigen::Index k = 0; k < places.rows(); ++k) points.emplace_back(places.row(k));
  return points;
}

}  // namespace

BlockSurface::BlockSurface(const BlockModel& model, int levels, const Eigen::Matrix3d& axes,
                           const BlockSurface* twin)
    : model_(&model), axes_(axes) {
  if (model.incremental() != nullptr) {
    whole_ = model.incremental()->surface();
    start_step();
  } else if (model.order() >= 2 && !model.fixed()) {
    adaptive_.emplace(model.solid(), model.order(), levels, axes);
    domain_phi_ =
        twin != nullptr
            ? twin->domain_phi_
            : std::make_shared<const Eigen::MatrixXd>(model.basis().values(adaptive_->domain_points()));
    take_division();
    largest_phi_ = twin != nullptr ? twin->largest_phi_ : adaptive_->largest_values(*domain_phi_);
  } else {
    whole_ = whole_surface(model.solid());
    point_phi_ = model.basis().values(whole_.points);
    largest_phi_ = point_phi_.cwiseAbs().colwise().maxCoeff();
  }
}

void BlockSurface::start_step() {
  whole_.points = model_->carried().points;
  point_phi_ = model_->basis().values(whole_.points);
  largest_phi_ = point_phi_.cwiseAbs().colwise().maxCoeff();
}

const SubFaceSurface& BlockSurface::surface() const {
  return adaptive_ ? adaptive_->surface() : whole_;
}

Eigen::Matrix3Xd BlockSurface::domain_values(const BlockState& state) const {
  return (*domain_phi_ * state.position).transpose();
}

std::vector<Vector3> BlockSurface::points(const BlockState& state) const {
  return placed_points(point_phi_, state);
}

std::vector<Vector3> BlockSurface::edge_middles(const BlockState& state) const {
  return adaptive_ ? placed_points(middle_phi_, state) : std::vector<Vector3>{};
}

void BlockSurface::move(const BlockState& state) {
  state_ = state;
  if (adaptive_) {
    adaptive_->move(domain_values(state));
    box_ = adaptive_->box();
  }
  points_ = points(state);
  if (!adaptive_) box_ = box_along(axes_, points_);
}

double BlockSurface::motion_bound(const BlockState& before, const BlockState& after) const {
  if (adaptive_) return adaptive_->motion_bound(domain_values(before), domain_values(after));
  return std::sqrt((point_phi_ * (after.position - before.position)).rowwise().squaredNorm().maxCoeff());
}

double BlockSurface::bulge(const BlockState& state) const {
  return adaptive_ ? adaptive_->chord_bound_in(domain_values(state)) : 0.0;
}

double BlockSurface::quick_motion_bound(const Eigen::MatrixX3d& change) const {
  return largest_phi_ * change.rowwise().norm();
}

double BlockSurface::largest_speed(const BlockState& state) const {
  const Eigen::MatrixXd& phi = adaptive_ ? *domain_phi_ : point_phi_;
  return std::sqrt((phi * state.velocity).rowwise().squaredNorm().maxCoeff());
}

bool BlockSurface::divide(const DivisionDemand& demand) {
  if (!adaptive_ || !adaptive_->divide(demand)) return false;
  take_division();
  points_ = points(state_);
  return true;
}

PlacedSurface BlockSurface::placed() const {
  if (!adaptive_) return {whole_, points_};
  return {adaptive_->surface(), points_, adaptive_->cell_shapes()};
}

std::vector<std::uint64_t> BlockSurface::wanted() const {
  return adaptive_ ? adaptive_->wanted() : std::vector<std::uint64_t>{};
}

SurfaceDivision BlockSurface::division() const {
  return adaptive_ ? adaptive_->division() : SurfaceDivision{};
}

void BlockSurface::restore(const SurfaceDivision& division) {
  if (!adaptive_) return;
  adaptive_->restore(division);
  take_division();
}

/// Evaluates the functions at the present points and edges of the adaptive surface.
void BlockSurface::take_division() {
  point_phi_ = model_->basis().values(adaptive_->surface().points);
  middle_phi_ = values_at_middles(*model_, adaptive_->surface());
}

}  // namespace ashlar
