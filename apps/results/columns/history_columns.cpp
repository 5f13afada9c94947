#include "apps/results/columns/history_columns.hpp"

#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "apps/results/tables/contact_state.hpp"
#include "apps/results/text/json_text.hpp"
#include "geometry/index.hpp"
#include "solver/fracture/cracked_blocks.hpp"

namespace ashlar {
namespace {

/// A measured point or block in one row.
struct MeasuredPoint {
  PointMotion motion;
  Vector3 displacement;  ///< m, since the last reset
  Vector3 turn;          ///< degrees; of a block
  double kinetic;        ///< J, of a block
  double runout;         ///< m, of a block
};

/// A measured drift in one row.
struct MeasuredDrift {
  Vector3 drift;
};

/// The run in one row.
struct RunRow {
  const Ledger& ledger;
  const StepReport& report;
  double time;
  Vector3 momentum, angular_momentum;
  ShownContacts counts;
};

using P = MeasuredPoint;
constexpr ColumnOf<P> point_columns[] = {
    {"x", "m", "position", "place of the point; of a block of its centroid",
     [](const P& p) { return p.motion.place.x(); }, "x"},
    {"y", "m", "position", "place of the point; of a block of its centroid",
     [](const P& p) { return p.motion.place.y(); }, "y"},
    {"z", "m", "position", "place of the point; of a block of its centroid",
     [](const P& p) { return p.motion.place.z(); }, "z"},
    {"ux", "m", "displacement",
     "displacement of the point since it was placed, or since `reset_displacement`",
     [](const P& p) { return p.displacement.x(); }, "x"},
    {"uy", "m", "displacement",
     "displacement of the point since it was placed, or since `reset_displacement`",
     [](const P& p) { return p.displacement.y(); }, "y"},
    {"uz", "m", "displacement",
     "displacement of the point since it was placed, or since `reset_displacement`",
     [](const P& p) { return p.displacement.z(); }, "z"},
    {"vx", "m/s", "velocity", "velocity of the point", [](const P& p) { return p.motion.velocity.x(); }, "x"},
    {"vy", "m/s", "velocity", "velocity of the point", [](const P& p) { return p.motion.velocity.y(); }, "y"},
    {"vz", "m/s", "velocity", "velocity of the point", [](const P& p) { return p.motion.velocity.z(); }, "z"},
};
constexpr const char* rotation = "rotation since placement, axis times angle, up to 180";
constexpr ColumnOf<P> turn_columns[] = {
    {"rx", "degrees", "rotation", rotation, [](const P& p) { return p.turn.x(); }, "x"},
    {"ry", "degrees", "rotation", rotation, [](const P& p) { return p.turn.y(); }, "y"},
    {"rz", "degrees", "rotation", rotation, [](const P& p) { return p.turn.z(); }, "z"},
};
constexpr const char* cauchy = "Cauchy stress, tension positive";
constexpr ColumnOf<P> stress_columns[] = {
    {"sxx", "Pa", "stress", cauchy, [](const P& p) { return p.motion.stress(0, 0); }, "xx"},
    {"syy", "Pa", "stress", cauchy, [](const P& p) { return p.motion.stress(1, 1); }, "yy"},
    {"szz", "Pa", "stress", cauchy, [](const P& p) { return p.motion.stress(2, 2); }, "zz"},
    {"sxy", "Pa", "stress", cauchy, [](const P& p) { return p.motion.stress(0, 1); }, "xy"},
    {"syz", "Pa", "stress", cauchy, [](const P& p) { return p.motion.stress(1, 2); }, "yz"},
    {"sxz", "Pa", "stress", cauchy, [](const P& p) { return p.motion.stress(0, 2); }, "xz"},
};
constexpr ColumnOf<P> speed_columns[] = {
    {"speed", "m/s", "speed", "length of the velocity", [](const P& p) { return p.motion.velocity.norm(); }},
};
constexpr ColumnOf<P> travel_columns[] = {
    {"kinetic_energy", "J", "kinetic energy", "kinetic energy, with that of rotation and deformation",
     [](const P& p) { return p.kinetic; }},
    {"runout", "m", "runout", "length of the displacement across gravity",
     [](const P& p) { return p.runout; }},
};

constexpr ColumnOf<PairMeasure> pair_columns[] = {
    {"normal_force", "N", "forces", "sum of normal forces, compression positive",
     [](const PairMeasure& pair) { return pair.normal_force; }},
    {"shear_force", "N", "forces", "length of the sum of shear forces",
     [](const PairMeasure& pair) { return pair.shear_force; }},
    {"opening", "m", "opening and slip", "mean gap over the area of the contact points (nan: there are none)",
     [](const PairMeasure& pair) { return pair.opening; }},
    {"slip", "m", "opening and slip", "mean slip since placement over the area of the contact points",
     [](const PairMeasure& pair) { return pair.slip; }},
    {"area", "m^2", "area", "area of the closed contact points",
     [](const PairMeasure& pair) { return pair.area; }},
};

constexpr ColumnOf<BoltMeasure> bolt_columns[] = {
    {"axial_force", "N", "forces", "largest force along the bar by its amount, tension positive",
     [](const BoltMeasure& bolt) { return bolt.axial_force; }},
    {"shear_force", "N", "forces", "largest force across the bar at a joint",
     [](const BoltMeasure& bolt) { return bolt.shear_force; }},
    {"state", "1", "state",
     "worst state so far: 0 not installed, 1 elastic, 2 its grout slips or it yields in shear, 3 its steel "
     "yields, 4 "
     "ruptured",
     [](const BoltMeasure& bolt) { return static_cast<double>(static_cast<int>(bolt.condition)); }},
};

constexpr const char* drift_part = "component of the drift";
constexpr ColumnOf<MeasuredDrift> drift_columns[] = {
    {"drift", "1", "drift",
     "horizontal displacement of the upper level less that of the lower one, over their distance (nan: a "
     "level has no "
     "block)",
     [](const MeasuredDrift& level) { return level.drift.norm(); }},
    {"drift_x", "1", "drift", drift_part, [](const MeasuredDrift& level) { return level.drift.x(); }, "x"},
    {"drift_y", "1", "drift", drift_part, [](const MeasuredDrift& level) { return level.drift.y(); }, "y"},
    {"drift_z", "1", "drift", drift_part, [](const MeasuredDrift& level) { return level.drift.z(); }, "z"},
};

constexpr ColumnOf<CrackWidths> crack_columns[] = {
    {"largest_opening", "m", "opening and slip",
     "largest opening of faces that touched at the start; closed faces count as 0 (nan: no joint is left)",
     [](const CrackWidths& crack) { return crack.largest_opening; }},
    {"mean_opening", "m", "opening and slip",
     "mean opening over the area of the faces that touched at the start; closed faces count as 0",
     [](const CrackWidths& crack) { return crack.mean_opening; }},
    {"largest_slip", "m", "opening and slip", "largest slip along the faces that touched at the start",
     [](const CrackWidths& crack) { return crack.largest_slip; }},
    {"open_area", "m^2", "area", "area of the faces that touched at the start and are open at their centre",
     [](const CrackWidths& crack) { return crack.open_area; }},
};

constexpr ColumnOf<double> fracture_columns[] = {
    {"cracks", "J", "energies",
     "fracture energy of the damaged area of cracks that have appeared, a part of energy.friction",
     [](const double& energy) { return energy; }},
};

constexpr ColumnOf<RunRow> time_columns[] = {
    {"time", "s", "", "time, of the present stage", [](const RunRow& run) { return run.time; }},
    {"dt", "s", "step size", "length of the step that ends here",
     [](const RunRow& run) { return run.report.step; }},
};

using R = RunRow;
constexpr const char* momentum = "momentum of all moving blocks";
constexpr const char* about = "angular momentum of all moving blocks about `origin`";
constexpr ColumnOf<R> run_columns[] = {
    {"energy.kinetic", "J", "energies", "kinetic energy", [](const R& r) { return r.ledger.kinetic; }},
    {"energy.elastic", "J", "energies", "elastic energy stored in blocks",
     [](const R& r) { return r.ledger.elastic; }},
    {"energy.gravity", "J", "energies",
     "energy of gravity: -m g . x, x from `origin` (0 with `gravity_history`)",
     [](const R& r) { return r.ledger.gravity; }},
    {"energy.contact", "J", "energies", "energy stored in contact springs",
     [](const R& r) { return r.ledger.contact; }},
    {"energy.friction", "J", "energies",
     "dissipated since the start by sliding (less the work of dilation) and by fracture of bonds",
     [](const R& r) { return r.ledger.friction; }},
    {"energy.damping", "J", "energies",
     "dissipated since the start by damping of mass, stiffness and joints and by impacts with `restitution`",
     [](const R& r) { return r.ledger.damping; }},
    {"energy.applied", "J", "energies",
     "work of loads, moving supports and gravity that has a history, since the start",
     [](const R& r) { return r.ledger.applied; }},
    {"energy.numerical", "J", "energies",
     "dissipated since the start by the integrator, with `augmented` by impacts too",
     [](const R& r) { return r.ledger.numerical; }},
    {"energy.residual", "J", "energies", "residual of the energy balance: rounding error",
     [](const R& r) { return r.ledger.residual; }},
    {"momentum.x", "N s", "momentum", momentum, [](const R& r) { return r.momentum.x(); }, "x"},
    {"momentum.y", "N s", "momentum", momentum, [](const R& r) { return r.momentum.y(); }, "y"},
    {"momentum.z", "N s", "momentum", momentum, [](const R& r) { return r.momentum.z(); }, "z"},
    {"angular_momentum.x", "N m s", "angular momentum", about,
     [](const R& r) { return r.angular_momentum.x(); }, "x"},
    {"angular_momentum.y", "N m s", "angular momentum", about,
     [](const R& r) { return r.angular_momentum.y(); }, "y"},
    {"angular_momentum.z", "N m s", "angular momentum", about,
     [](const R& r) { return r.angular_momentum.z(); }, "z"},
    {"contacts.open", "1", "contacts", "contact points that are open",
     [](const R& r) { return static_cast<double>(r.counts.open); }},
    {"contacts.locked", "1", "contacts",
     "contact points that are locked, those at their limit in a joint that is not among them: forces within "
     "a stiff joint are not unique",
     [](const R& r) { return static_cast<double>(r.counts.locked); }},
    {"contacts.sliding", "1", "contacts",
     "contact points that slide: faster than 1e-6 of the smaller block's size per second, or their joint as "
     "a whole is at its strength (99 % of it, in shear or twist)",
     [](const R& r) { return static_cast<double>(r.counts.sliding); }},
    {"penetration.max", "m", "penetration",
     "true depth of the deepest corner or edge of any block in another one, measured without the contacts; "
     "for edges in "
     "non-convex solids exact to `distance`, in every tenth step and at the end to a hundredth of it",
     [](const R& r) { return r.report.depth; }},
    {"open_close.iterations", "1", "open-close iterations", "open-close iterations of the step",
     [](const R& r) { return static_cast<double>(r.report.iterations); }},
    {"energy.redetection_gained", "J", "energies",
     "spring energy gained since the start when contacts were detected again",
     [](const R& r) { return r.ledger.redetection_gained; }},
    {"energy.redetection_lost", "J", "energies",
     "spring energy lost since the start when contacts were detected again",
     [](const R& r) { return r.ledger.redetection_lost; }},
};

/// True if a point of a block is measured.
bool has_motion(const Measure& measure) {
  return measure.kind == Measure::Kind::point || measure.kind == Measure::Kind::block;
}

/// Where the columns of a measure stand.
enum class Part {
  measures,  ///< before those of the run
  stresses,  ///< after them
  added,     ///< last: by later versions
};

/// Calls `visit` with the declarations of a measure's columns.
template <class Visit>
void visit_columns(Measure::Kind kind, Part part, const Visit& visit) {
  const bool of_block = kind == Measure::Kind::block;
  if (of_block || kind == Measure::Kind::point) {
    if (part == Part::measures) visit(point_columns);
    if (part == Part::measures && of_block) visit(turn_columns);
    if (part == Part::stresses) visit(stress_columns);
    if (part == Part::added) visit(speed_columns);
    if (part == Part::added && of_block) visit(travel_columns);
    return;
  }
  if (part == Part::added && kind == Measure::Kind::fracture) visit(fracture_columns);
  if (part != Part::measures) return;
  if (kind == Measure::Kind::pair) visit(pair_columns);
  if (kind == Measure::Kind::bolt) visit(bolt_columns);
  if (kind == Measure::Kind::drift) visit(drift_columns);
  if (kind == Measure::Kind::crack) visit(crack_columns);
}

MeasuredPoint measured_point(const Simulation& simulation, const Measure& measure, const Vector3* origin) {
  const PointMotion motion = measured_motion(simulation, measure);
  const Vector3 moved = origin == nullptr ? motion.displacement : Vector3(motion.displacement - *origin);
  if (measure.kind == Measure::Kind::point) return {motion, moved, Vector3::Zero(), 0.0, 0.0};
  const bool present = simulation.system().present(measure.block);
  return {motion, moved, measured_turn(simulation, measure),
          present
              ? simulation.blocks()[at(measure.block)].kinetic_energy(simulation.states()[at(measure.block)])
              : not_measured,
          (moved - moved.dot(measure.up) * measure.up).norm()};
}

/// Appends the values of a row.
class RowWriter {
 public:
  RowWriter(const Simulation& simulation, const std::vector<Measure>& measures,
            const DisplacementOrigin& origin)
      : simulation_(simulation), measures_(measures), origin_(origin), points_(measures.size()) {
    for (std::size_t k = 0; k < measures.size(); ++k)
      if (has_motion(measures[k])) points_[k] = measured_point(simulation, measures[k], origin_of(k));
  }

  template <class Source, std::size_t count>
  void append(const ColumnOf<Source> (&columns)[count], const Source& source) {
    for (const ColumnOf<Source>& column : columns) values_.push_back(column.value(source));
  }

  /// Appends the values of some columns of a measure.
  template <class Source, std::size_t count>
  void append_measure(std::size_t k, const ColumnOf<Source> (&columns)[count]) {
    if constexpr (std::is_same_v<Source, MeasuredPoint>) append(columns, points_[k]);
    if constexpr (std::is_same_v<Source, PairMeasure>)
      append(columns, measured_pair(simulation_, measures_[k]));
    if constexpr (std::is_same_v<Source, BoltMeasure>)
      append(columns, measured_bolt(simulation_, measures_[k]));
    if constexpr (std::is_same_v<Source, CrackWidths>)
      append(columns, measured_cracks(simulation_, *measures_[k].joints));
    if constexpr (std::is_same_v<Source, double>)
      append(columns, energy_of_cracks(simulation_, *measures_[k].parts));
    if constexpr (std::is_same_v<Source, MeasuredDrift>) {
      Vector3 drift = measured_drift(simulation_, *measures_[k].levels);
      if (const Vector3* origin = origin_of(k)) drift -= *origin;
      append(columns, MeasuredDrift{drift});
    }
  }

  void append(double value) { values_.push_back(value); }
  [[nodiscard]] std::vector<double> take() { return std::move(values_); }

 private:
  [[nodiscard]] const Vector3* origin_of(std::size_t k) const {
    return origin_.measures.empty() ? nullptr : &origin_.measures[k];
  }

  const Simulation& simulation_;
  const std::vector<Measure>& measures_;
  const DisplacementOrigin& origin_;
  std::vector<MeasuredPoint> points_;  ///< by measure, of points and blocks
  std::vector<double> values_;
};

template <class Source>
Column column_of(const ColumnOf<Source>& declared, const std::string& measure) {
  const std::string start = measure.empty() ? "" : measure + ".";
  return {start + declared.name, declared.unit, declared.group,
          declared.meaning,      measure,       declared.component};
}

/// Adds the columns of a measure to a list.
class ColumnLister {
 public:
  explicit ColumnLister(std::vector<Column>& columns, std::string measure = "")
      : columns_(columns), measure_(std::move(measure)) {}
  template <class Source, std::size_t count>
  void operator()(const ColumnOf<Source> (&declared)[count]) const {
    for (const ColumnOf<Source>& column : declared) columns_.push_back(column_of(column, measure_));
  }

 private:
  std::vector<Column>& columns_;
  std::string measure_;
};

}  // namespace

std::vector<Column> history_columns(const std::vector<Measure>& measures, bool in_stages) {
  std::vector<Column> columns = {{"step", "1", "", "number of the step, static: of the iteration", ""}};
  const ColumnLister of_run(columns);
  of_run(time_columns);
  const auto of_measures = [&](Part part) {
    for (const Measure& measure : measures)
      visit_columns(measure.kind, part, ColumnLister(columns, measure.name));
  };
  of_measures(Part::measures);
  of_run(run_columns);
  of_measures(Part::stresses);
  of_measures(Part::added);
  if (in_stages) columns.push_back({"stage", "1", "", "number of the stage, from 1", ""});
  return columns;
}

std::vector<double> history_row(const Simulation& simulation, const std::vector<Measure>& measures,
                                const DisplacementOrigin& origin, int stage) {
  RowWriter row(simulation, measures, origin);
  const RunRow run{simulation.ledger(),   simulation.report(),           simulation.time(),
                   simulation.momentum(), simulation.angular_momentum(), contact_counts(simulation)};
  const auto of_measures = [&](Part part) {
    for (std::size_t k = 0; k < measures.size(); ++k)
      visit_columns(measures[k].kind, part, [&](const auto& columns) { row.append_measure(k, columns); });
  };
  row.append(time_columns, run);
  of_measures(Part::measures);
  row.append(run_columns, run);
  of_measures(Part::stresses);
  of_measures(Part::added);
  if (stage > 0) row.append(stage);
  return row.take();
}

std::vector<MeasureColumns> columns_by_kind() {
  using Kind = Measure::Kind;
  std::vector<MeasureColumns> all;
  std::vector<Column> of_run = history_columns({}, true);
  all.push_back({"", std::move(of_run)});
  for (const auto& [word, kind] : {std::pair{"block", Kind::block},
                                   {"point", Kind::point},
                                   {"pair", Kind::pair},
                                   {"bolt", Kind::bolt},
                                   {"drift", Kind::drift},
                                   {"crack", Kind::crack}}) {
    MeasureColumns& entry = all.emplace_back(MeasureColumns{word, {}});
    const ColumnLister lister(entry.columns, "NAME");
    for (const Part part : {Part::measures, Part::stresses, Part::added}) visit_columns(kind, part, lister);
  }
  return all;
}

std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const Column& column : columns) names.push_back(column.name);
  return names;
}

std::string column_units(const std::vector<Column>& columns) {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const Column& column : columns)
    all[column.name] = {{"unit", column.unit},
                        {"measure", column.measure},
                        {"group", column.group},
                        {"meaning", column.meaning}};
  return json_text(all, 2) + "\n";
}

Vector3 measure_origin(const Simulation& simulation, const Measure& measure) {
  if (measure.kind == Measure::Kind::drift) return measured_drift(simulation, *measure.levels);
  if (!has_motion(measure)) return Vector3::Zero();
  return simulation.blocks()[at(measure.block)]
      .motion_of(simulation.states()[at(measure.block)], measure.point)
      .displacement;
}

}  // namespace ashlar
