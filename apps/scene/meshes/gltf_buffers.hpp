// Numbers of a glTF 2.0 file: accessors into views of buffers, whose bytes are in the file as base64, in the binary
// chunk of a .glb file, or in other files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/meshes/json_node.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Returns the bytes of the file of a buffer's uri. @throws MeshFileError
using BufferFile = std::function<std::shared_ptr<const std::string>(const std::string& uri)>;

/// Regular files in a folder or below it, each read once. Names with "..", absolute ones, and links out of the folder
/// are refused.
[[nodiscard]] BufferFile buffer_files_in(const std::filesystem::path& folder);

class GltfBuffers {
 public:
  /// @param chunk of a .glb file, otherwise empty; must outlive this
  GltfBuffers(JsonNode root, std::string_view chunk, BufferFile file);

  /// Number of elements of an accessor. The buffer has bytes for all of them.
  [[nodiscard]] std::size_t count(std::size_t accessor);

  /// Points of the given indices. @param accessor of three floats. @throws MeshFileError if a coordinate is not a
  /// number
  [[nodiscard]] std::vector<Vector3> points(std::size_t accessor, const std::vector<std::uint32_t>& indices);

  /// @param accessor of unsigned integers
  [[nodiscard]] std::vector<std::uint32_t> indices(std::size_t accessor);

  [[nodiscard]] std::size_t accessors() const { return accessors_; }
  /// Bytes of all buffers used so far.
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

  JsonNode root_;
  std::string_view chunk_;
  BufferFile file_;
  std::size_t accessors_;
  std::map<std::size_t, std::shared_ptr<const std::string>> loaded_;
  std::size_t bytes_ = 0;
};

}  // namespace ashlar
