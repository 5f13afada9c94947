// Numbers of a glTF 2.0 file: accessors into views of buffers, whose bytes are in the file as base64, in the binary chunk of
// a .glb file, or in files beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/json_node.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Bytes of a file that a buffer's uri names. @throws MeshFileError
using BufferFile = std::function<std::shared_ptr<const std::string>(const std::string& uri)>;

/// Regular files in a folder or below it, each read once. Names with "..", absolute ones, and links that lead out of the
/// folder are refused.
[[nodiscard]] BufferFile buffer_files_in(const std::filesystem::path& folder);

class GltfBuffers {
 public:
  /// @param root, chunk, file must outlive it. @param chunk of a .glb file, empty without one
  GltfBuffers(const JsonNode& root, std::string_view chunk, BufferFile file);

  /// Elements of an accessor. They exist: the buffer has bytes for them.
  [[nodiscard]] std::size_t count(std::size_t accessor);

  /// Points of the given indices. @param accessor of three floats. @throws MeshFileError where a coordinate is no number
  [[nodiscard]] std::vector<Vector3> points(std::size_t accessor, const std::vector<std::uint32_t>& indices);

  /// @param accessor of unsigned integers
  [[nodiscard]] std::vector<std::uint32_t> indices(std::size_t accessor);

  [[nodiscard]] std::size_t accessors() const { return accessors_; }
  /// Of all buffers that were used up to now.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Elements {
    std::string_view bytes;  ///< from the first element on
    std::size_t count;
    std::size_t stride;
    std::size_t component;  ///< glTF's number of the type
  };

  Elements elements(std::size_t accessor, std::string_view type, std::size_t components);
  std::string_view view(const JsonNode& view);
  std::string_view buffer(std::size_t index);

  const JsonNode& root_;
  std::string_view chunk_;
  BufferFile file_;
  std::size_t accessors_;
  std::map<std::size_t, std::shared_ptr<const std::string>> loaded_;
  std::size_t bytes_ = 0;
};

}  // namespace ashlar
