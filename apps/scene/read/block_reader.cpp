#include "apps/scene/read/block_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/model/support_history.hpp"
#include "apps/scene/read/block_arrays.hpp"
#include "apps/scene/read/history_reader.hpp"
#include "apps/scene/read/model_origin.hpp"
#include "apps/scene/toml/required_vectors.hpp"

namespace ashlar {
namespace {

SceneShape read_box(TomlTableReader table) {
  const SceneBox box{required_place(table, "min"), required_place(table, "max")};
  if (!box.min.allFinite() || !box.max.allFinite()) return {};
  for (int axis = 0; axis < 3; ++axis)
    if (box.min[axis] >= box.max[axis]) {
      table.error_at_value("min",
                           fmt::format("min is not below max in {} ({} and {}), min < max is needed in "
                                       "x, y and z",
                                       "xyz"[axis], box.min[axis], box.max[axis]));
      return {};
    }
  return box;
}

// @return true if the key is absent or valid
bool read_flip(TomlTableReader& table, SceneMesh::Flip& flip) {
  if (!table.given("flip")) return true;
  std::string word;
  const bool is_word = table.text_at("flip");
  bool always = false;
  if (is_word && table.read_text("flip", word) && word == "auto")
    flip = SceneMesh::Flip::automatic;
  else if (!is_word && table.read_bool("flip", always, " or \"auto\""))
    flip = always ? SceneMesh::Flip::always : SceneMesh::Flip::never;
  else if (is_word)
    table.error_at_value("flip",
                         fmt::format("unknown flip (\"{}\"), true or false or \"auto\" is needed", word));
  else
    return false;
  return !is_word || word == "auto";
}

/// Reads a file whose surface is one solid without changes.
SceneShape read_mesh_as_it_is(TomlTableReader table) {
  SceneMesh mesh;
  std::string file;
  table.require("file");
  const bool file_good = table.read_name("file", file);
  const bool scale_good = table.read_number("scale", mesh.scale, range::positive) || !table.given("scale");
  mesh.file = file;
  if (!file_good || !scale_good) return {};
  return mesh;
}

/// Reads a file of one or many blocks, which may be repaired.
SceneShape read_stones(TomlTableReader table) {
  SceneMesh mends;
  const bool split_good = table.read_choice("split", mends.split, split_names) || !table.given("split");
  const bool weld_good = table.read_number("weld", mends.weld, range::not_negative) || !table.given("weld");
  const bool closed_good =
      table.read_number("close_below", mends.close_below, range::any_number) || !table.given("close_below");
  const bool flip_good = read_flip(table, mends.flip);
  const bool repair_good = table.read_bool("repair", mends.repair) || !table.given("repair");
  const bool group_good = table.read_name("group", mends.group) || !table.given("group");
  SceneShape shape = read_mesh_as_it_is(table);
  auto* mesh = std::get_if<SceneMesh>(&shape);
  if (mesh == nullptr || !split_good || !group_good || !weld_good || !closed_good || !flip_good ||
      !repair_good)
    return {};
  mends.file = std::move(mesh->file);
  mends.scale = mesh->scale;
  return mends;
}

SceneShape read_hull(TomlTableReader table) {
  SceneHull hull;
  table.require("points");
  if (!table.read_places("points", hull.points, 4)) return {};
  return hull;
}

SceneShape read_sphere(TomlTableReader table) {
  SceneSphere sphere;
  table.require("radius");
  const bool center_good = table.read_place("center", sphere.center) || !table.given("center");
  const bool radius_good = table.read_number("radius", sphere.radius, range::positive_length);
  const bool fineness_good =
      table.read_integer("subdivisions", sphere.subdivisions, 0, 7) || !table.given("subdivisions");
  if (!center_good || !radius_good || !fineness_good) return {};
  return sphere;
}

}  // namespace

SceneShape read_shape(TomlTableReader& table, const std::string& what, MeshKeys mesh) {
  struct Kind {
    const char* key;
    SceneShape (*read)(TomlTableReader);
  };
  const std::array<Kind, 4> kinds = {{{"box", read_box},
                                      {"mesh", mesh == MeshKeys::mending ? read_stones : read_mesh_as_it_is},
                                      {"hull", read_hull},
                                      {"sphere", read_sphere}}};
  std::vector<std::string> given;
  SceneShape shape;
  for (const Kind& kind : kinds)
    if (table.given(kind.key)) {
      given.emplace_back(kind.key);
      if (auto content = table.table(kind.key)) shape = kind.read(*content);
    }
  if (given.size() == 1) return shape;
  const std::string fault =
      given.empty() ? fmt::format("{} has no shape", what)
                    : fmt::format("{} has {} shapes ({})", what, given.size(), fmt::join(given, ", "));
  table.error_at_table(fault + ", exactly one of box, mesh, hull, sphere is needed");
  return {};
}

namespace {

SceneRotation read_rotation(TomlTableReader table) {
  SceneRotation rotation;
  rotation.axis = required_direction(table, "axis");
  table.require("angle");
  table.read_number("angle", rotation.angle, range::any_number);
  table.read_place("about", rotation.about);
  return rotation;
}

// Place of a support or load: exactly one of plane and point.
std::variant<ScenePlane, Vector3> read_where(TomlTableReader& table) {
  const bool plane_given = table.given("plane"), point_given = table.given("point");
  if (plane_given == point_given)
    table.error_at_table(fmt::format("{} has {} (plane, point); give one of both", table.name(),
                                     plane_given ? "two places" : "no place"));
  if (plane_given) {
    TomlTableReader plane = table.table_or_empty("plane");
    return ScenePlane{required_place(plane, "point"), required_direction(plane, "normal")};
  }
  Vector3 point = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  table.read_place("point", point);
  return point;
}

void read_components(TomlTableReader& table, std::array<bool, 3>& components) {
  constexpr std::array<std::pair<const char*, int>, 3> names = {{{"x", 0}, {"y", 1}, {"z", 2}}};
  std::vector<std::string> words;
  if (!table.read_words("components", words, names)) return;
  if (words.empty())
    table.error_at_value("components",
                         "components is empty ([]), at least one of \"x\", \"y\", \"z\" is needed");
  for (const auto& [name, axis] : names)
    components[static_cast<std::size_t>(axis)] = std::find(words.begin(), words.end(), name) != words.end();
}

struct RecordKey {
  const char* key;
  MotionRecord record;
  const char* letter;
  const char* row;
};

constexpr std::array<RecordKey, 3> record_keys = {
    {{"displacement_history", MotionRecord::displacement, "u", "[t, ux, uy, uz]"},
     {"velocity_history", MotionRecord::velocity, "v", "[t, vx, vy, vz]"},
     {"acceleration_history", MotionRecord::acceleration, "a", "[t, ax, ay, az]"}}};

// Checks a history whose rows are valid by themselves. @return true if it can be used
bool check_history(TomlTableReader& table, const RecordKey& kind, const SceneFix& fix) {
  for (const auto& [time, value] : fix.history) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double component = value[static_cast<Eigen::Index>(axis)];
      if (fix.components[axis] || component == 0.0) continue;
      table.error_at_value(
          kind.key, fmt::format("{} moves a component that is not held ({}{} = {:g} at t = {:g}), 0 or "
                                "\"{}\" among components is needed",
                                kind.key, kind.letter, "xyz"[axis], component, time, "xyz"[axis]));
      return false;
    }
  }
  if (kind.record != MotionRecord::displacement && fix.history.front().time < 0.0) {
    table.error_at_value(kind.key,
                         fmt::format("{} begins before t = 0, where the block is at rest ({:g}), times "
                                     "of at least 0 are needed",
                                     kind.key, fix.history.front().time));
    return false;
  }
  try {
    const Vector3 start = RecordedMotion(support_history(fix)).displacement(0.0);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (start[axis] == 0.0) continue;
      table.error_at_value(
          kind.key, fmt::format("{} is not zero at t = 0, where the block is placed (u{} = {:g}), 0 is "
                                "needed",
                                kind.key, "xyz"[axis], start[axis]));
      return false;
    }
  } catch (const std::domain_error&) {
    table.error_at_value(kind.key,
                         fmt::format("{} leads to numbers that are not finite, smaller values or times "
                                     "farther apart are needed",
                                     kind.key));
    return false;
  }
  return true;
}

}  // namespace

SceneFix read_fix(TomlTableReader& table) {
  SceneFix fix;
  fix.where = read_where(table);
  read_components(table, fix.components);
  std::vector<std::string> given;
  const RecordKey* kind = nullptr;
  std::optional<HistoryRows> history;
  for (const RecordKey& candidate : record_keys) {
    if (!table.given(candidate.key)) continue;
    given.emplace_back(candidate.key);
    kind = &candidate;
    history = read_history(table, candidate.key, 4, candidate.row);
  }
  enum class Interpolation { linear, cubic };
  constexpr std::array<std::pair<const char*, Interpolation>, 2> names = {
      {{"linear", Interpolation::linear}, {"cubic", Interpolation::cubic}}};
  Interpolation interpolation = Interpolation::linear;
  const bool chosen = table.read_choice("interpolation", interpolation, names);
  if (given.size() > 1) {
    table.error_at_key(given.back(), fmt::format("a support has {} histories ({}), at most one is allowed",
                                                 given.size(), fmt::join(given, ", ")));
    return fix;
  }
  if (chosen && (kind == nullptr || kind->record != MotionRecord::displacement))
    table.error_at_key(
        "interpolation",
        fmt::format("interpolation without displacement_history ({}), it is that of displacements",
                    kind == nullptr ? "no history" : kind->key));
  if (!history) return fix;
  fix.file = std::move(history->file);
  fix.record = kind->record;
  if (fix.record == MotionRecord::displacement && interpolation == Interpolation::cubic)
    fix.record = MotionRecord::smooth_displacement;
  for (const auto& row : history->rows) fix.history.push_back({row[0], {row[1], row[2], row[3]}});
  if (!check_history(table, *kind, fix)) fix.history.clear();
  return fix;
}

SceneLoad read_load(TomlTableReader& table) {
  SceneLoad load;
  load.where = read_where(table);
  const bool traction_given = table.given("traction"), force_given = table.given("force");
  if (traction_given == force_given)
    table.error_at_table(fmt::format("load has {} (traction, force); give one of both",
                                     traction_given ? "two sizes" : "no size"));
  load.kind = traction_given ? SceneLoad::Kind::traction : SceneLoad::Kind::force;
  if (table.varies("traction"))
    table.read_field("traction", load.field, 3, "[x, y, z]");
  else
    table.read_vector("traction", load.vector);
  table.read_vector("force", load.vector);
  if (traction_given && table.given("point"))
    table.error_at_key("traction", "traction at a point (point); give a plane, or a force");
  if (std::optional<HistoryRows> history = read_history(table, "history", 2, "[t, factor]")) {
    load.file = std::move(history->file);
    for (const auto& row : history->rows) load.history.push_back({row[0], row[1]});
  }
  return load;
}

// A fixed block cannot have supports, loads or velocities: one of them is a mistake.
void refuse_motion_if_fixed(TomlTableReader& table, const SceneBlock& block) {
  if (!block.fixed) return;
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
}

void read_order(TomlTableReader& table, SceneBlock& block) {
  std::optional<int> order;
  if (!table.read_integer_or_auto("order", order, 0, 12) && table.given("order")) return;
  block.automatic_order = !order;
  block.order = order.value_or(1);
}

void keep_given_orders(Scene& scene) {
  if (scene.analysis.accuracy) return;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    SceneBlock& block = scene.block[k];
    if (!scene.places.contains(fmt::format("block.{}.order", k))) block.automatic_order = false;
  }
}

void read_block_place(TomlTableReader& table, SceneBlock& block) {
  block.shape = read_shape(table, block.name.empty() ? "block" : fmt::format("block \"{}\"", block.name),
                           MeshKeys::mending);
  if (auto rotation = table.table("rotate")) block.rotate = read_rotation(*rotation);
  if (table.given("rotate") && !(block.rotate && block.rotate->axis.allFinite())) block.shape = {};
  if (!table.read_place("translate", block.translate) && table.given("translate")) block.shape = {};
  block.array = read_array(table);
}

SceneBlock read_block(TomlTableReader& table) {
  SceneBlock block;
  table.require("name");
  table.read_name("name", block.name);
  table.read_bool("fixed", block.fixed);
  table.read_name("material", block.material);
  read_order(table, block);
  read_block_place(table, block);
  block.shape_origin = shape_origin_of(block, table.reading());
  table.read_vector("velocity", block.velocity);
  table.read_vector("angular_velocity", block.angular_velocity);
  block.fix = table.read_tables("fix", read_fix);
  block.load = table.read_tables("load", read_load);
  refuse_motion_if_fixed(table, block);
  return block;
}

}  // namespace ashlar
