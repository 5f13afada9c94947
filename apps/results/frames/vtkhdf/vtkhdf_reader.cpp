#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "apps/results/frames/vtkhdf/vtkhdf_file.hpp"
#include "apps/results/frames/vtkhdf/vtkhdf_tables.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

/// Reads rows of one series, within a limit of memory. The library reads what a table claims, and a chunk that was
/// never written costs a file nothing.
class SeriesRows {
 public:
  SeriesRows(const Hdf5File& file, const std::filesystem::path& path, const std::string& series)
      : file_(file),
        path_(path),
        group_(vtkhdf_root + "/" + series + "/"),
        left_(free_bytes + most_expansion * std::filesystem::file_size(path)) {}

  template <class T>
  std::vector<T> rows(const std::string& table, std::int64_t start, std::int64_t count) {
    if (start < 0 || count < 0) fail("negative numbers in the places of " + table);
    const Hdf5Table layout = file_.table(group_ + table);
    const std::uint64_t bytes = static_cast<std::uint64_t>(std::max(layout.columns, 1)) * sizeof(T);
    // HDF5 reads whole chunks.
    const std::uint64_t chunk = layout.chunk_rows > left_ / bytes ? left_ + 1 : layout.chunk_rows * bytes;
    const auto wanted = static_cast<std::uint64_t>(count);
    if (chunk > left_ || wanted > left_ / bytes)
      fail("the arrays are larger than a file of this size can hold");
    left_ -= wanted * bytes;
    return file_.read<T>(group_ + table, static_cast<std::uint64_t>(start), wanted);
  }
  /// Numbers of double or single precision. @param stored which of both the table has
  std::vector<double> reals(const std::string& table, std::int64_t start, std::int64_t count,
                            StoredReal& stored) {
    const bool rounded = file_.table(group_ + table).type == Hdf5Type::real32;
    stored = rounded ? StoredReal::float32 : StoredReal::float64;
    if (!rounded) return rows<double>(table, start, count);
    const std::vector<float> values = rows<float>(table, start, count);
    if (values.size() > left_ / sizeof(double))
      fail("the arrays are larger than a file of this size can hold");
    left_ -= values.size() * sizeof(double);
    return {values.begin(), values.end()};
  }
  std::int64_t entry(const std::string& table, std::int64_t row) {
    return rows<std::int64_t>(table, row, 1).at(0);
  }

  std::vector<DataArray> fields(const std::string& kind, std::int64_t frame, std::int64_t count) {
    std::vector<DataArray> arrays;
    for (const std::string& name : file_.names_in(group_ + kind)) {
      const std::string table = kind + "/" + name;
      const Hdf5Table layout = file_.table(group_ + table);
      const std::int64_t start = entry("Steps/" + kind + "Offsets/" + name, frame);
      DataArray& array = arrays.emplace_back(DataArray{name, std::max(layout.columns, 1), {}, {}, {}});
      if (layout.type == Hdf5Type::integer32)
        array.values = rows<std::int32_t>(table, start, count);
      else
        array.values = reals(table, start, count, array.stored);
    }
    return arrays;
  }

 private:
  static constexpr std::size_t free_bytes = std::size_t{1} << 24;
  static constexpr std::size_t most_expansion = 256;

  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path_.string(), reason));
  }

  const Hdf5File& file_;
  const std::filesystem::path& path_;
  std::string group_;
  std::size_t left_;  ///< bytes
};

int checked_index(std::int64_t number) {
  if (number < 0 || number > std::numeric_limits<int>::max())
    throw std::runtime_error(fmt::format("index {} in the cells of a frame", number));
  return static_cast<int>(number);
}

}  // namespace

VtkhdfReader::VtkhdfReader(std::filesystem::path path)
    : path_(std::move(path)), file_(path_, Hdf5File::Access::read) {
  if (!file_.exists(vtkhdf_root + "/Assembly") ||
      file_.text_attribute(vtkhdf_root, "Type") != "PartitionedDataSetCollection")
    throw std::runtime_error(fmt::format("cannot read {}: no file of frames", path_.string()));
  const std::vector<std::string> series = series_of(file_);
  if (series.empty()) return;
  SeriesRows rows(file_, path_, series.front());
  const auto count =
      static_cast<std::int64_t>(file_.table(vtkhdf_root + "/" + series.front() + "/Steps/Values").rows);
  const std::vector<double> times = rows.rows<double>("Steps/Values", 0, count);
  const std::vector<std::int64_t> steps = rows.rows<std::int64_t>("FieldData/step", 0, count);
  naming_the_file(path_, [&] {
    for (std::size_t k = 0; k < times.size(); ++k) frames_.push_back({times[k], checked_index(steps[k])});
  });
}

bool VtkhdfReader::has(const std::string& series) const {
  return file_.exists(vtkhdf_root + "/" + series + "/Steps");
}

UnstructuredGrid VtkhdfReader::read(const std::string& series, std::size_t frame) const {
  SeriesRows rows(file_, path_, series);
  const auto k = static_cast<std::int64_t>(frame);
  const std::int64_t part = rows.entry("Steps/PartOffsets", k);
  const std::int64_t points = rows.entry("NumberOfPoints", part), cells = rows.entry("NumberOfCells", part);
  const std::int64_t cell = rows.entry("Steps/CellOffsets", k);
  UnstructuredGrid grid;
  const std::vector<double> places =
      rows.reals("Points", rows.entry("Steps/PointOffsets", k), points, grid.stored_points);
  const std::vector<std::int64_t> connectivity =
      rows.rows<std::int64_t>("Connectivity", rows.entry("Steps/ConnectivityIdOffsets", k),
                              rows.entry("NumberOfConnectivityIds", part));
  const std::vector<std::int64_t> offsets = rows.rows<std::int64_t>("Offsets", cell + part + 1, cells);
  for (const std::uint8_t type : rows.rows<std::uint8_t>("Types", cell, cells))
    grid.types.push_back(static_cast<VtkCellType>(type));
  grid.point_data = rows.fields("PointData", k, points);
  grid.cell_data = rows.fields("CellData", k, cells);
  grid.time = frames_.at(frame).time;
  const std::vector<std::int64_t> names = rows.rows<std::int64_t>("Steps/FieldDataSizes/block_names", k, 1);
  grid.block_names = rows.rows<std::string>(
      "FieldData/block_names", rows.entry("Steps/FieldDataOffsets/block_names", k), names.back());
  naming_the_file(path_, [&] {
    if (places.size() != 3 * static_cast<std::size_t>(points))
      throw std::runtime_error("points without three coordinates");
    for (std::size_t p = 0; p < places.size(); p += 3)
      grid.points.emplace_back(places[p], places[p + 1], places[p + 2]);
    for (const std::int64_t point : connectivity) grid.connectivity.push_back(checked_index(point));
    for (const std::int64_t end : offsets) grid.offsets.push_back(checked_index(end));
    validate(grid);
  });
  return grid;
}

}  // namespace ashlar
