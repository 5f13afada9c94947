// [[measure]].
#include <fmt/format.h>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/shape_keys.hpp"

namespace ashlar::keys {
namespace {

using Measure = SceneMeasure;
using Drift = SceneDrift;
using Crack = SceneCrack;

bool check_heights(TomlTableReader& table, Drift& drift) {
  if (!(drift.heights[0] >= drift.heights[1]) || !table.given("heights")) return true;
  table.error_at_value("heights",
                       fmt::format("heights do not increase ({} and {}); give the lower level first",
                                   drift.heights[0], drift.heights[1]));
  drift.heights = {0.0, 0.0};
  return false;
}

const Keys<Drift> drift_table("",
                              {blocks(&Drift::blocks,
                                      "names or globs of the blocks of a storey: the drift between two "
                                      "levels is measured. With `inside` they "
                                      "may be left out"),
                               inside(&Drift::inside,
                                      "only blocks whose centroid is inside, as in `[[assign]]`")
                                   .not_written()
                                   .described_elsewhere(),
                               row("heights", &Drift::heights, "[lower, upper]", "m",
                                   "against gravity, of the two levels. A level is as far as the blocks that "
                                   "it cuts: the mean of their "
                                   "displacements there, by mass")
                                   .required_always()},
                              {all_inside<Drift>, check_heights});

const Keys<Crack> crack_table("", {names("joints", &Crack::joints,
                                         "names or globs of cuts and of blocks on either side: how far "
                                         "joints are open is measured, between faces "
                                         "that touch at the start")
                                       .otherwise("all joints"),
                                   names("to", &Crack::to,
                                         "names or globs of the blocks on the other side: only joints "
                                         "between one of `joints` and one of these")
                                       .unless_empty()});

const Keys<Drift>& drift_keys() {
  return drift_table;
}

const Keys<Crack>& crack_keys() {
  return crack_table;
}

bool of_pair(const Measure& measure) {
  return measure.bolt.empty() && !measure.drift && !measure.crack && measure.block.empty();
}

const Keys<Measure> measure_table(
    "A quantity with columns in history.csv",
    {name("name", &Measure::name,
          "heads columns of `history.csv`; each its own, not `momentum` or `angular_momentum`")
         .required_always(),
     pair("pair", &Measure::pair,
          "the names of two blocks, whose contacts are measured: forces, opening, slip, area")
         .written_if(of_pair)
         .otherwise("none"),
     name("bolt", &Measure::bolt, "the name of a bolt or prop, whose forces are measured")
         .not_beside({"pair"}),
     table<drift_keys>("drift", &Measure::drift, "").not_beside({"pair", "bolt"}),
     table<crack_keys>("crack", &Measure::crack, "").not_beside({"pair", "bolt", "drift"}),
     name("block", &Measure::block,
          "the name of a `[[block]]`, or `inside`, `pair`, `bolt`, `drift` or `crack` instead")
         .required_unless_given({"inside"})
         .not_beside({"pair", "bolt", "drift", "crack"}),
     inside(&Measure::inside, "the one block whose centroid is inside, as in `[[assign]]`")
         .not_beside({"pair", "bolt", "drift", "crack", "block"})
         .not_written()
         .described_elsewhere(),
     place("point", &Measure::point,
           "a material point of the placed, undeformed block, which is followed; without it the centroid is, "
           "and how "
           "the block turns")
         .not_beside({"pair", "bolt", "drift", "crack"})
         .otherwise("the block as a whole")});

}  // namespace

const Keys<SceneMeasure>& measure_keys() {
  return measure_table;
}

}  // namespace ashlar::keys
