// Vectors as values of rows and arrays.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Appends x, y and z.
inline void append(std::vector<double>& values, const Vector3& vector) {
  values.insert(values.end(), {vector.x(), vector.y(), vector.z()});
}

}  // namespace ashlar
