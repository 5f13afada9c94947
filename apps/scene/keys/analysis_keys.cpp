// [analysis]; its pushover and spectrum are in pushover_keys.cpp.
#include <fmt/format.h>

#include "apps/scene/keys/analysis_keys.hpp"
#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar::keys {
namespace {

using Analysis = SceneAnalysis;
using Factor = SceneAnalysis::FactorSearch;
using Movement = SceneAnalysis::SupportSearch;

bool check_bracket(TomlTableReader& table, Factor& search) {
  if (search.lower < search.upper) return true;
  table.error_at_key("upper", fmt::format("upper is not above lower ({}), more than {} is needed",
                                          search.upper, search.lower));
  return false;
}

template <const char* const& key>
bool check_names(TomlTableReader& table, Factor& search) {
  if (!search.of.empty()) return true;
  table.error_at_value(key, fmt::format("{} is empty (0 entries), names or globs are needed", key));
  return false;
}

constexpr const char* joints_key = "joints";
constexpr const char* blocks_key = "blocks";

const Keys<Factor> safety_table(
    "",
    {names(joints_key, &Factor::of,
           "`factor-of-safety` only: names or globs of `[[cut]]`s and of blocks on either side. The "
           "strengths of these joints (tan(friction), cohesion, tension and residual values) are divided by "
           "one factor; above it blocks move"),
     number("tolerance", &Factor::tolerance, range::positive_to_one, "", "relative width of the bracket"),
     number("lower", &Factor::lower, range::positive, "", "the smallest factor tried"),
     number("upper", &Factor::upper, range::positive, "", "the largest, above `lower`")},
    {check_names<joints_key>, check_bracket});

const Keys<Factor> capacity_table("",
                                  {names(blocks_key, &Factor::of,
                                         "`capacity` only: names or globs of blocks. Their `[[block.load]]`s "
                                         "are multiplied by one factor; gravity is not"),
                                   number("tolerance", &Factor::tolerance, range::positive_to_one, "",
                                          "as with `safety`, and so below"),
                                   number("lower", &Factor::lower, range::positive, "", ""),
                                   number("upper", &Factor::upper, range::positive, "", "")},
                                  {check_names<blocks_key>, check_bracket});

const Keys<Movement> movement_table(
    "", {names("supports", &Movement::supports,
               "`thrust` only: names or globs of blocks that do not move. How far each can move out and in, "
               "one at a time, before there is no equilibrium. Blocks are rigid, joints have friction alone"),
         direction("direction", &Movement::direction, "",
                   "not zero, any length: the support moves along it (out) and against it (in), e.g. `[0, 0, "
                   "-1]` to settle. None: level, away from the structure; a support that lies all around "
                   "spreads, each of its joints away from the centre"),
         number_or("auto", "limit", &Movement::limit, range::positive, "m",
                   "the largest movement tried. Auto: half the diagonal of the box around all contacts"),
         number_or("auto", "tolerance", &Movement::tolerance, range::positive, "m",
                   "width of the bracket. Auto: 1e-4 of that diagonal")});

const Keys<Factor>& safety_keys() {
  return safety_table;
}

const Keys<Factor>& capacity_keys() {
  return capacity_table;
}

const Keys<Movement>& movement_keys() {
  return movement_table;
}

bool read_time_step(TomlTableReader& table, const std::string& key, Analysis& analysis) {
  std::optional<double> step;
  if (!table.read_number_or_auto(key, step, range::positive)) return false;
  analysis.automatic_step = !step;
  analysis.time_step = step.value_or(0.0);
  return true;
}

const Own<Analysis> time_step = {
    "a number > 0 or \"auto\"",
    [] {
      return schema_of_any({Json{{"const", "auto"}}, schema_of_number(range::positive, "number")});
    },
    read_time_step,
    [](const Analysis& analysis) {
      return analysis.automatic_step ? Json("auto") : Json(analysis.time_step);
    }};

bool read_formulation(TomlTableReader& table, const std::string& key, Analysis& analysis) {
  FormulationChoice choice{analysis.formulation, analysis.paper};
  if (!table.read_choice(key, choice, formulation_names)) return false;
  analysis.formulation = choice.formulation;
  analysis.paper = choice.paper;
  return true;
}

const Own<Analysis> formulation = {"one of \"total\", \"incremental\", \"paper\"",
                                   [] {
                                     return Json{{"enum", words_of(formulation_names)}};
                                   },
                                   read_formulation,
                                   [](const Analysis& analysis) { return Json(formulation_name(analysis)); }};

const History<Analysis> gravity_history = {
    4, "[t, gx, gy, gz]",
    [](Analysis& analysis, HistoryRows history) {
      analysis.gravity_history.clear();
      analysis.gravity_file = std::move(history.file);
      for (const auto& row : history.rows)
        analysis.gravity_history.push_back({row[0], {row[1], row[2], row[3]}});
    },
    [](const Analysis& analysis) {
      return analysis.gravity_history.empty() ? Json()
                                              : json_of_rows(analysis.gravity_file, analysis.gravity_history);
    }};

/// In a stage one form of gravity replaces the other.
bool replace_history(TomlTableReader& table, Analysis& analysis) {
  if (table.given("gravity") && !table.given("gravity_history")) analysis.gravity_history.clear();
  return true;
}

bool constant_gravity(const Analysis& analysis) {
  return analysis.gravity_history.empty();
}

std::vector<Key<Analysis>> keys_of_time() {
  return {
      choice("type", &Analysis::type, analysis_type_names,
             "motion in time, or equilibrium under the loads of `end_time`; or the factor by which strengths "
             "have to be divided, or loads multiplied, until there is none. `thrust`: the least and greatest "
             "horizontal thrust on each block that does not move, over all forces within the strengths that "
             "balance the loads; `movement`: how far each can move. `pushover`: the multiplier of horizontal "
             "forces along the mechanism, and the [kinematic check](../howto/pushover.md)"),
      number("end_time", &Analysis::end_time, range::positive, "s",
             "static: may be left out (1) unless something has a history")
          .otherwise("required"),
      own("time_step", time_step, "s",
          "the largest step, at most `end_time`; steps that fail are halved, then grow back. Auto, with "
          "`accuracy` only, and its default there: chosen during the run, in factors of two. Static: between "
          "the loads that a history goes through, and the length of the first iteration; may be left out "
          "(1e-3) unless something has a history")
          .otherwise("required"),
      choice("integrator", &Analysis::integrator, integrator_names,
             "dynamic only. `dda` damps motion about as fast as the step, `average-acceleration` nothing, "
             "`generalized-alpha` high frequencies only"),
      number("spectral_radius", &Analysis::spectral_radius, range::zero_to_one, "",
             "of `generalized-alpha` only: the spectral radius at infinite frequency"),
      own("formulation", formulation, "",
          "`paper` is the method of the [source paper](../theory.md), for comparison: the incremental "
          "formulation with point springs. `incremental` is the formulation alone, with the springs of "
          "`contact.springs`. Both: dynamic, flat sub-faces, linear elasticity, no ties"),
      choice("initial_state", &Analysis::initial_state, initial_state_names,
             "`static`, of motion only: a static analysis under gravity and the loads at t = 0, contacts on, "
             "comes first, and motion starts from its positions, forces and bonds, with the velocities of "
             "the blocks; blocks without support stay as placed. If it finds blocks without equilibrium, a "
             "note says so and all start as placed; if it does not converge, the run fails. `equilibrium`: "
             "each block whose own `fix` leaves it no rigid motion and that is not tied starts deformed by "
             "gravity and loads at t = 0, without contacts. All others start as placed; a run names them"),
      number("accuracy", &Analysis::accuracy, range::positive_to_one, "",
             "static and dynamic, without stages: orders of blocks, the chord tolerance and the step that "
             "are not given are chosen so that the estimated relative error of each `[[measure]]` "
             "(displacement of a point or block, force of a pair or bolt, drift, width of cracks) is below "
             "it; without measures that of the energy of the blocks. The run says the estimate, and warns if "
             "it is larger: `error` in `summary.json`. How: [accuracy](../howto/accuracy.md)"),
      number("allowed_displacement", &Analysis::allowed_displacement, range::positive, "m",
             "none: a hundredth of the size of each block; `factor-of-safety` and `capacity`: a factor at "
             "which a block yields by more does not stand, wherever it would come to rest. Counted from the "
             "state at rest, before strengths fall or loads grow")};
}

std::vector<Key<Analysis>> keys_of_method() {
  return {
      vector("gravity", &Analysis::gravity, "m/s^2", "").written_if(constant_gravity),
      history("gravity_history", gravity_history, "s, m/s^2",
              "in place of `gravity`: a table that is tilted, an earthquake as a force (pseudo-static). "
              "Times increase, linear between, constant before and after. Such gravity is a load: its work "
              "is in `energy.applied`, and `energy.gravity` is 0. Static: followed in levels of `time_step`")
          .otherwise("constant"),
      choice("solver", &Analysis::solver, solver_names,
             "`cholmod`: a sparse factor, `cg`: conjugate gradients, which need no memory for a factor and "
             "were slower in all measurements (up to 12,000 unknowns). `auto` is `cholmod`"),
      number("mass_damping", &Analysis::mass_damping, range::not_negative, "1/s",
             "dynamic only: a force against every block, this times its momentum; with `generalized-alpha` "
             "at most 3 / `time_step`"),
      number("stiffness_damping", &Analysis::stiffness_damping, range::not_negative, "s",
             "Rayleigh's beta, dynamic only: forces against the deformation of every block, this times the "
             "rate of its elastic forces; a vibration of w rad/s has beta w / 2 of the critical damping. "
             "Motion of a block as a whole is not damped"),
      choice("method", &Analysis::method, method_names,
             "method of a search for a factor: `\"limit\"` treats blocks as rigid and needs seconds, "
             "`\"elastic\"` runs static analyses, first at the two ends that limit analysis finds. Where a "
             "joint loses strength when it fails, `\"limit\"` has its residual strength, with a warning, and "
             "the factor of `\"elastic\"` depends on the orders of blocks by some percent. Auto: `\"limit\"` "
             "unless there is `[initial_stress]`, a joint loses strength when it fails, or a bolt has a "
             "`rupture_strain` or no limit of its force"),
      table<safety_keys>("safety", &Analysis::safety, ""),
      table<capacity_keys>("capacity", &Analysis::capacity, ""),
      table<movement_keys>("movement", &Analysis::movement, ""),
      pushover_of_analysis(),
      spectrum_of_analysis(),
      flag("sleeping", &Analysis::sleeping,
           "blocks that have come to rest are held as they are until something touches, loads or moves them: "
           "they cost nothing. `false`: every block is computed in every step"),
      number_or(
          "auto", "memory_limit", &Analysis::memory_limit, range::positive, "bytes",
          "bound of the estimated memory of a scene, on [several processes](../howto/many-machines.md) of "
          "each; above it nothing is built. Auto: 8e9. The estimate is printed by `check` and `run`")};
}

const Keys<Analysis> analysis_table("Kind of analysis, its times and method",
                                    joined(keys_of_time(), keys_of_method()),
                                    {replace_history, check_push_direction});

}  // namespace

const Keys<SceneAnalysis>& analysis_keys() {
  return analysis_table;
}

}  // namespace ashlar::keys
