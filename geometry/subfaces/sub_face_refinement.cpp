#include "geometry/subfaces/sub_face_refinement.hpp"

#include <algorithm>
#include <limits>

#include "geometry/index.hpp"

namespace ashlar {

AdaptiveSurface::AdaptiveSurface(const Polyhedron& solid, int order, int levels, const Eigen::Matrix3d& axes)
    : solid_(&solid),
      form_(&BernsteinForm::of_order(order)),
      axes_(axes),
      surface_(divide_surface(solid, levels)),
      forest_(surface_) {
  const std::vector<Vector3> places = form_->domain_points();
  const std::vector<Vector3>& points = forest_.points();
  for (int root = 0; root < forest_.root_count(); ++root) {
    const auto& [a, b, c] = forest_.nodes()[at(root)].corners;
    for (const Vector3& place : places)
      domain_points_.emplace_back(place[0] * points[at(a)] + place[1] * points[at(b)] +
                                  place[2] * points[at(c)]);
    leaves_.push_back(root);
  }
}

std::vector<BernsteinTriangle> AdaptiveSurface::root_patches(
    const Eigen::Ref<const Eigen::Matrix3Xd>& values) const {
  std::vector<BernsteinTriangle> patches;
  patches.reserve(at(forest_.root_count()));
  for (int root = 0; root < forest_.root_count(); ++root)
    patches.emplace_back(*form_, values.middleCols(root * form_->size(), form_->size()));
  return patches;
}

void AdaptiveSurface::move(const Eigen::Ref<const Eigen::Matrix3Xd>& values) {
  root_patches_ = root_patches(values);
  cell_shapes_.clear();  // those of the earlier shape are outdated
  box_ = Box{};
  for (const BernsteinTriangle& patch : root_patches_) box_.include(patch.box(axes_));
}

double AdaptiveSurface::motion_bound(const Eigen::Ref<const Eigen::Matrix3Xd>& before,
                                     const Eigen::Ref<const Eigen::Matrix3Xd>& after) const {
  double bound = 0.0;
  for (int root = 0; root < forest_.root_count(); ++root) {
    const auto columns = [&](const Eigen::Ref<const Eigen::Matrix3Xd>& values) {
      return BernsteinTriangle(*form_, values.middleCols(root * form_->size(), form_->size()));
    };
    bound = std::max(bound, columns(after).distance_bound(columns(before)));
  }
  return bound;
}

Eigen::RowVectorXd AdaptiveSurface::largest_values(const Eigen::MatrixXd& values) const {
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(values.cols());
  for (int root = 0; root < forest_.root_count(); ++root) {
    const Eigen::MatrixXd control =
        form_->interpolation() * values.middleRows(root * form_->size(), form_->size());
    largest = largest.cwiseMax(control.cwiseAbs().colwise().maxCoeff());
  }
  // Far above the rounding error of the control points.
  return 1.001 * largest;
}

bool AdaptiveSurface::divide(const DivisionDemand& demand) {
  forest_.set_patches(root_patches_);
  bool changed = false;
  if (!division_fits(demand)) {
    const auto paths = [&](const std::vector<int>& leaves) {
      std::vector<std::uint64_t> result;
      result.reserve(leaves.size());
      for (const int leaf : leaves) result.push_back(forest_.nodes()[at(leaf)].path);
      return result;
    };
    const auto before = paths(leaves_);
    divide_anew(demand);
    std::vector<int> leaves = forest_.leaves();
    changed = before != paths(leaves);
    if (changed) {
      take_leaves(std::move(leaves));
    } else {
      leaves_ = std::move(leaves);
    }
  }
  cell_shapes_.clear();
  for (const int leaf : leaves_)
    cell_shapes_.push_back(
        {forest_.patch(leaf).box(), bound_of(forest_.nodes()[at(leaf)], forest_.patch(leaf))});
  return changed;
}

const BernsteinTriangle& AdaptiveSurface::patch(int cell) const {
  return forest_.patch(leaves_[at(cell)]);
}

double AdaptiveSurface::chord_bound_in(const Eigen::Ref<const Eigen::Matrix3Xd>& values) const {
  const std::vector<BernsteinTriangle> patches = forest_.patches(root_patches(values));
  double bound = 0.0;
  for (const int leaf : leaves_)
    bound = std::max(bound, bound_of(forest_.nodes()[at(leaf)], patches[at(leaf)]));
  return bound;
}

double AdaptiveSurface::chord_bound() const {
  double bound = 0.0;
  for (const CellShape& shape : cell_shapes_) bound = std::max(bound, shape.chord_bound);
  return bound;
}

std::vector<std::uint64_t> AdaptiveSurface::wanted() const {
  std::vector<std::uint64_t> result;
  for (const SubFaceForest::Node& node : forest_.nodes()) {
    if (node.wanted) result.push_back(node.path);
  }
  std::sort(result.begin(), result.end());
  return result;
}

void AdaptiveSurface::restore(const SurfaceDivision& division) {
  forest_.cut_again(division.cuts);
  const std::set<std::uint64_t> wanted(division.wanted.begin(), division.wanted.end());
  for (int node = 0; node < static_cast<int>(forest_.nodes().size()); ++node)
    if (wanted.contains(forest_.nodes()[at(node)].path)) forest_.want(node);
  root_patches_.clear();
  cell_shapes_.clear();
  take_leaves(forest_.leaves());
}

double AdaptiveSurface::bound_of(const SubFaceForest::Node& node, const BernsteinTriangle& patch) {
  return patch.chord_bound({node.rim[0] >= 0, node.rim[1] >= 0, node.rim[2] >= 0});
}

bool AdaptiveSurface::needs_division(const SubFaceForest::Node& node, const BernsteinTriangle& patch,
                                     double tolerance, const DivisionDemand& demand) const {
  if (node.bisections >= SubFaceForest::max_bisections) return false;
  if (bound_of(node, patch) <= tolerance) return false;
  const Box box = patch.box(axes_);
  return std::any_of(demand.neighbours.begin(), demand.neighbours.end(),
                     [&](const Box& neighbour) { return neighbour.meets(box); });
}

/// True if the division may stay. Triangles divided for a neighbour that would now be divided by their own chord
/// error are marked, so that the set of wanted triangles depends on the shape alone.
bool AdaptiveSurface::division_fits(const DivisionDemand& demand) {
  bool fits = true;
  for (std::size_t n = 0; n < forest_.nodes().size(); ++n) {
    const SubFaceForest::Node& node = forest_.nodes()[n];
    const bool leaf = node.children[0] < 0;
    if (leaf && forest_.leaf_count() >= max_cells) continue;
    const double tolerance = node.wanted ? 0.5 * demand.chord_tolerance : demand.chord_tolerance;
    const bool needed = needs_division(node, forest_.patch(static_cast<int>(n)), tolerance, demand);
    if (leaf ? needed : node.wanted && !needed) fits = false;
    if (!leaf && needed) forest_.want(static_cast<int>(n));
  }
  return fits;
}

void AdaptiveSurface::divide_anew(const DivisionDemand& demand) {
  for (const SubFaceForest::Node& node : forest_.nodes()) {
    if (node.wanted) remembered_.insert(node.path);
  }
  forest_.join(root_patches_);
  // Coarse tolerances first, so that a division ended by its limit is even.
  double coarse = demand.chord_tolerance;
  for (int root = 0; root < forest_.root_count(); ++root) {
    while (needs_division(forest_.nodes()[at(root)], forest_.patch(root), 8.0 * coarse, demand))
      coarse *= 8.0;
  }
  while (coarse > demand.chord_tolerance) {
    divide_to(coarse, demand);
    coarse *= 0.125;
  }
  divide_to(demand.chord_tolerance, demand);
  remembered_.clear();
}

void AdaptiveSurface::divide_to(double tolerance, const DivisionDemand& demand) {
  // Cutting appends nodes, so that every node is visited once, after all earlier ones.
  for (int node = 0; node < static_cast<int>(forest_.nodes().size()) && forest_.leaf_count() < max_cells;
       ++node) {
    const bool before = remembered_.count(forest_.nodes()[at(node)].path) > 0;
    if (forest_.nodes()[at(node)].wanted) continue;
    if (!needs_division(forest_.nodes()[at(node)], forest_.patch(node), before ? 0.5 * tolerance : tolerance,
                        demand))
      continue;
    forest_.want(node);
    if (forest_.nodes()[at(node)].children[0] < 0) forest_.cut_with_neighbours(node);
  }
}

void AdaptiveSurface::take_leaves(std::vector<int> leaves) {
  leaves_ = std::move(leaves);
  std::vector<SurfaceCell> cells;
  for (const int leaf : leaves_) {
    const SubFaceForest::Node& node = forest_.nodes()[at(leaf)];
    cells.push_back({node.face,
                     {node.corners[0], node.corners[1], node.corners[2]},
                     {node.rim[0], node.rim[1], node.rim[2]}});
  }
  surface_ = surface_of_triangles(*solid_, forest_.points(), std::move(cells));
}

}  // namespace ashlar
