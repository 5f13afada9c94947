// Triangles of a surface that are bisected on request, at their longest side and together with the neighbour beyond
// it, so that the surface stays closed. The choice of triangles is made by sub_face_refinement.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "geometry/subfaces/bernstein_triangle.hpp"
#include "geometry/subfaces/sub_face_surface.hpp"

namespace ashlar {

/// Trees of triangles: roots, their halves, and so on; the leaves are the surface.
class SubFaceForest {
 public:
  /// Times that a triangle can be cut: names of nodes have so many bits below that of their root.
  static constexpr int max_bisections = 24;

  struct Node {
    int face;
    std::array<int, 3> corners;   ///< points; numbered as in the node's patch
    std::array<int, 3> rim;       ///< by side
    std::uint64_t path;           ///< name: the root and the halves taken from there
    std::array<int, 2> children;  ///< -1: a leaf
    int longest;                  ///< the side it is cut at
    int bisections;               ///< from the root
    bool wanted;                  ///< cut for its own sake, not for a neighbour's
  };

  /// Roots are the triangles of a surface. There are no patches yet.
  explicit SubFaceForest(const SubFaceSurface& surface);

  [[nodiscard]] int root_count() const { return root_count_; }
  [[nodiscard]] int leaf_count() const { return leaf_count_; }
  [[nodiscard]] const std::vector<Node>& nodes() const {
    return nodes_;
  }  ///< roots first, parents before children
  /// Notes that a node is cut for its own sake.
  void want(int node) { nodes_[static_cast<std::size_t>(node)].wanted = true; }
  [[nodiscard]] const std::vector<Vector3>& points() const { return points_; }  ///< points of the roots first
  [[nodiscard]] const BernsteinTriangle& patch(int node) const {
    return patches_[static_cast<std::size_t>(node)];
  }

  /// Patches of all nodes. @param of_roots theirs
  [[nodiscard]] std::vector<BernsteinTriangle> patches(const std::vector<BernsteinTriangle>& of_roots) const;
  void set_patches(const std::vector<BernsteinTriangle>& of_roots) { patches_ = patches(of_roots); }

  /// Back to the roots, of which none is wanted.
  void join(const std::vector<BernsteinTriangle>& of_roots);
  /// Names of the nodes that were cut since the last join, in order.
  [[nodiscard]] std::vector<std::uint64_t> cuts() const;
  /// Joins, and makes the cuts of another forest of the same surface, so that nodes and points have its numbers. There
  /// are no patches then until set_patches().
  /// @throws std::invalid_argument if a name is that of no leaf
  void cut_again(const std::vector<std::uint64_t>& cuts);
  /// Cuts a leaf, after neighbours whose longer sides are in the way.
  void cut_with_neighbours(int node);
  /// Nodes in the order of the trees.
  [[nodiscard]] std::vector<int> leaves() const;

 private:
  [[nodiscard]] Node make_node(int face, const std::array<int, 3>& corners, const std::array<int, 3>& rim,
                               std::uint64_t path, int bisections) const;
  void cut(int node);

  std::vector<Vector3> points_;
  std::size_t root_points_;
  std::map<std::array<int, 2>, int> midpoints_;  ///< by the ends of a side
  std::vector<Node> nodes_;
  std::vector<BernsteinTriangle> patches_;          ///< by node
  std::map<std::array<int, 2>, int> leaf_of_side_;  ///< directed side of a leaf, since the last join
  int root_count_ = 0;
  int leaf_count_ = 0;
};

}  // namespace ashlar
