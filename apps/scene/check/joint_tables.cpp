#include "apps/scene/check/joint_tables.hpp"

#include <fmt/format.h>

namespace ashlar {

std::vector<JointTablePath> tables_of_joints(const Scene& scene) {
  std::vector<JointTablePath> tables = {{"contact", scene.contact.law}};
  const auto add = [&](const std::string& path, const SceneJoint& joint) {
    tables.push_back({path, scene.contact.law});
    override_law(tables.back().law, joint);
  };
  for (std::size_t k = 0; k < scene.joint.size(); ++k) add(fmt::format("joint.{}", k), scene.joint[k]);
  for (std::size_t s = 0; s < scene.stage.size(); ++s)
    for (std::size_t k = 0; k < scene.stage[s].joint.size(); ++k)
      add(fmt::format("stage.{}.joint.{}", s, k), scene.stage[s].joint[k]);
  return tables;
}

}  // namespace ashlar
