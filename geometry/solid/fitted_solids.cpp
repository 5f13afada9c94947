#include "geometry/solid/fitted_solids.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

struct FittedPlane {
  Vector3 normal = Vector3::Zero();
  Vector3 point = Vector3::Zero();

  [[nodiscard]] double distance(const Vector3& p) const { return normal.dot(p - point); }
};

struct SurveyedFace {
  std::size_t solid;
  Vector3 normal;
  Box box;
};

/// Faces that lie on one plane, by their root in the sets.
class FaceGroups {
 public:
  FaceGroups(const std::vector<std::optional<Polyhedron>>& solids, const FitLimits& limits)
      : fit_(limits.fit), same_way_(limits.same_way) {
    for (std::size_t s = 0; s < solids.size(); ++s) {
      first_face_.push_back(faces_.size());
      if (!solids[s]) continue;
      for (const PolyhedronFace& face : solids[s]->faces()) {
        std::vector<Vector3> corners;
        for (const auto& loop : face.loops)
          for (const int k : loop) corners.push_back(solids[s]->mesh().points[static_cast<std::size_t>(k)]);
        faces_.push_back({s, face.normal, box_of(corners).grown(fit_)});
        corners_.push_back(std::move(corners));
      }
    }
    sets_.emplace(faces_.size());
    for (std::size_t s = 0; s < solids.size(); ++s) {
      if (!solids[s]) continue;
      for (const PolyhedronEdge& edge : solids[s]->edges())
        unite_if_flat(index(s, edge.faces[0]), index(s, edge.faces[1]), 1.0);
    }
    std::vector<Box> boxes;
    for (const SurveyedFace& face : faces_) boxes.push_back(face.box);
    for (const auto& [a, b] : meeting_boxes(boxes))
      if (faces_[static_cast<std::size_t>(a)].solid != faces_[static_cast<std::size_t>(b)].solid)
        unite_if_flat(a, b, -1.0);
  }

  [[nodiscard]] int index(std::size_t solid, int face) const {
    return static_cast<int>(first_face_[solid]) + face;
  }
  [[nodiscard]] int group(int face) { return sets_->find(face); }
  [[nodiscard]] FittedPlane plane(int group) const {
    return fitted(corners_[static_cast<std::size_t>(group)]);
  }
  [[nodiscard]] std::size_t solid_of(std::size_t face) const { return faces_[face].solid; }
  [[nodiscard]] std::size_t size() const { return faces_.size(); }

 private:
  static FittedPlane fitted(const std::vector<Vector3>& corners) {
    Vector3 middle = Vector3::Zero();
    for (const Vector3& corner : corners) middle += corner;
    middle /= static_cast<double>(corners.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vector3& corner : corners) spread += (corner - middle) * (corner - middle).transpose();
    return {Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0), middle};
  }

  void unite_if_flat(int a, int b, double side) {
    const Vector3 &n = faces_[static_cast<std::size_t>(a)].normal,
                  &m = faces_[static_cast<std::size_t>(b)].normal;
    const int first = sets_->find(a), second = sets_->find(b);
    if (side * n.dot(m) < same_way_ || first == second) return;
    std::vector<Vector3> all = corners_[static_cast<std::size_t>(first)];
    const std::vector<Vector3>& others = corners_[static_cast<std::size_t>(second)];
    // Faces of one solid share corners, each of which was measured once.
    const auto is_new = [&](const Vector3& corner) {
      return side < 0.0 || std::find(all.begin(), all.end(), corner) == all.end();
    };
    std::vector<Vector3> added;
    std::copy_if(others.begin(), others.end(), std::back_inserter(added), is_new);
    all.insert(all.end(), added.begin(), added.end());
    const FittedPlane plane = fitted(all);
    const bool flat = std::all_of(all.begin(), all.end(), [&](const Vector3& corner) {
      return std::abs(plane.distance(corner)) <= fit_;
    });
    if (!flat) return;
    sets_->unite(first, second);
    corners_[static_cast<std::size_t>(sets_->find(first))] = std::move(all);
  }

  double fit_;
  double same_way_;
  std::vector<SurveyedFace> faces_;
  std::vector<std::size_t> first_face_;        ///< (#solids)
  std::vector<std::vector<Vector3>> corners_;  ///< (#faces), of the whole group at its root
  std::optional<UnionFind> sets_;
};

/// The nearest point of all planes, or the nearest to all that there is. @param dependent see FitLimits
Vector3 onto(const std::vector<FittedPlane>& planes, double dependent, const Vector3& point) {
  Eigen::MatrixXd normals(static_cast<Eigen::Index>(planes.size()), 3);
  Eigen::VectorXd distances(static_cast<Eigen::Index>(planes.size()));
  for (std::size_t k = 0; k < planes.size(); ++k) {
    normals.row(static_cast<Eigen::Index>(k)) = planes[k].normal.transpose();
    distances[static_cast<Eigen::Index>(k)] = -planes[k].distance(point);
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> factors(normals, Eigen::ComputeThinU | Eigen::ComputeThinV);
  factors.setThreshold(dependent);
  return point + factors.solve(distances);
}

[[noreturn]] void refuse(const std::string& what, double value, double fit) {
  std::ostringstream text;
  text << what << " (" << value << " m), a smaller fit than " << fit << " m is needed";
  throw std::invalid_argument(text.str());
}

}  // namespace

SolidFit fit_solids(std::vector<std::optional<Polyhedron>>& solids, const FitLimits& limits) {
  const double fit = limits.fit;
  FaceGroups groups(solids, limits);
  std::vector<std::set<std::size_t>> solids_of(groups.size());
  for (std::size_t f = 0; f < groups.size(); ++f)
    solids_of[static_cast<std::size_t>(groups.group(static_cast<int>(f)))].insert(groups.solid_of(f));
  std::vector<bool> shares(solids.size(), false);
  SolidFit done;
  for (const auto& members : solids_of) {
    if (members.size() < 2) continue;
    ++done.planes;
    for (const std::size_t s : members) shares[s] = true;
  }
  std::vector<std::optional<FittedPlane>> planes(groups.size());
  for (std::size_t s = 0; s < solids.size(); ++s) {
    if (!shares[s]) continue;
    TriangleMesh mesh = solids[s]->mesh();
    std::vector<std::set<int>> groups_at(mesh.points.size());
    double largest = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const int k : mesh.triangles[t])
        groups_at[static_cast<std::size_t>(k)].insert(
            groups.group(groups.index(s, solids[s]->face_of_triangle()[t])));
    for (const Vector3& point : mesh.points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
    std::size_t moved = 0;
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
      std::vector<FittedPlane> at;
      for (const int group : groups_at[k]) {
        auto& plane = planes[static_cast<std::size_t>(group)];
        if (!plane) plane = groups.plane(group);
        at.push_back(*plane);
      }
      const Vector3 place = onto(at, limits.dependent, mesh.points[k]);
      const double way = (place - mesh.points[k]).norm();
      if (!(way <= limits.farthest)) refuse("a corner would move too far", way, fit);
      if (way <= limits.rounding * largest) continue;
      mesh.points[k] = place;
      done.farthest = std::max(done.farthest, way);
      ++moved;
    }
    if (moved == 0) continue;
    done.corners += moved;
    ++done.solids;
    try {
      solids[s].emplace(std::move(mesh), limits.rounding * largest);
    } catch (const MeshError&) {
      refuse("a block is no solid any more", done.farthest, fit);
    }
  }
  return done;
}

}  // namespace ashlar
