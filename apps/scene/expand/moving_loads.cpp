#include "apps/scene/expand/moving_loads.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/scene/model/block_names.hpp"

namespace ashlar {
namespace {

/// Axes with the third one along a force.
struct ForceFrame {
  explicit ForceFrame(const Vector3& force) : along(force.stableNormalized()) {
    Vector3 other = Vector3::Zero();
    Eigen::Index least = 0;
    along.cwiseAbs().minCoeff(&least);
    other[least] = 1.0;
    first = along.cross(other).normalized();
    second = along.cross(first);
  }
  Vector3 along, first, second;
};

/// First height along the force at which a line through a point enters a solid; infinite if it misses. Signs of the
/// three products are opposite for the two triangles of an edge, so that no line passes between them.
double entry_height(const Polyhedron& solid, const ForceFrame& frame, const Vector3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& triangle : solid.mesh().triangles) {
    std::array<double, 3> u = {}, v = {}, height = {}, area = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& corner = solid.mesh().points[static_cast<std::size_t>(triangle[k])];
      u[k] = frame.first.dot(corner) - frame.first.dot(point);
      v[k] = frame.second.dot(corner) - frame.second.dot(point);
      height[k] = frame.along.dot(corner);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      area[k] = u[a] * v[b] - u[b] * v[a];
    }
    const double sum = area[0] + area[1] + area[2];
    const bool hit = std::all_of(area.begin(), area.end(), [](double part) { return part >= 0.0; }) ||
                     std::all_of(area.begin(), area.end(), [](double part) { return part <= 0.0; });
    if (!hit || sum == 0.0) continue;
    least = std::min(least, (area[0] * height[0] + area[1] * height[1] + area[2] * height[2]) / sum);
  }
  return least;
}

class PathLayer {
 public:
  PathLayer(Scene& scene, const std::vector<std::optional<Polyhedron>>& solids, Diagnostics& diagnostics)
      : scene_(scene), solids_(solids), diagnostics_(diagnostics) {}

  void lay(std::size_t index) {
    const SceneMovingLoad& load = scene_.load[index];
    const std::vector<std::size_t> blocks = blocks_of(index);
    const double length = length_of(load.path);
    constexpr double default_parts = 100.0;
    const double spacing = load.spacing.value_or(length / default_parts);
    if (blocks.empty() || load.path.empty()) return;
    if (length / spacing > most_path_points) {
      error(index, "spacing",
            fmt::format("path has too many points ({:.3g} m every {:g} m), at most {:g} are allowed", length,
                        spacing, most_path_points));
      return;
    }
    const std::vector<PathPoint> points = divided_path(load.path, length > 0.0 ? spacing : 1.0);
    const ForceFrame frame(load.force);
    bool any = false;
    for (std::size_t k = 0; k < points.size(); ++k) {
      std::size_t block = 0;
      double height = std::numeric_limits<double>::infinity();
      for (const std::size_t candidate : blocks) {
        const double entry = entry_height(*solids_[candidate], frame, points[k].place);
        if (entry < height) {
          height = entry;
          block = candidate;
        }
      }
      if (!std::isfinite(height)) continue;
      any = true;
      if (scene_.block[block].fixed) continue;
      const Vector3 place = points[k].place + (height - frame.along.dot(points[k].place)) * frame.along;
      add(index, block, place, share_of(points, k));
    }
    if (!any)
      error(index, "path", "path leads over no block, one that crosses the blocks along the force is needed");
  }

 private:
  std::vector<std::size_t> blocks_of(std::size_t index) {
    std::vector<std::size_t> blocks;
    for (const std::string& pattern : scene_.load[index].blocks) {
      const std::size_t before = blocks.size();
      for (std::size_t k = 0; k < scene_.block.size(); ++k)
        if (solids_[k] && pattern_names_block(scene_, pattern, k)) blocks.push_back(k);
      if (blocks.size() > before) continue;
      error(index, "blocks",
            fmt::format("load names no block (\"{}\"), the name of a [[block]] or a glob that "
                        "matches one is needed",
                        pattern));
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
  }

  /// 1 at the time of a point, 0 from those of its neighbours on.
  static std::vector<SceneLoad::Factor> share_of(const std::vector<PathPoint>& points, std::size_t k) {
    std::vector<SceneLoad::Factor> share;
    if (k > 0) share.push_back({points[k - 1].time, 0.0});
    share.push_back({points[k].time, 1.0});
    if (k + 1 < points.size()) share.push_back({points[k + 1].time, 0.0});
    return share;
  }

  void add(std::size_t index, std::size_t block, const Vector3& place,
           std::vector<SceneLoad::Factor> history) {
    std::vector<SceneLoad>& loads = scene_.block[block].load;
    scene_.places.record_origin(fmt::format("block.{}.load.{}", block, loads.size()),
                                fmt::format("load.{}", index));
    SceneLoad& added = loads.emplace_back();
    added.where = place;
    added.kind = SceneLoad::Kind::force;
    added.vector = scene_.load[index].force;
    added.history = std::move(history);
    added.of_path = true;
  }

  void error(std::size_t index, const char* key, std::string message) {
    diagnostics_.error(scene_.places.value(fmt::format("load.{}.{}", index, key)), std::move(message));
  }

  Scene& scene_;
  const std::vector<std::optional<Polyhedron>>& solids_;
  Diagnostics& diagnostics_;
};

}  // namespace

double length_of(const std::vector<SceneMovingLoad::Stop>& path) {
  double length = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) length += (path[k].place - path[k - 1].place).norm();
  return length;
}

std::vector<PathPoint> divided_path(const std::vector<SceneMovingLoad::Stop>& path, double spacing) {
  std::vector<PathPoint> points;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const auto& [start, from] = path[k];
    const auto& [end, to] = path[k + 1];
    const double parts = std::max(1.0, std::ceil((to - from).norm() / spacing));
    for (double n = 0.0; n < parts; ++n)
      points.push_back({start + n / parts * (end - start), from + n / parts * (to - from)});
  }
  points.push_back({path.back().time, path.back().place});
  return points;
}

void lay_moving_loads(Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                      Diagnostics& diagnostics) {
  PathLayer layer(scene, solids, diagnostics);
  for (std::size_t k = 0; k < scene.load.size(); ++k) layer.lay(k);
}

}  // namespace ashlar
