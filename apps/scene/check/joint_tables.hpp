// All tables of joints of a scene, for checks of keys that exclude each other.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// A table of joints and the law that it results in.
struct JointTablePath {
  std::string path;  ///< as in ScenePlaces
  SceneJointLaw law;
};

/// [contact], [[joint]] and [[stage.joint]].
[[nodiscard]] std::vector<JointTablePath> tables_of_joints(const Scene& scene);

}  // namespace ashlar
