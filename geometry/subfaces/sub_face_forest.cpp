#include "geometry/subfaces/sub_face_forest.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// A node's path: the number of its root, and below that a heap index: 1 for the root, 2 k and 2 k + 1 for
/// the halves of k.
constexpr int path_bits = SubFaceForest::max_bisections + 1;

std::array<int, 2> sorted(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

SubFaceForest::SubFaceForest(const SubFaceSurface& surface)
    : points_(surface.points), root_points_(surface.points.size()) {
  for (const SurfaceCell& cell : surface.cells) {
    const std::uint64_t path = (static_cast<std::uint64_t>(root_count_++) << path_bits) | 1U;
    nodes_.push_back(make_node(cell.face, {cell.corners[0], cell.corners[1], cell.corners[2]},
                               {cell.rim[0], cell.rim[1], cell.rim[2]}, path, 0));
  }
  leaf_count_ = root_count_;
}

/// The longest side is compared as (length, ends), the same from both sides of it: a total order, so that cutting
/// longer sides of neighbours first terminates. In single precision lengths that are equal but for rounding, such as
/// half the diagonals of a rectangle in a rotated scene, are equal.
SubFaceForest::Node SubFaceForest::make_node(int face, const std::array<int, 3>& corners,
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

/// Patches of all nodes from those of the roots: parents come before their children.
std::vector<BernsteinTriangle> SubFaceForest::patches(const std::vector<BernsteinTriangle>& of_roots) const {
  std::vector<BernsteinTriangle> patches = of_roots;
  patches.resize(nodes_.size(), of_roots.front());
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].children[0] < 0) continue;
    auto halves = patches[n].halves(nodes_[n].longest);
    for (std::size_t k = 0; k < 2; ++k) patches[at(nodes_[n].children[k])] = std::move(halves[k]);
  }
  return patches;
}

void SubFaceForest::join(const std::vector<BernsteinTriangle>& of_roots) {
  nodes_.resize(at(root_count_));
  patches_ = of_roots;
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
}

std::vector<std::uint64_t> SubFaceForest::cuts() const {
  std::vector<std::uint64_t> cuts((nodes_.size() - at(root_count_)) / 2);
  // Halves are made together, one cut after the other.
  for (const Node& node : nodes_)
    if (node.children[0] >= 0) cuts[at((node.children[0] - root_count_) / 2)] = node.path;
  return cuts;
}

void SubFaceForest::cut_again(const std::vector<std::uint64_t>& cuts) {
  join({});
  std::map<std::uint64_t, int> leaves;
  for (int root = 0; root < root_count_; ++root) leaves.emplace(nodes_[at(root)].path, root);
  for (const std::uint64_t path : cuts) {
    const auto leaf = leaves.find(path);
    if (leaf == leaves.end()) throw std::invalid_argument("a triangle that is cut is none of the surface");
    if (nodes_[at(leaf->second)].bisections >= max_bisections)
      throw std::invalid_argument("a triangle is cut too often");
    cut(leaf->second);
    for (const int child : nodes_[at(leaf->second)].children) leaves.emplace(nodes_[at(child)].path, child);
    leaves.erase(leaf);
  }
}

/// A side can only be cut if it is the longest one on both its sides: longer ones beyond it are cut first.
void SubFaceForest::cut_with_neighbours(int node) {
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

void SubFaceForest::cut(int index) {
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
  if (!patches_.empty()) {
    auto halves = patches_[at(index)].halves(node.longest);
    for (BernsteinTriangle& half : halves) patches_.push_back(std::move(half));
  }
  leaf_of_side_.erase({corner(0), corner(1)});
  for (const int child : nodes_[at(index)].children) {
    const auto& corners = nodes_[at(child)].corners;
    for (std::size_t k = 0; k < 3; ++k) leaf_of_side_[{corners[k], corners[(k + 1) % 3]}] = child;
  }
  ++leaf_count_;
}

std::vector<int> SubFaceForest::leaves() const {
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

}  // namespace ashlar
