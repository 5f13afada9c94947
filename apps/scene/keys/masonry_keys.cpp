// [[masonry]].
#include "apps/scene/keys/masonry_keys.hpp"

#include <fmt/format.h>

#include "apps/scene/keys/block_keys.hpp"
#include "apps/scene/keys/shape_keys.hpp"
#include "apps/scene/read/block_arrays.hpp"

namespace ashlar::keys {
namespace {

using Masonry = SceneMasonry;
using Opening = SceneOpening;
using Column = SceneColumn;
using Dome = SceneDome;

constexpr std::array<std::pair<const char*, Masonry::Kind>, 4> kind_names = {
    {{"wall", Masonry::Kind::wall},
     {"arch", Masonry::Kind::arch},
     {"column", Masonry::Kind::column},
     {"dome", Masonry::Kind::dome}}};
constexpr std::array<std::pair<const char*, SceneWall::Bond>, 3> bond_names = {
    {{"running", SceneWall::Bond::running},
     {"stack", SceneWall::Bond::stack},
     {"header", SceneWall::Bond::header}}};

constexpr NumberRange turn_range = {-360.0, 360.0, true, true, "a number of degrees from -360 to 360"};
constexpr int fewest_corners = 3, most_corners = 1000;

const Keys<Masonry> masonry_table(
    "", {of(&Masonry::block, name("name", &SceneBlock::name, "not empty, one line").required_always()),
         choice("kind", &Masonry::kind, kind_names, "").required_always(),
         of(&Masonry::block, name("material", &SceneBlock::material,
                                  "the name of a `[[material]]`, unless an `[[assign]]` gives it")
                                 .otherwise("required")),
         of(&Masonry::block, order_of_block("of every piece; 0: rigid. Auto: as with `[[block]]`")
                                 .otherwise("1, uniform strain"))});

/// @param meaning of a length, "" if another kind of masonry says it
template <class Struct, class Member>
Key<Struct> length(const char* name, Member Struct::*member, const char* meaning) {
  return number(name, member, range::positive_length, "m", meaning);
}

template <class Struct>
bool check_level(TomlTableReader& table, Struct& masonry) {
  const Vector3& direction = masonry.direction;
  if (direction.z() == 0.0 && !direction.head<2>().isZero(0.0)) return true;
  table.error_at_value("direction", fmt::format("direction is not level ([{}, {}, {}]), [x, y, 0] is needed",
                                                direction.x(), direction.y(), direction.z()));
  return false;
}

/// @tparam Struct with a mean radius and a thickness
template <class Struct>
bool check_ring(TomlTableReader& table, Struct& ring) {
  if (ring.radius == 0.0 || ring.thickness < 2.0 * ring.radius) return true;
  table.error_at_value("thickness", fmt::format("thickness leaves no inside ({} m), less than twice the mean "
                                                "radius ({} m) is needed",
                                                ring.thickness, 2.0 * ring.radius));
  return false;
}

bool check_brick(TomlTableReader& table, SceneWall& wall) {
  if (!(wall.brick.array() <= 0.0).any()) return true;
  table.error_at_value("brick", fmt::format("brick has a side that is not positive ([{}, {}, {}]), [length, "
                                            "thickness, height] > 0 is needed",
                                            wall.brick.x(), wall.brick.y(), wall.brick.z()));
  return false;
}

const Keys<SceneLintel> lintel_table(
    "", {length("height", &SceneLintel::height,
                "of a piece that spans the opening above it; without `lintel` there is none")
             .required_always(),
         number("bearing", &SceneLintel::bearing, range::positive_length, "m",
                "that it lies on the wall at each end")
             .required_always()});

const Keys<SceneLintel>& lintel_keys() {
  return lintel_table;
}

const Keys<Opening> opening_table("",
                                  {table<box_keys>("box", &Opening::box,
                                                   "wall: the free space, in the axes of the wall: along, "
                                                   "across and up from `origin`; across it must go through")
                                       .required_always(),
                                   table<lintel_keys>("lintel", &Opening::lintel, "")});

const Keys<Opening>& opening_keys() {
  return opening_table;
}

const Keys<SceneWall> wall_table(
    "",
    {place("origin", &SceneWall::origin,
           "wall: lower corner, where it begins; its thickness is to the left of `direction`")
         .otherwise("the origin"),
     vector("direction", &SceneWall::direction, "",
            "wall: of its courses; arch: of its span, from where angles count. Level, any length")
         .otherwise("along x"),
     length("length", &SceneWall::length, "wall").required_always(),
     length("height", &SceneWall::height, "wall, column").required_always(),
     length("thickness", &SceneWall::thickness,
            "wall: may be left out, it is then one brick; more makes leaves. Arch, dome: of the ring")
         .otherwise("required"),
     place("brick", &SceneWall::brick, "wall: length, thickness and height of a brick, joints included")
         .required_always(),
     choice(
         "bond", &SceneWall::bond, bond_names,
         "wall: in bond by half a brick; joint over joint; bricks laid across, in bond by half a thickness"),
     list<opening_keys>("openings", &SceneWall::openings, "")},
    {check_level<SceneWall>, check_brick});

const Keys<SceneFill> fill_table(
    "", {number("top", &SceneFill::top, range::any_number, "m",
                "arch: z up to which soil or rubble lies on it; above its crown. Its weight is a load on the "
                "outer faces; without `fill`, and on voussoirs that are fixed, there is none")
             .required_always(),
         number("weight", &SceneFill::weight, range::positive, "N/m^3", "of the fill").required_always()});

const Keys<SceneFill>& fill_keys() {
  return fill_table;
}

const Keys<SceneArch> arch_table(
    "",
    {place("center", &SceneArch::center,
           "arch: of its curve, in the middle of its width; column: of its foot; dome: of the sphere")
         .otherwise("the origin"),
     vector("direction", &SceneArch::direction, "", "").otherwise("along x"),
     length("radius", &SceneArch::radius, "arch, dome: mean radius; column: of the corners")
         .required_always(),
     length("thickness", &SceneArch::thickness, "").required_always(),
     length("width", &SceneArch::width, "arch").required_always(),
     number("from", &SceneArch::from, turn_range, "",
            "arch: 0 is `direction`, 90 is up; dome: elevation where it begins")
         .otherwise("0 degrees"),
     number("to", &SceneArch::to, turn_range, "",
            "arch: at most 360 from `from`; dome: elevation below 90 where it ends")
         .otherwise("180, of domes 80"),
     whole("voussoirs", &SceneArch::voussoirs, 1, most_laid_blocks, "",
           "arch: in all; dome: in each course, at least 3")
         .required_always(),
     table<fill_keys>("fill", &SceneArch::fill, "")},
    {check_level<SceneArch>, check_ring<SceneArch>});

const Keys<Column> column_table(
    "", {place("center", &Column::center, "").otherwise("the origin"),
         length("radius", &Column::radius, "").required_always(),
         length("top_radius", &Column::top_radius, "column: at its top").otherwise("as radius"),
         length("height", &Column::height, "").required_always(),
         whole("sides", &Column::sides, fewest_corners, most_corners, "", "column"),
         whole("drums", &Column::drums, 1, most_laid_blocks, "", "column").required_always()});

const Keys<Dome> dome_table(
    "",
    {place("center", &Dome::center, "").otherwise("the origin"),
     length("radius", &Dome::radius, "").required_always(),
     length("thickness", &Dome::thickness, "").required_always(),
     number("from", &Dome::from, turn_range, "", ""), number("to", &Dome::to, turn_range, "", ""),
     whole("courses", &Dome::courses, 1, most_laid_blocks, "", "dome, without the keystone")
         .required_always(),
     whole("voussoirs", &Dome::voussoirs, 1, most_laid_blocks, "", "").required_always(),
     flag("keystone", &Dome::keystone,
          "dome: whether one piece closes the space above `to` or it stays open")},
    {check_ring<Dome>});

}  // namespace

const Keys<SceneMasonry>& masonry_keys() {
  return masonry_table;
}

const Keys<SceneWall>& wall_keys() {
  return wall_table;
}

const Keys<SceneArch>& arch_keys() {
  return arch_table;
}

const Keys<SceneColumn>& column_keys() {
  return column_table;
}

const Keys<SceneDome>& dome_keys() {
  return dome_table;
}

const TableKeys& any_masonry_keys() {
  static const TableKeys table = TableKeys::of_any(
      "Walls, arches, columns and domes as blocks, without coordinates. A masonry has the keys of its kind",
      masonry_table.table(),
      {&wall_table.table(), &arch_table.table(), &column_table.table(), &dome_table.table()});
  return table;
}

}  // namespace ashlar::keys
