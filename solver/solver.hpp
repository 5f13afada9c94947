// The public interface of this layer: a simulation of blocks, the ground around them, its settings, and its state as
// bytes. Headers not included from here are internal and not installed.
#pragma once

#include "mechanics/mechanics.hpp"
#include "solver/ground/ground_boundary.hpp"
#include "solver/ground/ground_stress.hpp"
#include "solver/ground/side_layers.hpp"
#include "solver/ground/tied_pairs.hpp"
#include "solver/ground/water_pressure.hpp"
#include "solver/library_versions.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/run/simulation.hpp"
#include "solver/settings.hpp"
#include "solver/state/automatic.hpp"
