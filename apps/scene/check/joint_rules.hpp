// Rules between the keys of a law of joints in [contact], [[joint]] and [[stage.joint]]: what it needs, and what it does not have
// beside it.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports faults of joints that crush, rough joints, and joints that stiffen as they close. Ties have none of these.
void check_joint_rules(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar
