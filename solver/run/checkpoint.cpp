#include "solver/run/checkpoint.hpp"

#include <stdexcept>
#include <utility>

namespace ashlar {

void write_snapshot(ByteWriter& writer, const SimulationSnapshot& snapshot) {
  writer(snapshot);
}

SimulationSnapshot read_snapshot(ByteReader& reader) {
  SimulationSnapshot snapshot;
  reader(snapshot);
  return snapshot;
}

std::string to_bytes(const SimulationSnapshot& snapshot) {
  ByteWriter writer;
  writer(snapshot);
  return writer.take();
}

SimulationSnapshot snapshot_from_bytes(std::string_view bytes) {
  ByteReader reader(bytes);
  SimulationSnapshot snapshot = read_snapshot(reader);
  if (!reader.at_end()) throw std::runtime_error("more is stored than a snapshot has");
  return snapshot;
}

}  // namespace ashlar
