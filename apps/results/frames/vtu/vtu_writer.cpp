#include "apps/results/frames/vtu/vtu_writer.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/xml_text.hpp"

namespace ashlar {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are declared little-endian");
static_assert(sizeof(Vector3) == 3 * sizeof(double), "points are written as they lie in memory");

// VTK's own block size; a reader decompresses the data block by block.
constexpr std::size_t kBlockBytes = std::size_t{1} << 15;
// Coordinates and stresses hardly compress: higher levels take four times as long for a few per cent.
constexpr int kCompressionLevel = Z_BEST_SPEED;

void append_uint64(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

// Appends the array as vtkZLibDataCompressor expects it: number of blocks, bytes of a block, bytes of the last block
// if that is shorter (otherwise 0), compressed bytes of each block, then the compressed blocks.
void append_compressed(std::string& bytes, std::span<const std::byte> data) {
  const std::size_t block_count = (data.size() + kBlockBytes - 1) / kBlockBytes;
  std::string blocks;
  append_uint64(bytes, block_count);
  append_uint64(bytes, kBlockBytes);
  append_uint64(bytes, data.size() % kBlockBytes);
  for (std::size_t start = 0; start < data.size(); start += kBlockBytes) {
    const auto block = data.subspan(start, std::min(kBlockBytes, data.size() - start));
    uLongf size = compressBound(block.size());
    const std::size_t old_size = blocks.size();
    blocks.resize(old_size + size);
    if (compress2(reinterpret_cast<Bytef*>(blocks.data() + old_size), &size,
                  reinterpret_cast<const Bytef*>(block.data()), block.size(), kCompressionLevel) != Z_OK) {
      throw std::runtime_error("zlib cannot compress a block of a .vtu file: out of memory");
    }
    blocks.resize(old_size + size);
    append_uint64(bytes, size);
  }
  bytes += blocks;
}

// An array of the file: the XML text before its place, and its bytes.
struct PlacedArray {
  std::string element;
  std::span<const std::byte> values;
  std::vector<float> rounded;  // that `values` refers to, or none
};

// The XML elements, and the arrays with their places in the appended bytes.
class VtuText {
 public:
  void add(std::string_view text) { pending_ += text; }

  template <class T>
  void add_array(std::string_view type, std::string_view attributes, std::span<const T> values) {
    pending_ +=
        fmt::format("        <DataArray type=\"{}\" {} format=\"appended\" offset=\"", type, attributes);
    arrays_.push_back({std::exchange(pending_, "\"/>\n"), std::as_bytes(values), {}});
  }

  void add_reals(StoredReal stored, std::string_view attributes, std::span<const double> values) {
    if (stored == StoredReal::float64) {
      add_array<double>("Float64", attributes, values);
    } else {
      std::vector<float> rounded = to_float32(values);
      add_array<float>("Float32", attributes, rounded);
      arrays_.back().rounded = std::move(rounded);
    }
  }

  void add_array(const DataArray& array) {
    std::string attributes =
        fmt::format("Name=\"{}\" NumberOfComponents=\"{}\"", escape_xml(array.name), array.components);
    for (std::size_t i = 0; i < array.component_names.size(); ++i) {
      attributes += fmt::format(" ComponentName{}=\"{}\"", i, escape_xml(array.component_names[i]));
    }
    if (const auto* reals = std::get_if<std::vector<double>>(&array.values)) {
      add_reals(array.stored, attributes, *reals);
    } else {
      add_array<std::int32_t>("Int32", attributes, std::get<std::vector<std::int32_t>>(array.values));
    }
  }

  // The last array's bytes come first. meshio moves every array in turn, in the order of the bytes, and looks up the
  // next one by its offset, first element first. In the order of the elements it may find one that it has moved to
  // that very offset (meshio 5.0 to 5.3, _parse_raw_binary).
  [[nodiscard]] std::pair<std::string, std::string> elements_and_bytes() const {
    std::string elements, appended;
    std::vector<std::size_t> offsets(arrays_.size());
    for (std::size_t k = arrays_.size(); k-- > 0;) {
      offsets[k] = appended.size();
      append_compressed(appended, arrays_[k].values);
    }
    for (std::size_t k = 0; k < arrays_.size(); ++k)
      elements += arrays_[k].element + fmt::to_string(offsets[k]);
    return {elements + pending_, std::move(appended)};
  }

 private:
  std::vector<PlacedArray> arrays_;
  std::string pending_;  // text after the last array
};

void check_arrays(const std::vector<DataArray>& arrays, std::size_t tuples, std::string_view where) {
  std::set<std::string_view> names;
  for (const DataArray& array : arrays) {
    const auto complain = [&](std::string_view what) {
      throw std::invalid_argument(fmt::format("{} array '{}': {}", where, array.name, what));
    };
    if (!names.insert(array.name).second) complain("the name is used twice");
    if (array.components < 1) complain("fewer than one component");
    if (array.components > most_components)
      complain(fmt::format("{} components, {} at most", array.components, most_components));
    const auto components = static_cast<std::size_t>(array.components);
    if (!array.component_names.empty() && array.component_names.size() != components) {
      complain(fmt::format("{} component names for {} components", array.component_names.size(), components));
    }
    const std::size_t size = std::visit([](const auto& values) { return values.size(); }, array.values);
    if (size != tuples * components) {
      complain(fmt::format("{} values, {} x {} needed", size, tuples, components));
    }
  }
}

void check_cells(const UnstructuredGrid& grid) {
  if (grid.offsets.size() != grid.types.size()) {
    throw std::invalid_argument(
        fmt::format("{} cell offsets for {} cell types", grid.offsets.size(), grid.types.size()));
  }
  int start = 0;
  for (const int end : grid.offsets) {
    if (end < start) throw std::invalid_argument(fmt::format("cell offset {} after {}", end, start));
    start = end;
  }
  if (static_cast<std::size_t>(start) != grid.connectivity.size()) {
    throw std::invalid_argument(
        fmt::format("the cells end at {}, the connectivity at {}", start, grid.connectivity.size()));
  }
  for (const int point : grid.connectivity) {
    if (point < 0 || static_cast<std::size_t>(point) >= grid.points.size()) {
      throw std::invalid_argument(fmt::format("a cell names point {} of {}", point, grid.points.size()));
    }
  }
}

void add_data(VtuText& text, std::string_view tag, const std::vector<DataArray>& arrays) {
  text.add(fmt::format("      <{}>\n", tag));
  for (const DataArray& array : arrays) text.add_array(array);
  text.add(fmt::format("      </{}>\n", tag));
}

/// Data of the file as a whole. Strings are arrays of their bytes, each with a zero at its end.
std::string field_data(const UnstructuredGrid& grid) {
  if (!grid.time && grid.block_names.empty()) return {};
  std::string text = "    <FieldData>\n";
  if (grid.time) {
    text += fmt::format(
        "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">\n{}\n"
        "      </DataArray>\n",
        *grid.time);
  }
  if (!grid.block_names.empty()) {
    text += fmt::format(
        "      <DataArray type=\"String\" Name=\"block_names\" NumberOfTuples=\"{}\" format=\"ascii\">\n",
        grid.block_names.size());
    for (const std::string& name : grid.block_names) {
      for (const char byte : name) text += fmt::format("{} ", static_cast<unsigned char>(byte));
      text += "0\n";
    }
    text += "      </DataArray>\n";
  }
  return text + "    </FieldData>\n";
}

}  // namespace

void UnstructuredGrid::add_cell(VtkCellType type, std::span<const int> cell_points) {
  connectivity.insert(connectivity.end(), cell_points.begin(), cell_points.end());
  offsets.push_back(static_cast<int>(connectivity.size()));
  types.push_back(type);
}

void validate(const UnstructuredGrid& grid) {
  check_cells(grid);
  check_arrays(grid.point_data, grid.points.size(), "point");
  check_arrays(grid.cell_data, grid.types.size(), "cell");
}

std::string to_vtu(const UnstructuredGrid& grid) {
  validate(grid);
  VtuText text;
  add_data(text, "PointData", grid.point_data);
  add_data(text, "CellData", grid.cell_data);
  text.add("      <Points>\n");
  const double* coordinates = grid.points.empty() ? nullptr : grid.points.front().data();
  text.add_reals(grid.stored_points, "Name=\"Points\" NumberOfComponents=\"3\"",
                 {coordinates, 3 * grid.points.size()});
  text.add("      </Points>\n      <Cells>\n");
  text.add_array<int>("Int32", "Name=\"connectivity\"", grid.connectivity);
  text.add_array<int>("Int32", "Name=\"offsets\"", grid.offsets);
  text.add_array<VtkCellType>("UInt8", "Name=\"types\"", grid.types);
  text.add("      </Cells>\n");
  const auto [elements, appended] = text.elements_and_bytes();

  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
      "  <UnstructuredGrid>\n"
      "{}"
      "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "{}"
      "    </Piece>\n"
      "  </UnstructuredGrid>\n"
      "  <AppendedData encoding=\"raw\">\n"
      "_{}\n"
      "  </AppendedData>\n"
      "</VTKFile>\n",
      field_data(grid), grid.points.size(), grid.types.size(), elements, appended);
}

void write_vtu(const std::filesystem::path& path, const UnstructuredGrid& grid) {
  write_file_atomically(path, to_vtu(grid), Durability::process);
}

}  // namespace ashlar
