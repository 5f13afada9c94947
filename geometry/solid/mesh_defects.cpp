#include "geometry/solid/mesh_defects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <sstream>

#include "geometry/solid/exact_surface.hpp"
#include "geometry/solid/half_edges.hpp"
#include "geometry/solid/self_intersection.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

class DefectSearch {
 public:
  DefectSearch(const TriangleMesh& mesh, std::size_t limit)
      : mesh_(mesh), limit_(limit), half_edges_(mesh.triangles, mesh.points.size()) {}

  MeshCheck run() {
    if (mesh_.points.empty() || mesh_.triangles.empty()) {
      report(MeshDefectKind::empty, mesh_.points.size(), " points, ", mesh_.triangles.size(), " triangles");
      return std::move(result_);
    }
    check_points();
    check_indices();
    if (!result_.defects.empty()) return std::move(result_);

    half_edges_.add_all();
    by_edge_ = half_edges_.sorted_by_edge();
    check_unused_points();
    check_edges();
    check_vertices();
    check_components();
    const bool connected = result_.defects.empty();
    if (!connected || !is_star_shaped(mesh_)) check_embedding();
    if (closed_) check_volume();
    return std::move(result_);
  }

 private:
  template <class... Parts>
  void report(MeshDefectKind kind, const Parts&... parts) {
    std::size_t& count = counts_[static_cast<std::size_t>(kind)];
    if (++count > limit_) return;
    std::ostringstream text;
    (text << ... << parts);
    result_.defects.push_back({kind, text.str()});
  }

  void check_points() {
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      const Vector3& p = mesh_.points[i];
      if (p.allFinite()) continue;
      report(MeshDefectKind::non_finite_point, "point ", i, " (", p.x(), ", ", p.y(), ", ", p.z(), ")");
    }
  }

  void check_indices() {
    const int count = static_cast<int>(mesh_.points.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const int v : mesh_.triangles[t]) {
        if (v >= 0 && v < count) continue;
        report(MeshDefectKind::index_out_of_range, "triangle ", t, " (point ", v, ", allowed 0 to ",
               count - 1, ")");
        break;
      }
    }
  }

  void check_unused_points() {
    std::vector<char> used(mesh_.points.size(), 0);
    for (const auto& t : mesh_.triangles) {
      for (const int v : t) used[v] = 1;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i] == 0) report(MeshDefectKind::unused_vertex, "point ", i);
    }
  }

  void check_edges() {
    result_.twins = half_edges_.twins(by_edge_);
    for_each_edge([this](std::span<const int> edge) {
      if (result_.twins[edge[0]] >= 0) return;
      closed_ = false;
      report_edge(edge.size() == 1  ? MeshDefectKind::open_edge
                  : edge.size() > 2 ? MeshDefectKind::non_manifold_edge
                                    : MeshDefectKind::inconsistent_edge,
                  edge);
    });
  }

  template <class Visit>
  void for_each_edge(Visit visit) const {
    half_edges_.for_each_edge(by_edge_, visit);
  }

  void report_edge(MeshDefectKind kind, std::span<const int> edge) {
    std::string triangles;
    for (const int h : edge) triangles += (triangles.empty() ? " " : ", ") + std::to_string(h / 3);
    const auto [low, high] = std::minmax({half_edges_.start(edge[0]), half_edges_.end(edge[0])});
    report(kind, "edge ", low, "-", high, edge.size() == 1 ? " of triangle" : " of triangles", triangles);
  }

  // The corners of triangles at a point fall into one set per fan when united over all edges at the point.
  void check_vertices() {
    UnionFind fans(3 * mesh_.triangles.size());
    const auto corner = [this](int h, int point) {
      return half_edges_.start(h) == point ? h : next_half_edge(h);
    };
    for_each_edge([&](std::span<const int> edge) {
      for (const int h : edge.subspan(1)) {
        for (const int end : {half_edges_.start(h), half_edges_.end(h)})
          fans.unite(corner(edge[0], end), corner(h, end));
      }
    });
    constexpr int none = -1;
    constexpr int several = -2;
    std::vector<int> fan_of_point(mesh_.points.size(), none);
    for (const int h : by_edge_) {
      int& known = fan_of_point[half_edges_.start(h)];
      const int fan = fans.find(h);
      known = known == none || known == fan ? fan : several;
    }
    for (std::size_t v = 0; v < fan_of_point.size(); ++v) {
      if (fan_of_point[v] == several) report(MeshDefectKind::non_manifold_vertex, "point ", v);
    }
  }

  void check_components() {
    UnionFind surfaces(mesh_.triangles.size());
    for_each_edge([&](std::span<const int> edge) {
      for (const int h : edge.subspan(1)) surfaces.unite(edge[0] / 3, h / 3);
    });
    if (by_edge_.empty()) return;
    const int first = surfaces.find(*std::min_element(by_edge_.begin(), by_edge_.end()) / 3);
    std::vector<char> named(mesh_.triangles.size(), 0);
    named[first] = 1;
    for (const int h : by_edge_) {
      const int root = surfaces.find(h / 3);
      if (named[root] != 0) continue;
      named[root] = 1;
      report(MeshDefectKind::several_components, "triangle ", root, " (not connected to triangle ", first,
             ")");
    }
  }

  void check_embedding() {
    // For a mesh that is refused already, see notes/overlapping_triangles.md.
    constexpr std::size_t per_triangle = 100;
    const std::size_t candidates = result_.defects.empty() ? std::numeric_limits<std::size_t>::max()
                                                           : per_triangle * mesh_.triangles.size();
    const std::vector<int> representative = check_fused_points();
    std::vector<std::array<int, 3>> triangles;
    std::vector<int> number;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (is_degenerate(mesh_.points, mesh_.triangles[t])) {
        const auto& [a, b, c] = mesh_.triangles[t];
        report(MeshDefectKind::degenerate_triangle, "triangle ", t, " (points ", a, ", ", b, ", ", c, ")");
        continue;
      }
      auto& renamed = triangles.emplace_back(mesh_.triangles[t]);
      for (int& v : renamed) v = representative[v];
      number.push_back(static_cast<int>(t));
    }
    for (const auto& [i, j] : self_intersections(mesh_.points, triangles, limit_, candidates)) {
      report(MeshDefectKind::self_intersection, "triangles ", number[i], ", ", number[j]);
    }
  }

  // Returns for each point the first one with the same coordinates.
  std::vector<int> check_fused_points() {
    const auto& p = mesh_.points;
    std::vector<int> order(p.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&p](int i, int j) {
      for (int d = 0; d < 3; ++d) {
        if (p[i][d] != p[j][d]) return p[i][d] < p[j][d];
      }
      return i < j;
    });
    std::vector<int> representative(p.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const bool fused = k > 0 && p[order[k]] == p[order[k - 1]];
      representative[order[k]] = fused ? representative[order[k - 1]] : order[k];
      if (fused) report(MeshDefectKind::fused_vertices, "points ", representative[order[k]], ", ", order[k]);
    }
    return representative;
  }

  void check_volume() {
    result_.volume = signed_volume(mesh_);
    const auto kind = !std::isfinite(result_.volume) ? MeshDefectKind::volume_overflow
                      : result_.volume == 0.0        ? MeshDefectKind::zero_volume
                                                     : MeshDefectKind::inside_out;
    if (result_.volume > 0.0 && std::isfinite(result_.volume)) return;
    report(kind, "surface of triangle 0 (volume ", result_.volume, ")");
  }

  const TriangleMesh& mesh_;
  const std::size_t limit_;
  HalfEdges half_edges_;
  std::vector<int> by_edge_;  // as HalfEdges::sorted_by_edge
  bool closed_ = true;
  std::array<std::size_t, 16> counts_{};
  MeshCheck result_;
};

std::string summary(const std::vector<MeshDefect>& defects) {
  std::string text =
      defects.empty() ? "unknown defect" : to_string(defects[0].kind) + ": " + defects[0].element;
  if (defects.size() > 1) text += " and " + std::to_string(defects.size() - 1) + " more";
  return text;
}

}  // namespace

std::string to_string(MeshDefectKind kind) {
  switch (kind) {
    case MeshDefectKind::empty:
      return "empty mesh";
    case MeshDefectKind::non_finite_point:
      return "non-finite point";
    case MeshDefectKind::index_out_of_range:
      return "index out of range";
    case MeshDefectKind::degenerate_triangle:
      return "zero-area triangle";
    case MeshDefectKind::open_edge:
      return "open edge";
    case MeshDefectKind::non_manifold_edge:
      return "non-manifold edge";
    case MeshDefectKind::inconsistent_edge:
      return "inconsistently oriented edge";
    case MeshDefectKind::non_manifold_vertex:
      return "non-manifold vertex";
    case MeshDefectKind::fused_vertices:
      return "fused vertices";
    case MeshDefectKind::unused_vertex:
      return "unused vertex";
    case MeshDefectKind::self_intersection:
      return "self-intersection";
    case MeshDefectKind::several_components:
      return "several components";
    case MeshDefectKind::inside_out:
      return "inside out";
    case MeshDefectKind::zero_volume:
      return "zero volume";
    case MeshDefectKind::volume_overflow:
      return "volume overflow";
  }
  return "unknown defect";
}

MeshError::MeshError(std::vector<MeshDefect> defects)
    : runtime_error(summary(defects)), defects_(std::move(defects)) {}

MeshCheck check_mesh(const TriangleMesh& mesh, std::size_t limit) {
  return DefectSearch(mesh, std::max<std::size_t>(limit, 1)).run();
}

}  // namespace ashlar
