// [[bolt]] and [[prop]].
#include <fmt/format.h>

#include <limits>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/values.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar::keys {
namespace {

using Bolt = SceneBolt;
using Pattern = SceneBolt::Pattern;
using Prop = SceneProp;

/// @param support a SceneBolt or a SceneProp
template <class Support>
bool check_ends(TomlTableReader& table, Support& support) {
  if (support.from != support.to) return true;  // also where one of them is not finite
  table.error_at_value("to", fmt::format("both ends are the same point ([{}, {}, {}]), two points are needed",
                                         support.to.x(), support.to.y(), support.to.z()));
  support.from = support.to = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  return false;
}

bool check_spacing(TomlTableReader& table, Pattern& pattern) {
  if (!(pattern.spacing[0] <= 0.0 || pattern.spacing[1] <= 0.0)) return true;
  table.error_at_value("spacing", fmt::format("spacing is not positive ([{}, {}]), lengths > 0 are needed",
                                              pattern.spacing[0], pattern.spacing[1]));
  return false;
}

const Keys<Pattern> pattern_table(
    "",
    {table<plane_keys>("plane", &Pattern::plane, "").required_always(),
     row("spacing", &Pattern::spacing, "[a, b]", "m",
         "> 0: along the level line of the plane and across it; in a horizontal plane along x and y")
         .required_always(),
     number("length", &Pattern::length, range::positive_length, "m", "").required_always(),
     direction("direction", &Pattern::direction, "", "of the bolts from their heads on, any length")
         .otherwise("against the normal")},
    {check_spacing});

const Keys<Pattern>& pattern_keys() {
  return pattern_table;
}

bool grouted(const Bolt& bolt) {
  return bolt.anchored == Bolt::Anchorage::grouted;
}
constexpr const char* grout = "anchored = \"grouted\"";

/// A pattern stands in place of the ends.
bool check_pattern(TomlTableReader& table, Bolt& bolt) {
  if (!table.given("pattern")) return check_ends(table, bolt);
  bolt.from = bolt.to = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  return true;
}

bool check_pretension(TomlTableReader& table, Bolt& bolt) {
  if (!bolt.yield_force || bolt.pretension <= *bolt.yield_force) return true;
  table.error_at_value("pretension",
                       fmt::format("pretension is above yield_force ({} N), at most {} N is allowed",
                                   bolt.pretension, *bolt.yield_force));
  return false;
}

bool has_ends(const Bolt& bolt) {
  return !bolt.pattern;
}

const Keys<Bolt> bolt_table(
    "A bar through any number of blocks, or a row of them",
    {name("name", &Bolt::name, "each its own, among bolts and props").required_always(),
     place("from", &Bolt::from, "one end, in the placed, undeformed blocks")
         .required_unless_given({"pattern"})
         .not_beside({"pattern"})
         .written_if(has_ends),
     place("to", &Bolt::to, "the other end")
         .required_unless_given({"pattern"})
         .not_beside({"pattern"})
         .written_if(has_ends),
     faultless_table<pattern_keys>(
         "pattern", &Bolt::pattern,
         "instead of `from` and `to`: bolts NAME.1, NAME.2, ... on the faces in a plane, whose "
         "`point` is the head of one bolt, its `normal` out of the rock"),
     number("area", &Bolt::area, range::positive, "m^2", "of the steel").required_always(),
     number("young_modulus", &Bolt::young_modulus, range::positive, "Pa", ""),
     number("yield_force", &Bolt::yield_force, range::positive, "N",
            "of the steel, in tension and compression")
         .otherwise("does not yield"),
     number("rupture_strain", &Bolt::rupture_strain, range::positive, "",
            "strain at which the steel breaks, where it yields")
         .otherwise("does not break"),
     choice("anchored", &Bolt::anchored, anchorage_names, "bonded along its length, or held at both ends"),
     number("bond_stiffness", &Bolt::bond_stiffness, range::positive, "N/m per m",
            "shear stiffness of the grout; only if grouted, as the three below")
         .required_where(grouted)
         .only_if(grouted, grout),
     number("bond_strength", &Bolt::bond_strength, range::positive, "N/m", "shear strength of the grout")
         .only_if(grouted, grout)
         .otherwise("does not slip"),
     number("shear_stiffness", &Bolt::shear_stiffness, range::not_negative, "N/m",
            "of the dowel at each joint that a grouted bar crosses, where the blocks are nearer than its "
            "diameter")
         .only_if(grouted, grout),
     number("shear_strength", &Bolt::shear_strength, range::positive, "N", "of the dowel")
         .only_if(grouted, grout)
         .otherwise("unlimited"),
     number("pretension", &Bolt::pretension, range::not_negative, "N",
            "at installation; at most `yield_force`")},
    {check_pattern, check_pretension});

const Keys<Prop> prop_table(
    "A strut between two points of blocks",
    {name("name", &Prop::name, "each its own, among bolts and props").required_always(),
     place("from", &Prop::from, "one end, on or in a block as placed").required_always(),
     place("to", &Prop::to, "the other end").required_always(),
     number("stiffness", &Prop::stiffness, range::positive, "N/m", "").required_always(),
     number("yield_force", &Prop::yield_force, range::positive, "N", "").otherwise("does not yield"),
     flag("tension", &Prop::tension, "it pulls too")},
    {check_ends<Prop>});

}  // namespace

const Keys<SceneBolt>& bolt_keys() {
  return bolt_table;
}

const Keys<SceneProp>& prop_keys() {
  return prop_table;
}

}  // namespace ashlar::keys
