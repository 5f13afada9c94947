#include "apps/scene/import/compas_problem.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <utility>

#include "apps/scene/import/compas_reader.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

class ProblemReader {
 public:
  ProblemReader(ImportedModel& model, const std::map<std::string, std::size_t>& block_of)
      : model_(model), block_of_(block_of) {}

  void read(const JsonNode& problem) {
    const JsonNode conditions = compas_content(problem.at("boundary_conditions"));
    read_gravity(conditions);
    each(conditions, "point_loads", [this](const JsonNode& load) { add_point_load(load); });
    each(conditions, "surface_loads", [this](const JsonNode& load) { add_surface_load(load); });
    each(conditions, "displacements", [this](const JsonNode& support) { add_displacement(support); });
    const std::optional<JsonNode> contact = compas_member(problem, "contact_properties");
    read_contact(contact ? std::optional(compas_content(*contact)) : std::nullopt);
  }

 private:
  template <class Action>
  static void each(const JsonNode& node, const char* list, Action action) {
    const std::optional<JsonNode> entries = compas_member(node, list);
    if (!entries) return;
    for (std::size_t k = 0; k < entries->size(); ++k) action(entries->at(k));
  }

  void read_gravity(const JsonNode& conditions) {
    const std::optional<JsonNode> given = compas_member(conditions, "gravity");
    double gravity = compas_gravity;
    if (given && given->boolean()) {
      if (const std::optional<JsonNode> g = compas_member(conditions, "g")) gravity = g->number();
    } else {
      model_.notes.push_back(fmt::format(
          "the problem has no gravity: {} m/s^2 downwards, which compas_dem's solvers always apply",
          compas_gravity));
    }
    Vector3 all(0, 0, -gravity);
    each(conditions, "body_forces",
         [&](const JsonNode& acceleration) { all += compas_vector(acceleration); });
    model_.gravity = all;
  }

  ImportedBlock& block(const JsonNode& entry) {
    const JsonNode index = entry.at("block_index");
    const auto found = block_of_.find(std::to_string(index.count()));
    if (found == block_of_.end())
      index.fail(fmt::format("is unknown ({})", index.count()), "the node of a block");
    return model_.blocks[found->second];
  }

  void add_point_load(const JsonNode& entry) {
    ImportedBlock& loaded = block(entry);
    const std::optional<JsonNode> point = compas_member(entry, "point"),
                                  moment = compas_member(entry, "moment");
    add_load(loaded, point ? compas_vector(*point) : centroid_of(loaded), compas_vector(entry.at("force")),
             moment ? compas_vector(*moment) : Vector3::Zero());
    const std::optional<JsonNode> type = compas_member(entry, "loading_type");
    if (type && type->text() != "ramp")
      model_.left_out.push_back(fmt::format("loading type {} of a load on block {} (the analysis is static)",
                                            type->text(), loaded.name));
  }

  void add_surface_load(const JsonNode& entry) {
    ImportedBlock& loaded = block(entry);
    const JsonNode points = compas_content(entry.at("polygon")).at("points");
    std::vector<Vector3> corners;
    for (std::size_t k = 0; k < points.size(); ++k) corners.push_back(compas_vector(points.at(k)));
    if (corners.size() < 3) points.fail(fmt::format("has {} corners", corners.size()), "at least 3");
    // Triangles from the first corner: sums of their areas, as vectors, and of their centroids.
    Vector3 area = Vector3::Zero(), centre = Vector3::Zero();
    for (std::size_t k = 2; k < corners.size(); ++k)
      area += 0.5 * (corners[k - 1] - corners[0]).cross(corners[k] - corners[0]);
    if (area.isZero(0.0)) points.fail("has no area", "a polygon");
    const Vector3 normal = area.normalized();
    for (std::size_t k = 2; k < corners.size(); ++k)
      centre += 0.5 * (corners[k - 1] - corners[0]).cross(corners[k] - corners[0]).dot(normal) *
                (corners[0] + corners[k - 1] + corners[k]) / 3.0;
    const std::optional<JsonNode> direction = compas_member(entry, "direction");
    const double force = entry.at("magnitude").number() * area.norm();
    add_load(loaded, centre / area.norm(), force * (direction ? compas_vector(*direction) : normal),
             Vector3::Zero());
  }

  void add_displacement(const JsonNode& entry) {
    ImportedBlock& held = block(entry);
    const auto values = [&](const char* name) {
      std::vector<std::optional<double>> numbers(3);
      if (const std::optional<JsonNode> list = compas_member(entry, name)) {
        if (list->size() != 3) list->fail(fmt::format("has {} numbers", list->size()), "3");
        for (std::size_t k = 0; k < 3; ++k)
          if (!list->at(k).is_null()) numbers[k] = list->at(k).number();
      }
      return numbers;
    };
    const auto translation = values("translation"), rotation = values("rotation");
    const auto given = [](const auto& numbers) { return numbers[0] && numbers[1] && numbers[2]; };
    const auto zero = [](const auto& numbers) {
      return numbers[0].value_or(0) == 0.0 && numbers[1].value_or(0) == 0.0 && numbers[2].value_or(0) == 0.0;
    };
    if (!zero(rotation)) model_.left_out.push_back(fmt::format("prescribed rotation of block {}", held.name));
    if (!given(translation)) {
      if (!zero(translation) || translation[0] || translation[1] || translation[2])
        model_.left_out.push_back(fmt::format(
            "displacement of block {} in some directions only (all three are needed)", held.name));
      return;
    }
    held.fixed = zero(translation);
    if (!held.fixed) held.displacement = Vector3(*translation[0], *translation[1], *translation[2]);
    if (!given(rotation))
      model_.notes.push_back(
          fmt::format("block {}, whose displacement is prescribed, does not turn", held.name));
  }

  void read_contact(const std::optional<JsonNode>& properties) {
    if (properties && compas_member(*properties, "joint_model"))
      model_.left_out.emplace_back(
          "stiffness of joints kn, kt in N/m (a stiffness for each area, Pa/m, is needed)");
    const std::optional<JsonNode> written =
        properties ? compas_member(*properties, "contact_model") : std::nullopt;
    if (!written) return assume_compas_friction(model_);
    const JsonNode law = compas_content(*written);
    const std::optional<JsonNode> phi = compas_member(law, "phi"), mu = compas_member(law, "mu");
    if (!phi && !mu) written->fail("has no friction", "a Mohr-Coulomb law with phi or mu");
    const double angle = phi ? phi->number() : correctly_rounded::degrees_of_atan(mu->number());
    if (!(angle >= 0.0 && angle < 90.0))
      (phi ? *phi : *mu).fail(fmt::format("is {}", angle), "0 to below 90 degrees");
    model_.contact.friction_angle = angle;
    const auto strength = [&](const char* name) -> std::optional<double> {
      const std::optional<JsonNode> value = compas_member(law, name);
      if (!value) return std::nullopt;
      if (!(value->number() >= 0.0)) value->fail(fmt::format("is {}", value->number()), "a number >= 0");
      return value->number();
    };
    model_.contact.cohesion = strength("c");
    model_.contact.tensile_strength = strength("t_c");
    if (compas_member(law, "k_n") || compas_member(law, "k_t"))
      model_.left_out.emplace_back("stiffness k_n, k_t of the contact law (its unit is not said)");
  }

  ImportedModel& model_;
  const std::map<std::string, std::size_t>& block_of_;
};

}  // namespace

void read_compas_problem(const JsonNode& problem, ImportedModel& model,
                         const std::map<std::string, std::size_t>& block_of) {
  ProblemReader(model, block_of).read(problem);
}

}  // namespace ashlar
