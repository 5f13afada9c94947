// The public interface of this layer, installed as <ashlar/scene.hpp>: scenes read from TOML and checked, and
// simulations built from them. Headers not included from here are internal and not installed.
#pragma once

#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/initial_state.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/check/warnings/loose_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/solver.hpp"
