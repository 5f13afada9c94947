#include "apps/scene/import/poly_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include "apps/scene/import/poly_range.hpp"
#include "apps/scene/import/poly_statement.hpp"
#include "geometry/index.hpp"
#include "geometry/mesh/mesh_io.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

/// Commands without which the blocks would be others.
constexpr std::array<std::string_view, 8> shaping = {"jset",    "tunnel", "delete", "call",
                                                     "restore", "cut",    "block",  "densify"};

/// Coordinates with fewer decimals are meant as they are.
constexpr double coarsest_rounding = 0.5e-4;

class PolyReader {
 public:
  ImportedModel read(std::string_view text) {
    for (PolyStatement& statement : poly_statements(text)) read_command(statement);
    if (model_.blocks.empty()) throw MeshFileError("file has no blocks, the command poly is needed", 0, 0);
    use_materials();
    use_joint_material();
    if (finest_ <= coarsest_rounding) model_.rounding = finest_;
    for (const auto& [command, count] : passed_over_)
      model_.left_out.push_back(
          fmt::format("command {} ({})", command, count == 1 ? "once" : fmt::format("{} times", count)));
    return std::move(model_);
  }

 private:
  void read_command(PolyStatement& statement) {
    if (statement.take_if("polyhedron", 4)) return read_block(statement);
    if (statement.take_if("property", 4)) return read_property(statement);
    if (statement.take_if("change", 4)) return read_change(statement);
    if (statement.take_if("fix", 3)) return read_fix(statement);
    if (statement.take_if("gravity", 4)) return read_gravity(statement);
    if (statement.take_if("range", 3)) return read_range(statement);
    const std::string command = printable(statement.front().text);
    for (const std::string_view name : shaping)
      if (equal_ignoring_case(command, name))
        statement.fail(
            fmt::format("command {} changes the blocks and is not read, allowed is poly with brick, prism or "
                        "face",
                        command));
    ++passed_over_[command];
  }

  void read_block(PolyStatement& statement) {
    int region = 0, material = 1;
    for (;;) {
      if (statement.take_if("region", 3))
        region = statement.whole_number("region");
      else if (statement.take_if("material", 3))
        material = statement.whole_number("material");
      else if (statement.take_if("constitutive", 4))
        (void)statement.whole_number("constitutive number");
      else
        break;
    }
    ImportedBlock block;
    if (statement.take_if("prism", 2))
      read_prism(statement, block);
    else if (statement.take_if("brick", 2))
      read_brick(statement, block);
    else if (!statement.done() && is_poly_word(statement.front().text, "face", 2))
      read_faces(statement, block);
    else
      statement.fail(fmt::format("shape of poly ({}) is not read, allowed are brick, prism and face",
                                 statement.done() ? "none" : printable(statement.front().text)));
    if (!statement.done())
      statement.fail(fmt::format("word after a block ({}), the command must end here",
                                 printable(statement.front().text)));
    turn_outward(block);
    const std::string number = std::to_string(model_.blocks.size() + 1);
    block.name = region == 0 ? number : fmt::format("r{}_{}", region, number);
    places_.push_back({region, centroid_of(block)});
    material_of_.push_back(material);
    model_.blocks.push_back(std::move(block));
  }

  /// Three numbers each. The last decimals tell how exact the file is.
  std::vector<Vector3> corners(PolyStatement& statement, const char* of, std::size_t least) {
    std::vector<Vector3> points;
    while (statement.at_number()) {
      Vector3 point;
      for (double& coordinate : point) {
        if (statement.at_number()) finest_ = std::min(finest_, decimals(statement.front().text));
        coordinate = statement.number("coordinate");
      }
      points.push_back(point);
    }
    if (points.size() < least)
      statement.fail(fmt::format("{} has {} corners, at least {} are needed", of, points.size(), least));
    return points;
  }

  /// As rounding_of, where there is a decimal point.
  static double decimals(std::string_view number) {
    const double rounding = number.find('.') == std::string_view::npos ? 1.0 : rounding_of(number);
    return rounding > 0.0 ? rounding : 1.0;
  }

  void read_prism(PolyStatement& statement, ImportedBlock& block) {
    if (!statement.take_if("a", 1)) statement.fail("prism without its face a, which is needed");
    block.points = corners(statement, "face a", 3);
    const auto count = static_cast<int>(block.points.size());
    if (!statement.take_if("b", 1)) statement.fail("prism without its face b, which is needed");
    const std::vector<Vector3> other = corners(statement, "face b", 3);
    if (other.size() != block.points.size())
      statement.fail(fmt::format("face b has {} corners, face a has {}, the same number is needed",
                                 other.size(), count));
    block.points.insert(block.points.end(), other.begin(), other.end());
    std::vector<int> a, b;
    for (int k = 0; k < count; ++k) {
      a.push_back(k);
      b.push_back(count + k);
      const int next = (k + 1) % count;
      block.faces.push_back({k, next, count + next, count + k});
    }
    block.faces.push_back(a);
    block.faces.push_back(b);
  }

  void read_brick(PolyStatement& statement, ImportedBlock& block) {
    Vector3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = statement.number("lower limit of a brick");
      high[axis] = statement.number("upper limit of a brick");
      if (!(low[axis] < high[axis]))
        statement.fail(fmt::format("limits of a brick before here ({} to {}), they must increase", low[axis],
                                   high[axis]));
    }
    for (int k = 0; k < 8; ++k)
      block.points.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                                (k & 4) != 0 ? high.z() : low.z());
    block.faces = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  }

  // Faces name their corners by coordinates: equal ones are one.
  void read_faces(PolyStatement& statement, ImportedBlock& block) {
    std::map<std::array<double, 3>, int> index_of;
    while (statement.take_if("face", 2)) {
      std::vector<int> face;
      for (const Vector3& point : corners(statement, "face", 3)) {
        const auto [found, is_new] = index_of.emplace(std::array{point.x(), point.y(), point.z()},
                                                      static_cast<int>(block.points.size()));
        if (is_new) block.points.push_back(point);
        face.push_back(found->second);
      }
      block.faces.push_back(std::move(face));
    }
    if (block.faces.size() < 4)
      statement.fail(fmt::format("block has {} faces, at least 4 are needed", block.faces.size()));
  }

  void read_property(PolyStatement& statement) {
    const bool joints = statement.take_if("jmaterial", 4);
    if (!joints && !statement.take_if("material", 3))
      statement.fail("property of neither mat nor jmat, one of them is needed");
    const int number = statement.whole_number("number of a material");
    while (!statement.done()) {
      const std::string_view name = statement.take().text;
      const double value = statement.number("value of a property");
      if (joints)
        set_joint_property(number, name, value);
      else if (is_poly_word(name, "density", 4))
        density_[number] = value;
      else
        ++passed_over_[fmt::format("property mat {}", printable(name))];
    }
  }

  void set_joint_property(int number, std::string_view name, double value) {
    if (number != 1) {
      ++passed_over_[fmt::format("property jmat {} (contacts have jmat 1)", number)];
      return;
    }
    ImportedLaw& law = model_.contact;
    const bool none = value == 0.0;
    if (is_poly_word(name, "jfriction", 4))
      law.friction_angle = value;
    else if (is_poly_word(name, "jcohesion", 4))
      law.cohesion = value;
    else if (is_poly_word(name, "jtension", 4))
      law.tensile_strength = value;
    else if (is_poly_word(name, "jkn", 3))
      law.normal_stiffness = value;
    else if (is_poly_word(name, "jks", 3))
      law.shear_stiffness = value;
    else if (!none)
      ++passed_over_[fmt::format("property jmat {}", printable(name))];
  }

  std::vector<bool> blocks_in(PolyStatement& statement) {
    if (statement.done()) return std::vector<bool>(places_.size(), true);
    if (!statement.take_if("range", 3))
      statement.fail(fmt::format("word ({}) where a range is needed", printable(statement.front().text)));
    return PolyRange(statement, named_).select(places_);
  }

  void read_change(PolyStatement& statement) {
    if (statement.take_if("material", 3)) {
      const int material = statement.whole_number("number of a material");
      const std::vector<bool> in = blocks_in(statement);
      for (std::size_t k = 0; k < in.size(); ++k)
        if (in[k]) material_of_[k] = material;
    } else {
      ++passed_over_[fmt::format("change {}", statement.done() ? "" : printable(statement.front().text))];
    }
  }

  void read_fix(PolyStatement& statement) {
    const std::vector<bool> in = blocks_in(statement);
    for (std::size_t k = 0; k < in.size(); ++k)
      if (in[k]) model_.blocks[k].fixed = true;
  }

  void read_gravity(PolyStatement& statement) {
    Vector3 gravity;
    for (double& component : gravity) component = statement.number("gravity");
    model_.gravity = gravity;
  }

  void read_range(PolyStatement& statement) {
    if (!statement.take_if("name", 4)) statement.fail("range without name, which is needed");
    std::string name(statement.take().text);
    for (char& c : name)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    // A copy of what the names mean now: a later range of the same name does not change it.
    named_[name] = std::make_shared<const PolyRange>(statement, named_);
  }

  void use_materials() {
    std::map<int, std::size_t> index_of;
    for (std::size_t k = 0; k < model_.blocks.size(); ++k) {
      const int number = material_of_[k];
      const auto [found, is_new] = index_of.emplace(number, model_.materials.size());
      if (is_new) {
        ImportedMaterial material{fmt::format("mat{}", number), std::nullopt};
        if (const auto density = density_.find(number); density != density_.end()) {
          if (!(density->second > 0.0))
            throw MeshFileError(
                fmt::format("density of material {} ({}), must be > 0", number, density->second), 0, 0);
          material.density = density->second;
        } else {
          model_.notes.push_back(fmt::format("density of material {} is not in the file", number));
        }
        model_.materials.push_back(std::move(material));
      }
      model_.blocks[k].material = found->second;
    }
  }

  void use_joint_material() {
    ImportedLaw& law = model_.contact;
    if (!law.friction_angle)
      model_.notes.emplace_back("friction (jfriction of jmat 1) is not in the file: none");
    if (!model_.gravity) model_.notes.emplace_back("gravity is not in the file: 9.81 m/s^2 downwards");
    // Zero is no stiffness: 3DEC needs one.
    if (law.normal_stiffness == 0.0) law.normal_stiffness.reset();
    if (law.shear_stiffness == 0.0) law.shear_stiffness.reset();
  }

  ImportedModel model_;
  std::vector<PolyPlace> places_;  ///< (#blocks)
  std::vector<int> material_of_;   ///< (#blocks)
  std::map<int, double> density_;  ///< of materials
  PolyRange::Named named_;
  std::map<std::string, int> passed_over_;  ///< times that each was
  double finest_ = 1.0;
};

}  // namespace

ImportedModel read_poly(std::string_view text) {
  return PolyReader().read(text);
}

}  // namespace ashlar
