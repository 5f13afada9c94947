#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/mesh/binary_values.hpp"
#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/ply_header.hpp"

namespace ashlar {
namespace {

// Values of a text body: every item of an element has a line of its own.
class TextValues {
 public:
  explicit TextValues(TextScanner& scan) : scan_(scan) {}

  // Each property needs a digit and a blank or line end.
  [[nodiscard]] std::size_t most_items(const PlyElement& element) const {
    return scan_.rest().size() / std::max<std::size_t>(1, 2 * element.properties.size()) + 1;
  }
  void begin_item(const PlyElement& element) { scan_.require_line("the last " + element.name); }
  double value(const PlyProperty& property, PlyType type) {
    return is_integer(type) ? static_cast<double>(scan_.integer(property.name, low, high))
                            : scan_.number(property.name);
  }
  void end_item() { scan_.expect_end_of_line(); }
  void end_file() {
    if (!scan_.next_line()) return;
    scan_.word();
    scan_.fail("text after the last element", "the file must end here");
  }
  template <class Number>
  [[noreturn]] void fail(const std::string& what, Number /*value*/, const std::string& allowed) const {
    scan_.fail(what, allowed);
  }

 private:
  static constexpr long long low = std::numeric_limits<std::int32_t>::min();
  static constexpr long long high = std::numeric_limits<std::uint32_t>::max();
  TextScanner& scan_;
};

class BinaryValues {
 public:
  // @param start of the body in the file
  BinaryValues(std::string_view bytes, std::size_t start, std::endian order)
      : bytes_(bytes), file_size_(start + bytes.size()), order_(order) {}

  [[nodiscard]] std::size_t most_items(const PlyElement& element) const {
    std::size_t size = 0;
    for (const PlyProperty& p : element.properties) size += size_of(p.is_list ? p.count_type : p.type);
    return bytes_.size() / std::max<std::size_t>(1, size);
  }
  void begin_item(const PlyElement& element) { element_ = &element; }
  double value(const PlyProperty& property, PlyType type) {
    const auto size = static_cast<std::size_t>(size_of(type));
    if (bytes_.size() < size) {
      throw MeshFileError("file ends before " + property.name + " of the last " + element_->name, 0, 0);
    }
    const double result = decode(type);
    place_ = file_size_ - bytes_.size();
    bytes_.remove_prefix(size);
    return result;
  }
  void end_item() {}
  void end_file() const {
    if (bytes_.empty()) return;
    throw MeshFileError(std::to_string(bytes_.size()) + " bytes after the last element", 0, 0);
  }
  template <class Number>
  [[noreturn]] void fail(const std::string& what, Number value, const std::string& allowed) const {
    std::ostringstream text;
    text << what << " at byte " << place_ << " (" << value << "), " << allowed;
    throw MeshFileError(text.str(), 0, 0);
  }

 private:
  [[nodiscard]] double decode(PlyType type) const {
    switch (type) {
      case PlyType::int8:
        return read_binary<std::int8_t>(bytes_, order_);
      case PlyType::uint8:
        return read_binary<std::uint8_t>(bytes_, order_);
      case PlyType::int16:
        return read_binary<std::int16_t>(bytes_, order_);
      case PlyType::uint16:
        return read_binary<std::uint16_t>(bytes_, order_);
      case PlyType::int32:
        return read_binary<std::int32_t>(bytes_, order_);
      case PlyType::uint32:
        return read_binary<std::uint32_t>(bytes_, order_);
      case PlyType::float32:
        return read_binary<float>(bytes_, order_);
      case PlyType::float64:
        return read_binary<double>(bytes_, order_);
    }
    return 0.0;
  }

  std::string_view bytes_;
  std::size_t file_size_;
  std::size_t place_ = 0;  // of the last value in the file
  std::endian order_;
  const PlyElement* element_ = nullptr;
};

const PlyElement& find_element(const PlyHeader& header, std::string_view name) {
  const auto found = std::find_if(header.elements.begin(), header.elements.end(),
                                  [name](const PlyElement& e) { return e.name == name; });
  if (found == header.elements.end() || found->count == 0) {
    throw MeshFileError("file has no elements \"" + std::string(name) + "\"", 0, 0);
  }
  return *found;
}

int find_property(const PlyElement& element, std::initializer_list<std::string_view> names, bool is_list) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& p = element.properties[i];
    if (std::find(names.begin(), names.end(), p.name) != names.end() && p.is_list == is_list) {
      return static_cast<int>(i);
    }
  }
  throw MeshFileError("element " + element.name + " has no " + (is_list ? "list" : "number") + " \"" +
                          std::string(*names.begin()) + "\"",
                      0, 0);
}

// Reads the body in the order of the header; Values is TextValues or BinaryValues.
template <class Values>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, Values values) : header_(header), values_(values) {}

  PolygonSoup run() {
    const PlyElement& vertex = find_element(header_, "vertex");
    const PlyElement& face = find_element(header_, "face");
    axes_ = {find_property(vertex, {"x"}, false), find_property(vertex, {"y"}, false),
             find_property(vertex, {"z"}, false)};
    indices_ = find_property(face, {"vertex_indices", "vertex_index"}, true);
    point_count_ = vertex.count;
    if (!is_integer(face.properties[indices_].type)) {
      throw MeshFileError("type of vertex_indices must be an integer type", 0, 0);
    }
    for (const PlyElement& element : header_.elements)
      read_element(element, &element == &vertex, &element == &face);
    values_.end_file();
    return std::move(soup_);
  }

 private:
  void read_element(const PlyElement& element, bool is_vertex, bool is_face) {
    if (static_cast<std::size_t>(element.count) > values_.most_items(element)) {
      throw MeshFileError("number of elements \"" + element.name + "\" (" + std::to_string(element.count) +
                              "), the file is too short for them",
                          0, 0);
    }
    for (long long i = 0; i < element.count; ++i) {
      values_.begin_item(element);
      Vector3 point = Vector3::Zero();
      for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.is_list) {
          read_list(property, is_face && p == indices_);
          continue;
        }
        const double value = values_.value(property, property.type);
        const auto* const axis = std::find(axes_.begin(), axes_.end(), p);
        if (!is_vertex || axis == axes_.end()) continue;
        if (is_too_far(value)) values_.fail(property.name + " coordinate", value, "allowed -1e150 to 1e150");
        point[axis - axes_.begin()] = value;
      }
      values_.end_item();
      if (is_vertex) soup_.points.push_back(point);
    }
  }

  void read_list(const PlyProperty& property, bool is_corners) {
    const auto length = static_cast<long long>(values_.value(property, property.count_type));
    if (is_corners && length < 3) values_.fail("number of corners", length, "needs at least 3");
    if (length < 0) values_.fail("length of " + property.name, length, "must not be negative");
    // No reserve: a false length ends with the file.
    for (long long i = 0; i < length; ++i) {
      const double item = values_.value(property, property.type);
      if (!is_corners) continue;
      // The type is an integer one, so the item is whole.
      const auto value = static_cast<long long>(item);
      if (value < 0 || value >= point_count_) {
        values_.fail("point index", value, "allowed 0 to " + std::to_string(point_count_ - 1));
      }
      soup_.corners.push_back(static_cast<int>(value));
    }
    if (is_corners) soup_.face_ends.push_back(static_cast<int>(soup_.corners.size()));
  }

  const PlyHeader& header_;
  Values values_;
  std::array<int, 3> axes_{};
  int indices_ = 0;
  long long point_count_ = 0;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_ply(std::string_view text) {
  TextScanner scan(text, '\0');
  const PlyHeader header = read_ply_header(scan);
  if (header.format == PlyFormat::text) return BodyReader(header, TextValues(scan)).run();
  const std::endian order =
      header.format == PlyFormat::little_endian ? std::endian::little : std::endian::big;
  return BodyReader(header, BinaryValues(scan.rest(), text.size() - scan.rest().size(), order)).run();
}

}  // namespace ashlar
