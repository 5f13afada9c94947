#include "apps/scene/meshes/gltf_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "apps/scene/meshes/base64.hpp"
#include "geometry/mesh/binary_values.hpp"
#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

namespace fs = std::filesystem;

// glTF's numbers of component types (section 3.6.2.2).
constexpr std::size_t unsigned_byte = 5121;
constexpr std::size_t unsigned_short = 5123;
constexpr std::size_t unsigned_int = 5125;
constexpr std::size_t float_32 = 5126;

std::size_t bytes_of_component(const JsonNode& type) {
  switch (type.count()) {
    case unsigned_byte:
      return 1;
    case unsigned_short:
      return 2;
    case unsigned_int:
    case float_32:
      return 4;
    default:
      type.fail(fmt::format("is {}", type.count()),
                "5126 (float) for points, 5121, 5123 or 5125 (unsigned) for indices");
  }
}

/// Decodes %41 to A. @throws MeshFileError
std::string percent_decoded(const std::string& uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
  };
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? digit(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? digit(uri[i + 2]) : -1;
    if (high < 0 || low < 0)
      throw MeshFileError(
          fmt::format("uri (\"{}\") with a % that no two digits follow, allowed %20", printable(uri)), 0, 0);
    path += static_cast<char>(16 * high + low);
    i += 2;
  }
  return path;
}

[[noreturn]] void refuse_uri(const std::string& uri) {
  throw MeshFileError(
      fmt::format(
          "buffer file (\"{}\"), allowed are regular files in the folder of the mesh file or below it",
          printable(uri)),
      0, 0);
}

fs::path file_below(const fs::path& folder, const std::string& uri) {
  const fs::path relative = percent_decoded(uri);
  if (relative.empty() || relative.is_absolute() || relative.string().find('\0') != std::string::npos ||
      uri.find(':') != std::string::npos ||
      std::find(relative.begin(), relative.end(), "..") != relative.end())
    refuse_uri(uri);
  // Links may lead out of the folder.
  std::error_code error;
  const fs::path base = fs::canonical(folder.empty() ? "." : folder, error);
  const fs::path file = error ? fs::path() : fs::canonical(base / relative, error);
  if (error)
    throw MeshFileError(fmt::format("buffer file (\"{}\") does not exist or cannot be read", printable(uri)),
                        0, 0);
  const auto [end, rest] = std::mismatch(base.begin(), base.end(), file.begin(), file.end());
  if (end != base.end() || rest == file.end() || !fs::is_regular_file(file, error)) refuse_uri(uri);
  return file;
}

}  // namespace

BufferFile buffer_files_in(const fs::path& folder) {
  const auto read = std::make_shared<std::map<fs::path, std::shared_ptr<const std::string>>>();
  return [folder, read](const std::string& uri) {
    const fs::path file = file_below(folder, uri);
    std::shared_ptr<const std::string>& bytes = (*read)[file];
    try {
      if (!bytes) bytes = std::make_shared<const std::string>(read_mesh_bytes(file, "buffer file"));
    } catch (const MeshFileError& error) {
      throw MeshFileError(fmt::format("buffer file (\"{}\"): {}", printable(uri), error.what()), 0, 0);
    }
    return bytes;
  };
}

GltfBuffers::GltfBuffers(JsonNode root, std::string_view chunk, BufferFile file)
    : root_(std::move(root)), chunk_(chunk), file_(std::move(file)) {
  const auto accessors = root_.find("accessors");
  accessors_ = accessors ? accessors->size() : 0;
}

std::string_view GltfBuffers::buffer(std::size_t index) {
  const JsonNode buffer = root_.at("buffers").at(index);
  const std::size_t length = buffer.at("byteLength").count();
  const auto uri = buffer.find("uri");
  std::string_view bytes = chunk_;
  if (uri) {
    std::shared_ptr<const std::string>& kept = loaded_[index];
    if (!kept) {
      constexpr std::string_view data = "data:";
      constexpr std::string_view base64 = ";base64,";
      const std::string_view text = uri->text();
      if (text.starts_with(data)) {
        const std::size_t comma = text.find(',');
        const std::size_t coded = text.find(base64);
        if (coded == std::string_view::npos || coded + base64.size() != comma + 1)
          uri->fail("is data of another kind", "data:...;base64,...");
        try {
          kept = std::make_shared<const std::string>(from_base64(text.substr(comma + 1)));
        } catch (const std::invalid_argument&) {
          uri->fail("is no base64", "letters, digits, +, / and = at the end");
        }
      } else {
        kept = file_(uri->text());
      }
      bytes_ += kept->size();
    }
    bytes = *kept;
  } else if (index != 0 || chunk_.empty()) {
    buffer.fail("has no \"uri\"", "is that of the first buffer of a .glb file with a binary chunk");
  }
  if (length > bytes.size())
    buffer.fail(fmt::format("claims {} bytes", length),
                fmt::format("{}, which is what there is", bytes.size()));
  return bytes.substr(0, length);
}

std::string_view GltfBuffers::view(const JsonNode& view) {
  const std::string_view bytes = buffer(view.at("buffer").index(root_.at("buffers").size()));
  const auto offset = view.find("byteOffset");
  const std::size_t begin = offset ? offset->count() : 0;
  const std::size_t length = view.at("byteLength").count();
  if (begin > bytes.size() || length > bytes.size() - begin)
    view.fail(fmt::format("has bytes {} to {}", begin, begin + length),
              fmt::format("0 to {}, where its buffer ends", bytes.size()));
  return bytes.substr(begin, length);
}

GltfBuffers::Elements GltfBuffers::elements(std::size_t index, std::string_view type,
                                            std::size_t components) {
  const JsonNode accessor = root_.at("accessors").at(index);
  if (accessor.find("sparse")) accessor.fail("is sparse", "are accessors with all their elements");
  if (accessor.at("type").text() != type)
    accessor.fail(fmt::format("is of type {}", printable(accessor.at("type").text())), std::string(type));
  const auto view_index = accessor.find("bufferView");
  if (!view_index)
    accessor.fail("has no \"bufferView\" (it is empty, or compressed by an extension)", "is one with it");
  const JsonNode views = root_.at("bufferViews");
  const JsonNode from = views.at(view_index->index(views.size()));
  const std::string_view bytes = view(from);
  const JsonNode component = accessor.at("componentType");
  const std::size_t size = components * bytes_of_component(component);
  const auto given = from.find("byteStride");
  const std::size_t stride = given ? given->count() : size;
  if (stride < size) given->fail(fmt::format("is {}", stride), fmt::format("at least {}", size));
  const auto offset = accessor.find("byteOffset");
  const std::size_t begin = offset ? offset->count() : 0;
  const std::size_t count = accessor.at("count").count();
  const std::size_t room =
      begin > bytes.size() || bytes.size() - begin < size ? 0 : (bytes.size() - begin - size) / stride + 1;
  if (count > room)
    accessor.fail(fmt::format("has {} elements", count),
                  fmt::format("up to {}, for which its view has bytes", room));
  return {bytes.substr(std::min(begin, bytes.size())), count, stride, component.count()};
}

std::size_t GltfBuffers::count(std::size_t accessor) {
  const bool scalar = root_.at("accessors").at(accessor).at("type").text() == "SCALAR";
  return scalar ? elements(accessor, "SCALAR", 1).count : elements(accessor, "VEC3", 3).count;
}

std::vector<Vector3> GltfBuffers::points(std::size_t accessor, const std::vector<std::uint32_t>& indices) {
  const Elements of = elements(accessor, "VEC3", 3);
  const JsonNode node = root_.at("accessors").at(accessor);
  if (of.component != float_32)
    node.at("componentType").fail(fmt::format("of points is {}", of.component), "5126 (float)");
  std::vector<Vector3> points;
  points.reserve(indices.size());
  for (const std::uint32_t index : indices) {
    if (index >= of.count)
      throw MeshFileError(
          fmt::format("point index ({}), allowed 0 to {}", index, static_cast<long long>(of.count) - 1), 0,
          0);
    const std::string_view bytes = of.bytes.substr(index * of.stride);
    Vector3& point = points.emplace_back();
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = read_binary<float>(bytes.substr(4 * static_cast<std::size_t>(axis)), std::endian::little);
    if (!point.allFinite())
      node.fail(fmt::format("has a coordinate that is no number, in element {}", index), "numbers");
  }
  return points;
}

std::vector<std::uint32_t> GltfBuffers::indices(std::size_t accessor) {
  const Elements of = elements(accessor, "SCALAR", 1);
  std::vector<std::uint32_t> indices;
  indices.reserve(of.count);
  for (std::size_t i = 0; i < of.count; ++i) {
    const std::string_view bytes = of.bytes.substr(i * of.stride);
    if (of.component == unsigned_byte)
      indices.push_back(read_binary<std::uint8_t>(bytes, std::endian::little));
    else if (of.component == unsigned_short)
      indices.push_back(read_binary<std::uint16_t>(bytes, std::endian::little));
    else if (of.component == unsigned_int)
      indices.push_back(read_binary<std::uint32_t>(bytes, std::endian::little));
    else
      root_.at("accessors")
          .at(accessor)
          .at("componentType")
          .fail("of indices is 5126", "5121, 5123 or 5125 (unsigned)");
  }
  return indices;
}

}  // namespace ashlar
