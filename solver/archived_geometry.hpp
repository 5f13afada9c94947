// Stored members of classes of geometry that have constructors (byte_archive.hpp).
#pragma once

#include "geometry/subfaces/view_frame.hpp"
#include "solver/byte_archive.hpp"

namespace ashlar {

template <class Archive>
void visit_members(Archive& archive, ViewFrame& frame) {
  auto& [origin, e1, e2, w] = frame;
  archive(origin, e1, e2, w);
}

}  // namespace ashlar
