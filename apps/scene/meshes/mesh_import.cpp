#include "apps/scene/meshes/mesh_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/scene/meshes/dxf_reader.hpp"
#include "apps/scene/meshes/gltf_reader.hpp"
#include "apps/scene/meshes/height_grid.hpp"
#include "apps/scene/meshes/threemf_reader.hpp"
#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

struct ImportedFormat {
  const char* ending;
  const char* note;  ///< properties that a file does not define
  ShapeLayout (*read)(const std::string& bytes, const std::filesystem::path& folder);
};

constexpr const char* upward = "in glTF files y is up (rotate = { axis = [1, 0, 0], angle = 90 })";

constexpr std::array<ImportedFormat, 4> imported_formats = {
    {{".3mf", "3MF files are in millimetres unless they say otherwise, which is not read (mesh.scale = 1e-3)",
      [](const std::string& bytes, const std::filesystem::path&) { return read_3mf(bytes); }},
     {".dxf", "DXF files do not say their unit (mesh.scale)",
      [](const std::string& bytes, const std::filesystem::path&) { return read_dxf(bytes); }},
     {".gltf", upward,
      [](const std::string& bytes, const std::filesystem::path& folder) {
        return read_gltf(bytes, buffer_files_in(folder));
      }},
     {".glb", upward, [](const std::string& bytes, const std::filesystem::path& folder) {
        return read_glb(bytes, buffer_files_in(folder));
      }}}};

const ImportedFormat* imported_format(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  const auto* found =
      std::find_if(imported_formats.begin(), imported_formats.end(),
                   [&](const ImportedFormat& format) { return equal_ignoring_case(ending, format.ending); });
  return found == imported_formats.end() ? nullptr : found;
}

ShapeLayout import(const std::filesystem::path& path, const ImportedFormat& format) {
  return format.read(read_mesh_bytes(path), path.parent_path());
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& path) {
  if (is_height_grid(path)) return read_height_grid(path);
  const ImportedFormat* format = imported_format(path);
  return format == nullptr ? read_mesh(path) : import(path, *format).whole();
}

std::vector<MeshGroup> read_mesh_file_groups(const std::filesystem::path& path) {
  if (is_height_grid(path)) return {{"1", read_height_grid(path)}};
  const ImportedFormat* format = imported_format(path);
  return format == nullptr ? read_mesh_groups(path) : import(path, *format).groups();
}

std::optional<std::string> import_warning(const std::filesystem::path& path) {
  const ImportedFormat* format = imported_format(path);
  if (format == nullptr) return std::nullopt;
  return fmt::format("{}: {}", path.filename().string(), format->note);
}

}  // namespace ashlar
