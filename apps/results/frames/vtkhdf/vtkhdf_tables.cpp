// The tables of results.vtkhdf, and functions on whole files: appending the frames of another one, removing frames.
#include "apps/results/frames/vtkhdf/vtkhdf_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <utility>

#include "apps/results/frames/vtkhdf/vtkhdf_file.hpp"

namespace ashlar {

std::vector<std::string> series_of(const Hdf5File& file) {
  std::vector<std::string> series = file.names_in(vtkhdf_root);
  std::erase(series, "Assembly");
  return series;
}

FramePlace place_of(const Hdf5File& file, const std::string& group, std::uint64_t frame) {
  const auto at_frame = [&](const char* table) {
    return static_cast<std::uint64_t>(entry(file, group + "/Steps/" + table, frame));
  };
  return {at_frame("PartOffsets"), at_frame("PointOffsets"), at_frame("CellOffsets"),
          at_frame("ConnectivityIdOffsets")};
}

FrameCounts counts_of(const Hdf5File& file, const std::string& group, std::uint64_t part) {
  const auto of_part = [&](const char* table) {
    return static_cast<std::uint64_t>(entry(file, group + "/" + table, part));
  };
  return {of_part("NumberOfPoints"), of_part("NumberOfCells"), of_part("NumberOfConnectivityIds")};
}

std::int64_t entry(const Hdf5File& file, const std::string& table, std::uint64_t row) {
  return file.read<std::int64_t>(table, row, 1).front();
}

namespace {

/// @param shared true for the series whose tables all share
void copy_new_rows(const Hdf5File& from, Hdf5File& to, const std::string& group, bool shared) {
  const auto copy = [&](const std::string& table) {
    if (!to.exists(table)) to.add_table(table, from.table(table));
    to.add_rows_of(from, table);
  };
  for (const std::string folder : {"", "/Steps"}) {
    for (const std::string& name : from.names_in(group + folder)) {
      const bool is_table = !name.ends_with("Data") && !name.ends_with("DataOffsets") &&
                            name != "FieldDataSizes" && name != "Steps" && name != "Values";
      if (is_table) copy(group + folder + "/" + name);
    }
  }
  for (const std::string folder :
       {"/PointData", "/CellData", "/Steps/PointDataOffsets", "/Steps/CellDataOffsets"})
    for (const std::string& name : from.names_in(group + folder)) copy(group + folder + "/" + name);
  for (const std::string& name : shared_tables)
    if (shared) copy(group + "/" + name);
  to.set_attribute(group + "/Steps", "NSteps",
                   std::array{from.integer_attribute(group + "/Steps", "NSteps")});
}

/// Rows of a field's table up to its values in a frame.
std::uint64_t end_of_field(const Hdf5File& file, const std::string& offsets, std::uint64_t frame,
                           std::uint64_t rows) {
  return static_cast<std::uint64_t>(entry(file, offsets, frame)) + rows;
}

void cut_series(Hdf5File& file, const std::string& group, std::uint64_t frames) {
  const bool any = frames > 0;
  const FramePlace place = any ? place_of(file, group, frames - 1) : FramePlace{};
  const FrameCounts counts = any ? counts_of(file, group, place.part) : FrameCounts{};
  const std::string steps = group + "/Steps/";
  for (const auto& [kind, rows] :
       {std::pair("PointData", counts.points), std::pair("CellData", counts.cells)}) {
    for (const std::string& name : file.names_in(group + "/" + kind)) {
      const std::string offsets = steps + kind + "Offsets/" + name;
      file.resize(group + "/" + kind + "/" + name, any ? end_of_field(file, offsets, frames - 1, rows) : 0);
      file.resize(offsets, frames);
    }
  }
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    file.resize(group + "/" + name, any ? place.part + 1 : 0);
  if (file.exists(group + "/Points")) {
    file.resize(group + "/Points", place.point + counts.points);
    file.resize(group + "/Connectivity", place.connectivity + counts.connectivity);
    file.resize(group + "/Types", place.cell + counts.cells);
    file.resize(group + "/Offsets", any ? place.cell + place.part + counts.cells + 1 : 0);
  }
  for (const char* name :
       {"PartOffsets", "NumberOfParts", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"})
    file.resize(steps + name, frames);
  file.set_attribute(group + "/Steps", "NSteps", std::array{static_cast<std::int64_t>(frames)});
}

}  // namespace

void append_frames_of(const std::filesystem::path& other, const std::filesystem::path& path) {
  const Hdf5File from(other, Hdf5File::Access::read);
  Hdf5File to(path, Hdf5File::Access::change);
  const std::vector<std::string> series = series_of(from);
  if (series != series_of(to))
    throw std::runtime_error(fmt::format("{} and {} have different series", other.string(), path.string()));
  for (const std::string& name : series)
    copy_new_rows(from, to, vtkhdf_root + "/" + name, name == series.front());
  to.close();
}

void cut_vtkhdf(const std::filesystem::path& path, std::size_t frames) {
  Hdf5File file(path, Hdf5File::Access::change);
  const std::vector<std::string> series = series_of(file);
  if (series.empty())
    throw std::runtime_error(fmt::format("cannot resume {}: it has no series", path.string()));
  const std::string first = vtkhdf_root + "/" + series.front(), steps = first + "/Steps/";
  const std::uint64_t present = file.table(steps + "Values").rows;
  if (present < frames) {
    throw std::runtime_error(
        fmt::format("cannot resume {}: {} frames, {} were written", path.string(), present, frames));
  }
  for (const std::string& name : series) cut_series(file, vtkhdf_root + "/" + name, frames);
  const std::string sizes = steps + "FieldDataSizes/block_names";
  file.resize(
      first + "/FieldData/block_names",
      frames == 0
          ? 0
          : end_of_field(file, steps + "FieldDataOffsets/block_names", frames - 1,
                         static_cast<std::uint64_t>(file.read<std::int64_t>(sizes, frames - 1, 1)[1])));
  for (const std::string& name : shared_tables)
    if (name != "FieldData/block_names") file.resize(first + "/" + name, frames);
  file.close();
}

}  // namespace ashlar
