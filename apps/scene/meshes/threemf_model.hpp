// The model part of a 3MF file: objects and the build.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/meshes/shape_layout.hpp"
#include "apps/scene/meshes/xml_reader.hpp"

namespace ashlar {

class ThreemfModel : public XmlHandler {
 public:
  void start(std::string_view name, const XmlAttributes& attributes) override;
  void end() override;

  /// The layout of a part that was read; uses this up. @param bytes of the part
  [[nodiscard]] ShapeLayout layout(std::size_t bytes) &&;

 private:
  /// Elements that are read; all others are ignored with their content.
  enum class Element {
    other,
    model,
    resources,
    object,
    mesh,
    vertices,
    vertex,
    triangles,
    triangle,
    components,
    component,
    build,
    item
  };
  struct Use {
    std::size_t object;
    Eigen::Affine3d transformation;
  };
  struct Object {
    std::string name;
    PolygonSoup mesh;
    std::vector<Use> components;
  };

  [[nodiscard]] Element child(std::string_view name) const;
  void start_model(std::string_view name, const XmlAttributes& attributes);
  void start_object(const XmlAttributes& attributes);
  void add_vertex(const XmlAttributes& attributes);
  void add_triangle(const XmlAttributes& attributes);
  /// @param known number of objects that may be used
  [[nodiscard]] Use use_of(const char* what, const XmlAttributes& attributes, std::size_t known) const;

  std::vector<Element> open_;
  std::string prefix_;  ///< of the names of the core's elements, with its colon; usually empty
  std::map<long long, std::size_t> number_of_id_;
  std::vector<Object> objects_;
  std::vector<Use> items_;
};

}  // namespace ashlar
