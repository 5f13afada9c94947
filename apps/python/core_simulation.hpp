// Simulations and their blocks for Python: a Run that several Python threads may query and step, one after the
// other.
#pragma once

#include <pybind11/pybind11.h>

namespace ashlar {

/// Adds the classes Simulation and Block, and the type of contact rows, to the extension.
void bind_simulation(pybind11::module_& module);

}  // namespace ashlar
