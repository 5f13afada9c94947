// The fields of frames: their series, names, units and meanings.
#pragma once

#include <span>

namespace ashlar {

struct FrameField {
  const char* series;  ///< "blocks": of blocks.pvd
  const char* name;
  const char* unit;  ///< SI, "1": numbers without one
  const char* meaning;
};

/// All fields in the order of the reference.
[[nodiscard]] std::span<const FrameField> frame_fields();

}  // namespace ashlar
