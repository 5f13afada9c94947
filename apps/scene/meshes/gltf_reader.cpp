#include "apps/scene/meshes/gltf_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "geometry/mesh/binary_values.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

/// Triangles of a primitive's vertices (section 3.7.2.1); points and lines are modes 0 to 3.
constexpr std::size_t mode_triangles = 4;
constexpr std::size_t mode_strip = 5;
constexpr std::size_t mode_fan = 6;

std::size_t triangles_of(std::size_t mode, std::size_t vertices) {
  if (mode == mode_triangles) return vertices / 3;
  return vertices < 3 ? 0 : vertices - 2;
}

/// Positions in the list of vertices of triangle t.
std::array<std::size_t, 3> corners_of(std::size_t mode, std::size_t t) {
  if (mode == mode_triangles) return {3 * t, 3 * t + 1, 3 * t + 2};
  if (mode == mode_fan) return {0, t + 1, t + 2};
  // Every second triangle of a strip is reversed.
  const bool turned = mode == mode_strip && t % 2 != 0;
  return !turned ? std::array{t, t + 1, t + 2} : std::array{t + 1, t, t + 2};
}

void check_extensions(const JsonNode& root) {
  constexpr std::array<std::string_view, 4> without_shape = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                             "KHR_lights_"};
  const auto required = root.find("extensionsRequired");
  for (std::size_t i = 0; required && i < required->size(); ++i) {
    const std::string& name = required->at(i).text();
    const bool harmless =
        std::any_of(without_shape.begin(), without_shape.end(),
                    [&](std::string_view beginning) { return name.starts_with(beginning); });
    if (!harmless)
      required->at(i).fail(fmt::format("is {}, which is not read", printable(name)),
                           "are extensions of materials");
  }
}

Eigen::Matrix4d matrix_of(const JsonNode& node) {
  Eigen::Matrix4d matrix;
  if (node.size() != 16) node.fail(fmt::format("has {} numbers", node.size()), "16");
  for (int k = 0; k < 16; ++k) matrix(k % 4, k / 4) = node.at(static_cast<std::size_t>(k)).number();
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    node.fail("has a last row that is not 0, 0, 0, 1", "are moves and scales");
  return matrix;
}

template <int size>
Eigen::Matrix<double, size, 1> vector_of(const JsonNode& node) {
  Eigen::Matrix<double, size, 1> values;
  if (node.size() != size) node.fail(fmt::format("has {} numbers", node.size()), std::to_string(size));
  for (int k = 0; k < size; ++k) values[k] = node.at(static_cast<std::size_t>(k)).number();
  return values;
}

/// Scaling, then rotation, then translation (section 3.5.3).
Eigen::Affine3d transformation_of(const JsonNode& node) {
  const auto matrix = node.find("matrix");
  const auto translation = node.find("translation");
  const auto rotation = node.find("rotation");
  const auto scale = node.find("scale");
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  if (matrix) {
    if (translation || rotation || scale)
      node.fail("has a matrix beside translation, rotation or scale", "is one of both");
    result.matrix() = matrix_of(*matrix);
    return result;
  }
  if (translation) result.translation() = vector_of<3>(*translation);
  if (rotation) {
    const Eigen::Vector4d turn = vector_of<4>(*rotation);  // x, y, z, w
    if ((turn.array() == 0.0).all()) rotation->fail("is zero", "is a quaternion of length 1");
    result.linear() = Eigen::Quaterniond(turn.stableNormalized()).toRotationMatrix();
  }
  if (scale) result.linear() *= vector_of<3>(*scale).asDiagonal();
  return result;
}

class GltfReader {
 public:
  GltfReader(std::string_view text, std::string_view chunk, const BufferFile& file)
      : root_(std::make_shared<const nlohmann::json>(parse_json_file(text)), ""),
        bytes_(text.size()),
        buffers_(root_, chunk, file) {}

  ShapeLayout run() {
    const std::string& version = root_.at("asset").at("version").text();
    if (!version.starts_with("2."))
      root_.at("asset").at("version").fail(fmt::format("is {}", printable(version)), "2.0");
    check_extensions(root_);
    read_tree();
    const auto meshes = root_.find("meshes");
    shapes_.resize(meshes ? meshes->size() : 0);
    // Shapes first: the bound includes the contents of buffers.
    std::vector<PolygonSoup> read(shapes_.size());
    const std::vector<std::size_t> shown = nodes_of_scene();
    std::vector<bool> known(shapes_.size(), false);
    for (const std::size_t node : shown) {
      const auto mesh = nodes_->at(node).find("mesh");
      if (!mesh) continue;
      const std::size_t index = mesh->index(shapes_.size());
      if (!known[index]) read[index] = shape(meshes->at(index));
      known[index] = true;
    }
    ShapeLayout layout(ShapeLayout::SameName::numbered, limits());
    for (std::size_t i = 0; i < read.size(); ++i) shapes_[i] = layout.add(std::move(read[i]));
    place(shown, layout);
    return layout;
  }

 private:
  [[nodiscard]] LayoutLimits limits() const { return layout_limits(bytes_ + buffers_.bytes()); }

  /// Determines the parent of each node.
  void read_tree() {
    nodes_ = root_.find("nodes");
    parent_.assign(nodes_ ? nodes_->size() : 0, none);
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      const auto children = nodes_->at(i).find("children");
      for (std::size_t k = 0; children && k < children->size(); ++k) {
        std::size_t& parent = parent_[children->at(k).index(parent_.size())];
        if (parent != none)
          children->at(k).fail(fmt::format("is a node that node {} has already", parent),
                               "is one parent for each node");
        parent = i;
      }
    }
  }

  /// Nodes of the scene, each before its children, in their order.
  std::vector<std::size_t> nodes_of_scene() {
    const auto scenes = root_.find("scenes");
    const auto scene = root_.find("scene");
    std::vector<std::size_t> shown;
    if (!scenes || !nodes_) return shown;
    const auto roots = scenes->at(scene ? scene->index(scenes->size()) : 0).find("nodes");
    std::vector<std::size_t> stack;
    std::vector<bool> listed(parent_.size(), false);
    for (std::size_t k = 0; roots && k < roots->size(); ++k) {
      const std::size_t root = roots->at(k).index(parent_.size());
      if (parent_[root] != none || listed[root])
        roots->at(k).fail(fmt::format("is {}, a node that is below another one or listed twice", root),
                          "are nodes without a parent");
      listed[root] = true;
      stack.push_back(root);
    }
    std::reverse(stack.begin(), stack.end());
    // Each node has one parent, and these have none: none is visited twice.
    while (!stack.empty()) {
      const std::size_t node = stack.back();
      stack.pop_back();
      shown.push_back(node);
      const auto children = nodes_->at(node).find("children");
      for (std::size_t k = children ? children->size() : 0; k-- > 0;)
        stack.push_back(children->at(k).index(parent_.size()));
    }
    return shown;
  }

  PolygonSoup shape(const JsonNode& mesh) {
    PolygonSoup soup;
    const JsonNode primitives = mesh.at("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) add_primitive(primitives.at(p), soup);
    return soup;
  }

  void add_primitive(const JsonNode& primitive, PolygonSoup& soup) {
    const auto given = primitive.find("mode");
    const std::size_t mode = given ? given->index(mode_fan + 1) : mode_triangles;
    if (mode < mode_triangles) return;
    const auto position = primitive.at("attributes").find("POSITION");
    if (!position) return;
    const auto indexed = primitive.find("indices");
    const std::size_t points = position->index(buffers_.accessors());
    const std::size_t count = buffers_.count(indexed ? indexed->index(buffers_.accessors()) : points);
    const std::size_t triangles = triangles_of(mode, count);
    if (mode == mode_triangles && count % 3 != 0)
      primitive.fail(fmt::format("has {} corners of triangles", count), "is a multiple of 3");
    faces_ += triangles;
    if (faces_ > limits().faces)
      primitive.fail(fmt::format("and those before it have more than {} triangles", limits().faces),
                     "that many");
    std::vector<std::uint32_t> vertices(indexed ? 0 : count);
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = static_cast<std::uint32_t>(i);
    if (indexed) vertices = buffers_.indices(indexed->count());
    append(mode, triangles, vertices, points, soup);
  }

  void append(std::size_t mode, std::size_t triangles, const std::vector<std::uint32_t>& vertices,
              std::size_t points, PolygonSoup& soup) {
    // Many primitives may share one large array of points.
    std::vector<std::uint32_t> used = vertices;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const std::size_t offset = soup.points.size();
    for (const Vector3& point : buffers_.points(points, used)) soup.points.push_back(point);
    for (std::size_t t = 0; t < triangles; ++t) {
      for (const std::size_t corner : corners_of(mode, t)) {
        const auto place = std::lower_bound(used.begin(), used.end(), vertices[corner]) - used.begin();
        soup.corners.push_back(static_cast<int>(offset + static_cast<std::size_t>(place)));
      }
      soup.face_ends.push_back(static_cast<int>(soup.corners.size()));
    }
  }

  void place(const std::vector<std::size_t>& shown, ShapeLayout& layout) {
    std::vector<Eigen::Affine3d> of_node(parent_.size(), Eigen::Affine3d::Identity());
    for (const std::size_t index : shown) {
      const JsonNode node = nodes_->at(index);
      of_node[index] = transformation_of(node);
      if (parent_[index] != none) of_node[index] = of_node[parent_[index]] * of_node[index];
      const auto extensions = node.find("extensions");
      if (extensions && extensions->find("EXT_mesh_gpu_instancing"))
        node.fail("has instances (EXT_mesh_gpu_instancing), which are not read", "are nodes of their own");
      const auto mesh = node.find("mesh");
      if (!mesh) continue;
      const auto name = node.find("name");
      const bool named = name && !name->text().empty();
      layout.place(named ? name->text() : fmt::format("nodes[{}]", index), shapes_[mesh->count()],
                   of_node[index]);
    }
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  JsonNode root_;
  std::size_t bytes_;
  GltfBuffers buffers_;
  std::optional<JsonNode> nodes_;
  std::vector<std::size_t> parent_;  ///< of each node, or none
  std::vector<std::size_t> shapes_;  ///< of each mesh, in the layout
  std::size_t faces_ = 0;
};

std::uint32_t number_at(std::string_view bytes, std::size_t place) {
  return read_binary<std::uint32_t>(bytes.substr(place), std::endian::little);
}

/// Content of a chunk, and the rest.
std::pair<std::string_view, std::string_view> chunk(std::string_view bytes, std::uint32_t kind,
                                                    const char* name) {
  constexpr std::size_t head = 8;
  if (bytes.size() < head || number_at(bytes, 4) != kind)
    throw MeshFileError(fmt::format("file has no {} chunk where it must be", name), 0, 0);
  const std::size_t length = number_at(bytes, 0);
  if (length > bytes.size() - head)
    throw MeshFileError(fmt::format("{} chunk claims {} bytes, allowed {}, where the file ends", name, length,
                                    bytes.size() - head),
                        0, 0);
  return {bytes.substr(head, length), bytes.substr(head + length)};
}

constexpr std::string_view glb_magic = "glTF";

}  // namespace

ShapeLayout read_gltf(std::string_view text, const BufferFile& file) {
  if (text.starts_with(glb_magic))
    throw MeshFileError("binary file, allowed are texts (a binary one ends with .glb)", 0, 0);
  return GltfReader(text, {}, file).run();
}

ShapeLayout read_glb(std::string_view bytes, const BufferFile& file) {
  constexpr std::size_t head = 12;
  constexpr std::uint32_t json_kind = 0x4e4f534a;
  constexpr std::uint32_t binary_kind = 0x004e4942;
  if (bytes.size() < head || !bytes.starts_with(glb_magic))
    throw MeshFileError("file does not begin with \"glTF\", which .glb files do", 0, 0);
  if (number_at(bytes, 4) != 2)
    throw MeshFileError(fmt::format("version {}, allowed 2", number_at(bytes, 4)), 0, 0);
  if (number_at(bytes, 8) != bytes.size())
    throw MeshFileError(
        fmt::format("file of {} bytes, its header says {}", bytes.size(), number_at(bytes, 8)), 0, 0);
  const auto [json, rest] = chunk(bytes.substr(head), json_kind, "JSON");
  return GltfReader(json, rest.empty() ? rest : chunk(rest, binary_kind, "binary").first, file).run();
}

}  // namespace ashlar
