// Tables of results.vtkhdf (vtkhdf_file.hpp), for its writer and the functions that cut and copy it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/results/frames/vtkhdf/hdf5_file.hpp"

namespace ashlar {

inline const std::string vtkhdf_root = "/VTKHDF";

/// Tables of the first series that are those of all others too: times, steps and names of blocks.
inline const std::array<std::string, 7> shared_tables = {"FieldData/step",
                                                         "FieldData/block_names",
                                                         "Steps/Values",
                                                         "Steps/FieldDataOffsets/step",
                                                         "Steps/FieldDataSizes/step",
                                                         "Steps/FieldDataOffsets/block_names",
                                                         "Steps/FieldDataSizes/block_names"};

/// Points and cells of a frame.
struct FrameCounts {
  std::uint64_t points = 0;
  std::uint64_t cells = 0;
  std::uint64_t connectivity = 0;
};

/// Rows at which a frame begins, in tables of its series.
struct FramePlace {
  std::uint64_t part = 0;
  std::uint64_t point = 0;
  std::uint64_t cell = 0;
  std::uint64_t connectivity = 0;
};

[[nodiscard]] std::vector<std::string> series_of(const Hdf5File& file);
/// A value of a table of integers.
[[nodiscard]] std::int64_t entry(const Hdf5File& file, const std::string& table, std::uint64_t row);
/// @param group of the series. @param frame an existing one
[[nodiscard]] FramePlace place_of(const Hdf5File& file, const std::string& group, std::uint64_t frame);
[[nodiscard]] FrameCounts counts_of(const Hdf5File& file, const std::string& group, std::uint64_t part);

}  // namespace ashlar
