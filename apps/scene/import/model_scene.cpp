#include "apps/scene/import/model_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

// A float of TOML needs a point or an exponent, and Ashlar takes whole numbers too.
std::string number(double value) {
  return fmt::format("{}", value);
}

std::string vector(const Vector3& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

std::string scene_name(const std::string& name) {
  return fmt::format("{}.{}", imported_prefix, name);
}

/// Keys of a contact law, a line each.
std::string law_lines(const ImportedLaw& law) {
  std::string lines;
  const auto add = [&](const char* key, const std::optional<double>& value) {
    if (value) lines += fmt::format("{} = {}\n", key, number(*value));
  };
  add("friction_angle", law.friction_angle);
  add("cohesion", law.cohesion);
  add("tensile_strength", law.tensile_strength);
  add("normal_stiffness", law.normal_stiffness);
  add("shear_stiffness", law.shear_stiffness);
  return lines;
}

/// Names of many blocks, some on each line.
std::string names(const std::vector<std::string>& all) {
  constexpr std::size_t on_a_line = 8;
  std::string list = "[";
  for (std::size_t k = 0; k < all.size(); ++k)
    list += fmt::format("{}{}",
                        k == 0               ? ""
                        : k % on_a_line == 0 ? ",\n  "
                                             : ", ",
                        quoted(scene_name(all[k])));
  return list + "]";
}

/// Four corners that do not lie in one plane: the first one, and those farthest from it, from the line and from the plane
/// of those before.
std::array<Vector3, 4> spread_corners(const std::vector<Vector3>& points) {
  std::array<Vector3, 4> corners;
  corners.fill(points.front());
  const auto farthest = [&](auto distance) {
    return *std::max_element(points.begin(), points.end(),
                             [&](const Vector3& p, const Vector3& q) { return distance(p) < distance(q); });
  };
  corners[1] = farthest([&](const Vector3& p) { return (p - corners[0]).norm(); });
  const Vector3 along = corners[1] - corners[0];
  corners[2] = farthest([&](const Vector3& p) { return (p - corners[0]).cross(along).norm(); });
  const Vector3 normal = along.cross(corners[2] - corners[0]);
  corners[3] = farthest([&](const Vector3& p) { return std::abs((p - corners[0]).dot(normal)); });
  return corners;
}

/// A support that moves: a block of uniform strain, held at four corners.
std::string moving_support(const ImportedBlock& block) {
  std::string text = fmt::format("\n[[assign]]\nblocks = [{}]\norder = 1\n", quoted(scene_name(block.name)));
  for (const Vector3& corner : spread_corners(block.points))
    text += fmt::format(
        "[[assign.fix]]\npoint = {}\ndisplacement_history = [[0, 0, 0, 0], [1, {}, {}, {}]]\n",
        vector(corner), block.displacement->x(), block.displacement->y(), block.displacement->z());
  return text;
}

std::string loads_of(const ImportedBlock& block) {
  std::string text = fmt::format("\n[[assign]]\nblocks = [{}]\n", quoted(scene_name(block.name)));
  for (const ImportedLoad& load : block.loads)
    text += fmt::format("[[assign.load]]\npoint = {}\nforce = {}\n", vector(load.point), vector(load.force));
  return text;
}

std::string analysis(const ImportedModel& model) {
  std::string text = "[analysis]\ntype = \"static\"\n";
  const bool moves = std::any_of(model.blocks.begin(), model.blocks.end(),
                                 [](const ImportedBlock& block) { return block.displacement.has_value(); });
  if (moves) text += "end_time = 1\ntime_step = 0.1\n";
  if (model.gravity) text += fmt::format("gravity = {}\n", vector(*model.gravity));
  return text;
}

std::string materials(const ImportedModel& model) {
  std::string text;
  const auto add = [&](const std::string& name, const std::optional<double>& density) {
    text += fmt::format(
        "\n[[material]]\nname = {}\ndensity = {}{}\nyoung_modulus = {}  # not used by rigid blocks\n"
        "poisson_ratio = 0.2\n",
        quoted(name), number(density.value_or(imported_density)), density ? "" : "  # not in the file",
        number(imported_modulus));
  };
  for (const ImportedMaterial& material : model.materials) add(material.name, material.density);
  if (model.materials.empty()) add("stone", std::nullopt);
  return text;
}

/// Materials other than the first, and supports.
std::string assignments(const ImportedModel& model) {
  std::string text;
  std::map<std::size_t, std::vector<std::string>> by_material;
  std::vector<std::string> fixed;
  for (const ImportedBlock& block : model.blocks) {
    if (block.material.value_or(0) > 0) by_material[*block.material].push_back(block.name);
    if (block.fixed) fixed.push_back(block.name);
  }
  for (const auto& [material, blocks] : by_material)
    text += fmt::format("\n[[assign]]\nblocks = {}\nmaterial = {}\n", names(blocks),
                        quoted(model.materials[material].name));
  if (!fixed.empty()) text += fixed_blocks(fixed);
  for (const ImportedBlock& block : model.blocks) {
    if (block.displacement && !block.fixed) text += moving_support(block);
    if (!block.loads.empty() && !block.fixed) text += loads_of(block);
  }
  return text;
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? ' ' : c;
  }
  return result + '"';
}

std::string scene_of(const ImportedModel& model, const std::string& source, const std::filesystem::path& mesh,
                     const char* split) {
  std::string text = fmt::format("# Imported from {}.\ntitle = {}\n\n{}", quoted(source), quoted(model.title),
                                 analysis(model));
  text += "\n[contact]\n" + law_lines(model.contact);
  if (model.rounding > 0.0)
    text += fmt::format("allowed_overlap = {:.3g}  # by the digits of the file\n",
                        overlap_of_rounding * model.rounding);
  text += materials(model);
  text += fmt::format(
      "\n[[block]]\nname = {}\nmaterial = {}\norder = 0  # rigid\n"
      "mesh = {{ file = {}, split = \"{}\", flip = \"auto\" }}\n",
      quoted(imported_prefix), quoted(model.materials.empty() ? "stone" : model.materials.front().name),
      quoted(mesh.string()), split);
  text += assignments(model);
  for (const ImportedJoint& joint : model.joints)
    text += fmt::format("\n[[joint]]\nblocks = [{}, {}]\n{}{}", quoted(scene_name(joint.first)),
                        quoted(scene_name(joint.second)), law_lines(joint.law),
                        joint.tied ? "tied = true\n" : "");
  return text;
}

std::string fixed_blocks(const std::vector<std::string>& blocks) {
  return fmt::format("\n[[assign]]\nblocks = {}\nfixed = true\n", names(blocks));
}

std::string obj_of(const ImportedModel& model) {
  std::string text;
  int first = 1;
  for (const ImportedBlock& block : model.blocks) {
    text += fmt::format("o {}\n", block.name);
    for (const Vector3& point : block.points)
      text += fmt::format("v {} {} {}\n", point.x(), point.y(), point.z());
    for (const std::vector<int>& face : block.faces) {
      text += 'f';
      for (const int corner : face) text += fmt::format(" {}", first + corner);
      text += '\n';
    }
    first += static_cast<int>(block.points.size());
  }
  return text;
}

}  // namespace ashlar
