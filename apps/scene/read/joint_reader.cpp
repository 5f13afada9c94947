#include "apps/scene/read/joint_reader.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/read/region_reader.hpp"

namespace ashlar {
namespace {

/// @param law a SceneJointLaw or a SceneJoint
template <class Law>
void read_more_of_joint(TomlTableReader& table, Law& law) {
  table.read_number("friction_angle_residual", law.friction_angle_residual, range::zero_to_below_90);
  table.read_number("cohesion_residual", law.cohesion_residual, range::not_negative);
  table.read_number("tensile_strength_residual", law.tensile_strength_residual, range::not_negative);
  table.read_number("dilation_angle", law.dilation_angle, range::zero_to_below_90);
  table.read_number("damping", law.damping, range::zero_to_one);
  std::optional<double> restitution;
  if (table.read_number_or_word("restitution", "springs", restitution, range::zero_to_one))
    law.restitution = restitution;
  const bool fracture = table.given("fracture_energy");
  TomlTableReader energy = table.table_or_empty("fracture_energy");
  FractureEnergy read;
  energy.read_number("tension", read.tension, range::positive);
  energy.read_number("shear", read.shear, range::positive);
  if (fracture) law.fracture_energy = read;
}

}  // namespace

void read_contact(TomlTableReader table, SceneContact& contact) {
  table.read_choice("springs", contact.springs, springs_names);
  table.read_choice("surface", contact.surface, surface_names);
  table.read_number_or_auto("normal_stiffness", contact.law.normal_stiffness, range::positive);
  table.read_number_or_auto("shear_stiffness", contact.law.shear_stiffness, range::positive);
  table.read_number("friction_angle", contact.law.friction_angle, range::zero_to_below_90);
  table.read_number("cohesion", contact.law.cohesion, range::not_negative);
  table.read_number("tensile_strength", contact.law.tensile_strength, range::not_negative);
  table.read_number("compressive_strength", contact.law.compressive_strength, range::positive);
  read_more_of_joint(table, contact.law);
  table.read_number_or_auto("distance", contact.distance, range::positive);
  table.read_number_or_auto("angle", contact.angle, range::zero_to_45);
  table.read_number_or_auto("chord_tolerance", contact.chord_tolerance, range::positive);
  table.read_integer("subdivisions", contact.subdivisions, 0, 8);
  bool augmented = false;
  if (table.read_bool("augmented", augmented)) contact.augmented = augmented;
  table.read_number_or_auto("penetration_tolerance", contact.penetration_tolerance, range::positive);
  table.read_number_or_auto("allowed_depth", contact.allowed_depth, range::positive);
  table.read_number("allowed_overlap", contact.allowed_overlap, range::not_negative);
  table.refuse_former(
      "fit",
      "fit is no key any more, blocks stay as they are placed; allowed_overlap accepts blocks that "
      "overlap by the errors of a survey");
  if (contact.chord_tolerance && contact.subdivisions)
    table.error_at_key("subdivisions",
                       fmt::format("subdivisions beside chord_tolerance ({}), only one of both "
                                   "is allowed",
                                   *contact.subdivisions));
}

namespace {

// Distinguishes "not given" from "auto" for the stiffness of a joint.
void read_stiffness(TomlTableReader& table, const char* key, std::optional<std::optional<double>>& result) {
  std::optional<double> stiffness;
  if (table.read_number_or_auto(key, stiffness, range::positive)) result.emplace(stiffness);
}

/// `tied = true`, or a table with the strength of a tie that breaks.
void read_tie(TomlTableReader& table, SceneJoint& joint) {
  const toml::table* strength = table.table_at("tied");
  if (strength == nullptr || !(strength->contains("tension") || strength->contains("shear"))) {
    bool tied = false;
    if (table.read_bool("tied", tied, " or { tension, shear }")) joint.tied = tied;
    return;
  }
  TomlTableReader reader = *table.table("tied");
  for (const char* key : {"tension", "shear"}) reader.require(key);
  SceneTie tie;
  reader.read_number("tension", tie.tension, range::positive);
  reader.read_number("shear", tie.shear, range::positive);
  joint.tie = tie;
}

}  // namespace

SceneJoint read_joint(TomlTableReader& table) {
  SceneJoint joint;
  std::vector<std::string> blocks;
  joint.inside = read_inside(table);
  if (!table.read_name("cut", joint.cut) && !table.given("inside")) table.require("blocks");
  if (!joint.cut.empty() || table.given("inside")) joint.blocks = {"*", "*"};
  if (table.read_texts("blocks", blocks)) {
    if (blocks.size() == 2 && (blocks[0].empty() || blocks[1].empty()))
      table.error_at_value(
          "blocks",
          "joint names no block (\"\"), the name of a [[block]] or a glob that matches one is needed");
    else if (blocks.size() == 2)
      joint.blocks = {blocks[0], blocks[1]};
    else
      table.error_at_value("blocks", fmt::format("blocks has the wrong length ({} entries), two block names "
                                                 "are needed",
                                                 blocks.size()));
  }
  read_stiffness(table, "normal_stiffness", joint.normal_stiffness);
  read_stiffness(table, "shear_stiffness", joint.shear_stiffness);
  table.read_number("friction_angle", joint.friction_angle, range::zero_to_below_90);
  table.read_number("cohesion", joint.cohesion, range::not_negative);
  table.read_number("tensile_strength", joint.tensile_strength, range::not_negative);
  table.read_number("compressive_strength", joint.compressive_strength, range::positive);
  read_more_of_joint(table, joint);
  read_tie(table, joint);
  return joint;
}

}  // namespace ashlar
