// [contact] and [[joint]].
#include "apps/scene/keys/joint_law_keys.hpp"

#include <fmt/format.h>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/shape_keys.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar::keys {
namespace {

using JointLaw = SceneJointLaw;
using Contact = SceneContact;
using Joint = SceneJoint;
using Energy = FractureEnergy;
using Roughness = SceneRoughness;

bool has_tension(const Energy& energy) {
  return energy.tension > 0.0;
}
bool has_shear(const Energy& energy) {
  return energy.shear > 0.0;
}

const Keys<Energy> energy_table(
    "", {number("tension", &Energy::tension, range::positive, "J/m^2",
                "with `tensile_strength`: beyond it traction falls linearly to zero at an opening of 2 "
                "`fracture_energy.tension` / `tensile_strength`, and returns to zero along the secant. None: "
                "strength is lost at once. A joint with fracture energy has springs, also beside "
                "multipliers, of more than strength^2 / (2 energy) Pa/m; no residual strength but friction, "
                "no `dilation_angle`, no `damping`, no point springs")
             .written_if(has_tension)
             .otherwise("none"),
         number("shear", &Energy::shear, range::positive, "J/m^2",
                "with `cohesion`: it falls linearly to zero at a slip of 2 `fracture_energy.shear` / "
                "`cohesion`, which remains; friction stays. Each strength needs its energy")
             .written_if(has_shear)
             .otherwise("none")});

const Keys<Energy>& energy_keys() {
  return energy_table;
}

const Keys<Roughness> roughness_table(
    "",
    {number("jrc", &Roughness::jrc, range::above_zero_to_20, "deg",
            "joint roughness coefficient JRC of a wall of this size. The shear strength is that of Barton "
            "and Bandis, p tan(`friction_angle` + JRC log10(JCS / p)) at the pressure p, at an angle of at "
            "most 70 degrees; `friction_angle` is that of the worn joint "
            "([rule](../../../mechanics/notes/rough_joints.md))")
         .required_always(),
     number("jcs", &Roughness::jcs, range::positive, "Pa", "compressive strength JCS of the walls")
         .required_always(),
     number("length", &Roughness::length, range::positive, "m",
            "of the wall: roughness wears with slip beyond that of the peak, (L/500) (JRC/L)^0.33. None: it "
            "does not wear")});

const Keys<Roughness>& roughness_keys() {
  return roughness_table;
}

/// Stiffness and strength. @tparam Struct SceneJointLaw or SceneJoint, whose values may be left out
template <class Struct>
std::vector<Key<Struct>> keys_of_strength() {
  return {
      number_or("auto", "normal_stiffness", &Struct::normal_stiffness, range::positive, "Pa/m",
                "with area springs, N/m with point springs. Auto: 20 E / size, of the softer and the smaller "
                "block (of the one that is not fixed); times size^2 for point springs"),
      number_or("auto", "shear_stiffness", &Struct::shear_stiffness, range::positive, "",
                "the same units. Auto: half of the normal stiffness"),
      number(
          "maximum_closure", &Struct::maximum_closure, range::positive, "m",
          "the joint stiffens as it closes: its pressure at a closure c is `normal_stiffness` c / (1 - c / "
          "`maximum_closure`), on the same curve under load and unloading "
          "([rule](../../../mechanics/notes/joint_closure.md)). With a `normal_stiffness`, area springs, and "
          "without `tensile_strength`, `compressive_strength` and `fracture_energy`. None: linear, as where "
          "a "
          "`[[joint]]` gives a `normal_stiffness` alone"),
      number("friction_angle", &Struct::friction_angle, range::zero_to_below_90, "", "Coulomb friction"),
      number("cohesion", &Struct::cohesion, range::not_negative, "Pa",
             "of contact area; falls to `cohesion_residual` for good where the joint opens or slides"),
      number(
          "tensile_strength", &Struct::tensile_strength, range::not_negative, "Pa",
          "falls to `tensile_strength_residual` for good where the joint opens, or slides and has cohesion")};
}

/// Crushing, failure, dilation and impact.
template <class Struct>
std::vector<Key<Struct>> keys_of_failure() {
  return {
      number(
          "compressive_strength", &Struct::compressive_strength, range::positive, "Pa",
          "at least `tensile_strength`: the joint crushes at this normal pressure, at constant stress, "
          "with friction under it; what has closed stays closed "
          "([rule](../../../mechanics/notes/crushing.md)). Not in a pushover or with movements of supports; "
          "in motion and statics without `dilation_angle`, `damping` and `fracture_energy`. A factor of "
          "safety divides it too. Points and edges, which have no area, do not crush. None: unlimited"),
      number("friction_angle_residual", &Struct::friction_angle_residual, range::zero_to_below_90, "",
             "of joints that have failed, or touch later: at most `friction_angle`")
          .otherwise("as `friction_angle`"),
      number("cohesion_residual", &Struct::cohesion_residual, range::not_negative, "Pa",
             "at most `cohesion`; with residual values equal to all strengths a joint is perfectly plastic "
             "and never fails"),
      number("tensile_strength_residual", &Struct::tensile_strength_residual, range::not_negative, "Pa",
             "at most `tensile_strength`. In statics a joint keeps it at any opening (it yields); in motion "
             "a point that exceeds it opens, and bonds again when it closes"),
      number("dilation_angle", &Struct::dilation_angle, range::zero_to_below_90, "",
             "where a joint slides by s it opens by s tan(`dilation_angle`), in either direction; at most "
             "`friction_angle` and its residual value. It has no limit"),
      number(
          "damping", &Struct::damping, range::zero_to_one, "",
          "share of critical, dynamic only: dashpots beside the springs of a joint, normal where it is "
          "closed and shear where it does not slide, never in tension. 1 brings two blocks that move against "
          "each other on the joint, all else free, to rest without oscillation. Multipliers have none"),
      number_or(
          "springs", "restitution", &Struct::restitution, range::zero_to_one, "",
          "motion only: normal velocity after an impact over that before, whatever the step, the integrator, "
          "the stiffness and the order. A step in which the joint closes faster than 1.5 times gravity times "
          "`time_step` ends just before the touch. `\"springs\"`: blocks rebound as springs, `damping` or "
          "multipliers have it. No number with formulation `paper` or `incremental`")
          .otherwise(
              "chosen: 0, or `\"springs\"` where steps resolve a given stiffness or the vibrations of a "
              "block, and with `damping`"),
      table<energy_keys>("fracture_energy", &Struct::fracture_energy, ""),
      table<roughness_keys>("roughness", &Struct::roughness, "")};
}

std::vector<Key<Contact>> of_law(std::vector<Key<JointLaw>> keys) {
  std::vector<Key<Contact>> result;
  for (Key<JointLaw>& key : keys) result.push_back(of(&Contact::law, std::move(key)));
  return result;
}

bool no_subdivisions(const Contact& contact) {
  return !contact.subdivisions;
}

constexpr int most_subdivisions = 8;

std::vector<Key<Contact>> keys_of_springs() {
  return {choice("springs", &Contact::springs, springs_names,
                 "stiffness per area of contact, or per contact point. With formulation `paper`: "
                 "`\"point\"`, no other value"),
          choice("surface", &Contact::surface, surface_names,
                 "the true surface of bent blocks, or their flat sub-faces. With formulation `paper` or "
                 "`incremental`: `\"flat\"`, no other value")};
}

std::vector<Key<Contact>> keys_of_search() {
  return {number_or("auto", "distance", &Contact::distance, range::positive, "m",
                    "gaps searched beyond those that a step can close. Auto: 1e-3 of the smallest size"),
          number_or("auto", "angle", &Contact::angle, range::zero_to_45, "",
                    "up to this from parallel, faces meet as face-face and edges as edge-face. Auto: 10")};
}

std::vector<Key<Contact>> keys_of_accuracy() {
  return {
      whole("subdivisions", &Contact::subdivisions, 0, most_subdivisions, "",
            "instead of `chord_tolerance`: uniform levels, each with four times as many sub-faces. "
            "Incremental blocks: 2 if left out"),
      number_or(
          "auto", "chord_tolerance", &Contact::chord_tolerance, range::positive, "m",
          "faces of blocks of order >= 2 are divided until they are this near their curved shape. Auto: 5e-3 "
          "of the smallest size. With point springs they start from one level of `subdivisions`")
          .written_if(no_subdivisions),
      flag(
          "augmented", &Contact::augmented,
          "multipliers hold blocks apart: no penetration exceeds `penetration_tolerance` as long as position "
          "projection requires no more energy than contacts have dissipated; impacts are plastic where "
          "blocks meet. Left out, statics hold joints without a given stiffness by multipliers, so that "
          "limits are those of contact without compliance, and joints with one by their springs; motion that "
          "starts from `initial_state = \"static\"` has multipliers where no joint is given a stiffness")
          .otherwise("false in motion, true in statics"),
      number_or("auto", "penetration_tolerance", &Contact::penetration_tolerance, range::positive, "m",
                "only with `augmented`. Auto: 1e-3 of `distance`"),
      number_or("auto", "allowed_depth", &Contact::allowed_depth, range::positive, "m",
                "how deep a corner or edge of a block may be in another one beyond the depth of the "
                "contacts, and in all where springs approximate contact without compliance; joints of given "
                "stiffness have the compliance that was given. A run that would go deeper ends as failed. "
                "Auto: 1e-2 of the smaller block's size beyond contacts, 1e-1 in all, with a warning from "
                "1e-2 on. Depths of overlaps that `allowed_overlap` accepts count from there"),
      number("allowed_overlap", &Contact::allowed_overlap, range::not_negative, "m",
             "permitted overlap of blocks as placed, up to 0.1 of the smaller one's size. Their contacts "
             "start without force. `check` and `run` warn of the number of pairs, `summary.json` lists them. "
             "Not with formulation `paper` or `incremental`")};
}

bool check_division(TomlTableReader& table, Contact& contact) {
  table.refuse_former(
      "fit",
      "fit is no key any more, blocks stay as they are placed; allowed_overlap accepts blocks that "
      "overlap by the errors of a survey");
  if (!contact.chord_tolerance || !contact.subdivisions) return true;
  table.error_at_key("subdivisions", fmt::format("subdivisions beside chord_tolerance ({}), only one of both "
                                                 "is allowed",
                                                 *contact.chord_tolerance));
  return false;
}

std::vector<Key<Contact>> keys_of_contact() {
  return joined(joined(joined(keys_of_springs(), of_law(keys_of_strength<JointLaw>())),
                       joined(keys_of_search(), of_law(keys_of_failure<JointLaw>()))),
                keys_of_accuracy());
}

const Keys<Contact> contact_table("For all pairs of blocks", keys_of_contact(), {check_division});

bool read_joined_blocks(TomlTableReader& table, const std::string& key, Joint& joint) {
  if (table.text_at("cut") || table.given("inside")) joint.blocks = {"*", "*"};
  std::vector<std::string> blocks;
  if (!table.read_texts(key, blocks)) return false;
  if (blocks.size() != 2) {
    table.error_at_value(key, fmt::format("{} has the wrong length ({} entries), two block names are needed",
                                          key, blocks.size()));
    return false;
  }
  if (blocks[0].empty() || blocks[1].empty()) {
    table.error_at_value(
        key, "joint names no block (\"\"), the name of a [[block]] or a glob that matches one is needed");
    return false;
  }
  joint.blocks = {blocks[0], blocks[1]};
  return true;
}

const Keys<SceneTie> tie_table(
    "", {number("tension", &SceneTie::tension, range::positive, "Pa", "the `tensile_strength` of the tie")
             .required_always(),
         number("shear", &SceneTie::shear, range::positive, "Pa", "its `cohesion`").required_always()});

/// `tied = true`, or a table with the strength of a tie that breaks.
bool read_tie(TomlTableReader& table, const std::string& key, Joint& joint) {
  const toml::table* strength = table.table_at(key);
  if (strength != nullptr && (strength->contains("tension") || strength->contains("shear")))
    return tie_table.read_table(table, key.c_str(), joint.tie.emplace());
  bool tied = false;
  if (!table.read_bool(key, tied, " or { tension, shear }")) return false;
  joint.tied = tied;
  return true;
}

const Own<Joint> tied = {"true or false or { tension, shear }",
                         [] {
                           return schema_of_any({Json{{"type", "boolean"}}, tie_table.table().schema()});
                         },
                         read_tie,
                         [](const Joint& joint) {
                           if (joint.tie) return tie_table.json(*joint.tie);
                           return joint.tied ? Json(*joint.tied) : Json();
                         },
                         []() -> const TableKeys& { return tie_table.table(); }};

/// Keys of the law, in place of those of [contact].
std::vector<Key<Joint>> keys_of_law() {
  std::vector<Key<Joint>> keys = joined(keys_of_strength<Joint>(), keys_of_failure<Joint>());
  for (Key<Joint>& key : keys) {
    key.meaning = "as in `[contact]`";
    key.absent = "as `[contact]`";
    key.brief = true;
  }
  return keys;
}

std::vector<Key<Joint>> keys_of_blocks() {
  return {
      own<Joint>("blocks",
                 {"an array of texts", [] { return schema_of_array(schema_of_text(), 0); },
                  read_joined_blocks, [](const Joint& joint) { return Json(joint.blocks); }},
                 "",
                 "two names or globs (`*`: any characters, `?`: one, `[...]`: one of a set; a character is a "
                 "code point of UTF-8), in any order, that match at least one pair; with `cut` or `inside` "
                 "it may be left out")
          .required_unless_given({"cut", "inside"}),
      inside(&Joint::inside, "only pairs of blocks that both have their centroid inside, as in `[[assign]]`")
          .otherwise("everywhere")
          .described_elsewhere(),
      name("cut", &Joint::cut,
           "the name of a `[[cut]]`: only pairs of blocks that it parted. Of pairs without a common face, "
           "those that have faces on opposite sides of one of its planes, where they may come to touch. A "
           "pair has one law for all its contacts: where several cuts made its common faces, the last "
           "`[[joint]]` of any of them counts")
          .otherwise("every contact")};
}

std::vector<Key<Joint>> keys_of_tie() {
  return {own("tied", tied, "",
              "`true`: bonded without limit over faces that lie in one plane and overlap, instead of "
              "contact. A table: a tie that breaks, and has the friction of the joint then; "
              "`fracture_energy` makes it break gradually. It is contact with the springs of a tie, also "
              "beside multipliers. Some pair must have such faces; others that match have contact as always")
              .otherwise("not tied")};
}

const Keys<Joint> joint_table(
    "Properties of the contacts between some blocks, in place of those of [contact]",
    joined(joined(keys_of_blocks(), keys_of_law()), keys_of_tie()));

const Keys<Energy> both_energies_table(
    "", {number("tension", &Energy::tension, range::positive, "J/m^2",
                "as in `[contact]`; `fracture_energy = 50` is 50 for both. Where it may be "
                "left out, strength is lost at once without it")
             .required_always(),
         number("shear", &Energy::shear, range::positive, "J/m^2", "").required_always()});

}  // namespace

std::vector<std::string> joint_law_keys() {
  std::vector<std::string> names;
  for (const Key<Joint>& key : keys_of_law()) names.emplace_back(key.name);
  return names;
}

const Keys<FractureEnergy>& both_energies_keys() {
  return both_energies_table;
}

bool read_both_energies(TomlTableReader& table, const std::string& key, FractureEnergy& energy) {
  if (table.table_at(key) != nullptr) return both_energies_table.read_table(table, key.c_str(), energy);
  constexpr NumberRange words = {0.0, range::no_limit, false, false, "a number > 0 or { tension, shear }"};
  if (!table.read_number(key, energy.tension, words)) return false;
  energy.shear = energy.tension;
  return true;
}

const Keys<SceneContact>& contact_keys() {
  return contact_table;
}

const Keys<SceneJoint>& joint_keys() {
  return joint_table;
}

const Keys<FractureEnergy>& fracture_energy_keys() {
  return energy_table;
}

}  // namespace ashlar::keys
