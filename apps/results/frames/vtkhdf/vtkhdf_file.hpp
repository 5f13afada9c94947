// All frames of a run in one file: results.vtkhdf, in Kitware's format VTKHDF 2.2 (docs.vtk.org, VTKHDF file format),
// for ParaView and every HDF5 library. The type is PartitionedDataSetCollection: an unstructured grid for each series.
//
//   /VTKHDF                 attributes Version, Type
//     Assembly/SERIES/SERIES    soft link to /VTKHDF/SERIES, in a node of that name, which ParaView shows
//     SERIES                attributes Version, Type, Index
//       NumberOfPoints, NumberOfCells, NumberOfConnectivityIds   (#parts) int64
//       Points              (., 3) float64 or float32, m
//       Connectivity        (.) int64, point indices within the part
//       Offsets, Types      (.) int64: 0 and the end of each cell; uint8
//       PointData/NAME, CellData/NAME    (.) or (., components) float64, float32 or int32
//       FieldData/step      (#frames) int64, step of the run
//       FieldData/block_names  (.) UTF-8 texts, by the numbers of the fields `block`
//       Steps               attribute NSteps: frames
//         Values            (#frames) float64, times in s
//         PartOffsets, NumberOfParts, PointOffsets    (#frames) int64
//         CellOffsets, ConnectivityIdOffsets          (#frames, 1) int64
//         PointDataOffsets/NAME, CellDataOffsets/NAME, FieldDataOffsets/NAME   (#frames) int64
//         FieldDataSizes/NAME   (#frames, 2) int64: components, tuples
//
// Offsets say at which row the values of a frame begin. What equals the last frame bit for bit is not stored again: its
// offset repeats. So do cells, with their number of points: they are a part. New values begin with a chunk of their
// own, so that no chunk is written twice; rows between belong to no frame. A field that a frame of its series lacks is
// NaN or -1 there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "apps/results/frames/vtkhdf/hdf5_file.hpp"
#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

/// When a frame was written.
struct FrameTime {
  double time;  ///< s
  int step;
};

/// A frame of one series. Its time and block names are not used.
struct SeriesGrid {
  std::string series;  ///< "blocks" and the like
  UnstructuredGrid grid;
};

/// All functions throw std::runtime_error with the path and a reason.

/// Creates a file without frames. @param series at least one, each its own name
void create_vtkhdf(const std::filesystem::path& path, std::span<const std::string> series);

/// Appends a frame. @param grids one for each series of the file. @param block_names by number
/// @throws std::invalid_argument also as validate(UnstructuredGrid)
void append_vtkhdf(const std::filesystem::path& path, const FrameTime& frame,
                   std::span<const SeriesGrid> grids, std::span<const std::string> block_names);

/// Appends the frames of another file that has all frames of this one. @throws also if it has not the same series
void append_frames_of(const std::filesystem::path& other, const std::filesystem::path& path);

/// Removes all frames but the first ones. A file of which frames are removed and appended again has the contents of
/// one to which they were appended once. @throws also if it has fewer
void cut_vtkhdf(const std::filesystem::path& path, std::size_t frames);

/// Reads a file of append_vtkhdf, not VTKHDF in general.
class VtkhdfReader {
 public:
  explicit VtkhdfReader(std::filesystem::path path);

  [[nodiscard]] const std::vector<FrameTime>& frames() const { return frames_; }
  [[nodiscard]] bool has(const std::string& series) const;
  /// The grid as it was appended, rounded where it is stored so, otherwise bit for bit, with time and block names, without
  /// names of components. At most 16 MiB
  /// and 256 bytes for each byte of the file are allocated.
  [[nodiscard]] UnstructuredGrid read(const std::string& series, std::size_t frame) const;

 private:
  std::filesystem::path path_;
  Hdf5File file_;
  std::vector<FrameTime> frames_;
};

}  // namespace ashlar
