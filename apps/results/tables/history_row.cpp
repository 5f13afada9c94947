#include "apps/results/tables/history_row.hpp"

#include <initializer_list>

#include "apps/results/tables/append_vector.hpp"
#include "apps/results/tables/contact_state.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// xx, yy, zz, xy, yz, xz
void append_stress(std::vector<double>& values, const Eigen::Matrix3d& s) {
  values.insert(values.end(), {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)});
}

/// True if a point of a block is measured.
bool has_motion(const Measure& measure) {
  return measure.kind == Measure::Kind::point || measure.kind == Measure::Kind::block;
}

}  // namespace

std::vector<std::string> history_columns(const std::vector<Measure>& measures, bool in_stages) {
  std::vector<std::string> columns = {"step", "time", "dt"};
  const auto add = [&](const Measure& measure, std::initializer_list<const char*> parts) {
    for (const char* part : parts) columns.push_back(measure.name + part);
  };
  for (const Measure& measure : measures) {
    if (measure.kind == Measure::Kind::bolt) {
      add(measure, {".axial_force", ".shear_force", ".state"});
      continue;
    }
    if (measure.kind == Measure::Kind::drift) {
      add(measure, {".drift", ".drift_x", ".drift_y", ".drift_z"});
      continue;
    }
    if (measure.kind == Measure::Kind::crack) {
      add(measure, {".largest_opening", ".mean_opening", ".largest_slip", ".open_area"});
      continue;
    }
    if (measure.kind == Measure::Kind::pair) {
      add(measure, {".normal_force", ".shear_force", ".opening", ".slip", ".area"});
      continue;
    }
    add(measure, {".x", ".y", ".z", ".ux", ".uy", ".uz", ".vx", ".vy", ".vz"});
    if (measure.kind == Measure::Kind::block) add(measure, {".rx", ".ry", ".rz"});
  }
  for (const char* name :
       {"energy.kinetic",        "energy.elastic",     "energy.gravity",     "energy.contact",
        "energy.friction",       "energy.damping",     "energy.applied",     "energy.numerical",
        "energy.residual",       "momentum.x",         "momentum.y",         "momentum.z",
        "angular_momentum.x",    "angular_momentum.y", "angular_momentum.z", "contacts.open",
        "contacts.locked",       "contacts.sliding",   "penetration.max",    "open_close.iterations",
        "energy.refound_gained", "energy.refound_lost"}) {
    columns.emplace_back(name);
  }
  for (const Measure& measure : measures)
    if (has_motion(measure)) add(measure, {".sxx", ".syy", ".szz", ".sxy", ".syz", ".sxz"});
  if (in_stages) columns.emplace_back("stage");
  return columns;
}

std::vector<double> history_row(const Simulation& simulation, const std::vector<Measure>& measures,
                                const DisplacementOrigin& origin, int stage) {
  const StepReport& report = simulation.report();
  std::vector<double> values = {simulation.time(), report.step};
  std::vector<PointMotion> motions;
  for (std::size_t k = 0; k < measures.size(); ++k) {
    if (measures[k].kind == Measure::Kind::bolt) {
      const BoltMeasure bolt = measured_bolt(simulation, measures[k]);
      values.insert(values.end(), {bolt.axial_force, bolt.shear_force,
                                   static_cast<double>(static_cast<int>(bolt.condition))});
      continue;
    }
    if (measures[k].kind == Measure::Kind::drift) {
      Vector3 drift = measured_drift(simulation, *measures[k].levels);
      if (!origin.measures.empty()) drift -= origin.measures[k];
      values.push_back(drift.norm());
      append(values, drift);
      continue;
    }
    if (measures[k].kind == Measure::Kind::crack) {
      const CrackWidths widths = measured_cracks(simulation, *measures[k].joints);
      values.insert(values.end(),
                    {widths.largest_opening, widths.mean_opening, widths.largest_slip, widths.open_area});
      continue;
    }
    if (measures[k].kind == Measure::Kind::pair) {
      const PairMeasure pair = measured_pair(simulation, measures[k]);
      values.insert(values.end(), {pair.normal_force, pair.shear_force, pair.opening, pair.slip, pair.area});
      continue;
    }
    const PointMotion motion = motions.emplace_back(measured_motion(simulation, measures[k]));
    append(values, motion.place);
    append(values,
           origin.measures.empty() ? motion.displacement : Vector3(motion.displacement - origin.measures[k]));
    append(values, motion.velocity);
    if (measures[k].kind == Measure::Kind::block) append(values, measured_turn(simulation, measures[k]));
  }
  const Ledger& ledger = simulation.ledger();
  values.insert(values.end(),
                {ledger.kinetic, ledger.elastic, ledger.gravity, ledger.contact, ledger.friction,
                 ledger.damping, ledger.applied, ledger.numerical, ledger.residual});
  append(values, simulation.momentum());
  append(values, simulation.angular_momentum());
  const ShownContacts counts = contact_counts(simulation);
  for (const int count : {counts.open, counts.locked, counts.sliding}) values.push_back(count);
  values.push_back(report.depth);
  values.push_back(report.iterations);
  values.push_back(ledger.redetection_gained);
  values.push_back(ledger.redetection_lost);
  for (const PointMotion& motion : motions) append_stress(values, motion.stress);
  if (stage > 0) values.push_back(stage);
  return values;
}

Vector3 measure_origin(const Simulation& simulation, const Measure& measure) {
  if (measure.kind == Measure::Kind::drift) return measured_drift(simulation, *measure.levels);
  if (!has_motion(measure)) return Vector3::Zero();
  return simulation.blocks()[at(measure.block)]
      .motion_of(simulation.states()[at(measure.block)], measure.point)
      .displacement;
}

}  // namespace ashlar
