#include "apps/results/frames/vtkhdf/vtkhdf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "apps/results/frames/vtkhdf/vtkhdf_tables.hpp"

namespace ashlar {
namespace {

/// 2.1 has collections, 2.2 data beside them; readers from 2.1 on accept both.
constexpr std::array<std::int64_t, 2> version = {2, 2};
constexpr std::uint64_t step_chunk = 128;       // frames
constexpr std::uint64_t least_chunk = 64;       // rows
constexpr std::uint64_t usual_chunk = 4096;     // rows, of a series that begins without any
constexpr std::uint64_t chunk_bytes = 1 << 20;  // that of HDF5's cache

std::uint64_t rounded_up(std::uint64_t rows, std::uint64_t chunk) {
  return (rows + chunk - 1) / chunk * chunk;
}

/// Rows of a chunk for frames of so many rows: a whole number of chunks, none beyond HDF5's cache.
std::uint64_t chunk_rows(std::uint64_t rows, std::uint64_t row_bytes) {
  if (rows == 0) rows = usual_chunk;
  const std::uint64_t chunks = (rows * row_bytes + chunk_bytes - 1) / chunk_bytes;
  return std::max((rows + chunks - 1) / chunks, least_chunk);
}

Hdf5Type table_type(StoredReal stored) {
  return stored == StoredReal::float64 ? Hdf5Type::real64 : Hdf5Type::real32;
}

std::uint64_t size_of(StoredReal stored) {
  return stored == StoredReal::float64 ? sizeof(double) : sizeof(float);
}

void append_entry(Hdf5File& file, const std::string& table, std::int64_t value) {
  file.write<std::int64_t>(table, file.table(table).rows, std::array{value});
}

/// Appends frames to one series.
class SeriesWriter {
 public:
  SeriesWriter(Hdf5File& file, const std::string& series)
      : file_(file),
        group_(vtkhdf_root + "/" + series),
        frames_(file.table(group_ + "/Steps/PartOffsets").rows) {
    if (frames_ == 0) return;
    last_ = place_of(file_, group_, frames_ - 1);
    last_counts_ = counts_of(file_, group_, last_.part);
  }

  void append(const UnstructuredGrid& grid) {
    const FrameCounts counts = {grid.points.size(), grid.types.size(), grid.connectivity.size()};
    if (!file_.exists(group_ + "/Points")) add_geometry_tables(counts, grid.stored_points);
    append_cells(grid, counts);
    std::vector<double> places;
    places.reserve(3 * counts.points);
    for (const Vector3& point : grid.points) places.insert(places.end(), {point.x(), point.y(), point.z()});
    append_entry(file_, group_ + "/Steps/PointOffsets",
                 static_cast<std::int64_t>(
                     stored_reals(group_ + "/Points", last_.point, last_counts_.points, places)));
    append_data("PointData", grid.point_data, counts.points, &FrameCounts::points);
    append_data("CellData", grid.cell_data, counts.cells, &FrameCounts::cells);
    append_entry(file_, group_ + "/Steps/NumberOfParts", 1);
    file_.set_attribute(group_ + "/Steps", "NSteps", std::array{static_cast<std::int64_t>(frames_ + 1)});
  }

 private:
  void add_geometry_tables(const FrameCounts& counts, StoredReal points) {
    const auto add = [&](const char* name, Hdf5Type type, int columns, std::uint64_t rows,
                         std::uint64_t bytes) {
      file_.add_table(group_ + "/" + name, {type, columns, chunk_rows(rows, bytes), true});
    };
    add("Points", table_type(points), 3, counts.points, 3 * size_of(points));
    add("Connectivity", Hdf5Type::integer64, 0, counts.connectivity, sizeof(std::int64_t));
    // Places in both depend on each other.
    add("Offsets", Hdf5Type::integer64, 0, counts.cells, sizeof(std::int64_t));
    add("Types", Hdf5Type::unsigned8, 0, counts.cells, sizeof(std::int64_t));
  }

  /// Row at which new values begin.
  std::uint64_t end_of(const std::string& table, bool any) const {
    const Hdf5Table layout = file_.table(table);
    return any ? rounded_up(layout.rows, layout.chunk_rows) : layout.rows;
  }

  /// Row of the values, which are written unless they are those of the last frame.
  /// @param last row and number of rows of the last frame
  template <class T>
  std::uint64_t stored(const std::string& table, std::uint64_t last, std::uint64_t last_rows,
                       const std::vector<T>& values) {
    if (frames_ > 0 && repeats(table, last, last_rows, values)) return last;
    const std::uint64_t start = end_of(table, !values.empty());
    file_.write<T>(table, start, values);
    return start;
  }

  /// The same for reals, rounded if the table has single precision.
  std::uint64_t stored_reals(const std::string& table, std::uint64_t last, std::uint64_t last_rows,
                             const std::vector<double>& values) {
    return file_.table(table).type == Hdf5Type::real32 ? stored(table, last, last_rows, to_float32(values))
                                                       : stored(table, last, last_rows, values);
  }

  /// True if the rows have these values. Most fields differ in their first values already.
  template <class T>
  [[nodiscard]] bool repeats(const std::string& table, std::uint64_t start, std::uint64_t rows,
                             const std::vector<T>& values) const {
    const auto width = static_cast<std::size_t>(std::max(file_.table(table).columns, 1));
    if (values.size() != rows * width) return false;
    for (std::uint64_t done = 0, count = std::min(rows, least_chunk); count > 0;
         done += count, count = rows - done) {
      const std::vector<T> known = file_.read<T>(table, start + done, count);
      if (std::memcmp(known.data(), values.data() + done * width, known.size() * sizeof(T)) != 0)
        return false;
    }
    return true;
  }

  void append_cells(const UnstructuredGrid& grid, const FrameCounts& counts) {
    const std::vector<std::int64_t> connectivity(grid.connectivity.begin(), grid.connectivity.end());
    std::vector<std::int64_t> offsets = {0};
    offsets.insert(offsets.end(), grid.offsets.begin(), grid.offsets.end());
    std::vector<std::uint8_t> types;
    for (const VtkCellType type : grid.types) types.push_back(static_cast<std::uint8_t>(type));
    FramePlace place = last_;
    if (frames_ == 0 || counts.points != last_counts_.points ||
        !last_cells_are(connectivity, offsets, types)) {
      const std::string part = group_ + "/NumberOf";
      place.part = file_.table(part + "Points").rows;
      place.cell = end_of(group_ + "/Types", counts.cells > 0);
      place.connectivity = end_of(group_ + "/Connectivity", counts.connectivity > 0);
      append_entry(file_, part + "Points", static_cast<std::int64_t>(counts.points));
      append_entry(file_, part + "Cells", static_cast<std::int64_t>(counts.cells));
      append_entry(file_, part + "ConnectivityIds", static_cast<std::int64_t>(counts.connectivity));
      file_.write<std::uint8_t>(group_ + "/Types", place.cell, types);
      file_.write<std::int64_t>(group_ + "/Connectivity", place.connectivity, connectivity);
      // Each part before has one entry more than cells.
      file_.write<std::int64_t>(group_ + "/Offsets", place.cell + place.part, offsets);
    }
    append_entry(file_, group_ + "/Steps/PartOffsets", static_cast<std::int64_t>(place.part));
    append_entry(file_, group_ + "/Steps/CellOffsets", static_cast<std::int64_t>(place.cell));
    append_entry(file_, group_ + "/Steps/ConnectivityIdOffsets",
                 static_cast<std::int64_t>(place.connectivity));
  }

  [[nodiscard]] bool last_cells_are(const std::vector<std::int64_t>& connectivity,
                                    const std::vector<std::int64_t>& offsets,
                                    const std::vector<std::uint8_t>& types) const {
    return repeats(group_ + "/Types", last_.cell, last_counts_.cells, types) &&
           repeats(group_ + "/Offsets", last_.cell + last_.part, last_counts_.cells + 1, offsets) &&
           repeats(group_ + "/Connectivity", last_.connectivity, last_counts_.connectivity, connectivity);
  }

  void append_data(const std::string& kind, const std::vector<DataArray>& arrays, std::uint64_t rows,
                   std::uint64_t FrameCounts::*count) {
    const std::string data = group_ + "/" + kind + "/", offsets = group_ + "/Steps/" + kind + "Offsets/";
    const std::vector<std::string> known = file_.names_in(group_ + "/" + kind);
    for (const DataArray& array : arrays) {
      const std::string table = data + array.name, offset = offsets + array.name;
      if (std::find(known.begin(), known.end(), array.name) == known.end())
        add_field(table, offset, array, rows, count);
      std::visit([&](const auto& values) { append_field(table, offset, values, last_counts_.*count); },
                 array.values);
    }
    for (const std::string& name : known) {
      const auto has_name = [&](const DataArray& array) { return array.name == name; };
      if (std::none_of(arrays.begin(), arrays.end(), has_name))
        append_missing(data + name, offsets + name, rows, last_counts_.*count);
    }
  }

  void add_field(const std::string& table, const std::string& offset, const DataArray& array,
                 std::uint64_t rows, std::uint64_t FrameCounts::*count) {
    const bool real = std::holds_alternative<std::vector<double>>(array.values);
    const int columns = array.components == 1 ? 0 : array.components;
    const std::uint64_t row_bytes =
        static_cast<std::uint64_t>(array.components) * (real ? size_of(array.stored) : sizeof(std::int32_t));
    file_.add_table(table, {real ? table_type(array.stored) : Hdf5Type::integer32, columns,
                            chunk_rows(rows, row_bytes), true});
    file_.add_table(offset, {Hdf5Type::integer64, 0, step_chunk});
    // Frames before the first with this field.
    const std::uint64_t frames = frames_;
    std::uint64_t last_rows = 0;
    for (frames_ = 0; frames_ < frames; ++frames_) {
      const std::uint64_t of_frame = counts_of(file_, group_, place_of(file_, group_, frames_).part).*count;
      append_missing(table, offset, of_frame, std::exchange(last_rows, of_frame));
    }
  }

  template <class T>
  void append_field(const std::string& table, const std::string& offset, const std::vector<T>& values,
                    std::uint64_t last_rows) {
    const auto last = frames_ == 0 ? 0 : static_cast<std::uint64_t>(entry(file_, offset, frames_ - 1));
    if constexpr (std::is_same_v<T, double>)
      append_entry(file_, offset, static_cast<std::int64_t>(stored_reals(table, last, last_rows, values)));
    else
      append_entry(file_, offset, static_cast<std::int64_t>(stored(table, last, last_rows, values)));
  }

  void append_missing(const std::string& table, const std::string& offset, std::uint64_t rows,
                      std::uint64_t last_rows) {
    const Hdf5Table layout = file_.table(table);
    const std::size_t values = rows * static_cast<std::uint64_t>(std::max(layout.columns, 1));
    if (layout.type == Hdf5Type::real64 || layout.type == Hdf5Type::real32) {
      constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
      append_field(table, offset, std::vector<double>(values, no_number), last_rows);
    } else {
      append_field(table, offset, std::vector<std::int32_t>(values, -1), last_rows);
    }
  }

  Hdf5File& file_;
  std::string group_;
  std::uint64_t frames_;
  FramePlace last_;          ///< of the last frame, if there is one
  FrameCounts last_counts_;  ///< the same
};

/// Times, steps and names of blocks, which all series share.
void append_shared(Hdf5File& file, const std::string& group, const FrameTime& frame,
                   std::span<const std::string> names) {
  const std::string steps = group + "/Steps/", values = steps + "Values";
  const std::uint64_t frames = file.table(values).rows;
  file.write<double>(values, frames, std::array{frame.time});
  append_entry(file, group + "/FieldData/step", frame.step);
  append_entry(file, steps + "FieldDataOffsets/step", static_cast<std::int64_t>(frames));
  file.write<std::int64_t>(steps + "FieldDataSizes/step", frames, std::array<std::int64_t, 2>{1, 1});
  const std::string offsets = steps + "FieldDataOffsets/block_names",
                    sizes = steps + "FieldDataSizes/block_names";
  const std::string table = group + "/FieldData/block_names";
  auto start = static_cast<std::int64_t>(file.table(table).rows);
  if (frames > 0) {
    const std::int64_t last = entry(file, offsets, frames - 1);
    const auto size = file.read<std::int64_t>(sizes, frames - 1, 1)[1];
    const auto known =
        file.read<std::string>(table, static_cast<std::uint64_t>(last), static_cast<std::uint64_t>(size));
    if (std::equal(known.begin(), known.end(), names.begin(), names.end())) start = last;
  }
  if (start == static_cast<std::int64_t>(file.table(table).rows))
    file.write<std::string>(table, static_cast<std::uint64_t>(start), names);
  append_entry(file, offsets, start);
  file.write<std::int64_t>(sizes, frames,
                           std::array<std::int64_t, 2>{1, static_cast<std::int64_t>(names.size())});
}

void add_series(Hdf5File& file, const std::string& series, std::int64_t index, const std::string& first) {
  const std::string group = vtkhdf_root + "/" + series;
  for (const char* part : {"", "/PointData", "/CellData", "/FieldData", "/Steps", "/Steps/PointDataOffsets",
                           "/Steps/CellDataOffsets", "/Steps/FieldDataOffsets", "/Steps/FieldDataSizes"})
    file.add_group(group + part);
  file.set_attribute(group, "Version", version);
  file.set_attribute(group, "Type", "UnstructuredGrid");
  file.set_attribute(group, "Index", std::array{index});
  file.set_attribute(group + "/Steps", "NSteps", std::array<std::int64_t, 1>{0});
  const Hdf5Table column{Hdf5Type::integer64, 0, step_chunk};
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds", "Steps/PartOffsets",
                           "Steps/NumberOfParts", "Steps/PointOffsets"})
    file.add_table(group + "/" + name, column);
  for (const char* name : {"Steps/CellOffsets", "Steps/ConnectivityIdOffsets"})
    file.add_table(group + "/" + name, {Hdf5Type::integer64, 1, step_chunk});
  for (const std::string& name : shared_tables) {
    const std::string table = group + "/" + name;
    if (series != first)
      file.add_name(vtkhdf_root + "/" + first + "/" + name, table);
    else if (name == "Steps/Values")
      file.add_table(table, {Hdf5Type::real64, 0, step_chunk});
    else if (name == "FieldData/block_names")
      file.add_table(table, {Hdf5Type::text, 0, step_chunk});
    else
      file.add_table(table,
                     {Hdf5Type::integer64, name.find("Sizes") == std::string::npos ? 0 : 2, step_chunk});
  }
  const std::string node = vtkhdf_root + "/Assembly/" + series;
  file.add_group(node);
  file.add_soft_link(group, node + "/" + series);
}

}  // namespace

void create_vtkhdf(const std::filesystem::path& path, std::span<const std::string> series) {
  Hdf5File file(path, Hdf5File::Access::create);
  file.add_group(vtkhdf_root);
  file.set_attribute(vtkhdf_root, "Version", version);
  file.set_attribute(vtkhdf_root, "Type", "PartitionedDataSetCollection");
  file.add_group(vtkhdf_root + "/Assembly");
  for (std::size_t k = 0; k < series.size(); ++k)
    add_series(file, series[k], static_cast<std::int64_t>(k), series.front());
  file.close();
}

void append_vtkhdf(const std::filesystem::path& path, const FrameTime& frame,
                   std::span<const SeriesGrid> grids, std::span<const std::string> block_names) {
  for (const SeriesGrid& of : grids) validate(of.grid);
  Hdf5File file(path, Hdf5File::Access::change);
  const std::vector<std::string> series = series_of(file);
  for (const std::string& name : series) {
    const auto has_name = [&](const SeriesGrid& of) { return of.series == name; };
    const auto of = std::find_if(grids.begin(), grids.end(), has_name);
    if (of == grids.end()) throw std::invalid_argument(fmt::format("a frame without series '{}'", name));
    SeriesWriter(file, name).append(of->grid);
  }
  append_shared(file, vtkhdf_root + "/" + series.front(), frame, block_names);
  file.close();
}

}  // namespace ashlar
