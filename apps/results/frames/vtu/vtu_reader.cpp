#include "apps/results/frames/vtu/vtu_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/results/text/xml_text.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "geometry/mesh/text_scanner.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

template <class T>
T number(std::string_view text) {
  T value{};
  const auto [end, error] = parse_number(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(fmt::format("no number ({})", printable(text)));
  return value;
}

std::string required_attribute(std::string_view tag, std::string_view name) {
  std::optional<std::string> value = xml_attribute(tag, name);
  if (!value) fail(fmt::format("no {} in '{}'", name, printable(tag)));
  return *std::move(value);
}

/// Memory limit for the arrays of one file, independent of the sizes it claims.
///
/// Deflate never expands by more than 1032, which bounds each block. A frame as a whole compresses far less, as all
/// points and cells differ: at the writer's level zeros alone give a ratio of 192.
class Allowance {
 public:
  explicit Allowance(std::size_t file_bytes) : left_(free_bytes + most_expansion * file_bytes) {}

  void take(std::size_t bytes) {
    if (bytes > left_) fail("the arrays are larger than a file of this size can hold");
    left_ -= bytes;
  }

 private:
  static constexpr std::size_t free_bytes = std::size_t{1} << 24;
  static constexpr std::size_t most_expansion = 256;
  std::size_t left_;
};

/// Reads one array of the appended data in the layout of the writer's append_compressed.
class CompressedArray {
 public:
  CompressedArray(std::string_view appended, std::size_t offset) : bytes_(appended) {
    if (offset > bytes_.size()) fail("the file is cut");
    bytes_.remove_prefix(offset);
    const std::uint64_t blocks = take_uint64();
    block_bytes_ = take_uint64();
    const std::uint64_t last_bytes = take_uint64();
    if (blocks > bytes_.size() / sizeof blocks || block_bytes_ > largest_block || last_bytes > block_bytes_) {
      fail("a damaged array header");
    }
    size_ = blocks == 0 ? 0 : (blocks - 1) * block_bytes_ + (last_bytes == 0 ? block_bytes_ : last_bytes);
    for (std::uint64_t k = 0; k < blocks; ++k) packed_.push_back(take_uint64());
    std::size_t left = bytes_.size();
    for (std::size_t k = 0; k < packed_.size(); ++k) {
      if (packed_[k] > left) fail("the file is cut");
      left -= packed_[k];
      if (unpacked_size(k) > most_expansion * packed_[k]) fail("a damaged array header");
    }
    end_ = appended.size() - left;
  }

  /// End of the array in the appended data.
  [[nodiscard]] std::size_t end() const { return end_; }

  template <class T>
  std::vector<T> values(std::size_t tuples, std::size_t components, Allowance& allowance) {
    // By division, as the product of claimed sizes may overflow.
    const std::size_t tuple_bytes = components * sizeof(T);
    if (size_ % tuple_bytes != 0 || size_ / tuple_bytes != tuples)
      fail(fmt::format("an array of {} bytes for {} x {} values", size_, tuples, components));
    allowance.take(size_);
    std::vector<T> result(tuples * components);
    unpack(reinterpret_cast<Bytef*>(result.data()));
    return result;
  }

  /// Numbers of type Float64 or Float32.
  std::vector<double> reals(StoredReal stored, std::size_t tuples, std::size_t components,
                            Allowance& allowance) {
    if (stored == StoredReal::float64) return values<double>(tuples, components, allowance);
    const std::vector<float> rounded = values<float>(tuples, components, allowance);
    allowance.take(rounded.size() * sizeof(double));
    return {rounded.begin(), rounded.end()};
  }

  template <class T>
  std::vector<T> values(Allowance& allowance) {
    return values<T>(size_ / sizeof(T), 1, allowance);
  }

 private:
  static constexpr std::uint64_t largest_block = std::uint64_t{1} << 24;
  static constexpr std::uint64_t most_expansion = 1032;

  [[nodiscard]] std::size_t unpacked_size(std::size_t block) const {
    return std::min<std::size_t>(block_bytes_, size_ - block * block_bytes_);
  }

  void unpack(Bytef* place) {
    for (std::size_t k = 0; k < packed_.size(); ++k) {
      uLongf size = unpacked_size(k);
      uLong used = packed_[k];
      if (uncompress2(place, &size, reinterpret_cast<const Bytef*>(bytes_.data()), &used) != Z_OK ||
          size != unpacked_size(k) || used != packed_[k]) {
        fail("a damaged array");
      }
      bytes_.remove_prefix(packed_[k]);
      place += size;
    }
  }

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
  std::size_t end_ = 0;
};

/// The grid during reading, element by element of the file.
class GridReader {
 public:
  GridReader(std::string_view appended, std::size_t file_bytes)
      : appended_(appended), allowance_(file_bytes) {}

  void read_line(std::string_view line) {
    if (line.find("<FieldData>") != std::string_view::npos) {
      in_field_data_ = true;
    } else if (line.find("</FieldData>") != std::string_view::npos) {
      in_field_data_ = false;
    } else if (in_field_data_) {
      read_field_line(line);
    } else if (line.find("<Piece ") != std::string_view::npos) {
      read_piece(line);
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

  UnstructuredGrid take() {
    if (names_left_ > 0 || in_names_) fail("names of blocks are cut");
    return std::move(grid_);
  }

 private:
  enum class Section { none, point_data, cell_data, points, cells };

  void read_piece(std::string_view tag) {
    if (has_piece_) fail("more than one piece");
    has_piece_ = true;
    points_ = number<std::size_t>(required_attribute(tag, "NumberOfPoints"));
    cells_ = number<std::size_t>(required_attribute(tag, "NumberOfCells"));
  }

  /// Names of blocks; the time is that of the .pvd file.
  void read_field_line(std::string_view line) {
    if (line.find("<DataArray ") != std::string_view::npos) {
      in_names_ = xml_attribute(line, "Name") == "block_names";
      if (in_names_) names_left_ = number<std::size_t>(required_attribute(line, "NumberOfTuples"));
    } else if (line.find("</DataArray>") != std::string_view::npos) {
      in_names_ = false;
    } else if (in_names_) {
      if (names_left_-- == 0) fail("more names of blocks than it says");
      grid_.block_names.push_back(name_of_bytes(line));
    }
  }

  /// "97 49 0" is a1.
  static std::string name_of_bytes(std::string_view line) {
    std::string name;
    for (;;) {
      const std::size_t end = std::min(line.find(' '), line.size());
      const auto byte = number<unsigned char>(line.substr(0, end));
      if (byte == 0) return name;
      name += static_cast<char>(byte);
      line.remove_prefix(std::min(end + 1, line.size()));
    }
  }

  void read_array(std::string_view tag) {
    const auto offset = number<std::size_t>(required_attribute(tag, "offset"));
    CompressedArray array(appended_, offset);
    take_bytes(offset, array.end());
    switch (section_) {
      case Section::point_data:
        grid_.point_data.push_back(data_array(tag, array, points_));
        return;
      case Section::cell_data:
        grid_.cell_data.push_back(data_array(tag, array, cells_));
        return;
      case Section::points:
        grid_.stored_points = stored_real(tag, "Points", "Float64 or Float32");
        grid_.points = points_of(array.reals(grid_.stored_points, points_, 3, allowance_));
        return;
      case Section::cells:
        read_cells(tag, array);
        return;
      case Section::none:
        fail("an array outside of all sections");
    }
  }

  /// Prevents a file from claiming the same bytes for many arrays.
  void take_bytes(std::size_t start, std::size_t end) {
    const auto [place, is_new] = read_.try_emplace(start, end);
    const bool overlaps = !is_new || (std::next(place) != read_.end() && std::next(place)->first < end) ||
                          (place != read_.begin() && std::prev(place)->second > start);
    if (overlaps) fail("arrays overlap");
  }

  static std::vector<Vector3> points_of(const std::vector<double>& values) {
    std::vector<Vector3> points;
    points.reserve(values.size() / 3);
    for (std::size_t i = 0; i < values.size(); i += 3)
      points.emplace_back(values[i], values[i + 1], values[i + 2]);
    return points;
  }

  void read_cells(std::string_view tag, CompressedArray& array) {
    const std::string name = required_attribute(tag, "Name");
    if (name == "types") {
      require_type(tag, "UInt8");
      grid_.types = array.values<VtkCellType>(cells_, 1, allowance_);
    } else if (name == "connectivity" || name == "offsets") {
      require_type(tag, "Int32");
      if (name == "offsets")
        grid_.offsets = array.values<int>(cells_, 1, allowance_);
      else
        grid_.connectivity = array.values<int>(allowance_);
    }
  }

  static void require_type(std::string_view tag, std::string_view needed) {
    const std::string type = required_attribute(tag, "type");
    if (type != needed) fail(fmt::format("an array of type {}, {} is needed", printable(type), needed));
  }

  DataArray data_array(std::string_view tag, CompressedArray& array, std::size_t tuples) {
    DataArray data;
    data.name = required_attribute(tag, "Name");
    data.components = number<int>(required_attribute(tag, "NumberOfComponents"));
    if (data.components < 1 || data.components > most_components)
      fail(fmt::format("array '{}' of {} components, 1 to {} are allowed", printable(data.name),
                       data.components, most_components));
    for (int i = 0; i < data.components; ++i) {
      if (auto name = xml_attribute(tag, fmt::format("ComponentName{}", i)))
        data.component_names.push_back(*std::move(name));
    }
    const auto components = static_cast<std::size_t>(data.components);
    if (required_attribute(tag, "type") == "Int32") {
      data.values = array.values<std::int32_t>(tuples, components, allowance_);
    } else {
      data.stored = stored_real(tag, data.name, "Float64, Float32 or Int32");
      data.values = array.reals(data.stored, tuples, components, allowance_);
    }
    return data;
  }

  static StoredReal stored_real(std::string_view tag, const std::string& name, std::string_view needed) {
    const std::string type = required_attribute(tag, "type");
    if (type == "Float32") return StoredReal::float32;
    if (type != "Float64")
      fail(fmt::format("array '{}' of type {}, {} is needed", printable(name), printable(type), needed));
    return StoredReal::float64;
  }

  std::string_view appended_;
  Allowance allowance_;
  std::map<std::size_t, std::size_t> read_;  ///< start and end of the arrays read, in the appended data
  Section section_ = Section::none;
  bool in_field_data_ = false;
  bool in_names_ = false;       ///< of blocks, in the field data
  std::size_t names_left_ = 0;  ///< number of names still to be read
  bool has_piece_ = false;
  std::size_t points_ = 0;
  std::size_t cells_ = 0;
  UnstructuredGrid grid_;
};

}  // namespace

UnstructuredGrid from_vtu(std::string_view bytes) {
  constexpr std::string_view data_start = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t split = bytes.find(data_start);
  if (bytes.find("<VTKFile type=\"UnstructuredGrid\"") == std::string_view::npos ||
      split == std::string_view::npos) {
    fail("it is no frame of a result folder");
  }
  GridReader reader(bytes.substr(split + data_start.size()), bytes.size());
  std::string_view elements = bytes.substr(0, split);
  while (!elements.empty()) {
    const std::size_t end = std::min(elements.find('\n'), elements.size() - 1);
    reader.read_line(elements.substr(0, end));
    elements.remove_prefix(end + 1);
  }
  UnstructuredGrid grid = reader.take();
  try {
    validate(grid);
  } catch (const std::invalid_argument& error) {
    fail(error.what());
  }
  return grid;
}

UnstructuredGrid read_vtu(const std::filesystem::path& path) {
  return naming_the_file(path, [&] { return from_vtu(whole_file(path)); });
}

std::vector<PvdFrame> from_pvd(std::string_view text) {
  if (text.find("<VTKFile type=\"Collection\"") == std::string_view::npos) fail("it is no .pvd file");
  std::vector<PvdFrame> frames;
  constexpr std::string_view start = "<DataSet ";
  for (std::size_t at = text.find(start); at != std::string_view::npos; at = text.find(start)) {
    text.remove_prefix(at);
    const std::size_t end = text.find('>');
    if (end == std::string_view::npos) fail("the file is cut");
    const std::string_view tag = text.substr(0, end);
    const auto time = number<double>(required_attribute(tag, "timestep"));
    if (!std::isfinite(time)) fail(fmt::format("a frame at time {}", time));
    frames.push_back({time, required_attribute(tag, "file")});
    text.remove_prefix(end);
  }
  return frames;
}

std::vector<PvdFrame> read_pvd(const std::filesystem::path& path) {
  return naming_the_file(path, [&] { return from_pvd(whole_file(path)); });
}

}  // namespace ashlar
