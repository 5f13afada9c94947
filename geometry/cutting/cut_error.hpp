// A cut that is impossible.
#pragma once

#include <stdexcept>

namespace ashlar {

/// The message reads "what is wrong (value), what is allowed", without a full stop.
struct CutError : std::runtime_error {
  using runtime_error::runtime_error;
};

}  // namespace ashlar
