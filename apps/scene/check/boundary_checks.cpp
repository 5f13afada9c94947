#include "apps/scene/check/boundary_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "apps/scene/expand/ground_of_scene.hpp"
#include "mechanics/supports/quiet_faces.hpp"

namespace ashlar {
namespace {

std::string rounded_words(const Vector3& vector) {
  return fmt::format("[{:g}, {:g}, {:g}]", vector.x(), vector.y(), vector.z());
}

bool is_readable(const ScenePlane& plane) {
  return plane.point.allFinite() && plane.normal.allFinite() && !plane.normal.isZero(0.0);
}

class BoundaryCheck {
 public:
  BoundaryCheck(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                Diagnostics& diagnostics)
      : scene_(scene), solids_(solids), diagnostics_(diagnostics) {}

  void check(std::size_t boundary) {
    const ScenePlane& plane = scene_.boundary[boundary].plane;
    if (!is_readable(plane)) return;
    bool any = false;
    for (std::size_t k = 0; k < scene_.block.size(); ++k) {
      if (scene_.block[k].fixed || !solids_[k]) continue;
      const std::vector<int> faces = outer_faces(*solids_[k], {plane.point, plane.normal});
      if (faces.empty()) continue;
      any = true;
      check_block(boundary, k);
      check_faces(boundary, k, faces);
    }
    if (!any) return report_no_face(boundary);
    if (scene_.boundary[boundary].kind == SceneBoundary::Kind::free_field) check_free_field(boundary);
  }

 private:
  void report_no_face(std::size_t boundary) {
    const ScenePlane& plane = scene_.boundary[boundary].plane;
    bool inward = false, fixed = false;
    for (std::size_t k = 0; k < scene_.block.size(); ++k) {
      if (!solids_[k]) continue;
      const bool there = !faces_in_plane(*solids_[k], {plane.point, plane.normal}).empty();
      (scene_.block[k].fixed ? fixed : inward) |= there;
    }
    error(boundary, ".plane",
          fmt::format(
              "boundary meets no face of a moving block (point {}, normal {}), a plane of outer faces with "
              "the normal out of the blocks is needed{}",
              rounded_words(scene_.origin + plane.point), rounded_words(plane.normal),
              inward  ? "; faces in this plane have the opposite normal"
              : fixed ? "; blocks in this plane are fixed"
                      : ""));
  }

  void check_free_field(std::size_t boundary) {
    if (!scene_.boundary[boundary].wave.empty())
      diagnostics_.error(scene_.places.key(key(boundary) + ".wave"),
                         "wave of a free-field boundary, it belongs to the quiet boundary below it");
    for (const SceneBoundary& other : scene_.boundary)
      if (!is_readable(other.plane)) return;
    const std::vector<GroundBoundary> boundaries = ground_boundaries_of(scene_);
    const auto base = base_of_side(boundaries, boundary);
    if (!base)
      return error(
          boundary, ".kind",
          "free-field without a quiet boundary at right angles to it, one below the ground is needed");
    std::vector<const Polyhedron*> solids;
    for (const std::optional<Polyhedron>& solid : solids_) solids.push_back(solid ? &*solid : nullptr);
    const SideLayers layers =
        layers_beside(boundaries[boundary].plane, boundaries[*base].plane, ground_blocks_of(scene_, solids));
    if (layers.fault)
      error(
          boundary, ".plane",
          fmt::format("free-field has no column of ground beside it ({}), faces from the base up are needed",
                      words_of(*layers.fault)));
  }

  void check_block(std::size_t boundary, std::size_t k) {
    const SceneBlock& block = scene_.block[k];
    if (block.order == 0)
      error(
          boundary, ".plane",
          fmt::format("boundary at a rigid block (\"{}\", order 0), order 1 or more is needed", block.name));
    for (const SceneFix& fix : block.fix)
      if (!fix.history.empty()) {
        error(boundary, ".plane",
              fmt::format(
                  "boundary at a block with a moving support (\"{}\"), supports at rest are needed: a wave "
                  "moves the ground",
                  block.name));
        return;
      }
  }

  void check_faces(std::size_t boundary, std::size_t k, const std::vector<int>& faces) {
    for (const int face : faces) {
      const auto [first, is_new] = first_.emplace(std::pair(k, face), boundary);
      if (!is_new && first->second != boundary) {
        error(boundary, ".plane",
              fmt::format("face of block \"{}\" belongs to two boundaries (the other at {}), one is allowed",
                          scene_.block[k].name, to_string(scene_.places.key(key(first->second)))));
        return;
      }
    }
    for (const SceneFix& fix : scene_.block[k].fix) {
      const auto* plane = std::get_if<ScenePlane>(&fix.where);
      if (plane == nullptr || !is_readable(*plane)) continue;
      const std::vector<int> held = faces_in_plane(*solids_[k], {plane->point, plane->normal});
      const bool both = std::any_of(faces.begin(), faces.end(), [&](int face) {
        return std::find(held.begin(), held.end(), face) != held.end();
      });
      if (!both) continue;
      error(boundary, ".plane",
            fmt::format(
                "boundary at a face with a support (block \"{}\"), one of both is allowed: without motion "
                "the boundary holds the face",
                scene_.block[k].name));
      return;
    }
  }

  static std::string key(std::size_t boundary) { return fmt::format("boundary.{}", boundary); }
  void error(std::size_t boundary, const char* of, std::string message) {
    diagnostics_.error(scene_.places.value(key(boundary) + of), std::move(message));
  }

  const Scene& scene_;
  const std::vector<std::optional<Polyhedron>>& solids_;
  Diagnostics& diagnostics_;
  std::map<std::pair<std::size_t, int>, std::size_t> first_;  ///< boundary of a face of a block
};

void warn_of_start(const Scene& scene, Diagnostics& diagnostics) {
  if (is_static(scene.analysis) || scene.initial_stress.given() ||
      scene.analysis.initial_state != SceneAnalysis::InitialState::as_placed)
    return;
  for (std::size_t i = 0; i < scene.boundary.size(); ++i) {
    const ScenePlane& plane = scene.boundary[i].plane;
    if (!is_readable(plane) || plane.normal.dot(scene.analysis.gravity) == 0.0) continue;
    diagnostics.warning(
        scene.places.key(fmt::format("boundary.{}", i)),
        "boundary carries no weight at the start (initial_state = \"as-placed\" without "
        "initial_stress): blocks sink into it; initial_state = \"static\" or a static stage before "
        "the motion gives it their weight");
    return;
  }
}

void warn_of_idle_waves(const Scene& scene, Diagnostics& diagnostics) {
  const bool moves = scene.stage.empty()
                         ? !is_static(scene.analysis)
                         : std::any_of(scene.stage.begin(), scene.stage.end(),
                                       [](const SceneStage& stage) { return !is_static(stage.analysis); });
  for (std::size_t i = 0; i < scene.boundary.size() && !moves; ++i)
    if (!scene.boundary[i].wave.empty())
      diagnostics.warning(scene.places.key(fmt::format("boundary.{}.wave", i)),
                          "wave has no effect in a static analysis: it belongs to a dynamic one");
}

}  // namespace

void check_boundaries(const ExpandedScene& stage, const std::vector<std::optional<Polyhedron>>& solids,
                      Diagnostics& diagnostics) {
  if (stage.boundary.empty()) return;
  BoundaryCheck check(stage, solids, diagnostics);
  for (std::size_t i = 0; i < stage.boundary.size(); ++i) check.check(i);
}

void warn_of_boundaries(const Scene& whole, Diagnostics& diagnostics) {
  warn_of_start(whole, diagnostics);
  warn_of_idle_waves(whole, diagnostics);
}

}  // namespace ashlar
