// The public interface of this layer, installed as <ashlar/scene.hpp>: scenes read from TOML and checked, and
// simulations built from them. Headers not included from here are internal and not installed.
#pragma once

#include "apps/scene/build_simulation.hpp"
#include "apps/scene/diagnostics.hpp"
#include "apps/scene/initial_state.hpp"
#include "apps/scene/loose_blocks.hpp"
#include "apps/scene/scene.hpp"
#include "apps/scene/scene_loading.hpp"
#include "apps/scene/scene_stages.hpp"
#include "solver/solver.hpp"
