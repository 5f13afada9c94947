#include "apps/scene/assemble/scene_placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/expand/support_lines.hpp"
#include "apps/scene/model/model_position.hpp"
#include "apps/scene/read/model_origin.hpp"
#include "geometry/cutting/cut_plane.hpp"
#include "geometry/exact/axis_rotation.hpp"
#include "geometry/exact/degree_turn.hpp"
#include "geometry/solid/shapes.hpp"
#include "solver/ground/ground_boundary.hpp"

namespace ashlar {
namespace {

constexpr double direction_tolerance = 1e-9;  // relative difference of equal directions

[[noreturn]] void cannot_place(const std::string& key, const char* reason) {
  throw std::invalid_argument(fmt::format("{} cannot be placed: {}", key, reason));
}

/// Scene::origin of the placed scene, m.
Vector3 origin_of_placed(const Scene& scene, const ScenePlacement& placement) {
  const Box box = box_of_blocks(scene);
  if (box.is_empty()) return scene.origin;
  Box all;
  for (const Vector3& corner : make_box(box.low, box.high).points)
    all.include(placement.point(scene.origin + corner));
  return origin_for(all);
}

/// The analyses of all stages.
std::vector<SceneAnalysis> analyses_of(const Scene& scene) {
  std::vector<SceneAnalysis> all = {scene.analysis};
  for (const SceneStage& stage : scene.stage) all.push_back(stage.analysis);
  return all;
}

/// The reason why heights of a scene cannot be placed; null: they can be.
const char* fault_of_heights(const Scene& scene, const ScenePlacement& placement) {
  const Vector3 up = placement.direction(up_of(scene));
  for (const SceneAnalysis& analysis : analyses_of(scene)) {
    Scene alone;
    alone.analysis = analysis;
    if (!placement.direction(up_of(alone)).isApprox(up, direction_tolerance))
      return "stages have several directions of gravity, along which heights are";
    alone.analysis.gravity = placement.direction(analysis.gravity);
    if (!up_of(alone).isApprox(up, direction_tolerance))
      return "without constant gravity heights are along z";
  }
  return nullptr;
}

/// Number of components that a boundary holds without motion.
std::ptrdiff_t held_count(const Vector3& normal, const Vector3& gravity) {
  const std::array<bool, 3> held = held_components(normal, gravity);
  return std::count(held.begin(), held.end(), true);
}

/// Rotates and shifts the parts of a scene, in the coordinates of the model.
class ScenePlacer {
 public:
  ScenePlacer(const Scene& scene, const ScenePlacement& placement)
      : turned_(placement.is_turned()),
        origin_(origin_of_placed(scene, placement)),
        model_{placement.turn, placement.point(scene.origin) - origin_},
        climb_(placement.direction(up_of(scene)).dot(model_.shift)),
        fault_of_heights_(fault_of_heights(scene, placement)),
        analyses_(analyses_of(scene)) {}

  void place(Scene& scene) const {
    scene.origin = origin_;
    turn(scene.analysis);
    for (std::vector<SceneBlock>* blocks : {&scene.block, &scene.uncut}) place_all(*blocks);
    place_all(scene.assign);
    place_all(scene.joint);
    place_all(scene.cut);
    place_all(scene.bolt);
    place_all(scene.prop);
    place_all(scene.load);
    place_all(scene.measure);
    place_all(scene.water);
    place(scene.initial_stress);
    place_all(scene.boundary);
    place_all(scene.stage);
  }

 private:
  template <class Entry>
  void place_all(std::vector<Entry>& entries) const {
    for (Entry& entry : entries) place(entry);
  }

  void place(Vector3& point) const { point = model_.point(point); }
  void turn(Vector3& direction) const { direction = model_.direction(direction); }
  void turn(std::optional<Vector3>& direction) const {
    if (direction) turn(*direction);
  }
  void place(ScenePlane& plane) const {
    place(plane.point);
    turn(plane.normal);
  }
  void place(std::variant<ScenePlane, Vector3>& where) const {
    std::visit([&](auto& there) { place(there); }, where);
  }

  /// The rows of a file have rotated values.
  void turn(std::vector<SceneFix::Motion>& rows, std::optional<SceneRecord>& file) const {
    for (SceneFix::Motion& row : rows) turn(row.value);
    if (turned_) file.reset();
  }

  /// @param turned rotates the components
  template <class Turned>
  void place(SceneField& field, Turned turned) const {
    if (!field.at) return;
    std::vector<double> numbers;
    for (const auto& component : field.written)
      if (const double* number = std::get_if<double>(&component)) numbers.push_back(*number);
    if (numbers.size() == field.written.size()) {
      numbers = turned(numbers);
      field.written.assign(numbers.begin(), numbers.end());
    }
    field.at = [at = std::move(field.at), model = model_, turned](const Vector3& there) {
      return turned(at(model.point_back(there)));
    };
  }
  void place_vectors(SceneField& field) const {
    place(field, [model = model_](const std::vector<double>& v) {
      const Vector3 turned = model.direction({v[0], v[1], v[2]});
      return std::vector<double>(turned.begin(), turned.end());
    });
  }
  void place_tensors(SceneField& field) const {
    place(field, [model = model_](const std::vector<double>& s) {
      const Eigen::Matrix3d t = model.tensor(
          (Eigen::Matrix3d() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished());
      return std::vector<double>{t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
    });
  }

  void require_heights(const char* key) const {
    if (fault_of_heights_ != nullptr) cannot_place(key, fault_of_heights_);
  }

  /// The shape of a region or of a cut.
  void place(SceneShape& shape, const std::string& key) const {
    if (std::holds_alternative<SceneMesh>(shape))
      cannot_place(key + ".mesh", "its coordinates are those of its file");
    if (turned_) {
      if (const auto* box = std::get_if<SceneBox>(&shape))
        shape = SceneHull{make_box(box->min, box->max).points};
      else if (const auto* sphere = std::get_if<SceneSphere>(&shape))
        shape = SceneHull{make_sphere(sphere->center, sphere->radius, sphere->subdivisions).points};
    }
    if (auto* hull = std::get_if<SceneHull>(&shape)) {
      for (Vector3& point : hull->points) place(point);
    } else if (auto* box = std::get_if<SceneBox>(&shape)) {
      place(box->min);
      place(box->max);
    } else if (auto* sphere = std::get_if<SceneSphere>(&shape)) {
      place(sphere->center);
    }
  }
  void place(std::optional<SceneRegion>& region) const {
    if (!region) return;
    if (auto* half = std::get_if<SceneHalfspace>(&region->space)) {
      place(half->point);
      turn(half->normal);
    } else {
      place(std::get<SceneShape>(region->space), "inside");
    }
  }

  /// `rotate` turns the shape about a point a, M (x - a) + a, and `translate` t moves it: with the placement R, w the
  /// matrix is R M, and the movement R (a + t) + w - a.
  void place_shape(SceneBlock& block) const {
    if (std::holds_alternative<ScenePiece>(block.shape))
      cannot_place("cut", "blocks have been cut already, a scene as it was read is needed");
    if (!turned_) {
      block.translate += model_.shift;
      return;
    }
    const SceneRotation given = block.rotate.value_or(SceneRotation{});
    const Vector3 all = rotation_vector(
        model_.turn * rotation_matrix(given.axis.stableNormalized(), degree_turn(given.angle)));
    const double angle = all.norm();
    block.rotate = {angle > 0.0 ? Vector3(all / angle) : Vector3(Vector3::UnitX()),
                    angle * 180.0 / std::numbers::pi, given.about};
    block.translate = model_.point(given.about + block.translate) - given.about;
  }

  void place(SceneBlock& block) const {
    place_shape(block);
    turn(block.velocity);
    turn(block.angular_velocity);
    if (block.array) {
      for (Vector3& step : block.array->step) turn(step);
      turn(block.array->stagger);
    }
    place_all(block.fix);
    place_all(block.load);
  }
  void place(SceneAssign& assign) const {
    place(assign.inside);
    turn(assign.velocity);
    turn(assign.angular_velocity);
    place_all(assign.fix);
    place_all(assign.load);
  }

  void place(SceneFix& fix) const {
    if (turned_ && fix.components != std::array<bool, 3>{true, true, true})
      cannot_place("fix.components",
                   "components are along the axes, and a rotated support fixes other directions");
    place(fix.where);
    turn(fix.history, fix.file);
  }
  void place(SceneLoad& load) const {
    place(load.where);
    turn(load.vector);
    place_vectors(load.field);
  }
  void place(SceneJoint& joint) const { place(joint.inside); }

  void place(SceneCut& cut) const {
    if (cut.kind == SceneCut::Kind::discs)
      cannot_place("cut.file", "measured joints are read from their file when they cut");
    place(cut.inside);
    place(cut.point);
    place(cut.solid, "cut.solid");
    if (!turned_) return;
    if (cut.fisher > 0.0)
      cannot_place("cut.fisher", "the axes about which orientations are drawn do not turn");
    const Vector3 normal = model_.direction(plane_normal(cut.dip, cut.dip_direction));
    cut.dip = degrees_of(normal.z(), normal.head<2>().norm());
    cut.dip_direction = degrees_of(normal.y(), normal.x());
  }

  void place(SceneBolt& bolt) const {
    place(bolt.from);
    place(bolt.to);
    if (!bolt.pattern) return;
    const Vector3 row = model_.direction(pattern_row(bolt.pattern->plane.normal));
    place(bolt.pattern->plane);
    turn(bolt.pattern->direction);
    if (!pattern_row(bolt.pattern->plane.normal).isApprox(row, direction_tolerance))
      cannot_place("bolt.pattern", "its rows are horizontal, and rotated ones are not");
  }
  void place(SceneProp& prop) const {
    place(prop.from);
    place(prop.to);
  }
  void place(SceneMovingLoad& load) const {
    turn(load.force);
    for (SceneMovingLoad::Stop& stop : load.path) place(stop.place);
    load.file.reset();
  }

  void place(SceneMeasure& measure) const {
    place(measure.inside);
    if (measure.point) place(*measure.point);
    if (!measure.drift) return;
    require_heights("measure.drift.heights");
    place(measure.drift->inside);
    for (double& height : measure.drift->heights) height += climb_;
  }
  void place(SceneWater& water) const {
    if (water.file && turned_) cannot_place("water.level.file", "heights of its points are along z");
    if (!water.file) require_heights("water.level");
    place(water.level);
    place_all(water.surface);
  }
  void place(SceneInitialStress& initial) const {
    place_tensors(initial.stress);
    if (!initial.k0) return;
    require_heights("initial_stress.surface");
    initial.surface += climb_;
  }
  void place(SceneBoundary& boundary) const {
    for (const SceneAnalysis& analysis : analyses_)
      if (held_count(boundary.plane.normal, analysis.gravity) !=
          held_count(model_.direction(boundary.plane.normal), model_.direction(analysis.gravity)))
        cannot_place("boundary.plane",
                     "until motion begins a side holds its normal component along an axis only");
    place(boundary.plane);
    // A file of one column remains that of the rotated direction.
    std::optional<SceneRecord> of_components;
    turn(boundary.wave, boundary.direction ? of_components : boundary.file);
    turn(boundary.direction);
  }

  void turn(SceneAnalysis& analysis) const {
    turn(analysis.gravity);
    for (SceneAnalysis::Gravity& row : analysis.gravity_history) turn(row.value);
    if (turned_) analysis.gravity_file.reset();
    turn(analysis.movement.direction);
    turn(analysis.pushover.direction);
  }
  void place(SceneStage& stage) const {
    turn(stage.analysis);
    place(stage.remove_inside);
    place(stage.add_inside);
    for (SceneStage::Fix& entry : stage.fix) {
      place(entry.inside);
      place(entry.fix);
    }
    for (SceneStage::Load& entry : stage.load) {
      place(entry.inside);
      place(entry.load);
    }
    place_all(stage.joint);
    place_all(stage.water);
    place_all(stage.bolt);
    place_all(stage.prop);
  }

  bool turned_;
  Vector3 origin_;
  ScenePlacement model_;  ///< of coordinates relative to Scene::origin
  double climb_;          ///< m, of heights along the direction against gravity
  const char* fault_of_heights_;
  std::vector<SceneAnalysis> analyses_;
};

}  // namespace

Scene placed(Scene scene, const ScenePlacement& placement) {
  if (!placement.is_identity()) ScenePlacer(scene, placement).place(scene);
  return scene;
}

}  // namespace ashlar
