#include "apps/results/columns/frame_columns.hpp"

namespace ashlar {
namespace {

constexpr FrameField fields[] = {
    {"blocks", "displacement", "m", "at points, as far as `output.fields` asks"},
    {"blocks", "velocity", "m/s", "the same"},
    {"blocks", "stress", "Pa", "the same; tension positive"},
    {"blocks", "principal_stress", "Pa", "the same; largest first"},
    {"blocks", "block", "1", "number of the block"},
    {"blocks", "order", "1", "of the block's polynomial; 0: rigid or fixed"},
    {"blocks", "fixed", "1", "1: the block never moves"},
    {"blocks", "face", "1", "number of the face in its block"},
    {"contacts", "gap", "m", "of contact points; negative: penetration"},
    {"contacts", "area", "m^2", "of contact points"},
    {"contacts", "normal", "1", "unit vector, out of block_b"},
    {"contacts", "force", "N", "on block_a"},
    {"contacts", "traction", "Pa", "on block_a: force over area"},
    {"contacts", "type", "1", "0 face-face, 1 vertex-face, 2 edge-edge"},
    {"contacts", "state", "1", "0 open, 1 locked, 2 sliding, as `contacts.sliding`"},
    {"contacts", "block_a", "1", "number of the block"},
    {"contacts", "block_b", "1", "number of the block"},
    {"joints", "opening", "m",
     "of contact faces, which are polygons. Contacts at corners and edges have none"},
    {"joints", "slip", "m", "the same; a vector"},
    {"joints", "water_pressure", "Pa",
     "in the middle of the face, where the scene has `[[water]]`; the normal traction is then effective"},
    {"joints", "normal_traction", "Pa", "compression positive; traction times area is the force"},
    {"joints", "shear_traction", "Pa", "the same of friction and shear springs"},
    {"joints", "fracture_energy", "J/m^2",
     "dissipated by softening, where joints have `fracture_energy` or blocks crack; in one process"},
    {"joints", "area", "m^2", "of the face"},
    {"joints", "state", "1", "of most of the area, as of contact points"},
    {"joints", "broken", "1", "1: the joint has failed"},
    {"joints", "block_a", "1", "number of the block"},
    {"joints", "block_b", "1", "number of the block"},
    {"bolts", "axial_force", "N", "of pieces of bolts and props, which are lines; tension positive"},
    {"bolts", "shear_force", "N", "where they cross a joint"},
    {"bolts", "bond_force", "N/m", "of the grout on the bar"},
    {"bolts", "state", "1",
     "0 elastic, 1 its grout slips or it yields in shear, 2 its steel yields, 3 ruptured, there and so far"},
    {"bolts", "bolt", "1", "number of the bolt"},
    {"loads", "force", "N",
     "resultant of each load, at the centre of its faces or at its point (without water): Glyph filter"},
    {"loads", "held", "1",
     "of the other cells, faces and points of supports: 1 for x, 2 for y, 4 for z, summed; 0 of loads"},
    {"loads", "block", "1", "number of the block"},
};

}  // namespace

std::span<const FrameField> frame_fields() {
  return fields;
}

}  // namespace ashlar
