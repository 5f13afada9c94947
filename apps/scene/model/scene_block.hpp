// [[block]] and [[assign]]: the blocks of a scene (scene.hpp), their supports and loads.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/scene/model/scene_field.hpp"
#include "apps/scene/model/scene_record.hpp"
#include "apps/scene/model/scene_region.hpp"
#include "apps/scene/model/scene_shape.hpp"
#include "geometry/triangle_mesh.hpp"
#include "mechanics/supports/recorded_motion.hpp"

namespace ashlar {

/// A plane in placed coordinates. It selects the faces of the block in it, for both directions of their normals.
struct ScenePlane {
  Vector3 point = Vector3::Zero();   ///< m
  Vector3 normal = Vector3::Zero();  ///< not zero, any length
};

/// [[block.fix]]: clamped faces or a fixed point.
struct SceneFix {
  struct Motion {
    double time = 0.0;                ///< s
    Vector3 value = Vector3::Zero();  ///< m, m/s or m/s^2
  };
  std::variant<ScenePlane, Vector3>
      where;  ///< a plane with at least one face, or a point, m, placed coordinates
  std::array<bool, 3> components = {true, true, true};  ///< fixed components x, y, z
  /// Quantity of the rows of the history; displacements are linear or cubic between rows (`interpolation`).
  MotionRecord record = MotionRecord::displacement;
  std::vector<Motion> history;      ///< the rows of the given history; times increase; empty: at rest
  std::optional<SceneRecord> file;  ///< their file, if not in the scene
};

/// [[block.load]]: traction on faces, or a force on faces or at a point.
struct SceneLoad {
  struct Factor {
    double time = 0.0;  ///< s
    double factor = 1.0;
  };
  enum class Kind {
    traction,  ///< Pa, on the plane's faces
    force,     ///< N, distributed evenly over the plane's faces, or at the point
  };
  std::variant<ScenePlane, Vector3> where;  ///< as SceneFix::where; a traction needs a plane
  Kind kind = Kind::traction;
  Vector3 vector = Vector3::Zero();  ///< Pa or N
  SceneField field;                  ///< a traction that varies, Pa, in place of vector
  std::vector<Factor> history;       ///< times increase; empty: factor 1 always
  std::optional<SceneRecord> file;   ///< its file, if not in the scene
  bool of_path = false;              ///< made from a [[load]], not from the scene's block
  bool of_fill = false;              ///< weight of an arch's fill, which a fixed block ignores
};

/// array = { count, step, stagger }
struct SceneArray {
  std::vector<int> count;             ///< (1 to 3), blocks in each direction, >= 1
  std::vector<Vector3> step;          ///< as many, m, from one to the next
  Vector3 stagger = Vector3::Zero();  ///< m, for every second one of the last direction
};

/// [[block]]
struct SceneBlock {
  std::string name;              ///< unique; required
  std::string material;          ///< name of a [[material]]; only a fixed block may leave it out (empty)
  int order = 1;                 ///< 0 to 12; 0: rigid
  bool automatic_order = false;  ///< analysis.accuracy chooses a higher one: it is "auto", or not given
  SceneShape shape;              ///< exactly one of box, mesh, hull, sphere
  std::optional<SceneRotation> rotate;
  Vector3 translate = Vector3::Zero();  ///< m, after rotate
  /// m, share of Scene::origin that is subtracted from the shape and `rotate.about`, from a mesh file after its scale;
  /// the rest of it is subtracted from `translate`
  Vector3 shape_origin = Vector3::Zero();
  Vector3 velocity = Vector3::Zero();          ///< m/s
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s about the centroid
  bool fixed = false;                          ///< the whole block never moves; excludes fix, load and
                                               ///< velocity
  std::vector<SceneFix> fix;
  std::vector<SceneLoad> load;
  std::optional<SceneArray> array;  ///< empty in a scene that has been read: its copies are blocks there
};

/// [[assign]]: properties of the blocks matched by patterns. The last of several entries has priority, key by key;
/// supports and loads add up.
struct SceneAssign {
  std::vector<std::string> blocks;    ///< names or globs, each matches at least one block
  std::optional<SceneRegion> inside;  ///< only those of `blocks` inside
  std::optional<std::string> material;
  std::optional<int> order;
  bool automatic_order = false;  ///< order = "auto", which `order` is empty for
  std::optional<bool> fixed;
  std::optional<Vector3> velocity;
  std::optional<Vector3> angular_velocity;
  std::vector<SceneFix> fix;
  std::vector<SceneLoad> load;
};

}  // namespace ashlar
