#include "apps/scene/mesh_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

#ifdef ASHLAR_WITH_ASSIMP
#include <assimp/scene.h>
#include <assimp/version.h>

#include <assimp/Importer.hpp>
#endif

namespace ashlar {
namespace {

struct ImportedFormat {
  const char* ending;
  const char* note;  ///< what a file of it does not say by itself
};

constexpr std::array<ImportedFormat, 4> imported_formats = {
    {{".3mf",
      "3MF files are in millimetres unless they say otherwise, which is not read (mesh.scale = 1e-3)"},
     {".dxf", "DXF files do not say their unit (mesh.scale)"},
     {".gltf", "in glTF files y is up (rotate = { axis = [1, 0, 0], angle = 90 })"},
     {".glb", "in glTF files y is up (rotate = { axis = [1, 0, 0], angle = 90 })"}}};

const ImportedFormat* imported_format(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  const auto* found =
      std::find_if(imported_formats.begin(), imported_formats.end(),
                   [&](const ImportedFormat& format) { return equal_ignoring_case(ending, format.ending); });
  return found == imported_formats.end() ? nullptr : found;
}

#ifdef ASHLAR_WITH_ASSIMP

/// Objects as they are found, each a soup of polygons.
class ObjectCollector {
 public:
  explicit ObjectCollector(const aiScene& scene) : scene_(scene) {}

  /// @param whole one group for all objects
  std::vector<std::pair<std::string, PolygonSoup>> take(bool whole, const aiMatrix4x4& root) {
    whole_ = whole;
    // The root's own transformation is replaced: what it does is of the importer, not of the file.
    visit(*scene_.mRootNode, root);
    return std::move(objects_);
  }

 private:
  void visit(const aiNode& node, const aiMatrix4x4& transformation) {
    if (node.mNumMeshes > 0 && !whole_) begin(node);
    if (whole_ && objects_.empty()) objects_.emplace_back("", PolygonSoup());
    for (unsigned k = 0; k < node.mNumMeshes; ++k) add(*scene_.mMeshes[node.mMeshes[k]], transformation);
    if (!whole_ && !objects_.empty() && objects_.back().second.face_ends.empty()) objects_.pop_back();
    for (unsigned k = 0; k < node.mNumChildren; ++k)
      visit(*node.mChildren[k], transformation * node.mChildren[k]->mTransformation);
  }

  void begin(const aiNode& node) {
    std::string name = node.mName.C_Str();
    if (name.empty()) name = "object";
    const int before = names_[name]++;
    if (before > 0) name += fmt::format("_{}", before + 1);
    objects_.emplace_back(name, PolygonSoup());
    place_.clear();
  }

  void add(const aiMesh& mesh, const aiMatrix4x4& transformation) {
    PolygonSoup& soup = objects_.back().second;
    std::vector<int> index;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D point = transformation * mesh.mVertices[v];
      const std::array<double, 3> place = {point.x + 0.0, point.y + 0.0, point.z + 0.0};
      const auto [found, is_new] = place_.emplace(place, static_cast<int>(soup.points.size()));
      if (is_new) soup.points.emplace_back(place[0], place[1], place[2]);
      index.push_back(found->second);
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) continue;  // points and lines beside the faces
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices)
          throw MeshFileError(fmt::format("point index ({}), allowed 0 to {}", face.mIndices[k],
                                          static_cast<int>(mesh.mNumVertices) - 1),
                              0, 0);
        soup.corners.push_back(index[face.mIndices[k]]);
      }
      soup.face_ends.push_back(static_cast<int>(soup.corners.size()));
    }
  }

  const aiScene& scene_;
  bool whole_ = false;
  std::vector<std::pair<std::string, PolygonSoup>> objects_;
  std::map<std::string, int> names_;
  std::map<std::array<double, 3>, int> place_;  ///< of points of the last object
};

std::vector<MeshGroup> import(const std::filesystem::path& path, const ImportedFormat& format, bool whole) {
  if (!std::filesystem::is_regular_file(path))
    throw MeshFileError(
        std::filesystem::exists(path) ? "mesh file is not a regular file" : "mesh file does not exist", 0, 0);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw MeshFileError(fmt::format("assimp cannot read it ({})", printable(importer.GetErrorString())), 0,
                        0);
  const bool turned = equal_ignoring_case(format.ending, ".dxf");
  std::vector<MeshGroup> groups;
  for (auto& [name, soup] :
       ObjectCollector(*scene).take(whole, turned ? aiMatrix4x4() : scene->mRootNode->mTransformation))
    groups.push_back({name, triangulated(std::move(soup))});
  if (groups.empty() || groups.front().mesh.triangles.empty()) throw MeshFileError("file has no faces", 0, 0);
  return groups;
}

#else

std::vector<MeshGroup> import(const std::filesystem::path& /*path*/, const ImportedFormat& format,
                              bool /*whole*/) {
  throw MeshFileError(
      fmt::format("a {} file: this program is built without assimp, which reads them; allowed "
                  ".off, .obj, .stl, .ply",
                  format.ending),
      0, 0);
}

#endif

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& path) {
  const ImportedFormat* format = imported_format(path);
  return format == nullptr ? read_mesh(path) : import(path, *format, true).front().mesh;
}

std::vector<MeshGroup> read_mesh_file_groups(const std::filesystem::path& path) {
  const ImportedFormat* format = imported_format(path);
  return format == nullptr ? read_mesh_groups(path) : import(path, *format, false);
}

std::optional<std::string> import_warning(const std::filesystem::path& path) {
  const ImportedFormat* format = imported_format(path);
  if (format == nullptr || assimp_version().empty()) return std::nullopt;
  return fmt::format(
      "{} is read by assimp in single precision: corners are off by up to 6e-8 of the largest "
      "coordinate; {}",
      path.filename().string(), format->note);
}

std::string assimp_version() {
#ifdef ASHLAR_WITH_ASSIMP
  return fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch());
#else
  return {};
#endif
}

}  // namespace ashlar
