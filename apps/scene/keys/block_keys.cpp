// [[block]] and [[assign]].
#include "apps/scene/keys/block_keys.hpp"

#include <fmt/format.h>

#include "apps/scene/keys/fix_keys.hpp"
#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/shape_keys.hpp"
#include "apps/scene/read/block_arrays.hpp"
#include "apps/scene/read/model_origin.hpp"

namespace ashlar::keys {
namespace {

using Assign = SceneAssign;
using Array = SceneArray;

constexpr int largest_order = 12;
constexpr const char* order_words = "a whole number from 0 to 12 or \"auto\"";

Json schema_of_order() {
  return schema_of_any(
      {Json{{"const", "auto"}}, schema_of_number({0.0, largest_order, true, true, ""}, "integer")});
}

/// A block without an order has an automatic one, which the reader of scenes replaces.
bool read_order(TomlTableReader& table, const std::string& key, SceneBlock& block) {
  std::optional<int> order;
  const bool good = table.read_integer_or_auto(key, order, 0, largest_order);
  if (!good && table.given(key)) return false;
  block.automatic_order = !order;
  block.order = order.value_or(1);
  return good;
}

bool read_assigned_order(TomlTableReader& table, const std::string& key, Assign& assign) {
  const bool good = table.read_integer_or_auto(key, assign.order, 0, largest_order);
  assign.automatic_order = good && !assign.order;
  return good;
}

const Own<Assign> assigned_order = {
    order_words, schema_of_order, read_assigned_order, [](const Assign& assign) {
      return assign.automatic_order ? Json("auto") : assign.order ? Json(*assign.order) : Json();
    }};

bool read_count(TomlTableReader& table, const std::string& key, Array& array) {
  if (!table.read_integers(key, array.count, 1, most_laid_blocks)) return false;
  if (!array.count.empty() && array.count.size() <= most_array_directions) return true;
  table.error_at_value(key, fmt::format("{} has the wrong length ({} entries), 1 to 3 directions are needed",
                                        key, array.count.size()));
  array.count.clear();
  return false;
}

bool read_steps(TomlTableReader& table, const std::string& key, Array& array) {
  return table.read_places(key, array.step, 1);
}

/// Of counts and steps that were read.
bool check_array(TomlTableReader& table, Array& array) {
  if (array.count.empty()) return false;
  if (!array.step.empty() && array.step.size() != array.count.size()) {
    table.error_at_value("step", fmt::format("step has the wrong length ({} entries), one for each of the {} "
                                             "counts is needed",
                                             array.step.size(), array.count.size()));
    return false;
  }
  double blocks = 1.0;
  for (const int count : array.count) blocks *= count;
  if (blocks <= most_laid_blocks) return true;
  table.error_at_value("count", fmt::format("array is too large ({:.3g} blocks), at most {} are allowed",
                                            blocks, most_laid_blocks));
  return false;
}

const Keys<Array> array_table(
    "",
    {own<Array>(
         "count",
         {fmt::format("an array of {}", whole_number_words(1, most_laid_blocks)),
          [] {
            return schema_of_array(schema_of_number({1.0, most_laid_blocks, true, true, ""}, "integer"), 0);
          },
          read_count, [](const Array& array) { return Json(array.count); }},
         "",
         "blocks in each of 1 to 3 directions: NAME.1, NAME.2, ..., the first direction fastest; at most "
         "20000 in all")
         .required_always(),
     own<Array>("step",
                {"an array of [x, y, z]", [] { return schema_of_array(schema_of_row(3), 1); }, read_steps,
                 [](const Array& array) { return json_of_places(array.step); }},
                "m", "from one to the next, for each count; planes and points of `fix` and `load` move along")
         .required_always(),
     place("stagger", &Array::stagger, "of every second one in the last direction").otherwise("none")},
    {check_array});

const Keys<Array>& array_keys() {
  return array_table;
}

/// A block that is faulty or badly placed has no shape.
bool check_shape(TomlTableReader& table, SceneBlock& block) {
  const bool good = check_one_of(table, "shape", {"box", "mesh", "hull", "sphere"});
  const bool turned = !table.given("rotate") ||
                      (block.rotate && block.rotate->axis.allFinite() && block.rotate->about.allFinite());
  if (!good || !turned || !block.translate.allFinite()) block.shape = {};
  if (!block.translate.allFinite()) block.translate.setZero();
  return good;
}

std::vector<Key<SceneBlock>> keys_of_place() {
  return {alternative<box_keys, SceneBox>("box", &SceneBlock::shape, ""),
          alternative<mesh_keys, SceneMesh>("mesh", &SceneBlock::shape, ""),
          alternative<hull_keys, SceneHull>("hull", &SceneBlock::shape, ""),
          alternative<sphere_keys, SceneSphere>("sphere", &SceneBlock::shape, ""),
          table<rotation_keys>("rotate", &SceneBlock::rotate, ""),
          place("translate", &SceneBlock::translate, ""),
          faultless_table<array_keys>("array", &SceneBlock::array, "").not_written()};
}

std::vector<Key<SceneBlock>> keys_of_name() {
  return {name("name", &SceneBlock::name, "not empty, one line, each its own").required_always(),
          name("material", &SceneBlock::material, "the name of a `[[material]]`; a fixed block needs none")
              .otherwise("required"),
          order_of_block(
              "of the polynomial of its displacement; 0: rigid, without supports; 1: uniform strain. Auto, "
              "with `analysis.accuracy` only, and its default there: 1 to 8, chosen for the accuracy")
              .otherwise("`1`")};
}

bool not_of_path(const SceneLoad& load) {
  return !load.of_path;
}

std::vector<Key<SceneBlock>> keys_of_motion() {
  return {vector("velocity", &SceneBlock::velocity, "m/s", "at the start; static: dropped"),
          vector("angular_velocity", &SceneBlock::angular_velocity, "rad/s",
                 "about the centroid, at the start; static: dropped"),
          flag("fixed", &SceneBlock::fixed,
               "the whole block never moves; then no `fix`, `load` or velocity. A support that moves is a "
               "`fix` with a history"),
          list<fix_keys>("fix", &SceneBlock::fix, "").described_elsewhere(),
          list<load_keys>("load", &SceneBlock::load, "", not_of_path).described_elsewhere()};
}

/// A fixed block cannot have supports, loads or velocities: one of them is a mistake.
bool refuse_motion_if_fixed(TomlTableReader& table, SceneBlock& block) {
  if (!block.fixed) return true;
  for (const char* key : {"fix", "load"})
    if (table.given(key))
      table.error_at_key(
          std::string(key) + ".0",
          fmt::format("{} on a fixed block ({}), a block with fixed = true takes none", key, block.name));
  for (const auto& [key, value] :
       {std::pair("velocity", block.velocity), std::pair("angular_velocity", block.angular_velocity)})
    if (!value.isZero(0.0))
      table.error_at_value(
          key, fmt::format("{} of a fixed block ([{}, {}, {}]), a block with fixed = true has none", key,
                           value.x(), value.y(), value.z()));
  return true;
}

bool set_origin(TomlTableReader& table, SceneBlock& block) {
  block.shape_origin = shape_origin_of(block, table.reading());
  return true;
}

const Keys<SceneBlock> block_place_table("", keys_of_place(), {check_shape});

const Keys<SceneBlock> block_table("A block",
                                   joined(joined(keys_of_name(), keys_of_place()), keys_of_motion()),
                                   {check_shape, set_origin, refuse_motion_if_fixed});

const Keys<Assign> assign_table(
    "Properties by name",
    {blocks(&Assign::blocks,
            "names or globs; each must match a block or a piece of one. With `inside` they may be left out"),
     inside(&Assign::inside, "").not_written(), name("material", &Assign::material, "").otherwise("as it is"),
     own("order", assigned_order, "", "").otherwise("as it is"),
     flag("fixed", &Assign::fixed, "").otherwise("as it is"),
     vector("velocity", &Assign::velocity, "m/s", "").otherwise("as it is"),
     vector("angular_velocity", &Assign::angular_velocity, "rad/s", "").otherwise("as it is"),
     list<fix_keys>("fix", &Assign::fix, "supports, beside those of the block").described_elsewhere(),
     list<load_keys>("load", &Assign::load, "loads, beside those of the block").described_elsewhere()},
    {all_inside<Assign>});

}  // namespace

const Keys<SceneBlock>& block_keys() {
  return block_table;
}

const Keys<SceneBlock>& block_place_keys() {
  return block_place_table;
}

const Keys<SceneAssign>& assign_keys() {
  return assign_table;
}

Key<SceneBlock> order_of_block(const char* meaning) {
  return own<SceneBlock>(
      "order",
      {order_words, schema_of_order, read_order,
       [](const SceneBlock& block) { return block.automatic_order ? Json("auto") : Json(block.order); }},
      "", meaning);
}

}  // namespace ashlar::keys
