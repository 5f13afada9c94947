#include "geometry/subfaces/sub_face_refinement.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// A node's path: the number of its root, and below that a heap index: 1 for the root, 2 k and 2 k + 1 for
/// the halves of k.
constexpr int path_bits = AdaptiveSurface::max_bisections + 1;

std::array<int, 2> sorted(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

AdaptiveSurface::AdaptiveSurface(const Polyhedron& solid, int order, int levels, const Eigen::Matrix3d& axes)
    : solid_(&solid),
      form_(&BernsteinForm::of_order(order)),
      axes_(axes),
      surface_(divide_surface(solid, levels)) {
  points_ = surface_.points;
  root_points_ = points_.size();
  const std::vector<Vector3> places = form_->domain_points();
  for (const SurfaceCell& cell : surface_.cells) {
    const std::array<int, 3> corners = {cell.corners[0], cell.corners[1], cell.corners[2]};
    const std::uint64_t path = (static_cast<std::uint64_t>(root_count_) << path_bits) | 1U;
    nodes_.push_back(make_node(cell.face, corners, {cell.rim[0], cell.rim[1], cell.rim[2]}, path, 0));
    for (const Vector3& place : places) {
      domain_points_.emplace_back(place[0] * points_[at(corners[0])] + place[1] * points_[at(corners[1])] +
                                  place[2] * points_[at(corners[2])]);
    }
    leaves_.push_back(root_count_++);
  }
  leaf_count_ = root_count_;
}

/// The longest side is compared as (length, ends), the same from both sides of it: a total order, so that
/// cutting longer sides of neighbours first comes to an end. In single precision lengths that are equal but
/// for rounding, as half the diagonals of a rectangle in a turned scene, are equal.
AdaptiveSurface::Node AdaptiveSurface::make_node(int face, const std::array<int, 3>& corners,
                                                 const std::array<int, 3>& rim, std::uint64_t path,
                                                 int bisections) const {
  Node node{face, corners, rim, path, {-1, -1}, 0, bisections, false};
  std::tuple<float, std::array<int, 2>> best{-1.0F, {}};
  for (int side = 0; side < 3; ++side) {
    const std::array<int, 2> ends = sorted(corners[at(side)], corners[at((side + 1) % 3)]);
    const std::tuple length{static_cast<float>((points_[at(ends[1])] - points_[at(ends[0])]).norm()), ends};
    if (length <= best) continue;
    best = length;
    node.longest = side;
  }
  return node;
}

std::vector<BernsteinTriangle> AdaptiveSurface::root_patches(
    const Eigen::Ref<const Eigen::Matrix3Xd>& values) const {
  std::vector<BernsteinTriangle> patches;
  patches.reserve(at(root_count_));
  for (int root = 0; root < root_count_; ++root)
    patches.emplace_back(*form_, values.middleCols(root * form_->size(), form_->size()));
  return patches;
}

void AdaptiveSurface::move(const Eigen::Ref<const Eigen::Matrix3Xd>& values) {
  root_patches_ = root_patches(values);
  cell_shapes_.clear();  // those of the shape before would be in the wrong place
  box_ = Box{};
  for (const BernsteinTriangle& patch : root_patches_) box_.include(patch.box(axes_));
}

double AdaptiveSurface::motion_bound(const Eigen::Ref<const Eigen::Matrix3Xd>& before,
                                     const Eigen::Ref<const Eigen::Matrix3Xd>& after) const {
  double bound = 0.0;
  for (int root = 0; root < root_count_; ++root) {
    const auto columns = [&](const Eigen::Ref<const Eigen::Matrix3Xd>& values) {
      return BernsteinTriangle(*form_, values.middleCols(root * form_->size(), form_->size()));
    };
    bound = std::max(bound, columns(after).distance_bound(columns(before)));
  }
  return bound;
}

Eigen::RowVectorXd AdaptiveSurface::largest_values(const Eigen::MatrixXd& values) const {
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(values.cols());
  for (int root = 0; root < root_count_; ++root) {
    const Eigen::MatrixXd control =
        form_->interpolation() * values.middleRows(root * form_->size(), form_->size());
    largest = largest.cwiseMax(control.cwiseAbs().colwise().maxCoeff());
  }
  // Far more than the rounding of the control points.
  return 1.001 * largest;
}

bool AdaptiveSurface::divide(const DivisionDemand& demand) {
  patches_ = placed_patches(root_patches_);
  bool changed = false;
  if (!division_fits(demand)) {
    const auto paths = [&](const std::vector<int>& leaves) {
      std::vector<std::uint64_t> result;
      result.reserve(leaves.size());
      for (const int leaf : leaves) result.push_back(nodes_[at(leaf)].path);
      return result;
    };
    const auto before = paths(leaves_);
    divide_anew(demand);
    std::vector<int> leaves = list_leaves();
    changed = before != paths(leaves);
    if (changed) {
      take_leaves(std::move(leaves));
    } else {
      leaves_ = std::move(leaves);
    }
  }
  cell_shapes_.clear();
  for (const int leaf : leaves_)
    cell_shapes_.push_back({patches_[at(leaf)].box(), bound_of(nodes_[at(leaf)], patches_[at(leaf)])});
  return changed;
}

const BernsteinTriangle& AdaptiveSurface::patch(int cell) const {
  return patches_[at(leaves_[at(cell)])];
}

double AdaptiveSurface::chord_bound_in(const Eigen::Ref<const Eigen::Matrix3Xd>& values) const {
  const std::vector<BernsteinTriangle> patches = placed_patches(root_patches(values));
  double bound = 0.0;
  for (const int leaf : leaves_) bound = std::max(bound, bound_of(nodes_[at(leaf)], patches[at(leaf)]));
  return bound;
}

double AdaptiveSurface::chord_bound() const {
  double bound = 0.0;
  for (const CellShape& shape : cell_shapes_) bound = std::max(bound, shape.chord_bound);
  return bound;
}

std::vector<std::uint64_t> AdaptiveSurface::wanted() const {
  // What was set counts until it has been used.
  std::set<std::uint64_t> result = remembered_;
  for (const Node& node : nodes_) {
    if (node.wanted) result.insert(node.path);
  }
  return {result.begin(), result.end()};
}

double AdaptiveSurface::bound_of(const Node& node, const BernsteinTriangle& patch) {
  return patch.chord_bound({node.rim[0] >= 0, node.rim[1] >= 0, node.rim[2] >= 0});
}

/// Patches of all nodes from those of the roots: parents come before their children.
std::vector<BernsteinTriangle> AdaptiveSurface::placed_patches(
    const std::vector<BernsteinTriangle>& of_roots) const {
  std::vector<BernsteinTriangle> patches = of_roots;
  patches.resize(nodes_.size(), of_roots.front());
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].children[0] < 0) continue;
    auto halves = patches[n].halves(nodes_[n].longest);
    for (std::size_t k = 0; k < 2; ++k) patches[at(nodes_[n].children[k])] = std::move(halves[k]);
  }
  return patches;
}

bool AdaptiveSurface::needs_division(const Node& node, const BernsteinTriangle& patch, double tolerance,
                                     const DivisionDemand& demand) const {
  if (node.bisections >= max_bisections) return false;
  if (bound_of(node, patch) <= tolerance) return false;
  const Box box = patch.box(axes_);
  return std::any_of(demand.neighbours.begin(), demand.neighbours.end(),
                     [&](const Box& neighbour) { return neighbour.meets(box); });
}

/// Whether the division may stay. Triangles that were cut for a neighbour and now would be for their own sake
/// are noted as such, so that what is wanted follows from the shape alone.
bool AdaptiveSurface::division_fits(const DivisionDemand& demand) {
  bool fits = remembered_.empty();
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    const bool leaf = node.children[0] < 0;
    if (leaf && leaf_count_ >= max_cells) continue;
    const double tolerance = node.wanted ? 0.5 * demand.chord_tolerance : demand.chord_tolerance;
    const bool needed = needs_division(node, patches_[n], tolerance, demand);
    if (leaf ? needed : node.wanted && !needed) fits = false;
    if (!leaf && needed) node.wanted = true;
  }
  return fits;
}

void AdaptiveSurface::divide_anew(const DivisionDemand& demand) {
  for (const Node& node : nodes_) {
    if (node.wanted) remembered_.insert(node.path);
  }
  nodes_.resize(at(root_count_));
  patches_ = root_patches_;
  points_.resize(root_points_);
  midpoints_.clear();
  leaf_of_side_.clear();
  leaf_count_ = root_count_;
  for (int root = 0; root < root_count_; ++root) {
    Node& node = nodes_[at(root)];
    node.children = {-1, -1};
    node.wanted = false;
    for (std::size_t k = 0; k < 3; ++k) leaf_of_side_[{node.corners[k], node.corners[(k + 1) % 3]}] = root;
  }
  // Coarse tolerances first, so that a division that is ended by its limit is even.
  double coarse = demand.chord_tolerance;
  for (int root = 0; root < root_count_; ++root) {
    while (needs_division(nodes_[at(root)], patches_[at(root)], 8.0 * coarse, demand)) coarse *= 8.0;
  }
  while (coarse > demand.chord_tolerance) {
    divide_to(coarse, demand);
    coarse *= 0.125;
  }
  divide_to(demand.chord_tolerance, demand);
  remembered_.clear();
}

void AdaptiveSurface::divide_to(double tolerance, const DivisionDemand& demand) {
  // Cutting appends nodes, so that every node is looked at once, when all before it are done.
  for (int node = 0; node < static_cast<int>(nodes_.size()) && leaf_count_ < max_cells; ++node) {
    const bool before = remembered_.count(nodes_[at(node)].path) > 0;
    if (nodes_[at(node)].wanted) continue;
    if (!needs_division(nodes_[at(node)], patches_[at(node)], before ? 0.5 * tolerance : tolerance, demand))
      continue;
    nodes_[at(node)].wanted = true;
    if (nodes_[at(node)].children[0] < 0) cut_with_neighbours(node);
  }
}

/// A side can only be cut where it is the longest one on both its sides: longer ones beyond it go first.
void AdaptiveSurface::cut_with_neighbours(int node) {
  std::vector<int> path = {node};
  while (!path.empty()) {
    const int last = path.back();
    const Node& triangle = nodes_[at(last)];
    if (triangle.children[0] >= 0) {
      path.pop_back();
      continue;
    }
    const int start = triangle.corners[at(triangle.longest)];
    const int end = triangle.corners[at((triangle.longest + 1) % 3)];
    const int beyond = leaf_of_side_.at({end, start});
    const Node& other = nodes_[at(beyond)];
    if (other.corners[at(other.longest)] != end || other.corners[at((other.longest + 1) % 3)] != start) {
      path.push_back(beyond);
      continue;
    }
    cut(last);
    cut(beyond);
    path.pop_back();
  }
}

void AdaptiveSurface::cut(int index) {
  const Node node = nodes_[at(index)];
  const auto corner = [&](int k) { return node.corners[at((node.longest + k) % 3)]; };
  const auto rim = [&](int k) { return node.rim[at((node.longest + k) % 3)]; };
  const auto [place, added] =
      midpoints_.try_emplace(sorted(corner(0), corner(1)), static_cast<int>(points_.size()));
  if (added) points_.emplace_back(0.5 * (points_[at(corner(0))] + points_[at(corner(1))]));
  const int middle = place->second;
  nodes_[at(index)].children = {static_cast<int>(nodes_.size()), static_cast<int>(nodes_.size()) + 1};
  const auto child_path = [&](std::uint64_t half) {
    const std::uint64_t steps = node.path & ((std::uint64_t{1} << path_bits) - 1U);
    return node.path + steps + half;
  };
  nodes_.push_back(make_node(node.face, {middle, corner(1), corner(2)}, {rim(0), rim(1), -1}, child_path(0),
                             node.bisections + 1));
  nodes_.push_back(make_node(node.face, {corner(0), middle, corner(2)}, {rim(0), -1, rim(2)}, child_path(1),
                             node.bisections + 1));
  auto halves = patches_[at(index)].halves(node.longest);
  for (BernsteinTriangle& half : halves) patches_.push_back(std::move(half));
  leaf_of_side_.erase({corner(0), corner(1)});
  for (const int child : nodes_[at(index)].children) {
    const auto& corners = nodes_[at(child)].corners;
    for (std::size_t k = 0; k < 3; ++k) leaf_of_side_[{corners[k], corners[(k + 1) % 3]}] = child;
  }
  ++leaf_count_;
}

std::vector<int> AdaptiveSurface::list_leaves() const {
  std::vector<int> leaves;
  std::vector<int> open;
  for (int root = root_count_ - 1; root >= 0; --root) open.push_back(root);
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const auto& children = nodes_[at(index)].children;
    if (children[0] < 0) {
      leaves.push_back(index);
    } else {
      open.insert(open.end(), {children[1], children[0]});
    }
  }
  return leaves;
}

void AdaptiveSurface::take_leaves(std::vector<int> leaves) {
  leaves_ = std::move(leaves);
  std::vector<SurfaceCell> cells;
  for (const int leaf : leaves_) {
    const Node& node = nodes_[at(leaf)];
    cells.push_back({node.face,
                     {node.corners[0], node.corners[1], node.corners[2]},
                     {node.rim[0], node.rim[1], node.rim[2]}});
  }
  surface_ = surface_of_triangles(*solid_, points_, std::move(cells));
}

}  // namespace ashlar
