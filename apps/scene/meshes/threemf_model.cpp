#include "apps/scene/meshes/threemf_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

[[noreturn]] void refuse_model(const std::string& what) {
  throw MeshFileError(what, 0, 0);  // the XML reader adds the place
}

std::string_view required(const char* element, const char* name, const XmlAttributes& attributes) {
  const auto value = attributes.find(name);
  if (!value) refuse_model(fmt::format("{} without {}, which is needed", element, name));
  return *value;
}

double number(TextScanner& scan, const char* what) {
  const double value = scan.coordinate(what);
  if (!std::isfinite(value)) scan.fail(what, "must be a number");
  return value;
}

double number(const char* element, const char* name, const XmlAttributes& attributes) {
  TextScanner scan(required(element, name, attributes), '\0');
  if (!scan.next_line()) refuse_model(fmt::format("{} with an empty {}, a number is needed", element, name));
  const double value = number(scan, name);
  scan.expect_end_of_line();
  return value;
}

long long integer(const char* element, const char* name, const XmlAttributes& attributes, long long low,
                  long long high) {
  TextScanner scan(required(element, name, attributes), '\0');
  if (!scan.next_line()) refuse_model(fmt::format("{} with an empty {}, a number is needed", element, name));
  const long long value = scan.integer(name, low, high);
  scan.expect_end_of_line();
  return value;
}

/// Points are rows: p' = p M, the last row is the translation (section 3.3).
Eigen::Affine3d transformation_of(const XmlAttributes& attributes) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  const auto text = attributes.find("transform");
  if (!text) return result;
  TextScanner scan(*text, '\0');
  if (!scan.next_line()) refuse_model("empty transform, 12 numbers are needed");
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 3; ++column) result(column, row) = number(scan, "transform");
  scan.expect_end_of_line();
  return result;
}

constexpr std::array<std::string_view, 3> harmless_extensions = {
    "http://schemas.microsoft.com/3dmanufacturing/material/",
    "http://schemas.microsoft.com/3dmanufacturing/production/",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/"};

void check_extensions(const XmlAttributes& attributes) {
  TextScanner scan(attributes.find("requiredextensions").value_or(""), '\0');
  if (!scan.next_line()) return;
  for (std::string_view prefix = scan.word(); !prefix.empty(); prefix = scan.word()) {
    const std::string_view space = attributes.find(std::string("xmlns:").append(prefix)).value_or(prefix);
    if (std::none_of(harmless_extensions.begin(), harmless_extensions.end(),
                     [&](std::string_view known) { return space.starts_with(known); }))
      refuse_model(
          fmt::format("required extension \"{}\", allowed are materials and production", printable(space)));
  }
}

}  // namespace

ThreemfModel::Element ThreemfModel::child(std::string_view name) const {
  struct Rule {
    Element parent;
    std::string_view name;
    Element element;
  };
  constexpr std::array<Rule, 11> rules = {{{Element::vertices, "vertex", Element::vertex},
                                           {Element::triangles, "triangle", Element::triangle},
                                           {Element::model, "resources", Element::resources},
                                           {Element::model, "build", Element::build},
                                           {Element::resources, "object", Element::object},
                                           {Element::object, "mesh", Element::mesh},
                                           {Element::object, "components", Element::components},
                                           {Element::mesh, "vertices", Element::vertices},
                                           {Element::mesh, "triangles", Element::triangles},
                                           {Element::components, "component", Element::component},
                                           {Element::build, "item", Element::item}}};
  if (!name.starts_with(prefix_)) return Element::other;
  name.remove_prefix(prefix_.size());
  for (const Rule& rule : rules)
    if (rule.parent == open_.back() && rule.name == name) return rule.element;
  return Element::other;
}

void ThreemfModel::start(std::string_view name, const XmlAttributes& attributes) {
  if (open_.empty()) {
    start_model(name, attributes);
    return;
  }
  const Element element = child(name);
  if (element == Element::object) start_object(attributes);
  if (element == Element::vertex) add_vertex(attributes);
  if (element == Element::triangle) add_triangle(attributes);
  // An object can be referred to once it is complete.
  if (element == Element::component)
    objects_.back().components.push_back(use_of("component", attributes, objects_.size() - 1));
  if (element == Element::item) items_.push_back(use_of("item", attributes, objects_.size()));
  open_.push_back(element);
}

void ThreemfModel::end() {
  open_.pop_back();
}

void ThreemfModel::start_model(std::string_view name, const XmlAttributes& attributes) {
  constexpr std::string_view core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
  const std::size_t colon = name.find(':');
  const std::size_t local = colon == std::string_view::npos ? 0 : colon + 1;
  prefix_ = name.substr(0, local);
  const std::string space = local == 0 ? "xmlns" : fmt::format("xmlns:{}", name.substr(0, colon));
  const auto given = attributes.find(space);
  if (name.substr(local) != "model" || (given && *given != core))
    refuse_model(fmt::format("root element {} of {}, allowed is model of {}", printable(name),
                             given ? std::string(*given) : "no namespace", core));
  check_extensions(attributes);
  open_.push_back(Element::model);
}

void ThreemfModel::start_object(const XmlAttributes& attributes) {
  const long long id = integer("object", "id", attributes, 0, std::numeric_limits<int>::max());
  if (!number_of_id_.emplace(id, objects_.size()).second)
    refuse_model(fmt::format("two objects with the id {}, each needs its own", id));
  objects_.push_back({fmt::format("Object_{}", id), {}, {}});
}

void ThreemfModel::add_vertex(const XmlAttributes& attributes) {
  objects_.back().mesh.points.emplace_back(number("vertex", "x", attributes),
                                           number("vertex", "y", attributes),
                                           number("vertex", "z", attributes));
}

void ThreemfModel::add_triangle(const XmlAttributes& attributes) {
  PolygonSoup& mesh = objects_.back().mesh;
  if (mesh.points.empty()) refuse_model("triangle of an object without vertices above it, which it needs");
  const auto last = static_cast<long long>(mesh.points.size()) - 1;
  for (const char* name : {"v1", "v2", "v3"})
    mesh.corners.push_back(static_cast<int>(integer("triangle", name, attributes, 0, last)));
  mesh.face_ends.push_back(static_cast<int>(mesh.corners.size()));
}

ThreemfModel::Use ThreemfModel::use_of(const char* what, const XmlAttributes& attributes,
                                       std::size_t known) const {
  attributes.each([&](std::string_view name, std::string_view) {
    if (name == "path" || name.ends_with(":path"))
      refuse_model(fmt::format("{} from another part of the package ({}), allowed are objects of this one",
                               what, printable(name)));
  });
  const long long id = integer(what, "objectid", attributes, 0, std::numeric_limits<int>::max());
  const auto found = number_of_id_.find(id);
  if (found == number_of_id_.end() || found->second >= known)
    refuse_model(fmt::format("{} of object {}, allowed are objects that stand above it", what, id));
  return {found->second, transformation_of(attributes)};
}

ShapeLayout ThreemfModel::layout(std::size_t bytes) && {
  ShapeLayout layout(ShapeLayout::SameName::numbered, layout_limits(bytes));
  std::vector<std::size_t> shapes;
  for (Object& object : objects_) shapes.push_back(layout.add(std::move(object.mesh)));
  // Components precede the object that contains them.
  std::vector<LayoutSize> sizes;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    LayoutSize& size = sizes.emplace_back(LayoutSize{1.0, static_cast<double>(layout.faces(shapes[i]))});
    for (const Use& component : objects_[i].components) size += sizes[component.object];
  }
  LayoutSize all;
  for (const Use& item : items_) all += sizes[item.object];
  layout.require_room(all);
  for (const Use& item : items_) {
    std::vector<Use> stack = {item};
    while (!stack.empty()) {
      const Use use = stack.back();
      stack.pop_back();
      const Object& object = objects_[use.object];
      layout.place(object.name, shapes[use.object], use.transformation);
      for (std::size_t k = object.components.size(); k-- > 0;) {
        const Use& component = object.components[k];
        stack.push_back({component.object, use.transformation * component.transformation});
      }
    }
  }
  return layout;
}

}  // namespace ashlar
