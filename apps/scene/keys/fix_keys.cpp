// [[block.fix]] and [[block.load]].
#include "apps/scene/keys/fix_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <stdexcept>

#include "apps/scene/json/value_json.hpp"
#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/model/support_history.hpp"

namespace ashlar::keys {
namespace {

using Fix = SceneFix;
using Load = SceneLoad;
using Where = std::variant<ScenePlane, Vector3>;

const Vector3 nowhere = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());

/// @tparam Support SceneFix or SceneLoad
template <class Support>
Key<Support> plane() {
  return key_of(
      "plane", &Support::where,
      table_values({table_keys<plane_keys>,
                    [](void* where) -> void* { return &static_cast<Where*>(where)->emplace<ScenePlane>(); },
                    [](const void* where) -> const void* {
                      return std::get_if<ScenePlane>(static_cast<const Where*>(where));
                    }}),
      "", "");
}

template <class Support>
bool read_point(TomlTableReader& table, const std::string& key, Support& support) {
  if (!table.given(key)) return false;
  Vector3 point = nowhere;
  const bool good = table.read_place(key, point);
  support.where = point;
  return good;
}

template <class Support>
Json json_of_point(const Support& support) {
  const Vector3* point = std::get_if<Vector3>(&support.where);
  return point == nullptr ? Json() : to_json(*point);
}

template <class Support>
Key<Support> point(const char* meaning) {
  return own<Support>(
      "point", {"[x, y, z]", [] { return schema_of_row(3); }, read_point<Support>, json_of_point<Support>},
      "m", meaning);
}

template <class Support>
bool check_where(TomlTableReader& table, Support& support) {
  if (std::holds_alternative<ScenePlane>(support.where) && table.table_at("plane") == nullptr)
    support.where = nowhere;
  return check_one_of(table, "place", {"plane", "point"});
}

Key<Fix> components() {
  using Components = std::array<bool, 3>;
  const auto get = [](const void* held, std::size_t k) { return (*static_cast<const Components*>(held))[k]; };
  const auto set = [](void* held, std::size_t k, bool value) {
    (*static_cast<Components*>(held))[k] = value;
  };
  return key_of("components", &Fix::components, words_values({"x", "y", "z"}, get, set), "",
                "directions held, along the axes of the scene");
}

bool check_components(TomlTableReader& table, const Fix& fix) {
  if (std::find(fix.components.begin(), fix.components.end(), true) != fix.components.end()) return true;
  table.error_at_value("components",
                       "components is empty ([]), at least one of \"x\", \"y\", \"z\" is needed");
  return false;
}

struct Motion {
  const char* key;
  MotionRecord record;
  const char* letter;
  const char* row;
};

constexpr std::array<Motion, 3> motions = {
    {{"displacement_history", MotionRecord::displacement, "u", "[t, ux, uy, uz]"},
     {"velocity_history", MotionRecord::velocity, "v", "[t, vx, vy, vz]"},
     {"acceleration_history", MotionRecord::acceleration, "a", "[t, ax, ay, az]"}}};

enum class Interpolation { linear, cubic };
constexpr std::array<std::pair<const char*, Interpolation>, 2> interpolation_names = {
    {{"linear", Interpolation::linear}, {"cubic", Interpolation::cubic}}};

/// Histories and their interpolation belong together: read_motion reads them.
bool read_later(TomlTableReader&, const std::string&, Fix&) {
  return true;
}

template <std::size_t kind>
Key<Fix> motion(const char* unit, const char* meaning) {
  return own<Fix>(motions[kind].key,
                  {history_words(motions[kind].row), [] { return history_schema(4); }, read_later,
                   [](const Fix& fix) {
                     return history_key(fix) == std::string_view(motions[kind].key)
                                ? json_of_rows(fix.file, fix.history)
                                : Json();
                   }},
                  unit, meaning);
}

const Own<Fix> interpolation = {
    "one of \"linear\", \"cubic\"",
    [] {
      return Json{{"enum", words_of(interpolation_names)}};
    },
    read_later,
    [](const Fix& fix) { return fix.record == MotionRecord::smooth_displacement ? Json("cubic") : Json(); }};

/// A component that is not held does not move.
bool check_held(TomlTableReader& table, const Motion& kind, const Fix& fix) {
  for (const auto& [time, value] : fix.history)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double component = value[static_cast<Eigen::Index>(axis)];
      if (fix.components[axis] || component == 0.0) continue;
      table.error_at_value(
          kind.key, fmt::format("{} moves a component that is not held ({}{} = {:g} at t = {:g}), 0 or "
                                "\"{}\" among components is needed",
                                kind.key, kind.letter, "xyz"[axis], component, time, "xyz"[axis]));
      return false;
    }
  return true;
}

/// At t = 0 the block is where it is placed.
bool check_start(TomlTableReader& table, const Motion& kind, const Fix& fix) {
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

/// The histories that are given, of which one is allowed.
std::vector<const Motion*> given_motions(TomlTableReader& table, std::optional<HistoryRows>& history) {
  std::vector<const Motion*> given;
  for (const Motion& candidate : motions) {
    if (!table.given(candidate.key)) continue;
    given.push_back(&candidate);
    history = read_history(table, candidate.key, 4, candidate.row);
  }
  return given;
}

bool read_motion(TomlTableReader& table, Fix& fix) {
  std::optional<HistoryRows> history;
  const std::vector<const Motion*> given = given_motions(table, history);
  Interpolation chosen = Interpolation::linear;
  const bool has_choice = table.read_choice("interpolation", chosen, interpolation_names);
  if (given.size() > 1) {
    std::vector<std::string> names;
    for (const Motion* motion : given) names.emplace_back(motion->key);
    table.error_at_key(names.back(), fmt::format("a support has {} histories ({}), at most one is allowed",
                                                 names.size(), fmt::join(names, ", ")));
    return false;
  }
  const Motion* kind = given.empty() ? nullptr : given.front();
  if (has_choice && (kind == nullptr || kind->record != MotionRecord::displacement))
    table.error_at_key(
        "interpolation",
        fmt::format("interpolation without displacement_history ({}), it is that of displacements",
                    kind == nullptr ? "no history" : kind->key));
  if (!history) return true;
  fix.file = std::move(history->file);
  fix.record = kind->record;
  if (fix.record == MotionRecord::displacement && chosen == Interpolation::cubic)
    fix.record = MotionRecord::smooth_displacement;
  for (const auto& row : history->rows) fix.history.push_back({row[0], {row[1], row[2], row[3]}});
  const bool good = check_held(table, *kind, fix) && check_start(table, *kind, fix);
  if (!good) fix.history.clear();
  return good;
}

bool read_traction(TomlTableReader& table, const std::string& key, Load& load) {
  return table.varies(key) ? table.read_field(key, load.field, 3, "[x, y, z]")
                           : table.read_vector(key, load.vector);
}

bool of_traction(const Load& load) {
  return load.kind == Load::Kind::traction;
}
bool of_force(const Load& load) {
  return load.kind == Load::Kind::force;
}

bool check_size_of_load(TomlTableReader& table, Load& load) {
  const bool traction = table.given("traction");
  load.kind = traction ? Load::Kind::traction : Load::Kind::force;
  if (traction && table.given("point"))
    table.error_at_key("traction", "traction at a point (point); give a plane, or a force");
  return check_one_of(table, "size", {"traction", "force"});
}

const Own<Load> traction = {
    "[x, y, z]", [] { return schema_of_row(3); }, read_traction,
    [](const Load& load) { return load.field.given() ? to_json(load.field) : to_json(load.vector); }};

const History<Load> factors = {2, "[t, factor]",
                               [](Load& load, HistoryRows history) {
                                 load.file = std::move(history.file);
                                 for (const auto& row : history.rows)
                                   load.history.push_back({row[0], row[1]});
                               },
                               [](const Load& load) {
                                 if (load.file) return json_of_file(*load.file);
                                 Json rows = Json::array();
                                 for (const Load::Factor& factor : load.history)
                                   rows.push_back({factor.time, factor.factor});
                                 return rows.empty() ? Json() : rows;
                               }};

}  // namespace

std::vector<Key<SceneFix>> keys_of_fix() {
  return {plane<Fix>(),
          point<Fix>("instead of a plane"),
          components(),
          own("interpolation", interpolation, "",
              "of displacements. `linear`: the velocity jumps at each row, and the acceleration of a step "
              "grows as steps get shorter; `run` and `check` warn where it is ten times that of a smooth "
              "curve. `cubic`: a spline with continuous acceleration, at rest at its first and last row")
              .otherwise("linear"),
          motion<0>("s, m",
                    "where the support is, zero at t = 0 and in directions not held; times increase, "
                    "constant after the last. Between rows as `interpolation` says")
              .otherwise("at rest"),
          motion<1>("s, m/s",
                    "instead: linear between rows and integrated exactly, from rest; the last velocity stays")
              .otherwise("none"),
          motion<2>("s, m/s^2",
                    "instead: linear between rows and integrated exactly, twice, from rest; after the last "
                    "row the velocity stays that it left")
              .otherwise("none")};
}

bool check_fix(TomlTableReader& table, SceneFix& fix) {
  const bool placed = check_where(table, fix), held = check_components(table, fix);
  return read_motion(table, fix) && placed && held;
}

std::vector<Key<SceneLoad>> keys_of_load() {
  return {plane<Load>(), point<Load>("instead of a plane; takes a force"),
          own("traction", traction, "Pa",
              "on the faces in the plane; a text such as `\"= 1e3*z\"` is a formula of x, y and z (m)")
              .written_if(of_traction)
              .otherwise("none"),
          vector("force", &Load::vector, "N", "spread evenly over the faces in the plane, or at the point")
              .written_if(of_force)
              .otherwise("none"),
          history("history", factors, "s",
                  "factor of the load; times increase, linear between, constant before and after")
              .otherwise("factor 1")};
}

bool check_load(TomlTableReader& table, SceneLoad& load) {
  const bool placed = check_where(table, load);
  return check_size_of_load(table, load) && placed;
}

const Keys<SceneFix>& fix_keys() {
  static const Keys<Fix> table("Faces clamped exactly, or a point held", keys_of_fix(), {check_fix});
  return table;
}

const Keys<SceneLoad>& load_keys() {
  static const Keys<Load> table("A load on faces or at a point", keys_of_load(), {check_load});
  return table;
}

}  // namespace ashlar::keys
