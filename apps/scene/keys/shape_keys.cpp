// Shapes of blocks and regions: box, mesh, hull, sphere, halfspace; rotations.
#include "apps/scene/keys/shape_keys.hpp"

#include <fmt/format.h>

#include "apps/scene/keys/values.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar::keys {
namespace {

using Box = SceneBox;
using Mesh = SceneMesh;
using Hull = SceneHull;
using Sphere = SceneSphere;
using Rotation = SceneRotation;

bool check_corners(TomlTableReader& table, Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.min[axis] >= box.max[axis])) continue;  // also where one of them is not finite
    table.error_at_value("min", fmt::format("min is not below max in {} ({} and {}), min < max is needed in "
                                            "x, y and z",
                                            "xyz"[axis], box.min[axis], box.max[axis]));
    return false;
  }
  return true;
}

const Keys<Box> box_table("",
                          {place("min", &Box::min, "below `max` in every component").required_always(),
                           place("max", &Box::max, "").required_always()},
                          {check_corners});

Key<Mesh> file_of_stones() {
  return name("file", &Mesh::file,
              "OFF, OBJ, STL, PLY or Gmsh's MSH (text or binary, version 2.0 to 2.2 or 4.1, tetrahedra of 4 "
              "nodes, those "
              "of 10 by their corners), and 3MF, DXF (text: 3DFACE, polyface and polygon meshes, closed "
              "outlines with a "
              "thickness, extruded, inserted blocks) or glTF 2.0 (.gltf, .glb; buffers in the file or beside "
              "it), and "
              "terrain on a grid with `mesh.close_below`: ESRI grids (.asc) and points x, y, z (.xyz); "
              "coordinates, "
              "units and axes are those of the file, the outside of a mirrored object stays outside; one "
              "closed surface, "
              "of an MSH file that around its tetrahedra, or its triangles if it has none, triangles "
              "counter-clockwise "
              "from outside; faces that are flat to 1.4e-14 of the largest coordinate are one face, and a "
              "body that is as "
              "thin as that as a whole is refused")
      .required_always();
}

constexpr const char* flip_words = "true or false or \"auto\"";

bool read_flip(TomlTableReader& table, const std::string& key, Mesh& mesh) {
  if (!table.text_at(key)) {
    bool always = false;
    if (!table.read_bool(key, always, " or \"auto\"")) return false;
    mesh.flip = always ? Mesh::Flip::always : Mesh::Flip::never;
    return true;
  }
  std::string word;
  (void)table.read_text(key, word);
  if (word == "auto") {
    mesh.flip = Mesh::Flip::automatic;
    return true;
  }
  table.error_at_value(key, fmt::format("unknown flip (\"{}\"), {} is needed", word, flip_words));
  return false;
}

const Own<Mesh> flip = {flip_words,
                        [] {
                          return schema_of_any({Json{{"type", "boolean"}}, Json{{"const", "auto"}}});
                        },
                        read_flip,
                        [](const Mesh& mesh) {
                          return mesh.flip == Mesh::Flip::automatic ? Json("auto")
                                                                    : Json(mesh.flip == Mesh::Flip::always);
                        }};

/// @param file its key
std::vector<Key<Mesh>> keys_of_mesh(Key<Mesh> file) {
  return {
      std::move(file),
      number("scale", &Mesh::scale, range::positive, "", "the points of the file times this are m"),
      choice(
          "split", &Mesh::split, split_names,
          "many blocks in one file: `components`: each closed surface is a block, NAME.1, NAME.2, ... in the "
          "order of "
          "the file, also of blocks that share corners, edges or whole faces; `groups`: each object or group "
          "of an OBJ "
          "file, physical group of an MSH file, object of a 3MF or glTF file, or layer of a DXF file is one, "
          "NAME.GROUP; `tetrahedra`: each tetrahedron of an MSH file, NAME.1, NAME.2, ... Of an MSH file "
          "that is split, "
          "supports and loads on planes go to the blocks with a face there, a force in parts by area; "
          "supports, loads "
          "and measures at a point to the block that has it. `[[joint]] blocks = [\"NAME.*\", \"NAME.*\"], "
          "tied = true` "
          "makes one body of them again"),
      number("weld", &Mesh::weld, range::not_negative, "m",
             "corners this near become one (the first in the file), at most a tenth of the file's width; "
             "`check` and `run` "
             "say how many"),
      own("flip", flip, "",
          "`true`: all surfaces are turned inside out; `\"auto\"`: those that are inside out; `check` and "
          "`run` say "
          "which"),
      number("close_below", &Mesh::close_below, range::any_number, "m",
             "of an open surface, as a terrain of a survey, makes a body by upright walls below its rim and "
             "a level bottom "
             "at this z, before `rotate`. Each place has one height; holes become shafts"),
      flag("repair", &Mesh::repair,
           "after welding, of each block: holes are filled without new points, double triangles left out, "
           "neighbours "
           "turned alike, the surface outward (CGAL's polygon mesh processing); `check` and `run` report the "
           "changes"),
      name("group", &Mesh::group,
           "of an MSH file: the only physical group that is read, by its name, or number if it has none")
          .otherwise("all")};
}

/// A file of one block, as it is: JSON has the other keys with their defaults.
std::vector<Key<Mesh>> keys_of_solid_mesh() {
  std::vector<Key<Mesh>> all = keys_of_mesh(name("file", &Mesh::file, "a closed surface").required_always());
  constexpr std::size_t readable = 2;
  for (std::size_t k = readable; k < all.size(); ++k) all[k].found = true;
  return all;
}

std::vector<Key<Mesh>> keys_of_stones() {
  std::vector<Key<Mesh>> all = keys_of_mesh(file_of_stones());
  all.push_back(
      found<Mesh>("number", [](const Mesh& mesh) { return mesh.number > 0 ? Json(mesh.number) : Json(); }));
  return all;
}

const Keys<Mesh> solid_mesh_table("", keys_of_solid_mesh());
const Keys<Mesh> mesh_table("", keys_of_stones());

const Keys<Hull> hull_table(
    "", {own<Hull>("points",
                   {"an array of [x, y, z]", [] { return schema_of_array(schema_of_row(3), 4); },
                    [](TomlTableReader& table, const std::string& key, Hull& hull) {
                      return table.read_places(key, hull.points, 4);
                    },
                    [](const Hull& hull) { return json_of_places(hull.points); }},
                   "m", "at least 4, not in one plane; flat faces as with `mesh.file`")
             .required_always()});

constexpr int finest_sphere = 7;

const Keys<Sphere> sphere_table(
    "", {place("center", &Sphere::center, ""),
         number("radius", &Sphere::radius, range::positive_length, "m", "all corners lie on the sphere")
             .required_always(),
         whole("subdivisions", &Sphere::subdivisions, 0, finest_sphere, "", "20 x 4^n triangles")});

const Keys<Rotation> rotation_table(
    "", {direction("axis", &Rotation::axis, "", "not zero, any length").required_always(),
         number("angle", &Rotation::angle, range::any_number, "degrees", "right-handed").required_always(),
         place("about", &Rotation::about, "a point of the axis")});

const Keys<SceneHalfspace> halfspace_table(
    "", {place("point", &SceneHalfspace::point, "on its boundary").required_always(),
         direction("normal", &SceneHalfspace::normal, "",
                   "outward, as that of a face: `[0, 0, 1]` is all below `point`")
             .required_always()});

const Keys<SceneHalfspace>& halfspace_keys() {
  return halfspace_table;
}

Key<ShapeTable> box_of_region() {
  return alternative<box_keys, Box>("box", &ShapeTable::shape, "");
}
Key<ShapeTable> mesh_of_region() {
  return alternative<solid_mesh_keys, Mesh>("mesh", &ShapeTable::shape, "");
}
Key<ShapeTable> hull_of_region() {
  return alternative<hull_keys, Hull>("hull", &ShapeTable::shape, "");
}
Key<ShapeTable> sphere_of_region() {
  return alternative<sphere_keys, Sphere>("sphere", &ShapeTable::shape, "");
}

bool check_solid(TomlTableReader& table, ShapeTable& solid) {
  if (check_one_of(table, "shape", {"box", "mesh", "hull", "sphere"})) return true;
  solid = {};
  return false;
}

bool check_region(TomlTableReader& table, ShapeTable& region) {
  if (check_one_of(table, "shape", {"box", "mesh", "hull", "sphere", "halfspace"})) return true;
  region = {};
  return false;
}

const Keys<ShapeTable> solid_table("",
                                   {box_of_region(), mesh_of_region(), hull_of_region(), sphere_of_region()},
                                   {check_solid});

const Keys<ShapeTable> region_table("Blocks by place",
                                    {box_of_region(), mesh_of_region(), hull_of_region(), sphere_of_region(),
                                     faultless_table<halfspace_keys>("halfspace", &ShapeTable::halfspace,
                                                                     "")},
                                    {check_region});

class Region : public Values {
 public:
  bool read(TomlTableReader& table, const std::string& key, void* member) const override {
    std::optional<TomlTableReader> content = table.table(key);
    if (!content) return false;
    ShapeTable region = region_keys().read(*content);
    auto& result = *static_cast<std::optional<SceneRegion>*>(member);
    if (region.halfspace)
      result = SceneRegion{*region.halfspace};
    else if (!std::holds_alternative<std::monostate>(region.shape))
      result = SceneRegion{std::move(region.shape)};
    return result.has_value();
  }
  [[nodiscard]] Json json(const void* member) const override {
    const auto& region = *static_cast<const std::optional<SceneRegion>*>(member);
    if (!region) return nullptr;
    ShapeTable table;
    if (const auto* half = std::get_if<SceneHalfspace>(&region->space))
      table.halfspace = *half;
    else
      table.shape = std::get<SceneShape>(region->space);
    return region_keys().json(table);
  }
  [[nodiscard]] Json schema() const override { return region_keys().table().schema(); }
  [[nodiscard]] std::string words() const override { return "a table"; }
  [[nodiscard]] const TableKeys* inner() const override { return &region_keys().table(); }
};

}  // namespace

const Keys<SceneBox>& box_keys() {
  return box_table;
}

const Keys<SceneMesh>& mesh_keys() {
  return mesh_table;
}

const Keys<SceneMesh>& solid_mesh_keys() {
  return solid_mesh_table;
}

const Keys<SceneHull>& hull_keys() {
  return hull_table;
}

const Keys<SceneSphere>& sphere_keys() {
  return sphere_table;
}

const Keys<SceneRotation>& rotation_keys() {
  return rotation_table;
}

const Keys<ShapeTable>& solid_keys() {
  return solid_table;
}

const Keys<ShapeTable>& region_keys() {
  return region_table;
}

Shared region_values() {
  return std::make_shared<Region>();
}

}  // namespace ashlar::keys
