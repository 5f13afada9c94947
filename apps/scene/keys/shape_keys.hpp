// Keys of shapes: box, mesh, hull, sphere and halfspace, and the regions that they bound.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/keys/values.hpp"
#include "apps/scene/model/scene_region.hpp"
#include "apps/scene/model/scene_shape.hpp"

namespace ashlar::keys {

[[nodiscard]] const Keys<SceneBox>& box_keys();
/// Of a file of one or many blocks, which may be repaired.
[[nodiscard]] const Keys<SceneMesh>& mesh_keys();
/// Of a file whose surface is one solid without changes.
[[nodiscard]] const Keys<SceneMesh>& solid_mesh_keys();
[[nodiscard]] const Keys<SceneHull>& hull_keys();
[[nodiscard]] const Keys<SceneSphere>& sphere_keys();
[[nodiscard]] const Keys<SceneRotation>& rotation_keys();

/// A table with one shape or halfspace, neither after a fault.
struct ShapeTable {
  SceneShape shape;
  std::optional<SceneHalfspace> halfspace;
};
/// box, mesh, hull or sphere
[[nodiscard]] const Keys<ShapeTable>& solid_keys();
/// The same, or halfspace.
[[nodiscard]] const Keys<ShapeTable>& region_keys();

[[nodiscard]] Shared region_values();

/// Blocks by place, alone or among those that `blocks` names.
template <class Struct>
[[nodiscard]] Key<Struct> inside(std::optional<SceneRegion> Struct::*member, const char* meaning) {
  return key_of("inside", member, region_values(), "", meaning);
}
/// Names or globs, required unless there is a region: then all blocks if they are left out (all_inside).
template <class Struct>
[[nodiscard]] Key<Struct> blocks(std::vector<std::string> Struct::*member, const char* meaning) {
  return names("blocks", member, meaning).required_unless_given({"inside"});
}
template <class Struct>
bool all_inside(TomlTableReader& table, Struct& object) {
  if (table.given("inside") && !table.given("blocks")) object.blocks = {"*"};
  return true;
}

}  // namespace ashlar::keys
