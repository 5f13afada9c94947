#include <stdexcept>

#include "fuzz/targets.hpp"
#include "solver/run/checkpoint.hpp"

namespace ashlar::fuzz {

bool checkpoint(std::string_view bytes) {
  try {
    const SimulationSnapshot snapshot = snapshot_from_bytes(bytes);
    // Maps may be stored in another order than they are written in, hence not the same bytes.
    const std::string written = to_bytes(snapshot);
    require(to_bytes(snapshot_from_bytes(written)) == written, "what is written is read back");
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace ashlar::fuzz
