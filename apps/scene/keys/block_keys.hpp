// Keys of [[block]] that other tables have too.
#pragma once

#include "apps/scene/keys/key.hpp"
#include "apps/scene/model/scene_block.hpp"

namespace ashlar::keys {

[[nodiscard]] Key<SceneBlock> order_of_block(const char* meaning);

}  // namespace ashlar::keys
