#include "apps/scene/model/model_position.hpp"

#include <cmath>
#include <utility>

#include "apps/scene/check/water_checks.hpp"

namespace ashlar {
namespace {

/// Adds a vector to positions.
class Mover {
 public:
  /// @param sign of Scene::origin: -1 to the model, 1 to the user
  Mover(const Scene& scene, double sign)
      : sign_(sign), shift_(sign * scene.origin), climb_(up_of(scene).dot(shift_)) {}

  void move(Scene& scene) const {
    for (std::vector<SceneBlock>* blocks : {&scene.block, &scene.uncut})
      for (SceneBlock& block : *blocks) move(block);
    for (SceneAssign& assign : scene.assign) {
      move(assign.inside);
      move_all(assign.fix);
      move_all(assign.load);
    }
    move_all(scene.joint);
    move_all(scene.cut);
    move_all(scene.bolt);
    move_all(scene.prop);
    move_all(scene.load);
    move_all(scene.measure);
    move_all(scene.water);
    scene.initial_stress.surface += climb_;
    move(scene.initial_stress.stress);
    for (SceneBoundary& boundary : scene.boundary) move(boundary.plane);
    move_all(scene.stage);
  }

 private:
  template <class Entry>
  void move_all(std::vector<Entry>& entries) const {
    for (Entry& entry : entries) move(entry);
  }

  void move(Vector3& point) const { point += shift_; }
  void move(ScenePlane& plane) const { plane.point += shift_; }
  void move(std::variant<ScenePlane, Vector3>& where) const {
    std::visit([&](auto& place) { move(place); }, where);
  }
  void move(SceneField& field) const {
    if (field.at)
      field.at = [at = std::move(field.at), shift = shift_](const Vector3& place) {
        return at(place - shift);
      };
  }

  /// Coordinates of a mesh are those of its file: SceneBlock::shape_origin.
  static void move(SceneShape& shape, const Vector3& shift) {
    if (auto* box = std::get_if<SceneBox>(&shape)) {
      box->min += shift;
      box->max += shift;
    } else if (auto* hull = std::get_if<SceneHull>(&shape)) {
      for (Vector3& point : hull->points) point += shift;
    } else if (auto* sphere = std::get_if<SceneSphere>(&shape)) {
      sphere->center += shift;
    }
  }

  void move(std::optional<SceneRegion>& region) const {
    if (!region) return;
    if (auto* half = std::get_if<SceneHalfspace>(&region->space))
      half->point += shift_;
    else
      move(std::get<SceneShape>(region->space), shift_);
  }

  void move(SceneBlock& block) const {
    const Vector3 of_shape = sign_ * block.shape_origin;
    move(block.shape, of_shape);
    if (block.rotate) block.rotate->about += of_shape;
    block.translate += shift_ - of_shape;
    move_all(block.fix);
    move_all(block.load);
  }

  void move(SceneFix& fix) const { move(fix.where); }
  void move(SceneLoad& load) const {
    move(load.where);
    move(load.field);
  }
  void move(SceneJoint& joint) const { move(joint.inside); }

  /// Measured joints are read when they cut.
  void move(SceneCut& cut) const {
    move(cut.inside);
    cut.point += shift_;
    move(cut.solid, shift_);
  }

  void move(SceneBolt& bolt) const {
    bolt.from += shift_;
    bolt.to += shift_;
    if (bolt.pattern) move(bolt.pattern->plane);
  }
  void move(SceneProp& prop) const {
    prop.from += shift_;
    prop.to += shift_;
  }
  void move(SceneMovingLoad& load) const {
    for (SceneMovingLoad::Stop& stop : load.path) move(stop.place);
  }

  void move(SceneMeasure& measure) const {
    move(measure.inside);
    if (measure.point) move(*measure.point);
    if (!measure.drift) return;
    move(measure.drift->inside);
    for (double& height : measure.drift->heights) height += climb_;
  }

  void move(SceneWater& water) const {
    move(water.level);
    move_all(water.surface);
  }

  void move(SceneStage& stage) const {
    move(stage.remove_inside);
    move(stage.add_inside);
    for (SceneStage::Fix& entry : stage.fix) {
      move(entry.inside);
      move(entry.fix);
    }
    for (SceneStage::Load& entry : stage.load) {
      move(entry.inside);
      move(entry.load);
    }
    move_all(stage.joint);
    move_all(stage.water);
    move_all(stage.bolt);
    move_all(stage.prop);
  }

  double sign_;
  Vector3 shift_;
  double climb_;  ///< m, of heights along the direction against gravity
};

}  // namespace

Vector3 origin_for(const Box& box) {
  constexpr double far_away = 8.0;  // sides
  Vector3 origin = Vector3::Zero();
  const double side = (box.high - box.low).maxCoeff();
  if (!(side > 0.0) || !std::isfinite(side)) return origin;
  const double step = std::ldexp(1.0, std::ilogb(side) + 1);
  for (int axis = 0; axis < 3; ++axis) {
    const double center = 0.5 * box.low[axis] + 0.5 * box.high[axis];
    if (std::abs(center) > far_away * side) origin[axis] = step * std::round(center / step);
  }
  return origin;
}

void move_to_model(Scene& scene) {
  if (!scene.origin.isZero(0.0)) Mover(scene, -1.0).move(scene);
}

void move_to_user(Scene& scene) {
  if (!scene.origin.isZero(0.0)) Mover(scene, 1.0).move(scene);
}

}  // namespace ashlar
