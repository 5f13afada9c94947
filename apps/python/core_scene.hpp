// A scene in the Python module.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "apps/scene/assemble/scene_loading.hpp"

namespace ashlar {

/// A scene and its faults.
struct CoreScene {
  std::shared_ptr<const LoadedScene> loaded;  ///< null: there are errors
  std::vector<Diagnostic> faults;             ///< errors and warnings

  /// @throws std::invalid_argument if there are errors
  [[nodiscard]] const std::shared_ptr<const LoadedScene>& good() const {
    if (!loaded) throw std::invalid_argument("the scene has errors");
    return loaded;
  }
};

/// For a class whose objects are made by the extension only: Python's NAME.__new__(NAME) would be empty.
inline pybind11::custom_type_setup made_here() {
  return pybind11::custom_type_setup([](PyHeapTypeObject* type) {
    type->ht_type.tp_new = [](PyTypeObject* of, PyObject*, PyObject*) -> PyObject* {
      PyErr_Format(PyExc_TypeError, "objects of %s are made by ashlar alone", of->tp_name);
      return nullptr;
    };
  });
}

}  // namespace ashlar
