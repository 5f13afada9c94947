#include "apps/vtu_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/xml_text.hpp"

namespace ashlar {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

template <class T>
T number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) fail(fmt::format("no number ({})", text));
  return value;
}

std::string required_attribute(std::string_view tag, std::string_view name) {
  std::optional<std::string> value = xml_attribute(tag, name);
  if (!value) fail(fmt::format("no {} in '{}'", name, tag));
  return *std::move(value);
}

/// Reads one array of the appended data, laid out as append_compressed of the writer does.
class CompressedArray {
 public:
  CompressedArray(std::string_view appended, std::size_t offset) : bytes_(appended) {
    if (offset > bytes_.size()) fail("the file is cut");
    bytes_.remove_prefix(offset);
    const std::uint64_t blocks = take_uint64();
    block_bytes_ = take_uint64();
    const std::uint64_t last_bytes = take_uint64();
    // No block of a sound file is larger than the writer's; more would only be memory asked for by damage.
    if (blocks > bytes_.size() / sizeof blocks || block_bytes_ > largest_block || last_bytes > block_bytes_) {
      fail("a damaged array header");
    }
    for (std::uint64_t k = 0; k < blocks; ++k) packed_.push_back(take_uint64());
    size_ = blocks == 0 ? 0 : (blocks - 1) * block_bytes_ + (last_bytes == 0 ? block_bytes_ : last_bytes);
  }

  template <class T>
  std::vector<T> values(std::size_t count) {
    if (count * sizeof(T) != size_) fail(fmt::format("an array of {} bytes for {} values", size_, count));
    std::vector<T> result(count);
    auto* place = reinterpret_cast<Bytef*>(result.data());
    std::size_t left = size_;
    for (const std::uint64_t packed : packed_) {
      if (packed > bytes_.size()) fail("the file is cut");
      const std::size_t expected = std::min<std::size_t>(left, block_bytes_);
      uLongf size = expected;
      uLong used = packed;
      if (uncompress2(place, &size, reinterpret_cast<const Bytef*>(bytes_.data()), &used) != Z_OK ||
          size != expected || used != packed) {
        fail("a damaged array");
      }
      bytes_.remove_prefix(packed);
      place += size;
      left -= size;
    }
    return result;
  }

  template <class T>
  std::vector<T> values() {
    return values<T>(size_ / sizeof(T));
  }

 private:
  static constexpr std::uint64_t largest_block = std::uint64_t{1} << 24;

  std::uint64_t take_uint64() {
    std::uint64_t value = 0;
    if (bytes_.size() < sizeof value) fail("the file is cut");
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }

  std::string_view bytes_;
  std::uint64_t block_bytes_ = 0;
  std::vector<std::uint64_t> packed_;
  std::size_t size_ = 0;
};

/// The grid as it grows, element by element of the file.
class GridReader {
 public:
  explicit GridReader(std::string_view appended) : appended_(appended) {}

  void read_line(std::string_view line) {
    if (line.find("<Piece ") != std::string_view::npos) {
      points_ = number<std::size_t>(required_attribute(line, "NumberOfPoints"));
      cells_ = number<std::size_t>(required_attribute(line, "NumberOfCells"));
    } else if (line.find("<PointData>") != std::string_view::npos) {
      section_ = Section::point_data;
    } else if (line.find("<CellData>") != std::string_view::npos) {
      section_ = Section::cell_data;
    } else if (line.find("<Points>") != std::string_view::npos) {
      section_ = Section::points;
    } else if (line.find("<Cells>") != std::string_view::npos) {
      section_ = Section::cells;
    } else if (line.find("<DataArray ") != std::string_view::npos) {
      read_array(line);
    }
  }

  UnstructuredGrid take() { return std::move(grid_); }

 private:
  enum class Section { none, point_data, cell_data, points, cells };

  void read_array(std::string_view tag) {
    CompressedArray array(appended_, number<std::size_t>(required_attribute(tag, "offset")));
    switch (section_) {
      case Section::point_data:
        grid_.point_data.push_back(data_array(tag, array, points_));
        return;
      case Section::cell_data:
        grid_.cell_data.push_back(data_array(tag, array, cells_));
        return;
      case Section::points: {
        const auto values = array.values<double>(3 * points_);
        for (std::size_t i = 0; i < points_; ++i)
          grid_.points.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
        return;
      }
      case Section::cells:
        read_cells(required_attribute(tag, "Name"), array);
        return;
      case Section::none:
        fail("an array outside of all sections");
    }
  }

  void read_cells(const std::string& name, CompressedArray& array) {
    if (name == "connectivity") grid_.connectivity = array.values<int>();
    if (name == "offsets") grid_.offsets = array.values<int>(cells_);
    if (name == "types") grid_.types = array.values<VtkCellType>(cells_);
  }

  static DataArray data_array(std::string_view tag, CompressedArray& array, std::size_t tuples) {
    DataArray data;
    data.name = required_attribute(tag, "Name");
    data.components = number<int>(required_attribute(tag, "NumberOfComponents"));
    for (int i = 0; i < data.components; ++i) {
      if (auto name = xml_attribute(tag, fmt::format("ComponentName{}", i)))
        data.component_names.push_back(*std::move(name));
    }
    const std::size_t count = tuples * static_cast<std::size_t>(data.components);
    if (required_attribute(tag, "type") == "Float64") {
      data.values = array.values<double>(count);
    } else {
      data.values = array.values<std::int32_t>(count);
    }
    return data;
  }

  std::string_view appended_;
  Section section_ = Section::none;
  std::size_t points_ = 0;
  std::size_t cells_ = 0;
  UnstructuredGrid grid_;
};

std::string whole_file(const std::filesystem::path& path) {
  std::ifstream input(path, std::ios::binary);
  if (!input) fail("it cannot be opened");
  return {std::istreambuf_iterator<char>(input), {}};
}

template <class Read>
auto naming_the_file(const std::filesystem::path& path, Read read) {
  try {
    return read(whole_file(path));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

}  // namespace

UnstructuredGrid from_vtu(std::string_view bytes) {
  constexpr std::string_view data_start = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t split = bytes.find(data_start);
  if (bytes.find("<VTKFile type=\"UnstructuredGrid\"") == std::string_view::npos ||
      split == std::string_view::npos) {
    fail("it is no frame of a result folder");
  }
  GridReader reader(bytes.substr(split + data_start.size()));
  std::string_view elements = bytes.substr(0, split);
  while (!elements.empty()) {
    const std::size_t end = std::min(elements.find('\n'), elements.size() - 1);
    reader.read_line(elements.substr(0, end));
    elements.remove_prefix(end + 1);
  }
  UnstructuredGrid grid = reader.take();
  validate(grid);
  return grid;
}

UnstructuredGrid read_vtu(const std::filesystem::path& path) {
  return naming_the_file(path, [](const std::string& bytes) { return from_vtu(bytes); });
}

std::vector<PvdFrame> read_pvd(const std::filesystem::path& path) {
  return naming_the_file(path, [](std::string_view text) {
    if (text.find("<VTKFile type=\"Collection\"") == std::string_view::npos) fail("it is no .pvd file");
    std::vector<PvdFrame> frames;
    constexpr std::string_view start = "<DataSet ";
    for (std::size_t at = text.find(start); at != std::string_view::npos; at = text.find(start, at + 1)) {
      const std::string_view tag = text.substr(at, text.find('>', at) - at);
      frames.push_back(
          {number<double>(required_attribute(tag, "timestep")), required_attribute(tag, "file")});
    }
    return frames;
  });
}

}  // namespace ashlar
