// [[material]] and [output].
#include <limits>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/values.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar::keys {
namespace {

using Material = SceneMaterial;
using Output = SceneOutput;

const Keys<Material> material_table(
    "A material",
    {name("name", &Material::name, "not empty, one line, each its own").required_always(),
     number("density", &Material::density, range::positive, "kg/m^3", "").required_always(),
     number("young_modulus", &Material::young_modulus, range::positive, "Pa",
            "5 GPa are 5e9. `check` and `run` warn where its own weight, its load, or an impact at its "
            "velocity would strain a block by more than 0.1, and of a `normal_stiffness` at which a block "
            "sinks by 0.1 of its size")
         .required_always(),
     number("poisson_ratio", &Material::poisson_ratio, range::zero_to_below_half, "",
            "at most as near to 0.5 as double precision allows: 0.49999997 for order 1, 0.49999992 for 2, "
            "0.499996 for 12")
         .required_always(),
     choice("elasticity", &Material::elasticity, elasticity_names,
            "Hooke's law in a frame that turns with the block, unless supports hold it, or in Green strain "
            "(large bending in one block; orders 1 to 7)")});

constexpr int any_number_of_steps = std::numeric_limits<int>::max();

const Keys<Output> output_table(
    "Results",
    {whole("every", &Output::every, 1, any_number_of_steps, "",
           "steps between frames; the first and the last state always have one")
         .otherwise("`10`"),
     number("interval", &Output::interval, range::positive, "s", "between frames, instead of `every`")
         .not_beside({"every"}),
     whole("history_every", &Output::history_every, 1, any_number_of_steps, "",
           "steps between rows of `history.csv`; the first and the last state always have one"),
     words("fields", &Output::fields, field_names, "fields of frames"),
     flag("curved", &Output::curved,
          "faces of frames as Lagrange triangles of the block's order, with `solid` Lagrange tetrahedra; not "
          "of incremental blocks"),
     flag("solid", &Output::solid,
          "blocks in frames as volumes (tetrahedra), so that a clip shows them filled; not of incremental "
          "blocks"),
     choice("format", &Output::format, frame_format_names,
            "a file for each frame, or [one file](results.md#one-file-for-all-frames), `results.vtkhdf`, for "
            "all"),
     choice("precision", &Output::precision, precision_names,
            "of real numbers in frames, seven digits or sixteen ([what stays double](results.md#precision)); "
            "`\"auto\"`: single in `results.vtkhdf`, double in `.vtu`; tables have sixteen always")});

}  // namespace

const Keys<SceneMaterial>& material_keys() {
  return material_table;
}

const Keys<SceneOutput>& output_keys() {
  return output_table;
}

}  // namespace ashlar::keys
