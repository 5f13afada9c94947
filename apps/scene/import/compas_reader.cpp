#include "apps/scene/import/compas_reader.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <utility>

#include "apps/scene/import/compas_problem.hpp"
#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

constexpr const char* allowed_models =
    "a Problem or BlockModel of compas_dem, an Assembly of compas_assembly or compas_cra, meshes";

/// A 4 by 4 matrix that is applied to points; the identity where there is none.
using Placement = Eigen::Matrix4d;

class CompasReader {
 public:
  ImportedModel read(const JsonNode& root) {
    read_any(root);
    if (model_.blocks.empty()) root.fail("has no blocks", allowed_models);
    if (!has_problem_) assume_problem();
    if (model_.materials.empty() || !model_.materials.front().density)
      model_.notes.emplace_back("densities are not in the file");
    return std::move(model_);
  }

 private:
  void read_any(const JsonNode& written) {
    const JsonNode node = compas_content(written);
    if (node.is_array()) {
      for (std::size_t k = 0; k < node.size(); ++k) read_any(node.at(k));
    } else if (!node.is_object()) {
      written.fail("is no model of COMPAS", allowed_models);
    } else if (node.find("model") && node.find("boundary_conditions")) {
      read_model(compas_content(node.at("model")));
      read_compas_problem(node, model_, block_of_);
      has_problem_ = true;
    } else if (node.find("elements") && node.find("graph")) {
      read_model(node);
    } else if (node.find("graph")) {
      read_assembly(compas_content(node.at("graph")));
    } else if (node.find("node")) {
      read_assembly(node);
    } else if (node.find("assembly") && node.find("blocks")) {
      read_older_assembly(node);
    } else if (is_mesh(node)) {
      add_block(node, std::to_string(model_.blocks.size()), Placement::Identity());
    } else {
      const std::optional<JsonNode> type = written.find("dtype");
      written.fail(type && type->is_text() ? fmt::format("is a {}", type->text()) : "is no model of COMPAS",
                   allowed_models);
    }
  }

  static bool is_mesh(const JsonNode& node) {
    return node.is_object() &&
           ((node.find("vertex") && node.find("face")) || (node.find("vertices") && node.find("faces")));
  }

  /// compas_model: elements by their identity, materials, and the nodes of the graph that number them.
  void read_model(const JsonNode& node) {
    const Placement of_model = placement(node);
    read_materials(node);
    std::map<std::string, JsonNode> elements;
    const JsonNode listed = node.at("elements");
    if (listed.is_array()) {
      for (std::size_t k = 0; k < listed.size(); ++k)
        elements.emplace(listed.at(k).at("guid").text(), listed.at(k));
    } else {
      for (auto& [guid, element] : listed.members()) elements.emplace(guid, element);
    }
    if (const std::optional<JsonNode> tree = node.find("tree"); tree && tree->find("root"))
      refuse_placed_parents(tree->at("root"), elements);
    std::size_t contacts = 0;
    const JsonNode graph = compas_content(node.at("graph"));
    for (const auto& [number, entry] : graph.at("node").members()) {
      const JsonNode guid = entry.at("element");
      const auto found = elements.find(guid.text());
      if (found == elements.end())
        guid.fail(fmt::format("is unknown ({})", guid.text()), "one of the elements");
      read_element(found->second, number, of_model, node);
    }
    if (const std::optional<JsonNode> edges = graph.find("edge"); edges && edges->is_object())
      for (const auto& [number, others] : edges->members()) contacts += others.members().size();
    if (contacts > 0)
      model_.left_out.push_back(
          fmt::format("contacts of {} pairs of blocks (found again from the geometry)", contacts));
  }

  void read_element(const JsonNode& element, const std::string& number, const Placement& of_model,
                    const JsonNode& model) {
    const JsonNode data = compas_content(element);
    std::optional<JsonNode> geometry = member(data, "geometry");
    if (!geometry) geometry = member(data, "shape");
    if (!geometry) data.fail("has no geometry", "a mesh");
    const JsonNode mesh = compas_content(*geometry);
    if (!is_mesh(mesh)) {
      const std::optional<JsonNode> type = geometry->is_object() ? geometry->find("dtype") : std::nullopt;
      geometry->fail(
          fmt::format("is a {}", type && type->is_text() ? type->text() : "geometry of another kind"),
          "a mesh or a polyhedron");
    }
    ImportedBlock& block = add_block(mesh, number, of_model * placement(data));
    if (const std::optional<JsonNode> support = member(data, "is_support")) block.fixed = support->boolean();
    if (const std::optional<JsonNode> material = member(data, "material"))
      block.material = index_of_material(*material);
    else if (const std::optional<JsonNode> table = member(model, "element_material"))
      if (const std::optional<JsonNode> guid = member(element, "guid"))
        if (const std::optional<JsonNode> other = member(*table, guid->text().c_str()))
          block.material = index_of_material(*other);
    if (const std::optional<JsonNode> features = member(data, "features");
        features && features->is_array() && features->size() > 0)
      model_.left_out.push_back(fmt::format("features of block {}", number));
  }

  /// Elements below an element that is placed are placed with it, which is not read.
  static void refuse_placed_parents(const JsonNode& node, const std::map<std::string, JsonNode>& elements) {
    const std::optional<JsonNode> children = member(node, "children");
    if (!children) return;
    const std::optional<JsonNode> guid = member(node, "element");
    if (guid && children->size() > 0) {
      const auto found = elements.find(guid->text());
      if (found != elements.end() && member(compas_content(found->second), "transformation"))
        guid->fail("has a transformation and other elements below it", "elements side by side");
    }
    for (std::size_t k = 0; k < children->size(); ++k) refuse_placed_parents(children->at(k), elements);
  }

  void read_materials(const JsonNode& node) {
    const std::optional<JsonNode> materials = member(node, "materials");
    if (!materials) return;
    const auto add = [&](const std::string& guid, const JsonNode& material) {
      const JsonNode data = compas_content(material);
      ImportedMaterial read;
      const std::optional<JsonNode> name = member(data, "name");
      read.name = plain_name(name ? name->text() : "material");
      if (index_of_material_.contains(guid)) material.fail("is given twice", "each material once");
      for (const ImportedMaterial& other : model_.materials)
        if (other.name == read.name) read.name += fmt::format(".{}", model_.materials.size() + 1);
      if (const std::optional<JsonNode> density = member(data, "density")) {
        read.density = density->number();
        if (!(*read.density > 0.0)) density->fail(fmt::format("is {}", *read.density), "a number > 0");
      }
      if (member(data, "Ecm") || member(data, "fc"))
        model_.left_out.push_back(fmt::format(
            "elasticity and strength of material {} (blocks are rigid; their unit is not said)", read.name));
      index_of_material_[guid] = model_.materials.size();
      model_.materials.push_back(std::move(read));
    };
    if (materials->is_array()) {
      for (std::size_t k = 0; k < materials->size(); ++k)
        add(materials->at(k).at("guid").text(), materials->at(k));
    } else {
      for (const auto& [guid, material] : materials->members()) add(guid, material);
    }
  }

  std::size_t index_of_material(const JsonNode& guid) const {
    const auto found = index_of_material_.find(guid.text());
    if (found == index_of_material_.end())
      guid.fail(fmt::format("is unknown ({})", guid.text()), "one of the materials");
    return found->second;
  }

  /// compas_assembly: blocks are attributes of the nodes.
  void read_assembly(const JsonNode& graph) {
    for (const auto& [number, node] : graph.at("node").members()) {
      const std::optional<JsonNode> mesh = member(node, "block");
      if (!mesh) node.fail("has no block", "nodes with a block");
      if (!is_mesh(compas_content(*mesh))) mesh->fail("is no mesh", "a mesh");
      ImportedBlock& block = add_block(compas_content(*mesh), number, Placement::Identity());
      if (const std::optional<JsonNode> support = member(node, "is_support"))
        block.fixed = support->boolean();
    }
  }

  /// The form before graphs: supports are attributes of the vertices of a network, blocks are beside it.
  void read_older_assembly(const JsonNode& node) {
    const JsonNode assembly = compas_content(node.at("assembly"));
    const std::optional<JsonNode> vertices = member(assembly, "vertex");
    for (const auto& [number, mesh] : compas_content(node.at("blocks")).members()) {
      if (!is_mesh(compas_content(mesh))) mesh.fail("is no mesh", "a mesh");
      ImportedBlock& block = add_block(compas_content(mesh), number, Placement::Identity());
      const std::optional<JsonNode> vertex = vertices ? member(*vertices, number.c_str()) : std::nullopt;
      const std::optional<JsonNode> support = vertex ? member(*vertex, "is_support") : std::nullopt;
      if (support) block.fixed = support->boolean();
    }
  }

  ImportedBlock& add_block(const JsonNode& mesh, const std::string& number, const Placement& placement) {
    ImportedBlock block;
    block.name = plain_name(number);
    std::map<std::string, int> index_of;
    const bool named = mesh.find("vertex").has_value();
    const auto add_point = [&](const JsonNode& place, Vector3 point) {
      point = (placement * point.homogeneous()).head<3>();
      if (!point.allFinite() || is_too_far(point.cwiseAbs().maxCoeff()))
        place.fail("is too far away", "coordinates from -1e150 to 1e150");
      block.points.push_back(point);
    };
    if (named) {
      for (const auto& [key, vertex] : mesh.at("vertex").members()) {
        index_of.emplace(key, static_cast<int>(block.points.size()));
        const auto coordinate = [&, &v = vertex](const char* name) {
          const std::optional<JsonNode> value = member(v, name);
          return value ? value->number() : 0.0;
        };
        add_point(vertex, {coordinate("x"), coordinate("y"), coordinate("z")});
      }
    } else {
      const JsonNode vertices = mesh.at("vertices");
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        index_of.emplace(std::to_string(k), static_cast<int>(k));
        add_point(vertices.at(k), compas_vector(vertices.at(k)));
      }
    }
    const auto add_face = [&](const JsonNode& corners) {
      std::vector<int> face;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const JsonNode corner = corners.at(k);
        const std::string key = corner.is_text() ? corner.text() : std::to_string(corner.count());
        const auto found = index_of.find(key);
        if (found == index_of.end()) corner.fail(fmt::format("is unknown ({})", key), "a vertex of the mesh");
        face.push_back(found->second);
      }
      if (face.size() < 3) corners.fail(fmt::format("has {} corners", face.size()), "at least 3");
      block.faces.push_back(std::move(face));
    };
    const JsonNode faces = mesh.at(named ? "face" : "faces");
    if (faces.is_array()) {
      for (std::size_t k = 0; k < faces.size(); ++k) add_face(faces.at(k));
    } else {
      for (const auto& [key, face] : faces.members())
        if (!face.is_null()) add_face(face);
    }
    if (block.faces.empty()) mesh.fail("has no faces", "a closed surface");
    if (!block_of_.emplace(number, model_.blocks.size()).second)
      mesh.fail(fmt::format("has the number of another block ({})", number), "one model in a file");
    model_.blocks.push_back(std::move(block));
    return model_.blocks.back();
  }

  static Placement placement(const JsonNode& node) {
    Placement placement = Placement::Identity();
    if (const std::optional<JsonNode> frame = member(node, "frame"))
      frame->fail("is given", "a transformation in place of a frame");
    const std::optional<JsonNode> written = member(node, "transformation");
    if (!written) return placement;
    const JsonNode matrix = compas_content(*written).at("matrix");
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        placement(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
            matrix.at(row).at(column).number();
    if (placement.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
      matrix.fail("is a projection", "0, 0, 0, 1 as last row");
    return placement;
  }

  void assume_problem() {
    model_.gravity = Vector3(0, 0, -compas_gravity);
    assume_compas_friction(model_);
    model_.notes.emplace_back("loads are not in the file: gravity alone, downwards");
  }

  static std::optional<JsonNode> member(const JsonNode& node, const char* name) {
    return compas_member(node, name);
  }

  ImportedModel model_;
  std::map<std::string, std::size_t> block_of_;  ///< by the number of the node
  std::map<std::string, std::size_t> index_of_material_;
  bool has_problem_ = false;
};

}  // namespace

JsonNode compas_content(const JsonNode& written) {
  JsonNode node = written;
  for (const char* key : {"data", "value", "data"}) {
    if (!node.is_object() || !node.find(key) || node.find("vertex") || node.find("node")) continue;
    node = node.at(key);
  }
  return node;
}

std::optional<JsonNode> compas_member(const JsonNode& node, const char* name) {
  std::optional<JsonNode> member = node.find(name);
  if (member && member->is_null()) return std::nullopt;
  return member;
}

Vector3 compas_vector(const JsonNode& written) {
  const JsonNode node = compas_content(written);
  if (node.size() != 3) node.fail(fmt::format("has {} numbers", node.size()), "3");
  return {node.at(std::size_t{0}).number(), node.at(1).number(), node.at(2).number()};
}

void assume_compas_friction(ImportedModel& model) {
  model.contact.friction_angle = correctly_rounded::degrees_of_atan(compas_friction);
  model.notes.push_back(fmt::format(
      "friction is not in the file: a coefficient of {}, as compas_dem's solvers assume", compas_friction));
}

ImportedModel read_compas(std::string_view text) {
  auto tree = std::make_shared<const nlohmann::json>(parse_json_file(text, "a model of COMPAS"));
  return CompasReader().read(JsonNode(std::move(tree), ""));
}

}  // namespace ashlar
