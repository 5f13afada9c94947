#include "solver/statics/static_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "mechanics/basis/field_moments.hpp"
#include "solver/run/automatic.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {
namespace {

/// Of settings.static_travel: what has gone so far when iterations end moves, if slowly.
constexpr double slow_share = 0.1;
/// Of settings.static_travel: what moving blocks take along, or what sinks while others give way to it, has
/// travelled this at least; blocks that only bear more than before have hardly moved.
constexpr double taken_along_share = 1e-3;

TimeScheme static_scheme(double inertia) {
  TimeScheme scheme;
  scheme.inertia = inertia;
  scheme.from_rest = true;
  return scheme;
}

std::array<int, 3> contact_states(const StepReport& report) {
  return {report.open, report.locked, report.sliding};
}

}  // namespace

double mean_motion(const BlockModel& block, const Eigen::MatrixX3d& change) {
  return change.norm() / std::sqrt(block.basis().volume());
}

std::vector<std::vector<int>> Simulation::loose_blocks() {
  const std::vector<ContactPair> pairs = make_pairs(find_contacts(0.0), false);
  std::vector<std::vector<int>> loose;
  for (const Island& island : find_islands(moving_, pairs)) {
    bool held =
        island.pairs.empty() && blocks_[static_cast<std::size_t>(island.bodies.front())].space().held();
    for (const int index : island.pairs) {
      const ContactPair& pair = pairs[static_cast<std::size_t>(index)];
      for (const int block : {pair.a(), pair.b()}) {
        const BlockModel& model = blocks_[static_cast<std::size_t>(block)];
        held = held || model.fixed() || model.supported();
      }
    }
    if (!held) loose.push_back(island.bodies);
  }
  return loose;
}

std::vector<bool> Simulation::held_without_contacts() const {
  std::vector<bool> held;
  held.reserve(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) held.push_back(!moving_[k] || blocks_[k].space().held());
  for (bool more = true; more;) {
    more = false;
    for (const TiedBlocks& tie : ties_) {
      const auto a = static_cast<std::size_t>(tie.a), b = static_cast<std::size_t>(tie.b);
      if (held[a] == held[b]) continue;
      held[a] = held[b] = more = true;
    }
  }
  return held;
}

double Simulation::least_inertia() const {
  double most = 0.0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k] || blocks_[k].unknowns() == 0) continue;
    const double stiffness = blocks_[k].tangent(Eigen::Matrix3d::Identity()).diagonal().maxCoeff();
    most = std::max(most, stiffness / blocks_[k].material().density);
  }
  const std::vector<bool> held = held_without_contacts();
  const bool all = std::find(held.begin(), held.end(), false) == held.end();
  return (all ? settings_.static_held_inertia_share : settings_.static_inertia_share) * most;
}

void Simulation::start_load_level(double end_time) {
  const bool changing = settings_.gravity_history.changes_between(time(), end_time) ||
                        std::any_of(blocks_.begin(), blocks_.end(), [&](const BlockModel& block) {
                          return block.loads_change_between(time(), end_time);
                        });
  if (changing && clock_.time_after(settings_.time_step) < end_time - time_rounding(end_time)) {
    clock_.advance(settings_.time_step);
  } else {
    clock_ = {.start = end_time};
  }
  // From one equilibrium to the next, inertia would make blocks slide that supports only carry along.
  const bool from_equilibrium = static_.balanced;
  static_ = StaticState{};
  if (from_equilibrium) static_.inertia = least_inertia();
  if (static_.inertia == 0.0) static_.inertia = 2.0 / (settings_.time_step * settings_.time_step);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (moving_[k]) ledger_.numerical += blocks_[k].kinetic_energy(states_[k]);
    states_[k].velocity.setZero();
    static_.milestones.push_back(states_[k].position);
  }
  static_.milestone_forces.assign(blocks_.size(), std::numeric_limits<double>::infinity());
  static_.travels.assign(blocks_.size(), 0.0);
  for (const BlockState& state : states_) static_.level_start.push_back(state.position);
  for (auto& [blocks, memory] : memory_) memory.start_level();
  static_.holds_bonds = true;
  forget_accelerations();
}

std::vector<Vector3> Simulation::moved_in_level(int a, int b, const std::vector<ContactPoint>& points) const {
  std::vector<Vector3> moved(points.size(), Vector3::Zero());
  for (const bool of_a : {true, false}) {
    const auto block = static_cast<std::size_t>(of_a ? a : b);
    if (!moving_[block]) continue;
    std::vector<Vector3> material;
    material.reserve(points.size());
    for (const ContactPoint& point : points) material.push_back(of_a ? point.material_a : point.material_b);
    const Eigen::MatrixX3d motion =
        blocks_[block].basis().values(material) * (states_[block].position - static_.level_start[block]);
    for (std::size_t k = 0; k < points.size(); ++k)
      moved[k] += (of_a ? 1.0 : -1.0) * motion.row(static_cast<Eigen::Index>(k)).transpose();
  }
  return moved;
}

StaticStatus Simulation::static_step(double end_time) {
  if (any_incremental()) throw std::logic_error("incremental blocks have no static analysis");
  if (static_.moving) return StaticStatus::moving;
  if (static_.balanced && reached(end_time)) return StaticStatus::equilibrium;
  if (static_.inertia == 0.0 || static_.balanced) start_load_level(end_time);
  if (static_.iterations >= settings_.static_iterations) return give_up();
  ++static_.iterations;
  const double least = least_inertia();
  std::vector<FoundContacts> found = find_contacts(0.0);
  Trial trial;
  trial.pairs = make_pairs(found, false);
  static_.holds_bonds = static_.holds_bonds && std::any_of(trial.pairs.begin(), trial.pairs.end(),
                                                           [](const ContactPair& p) { return p.bonded(); });
  bool cut = false;
  bool cut_to_touch = false;
  for (int cuts = 0; cuts <= settings_.static_cuts; ++cuts) {
    const TimeScheme scheme = static_scheme(std::max(static_.inertia, least));
    const double step = std::sqrt(2.0 / scheme.inertia);
    const IslandStatus status = try_step(scheme, trial);
    double raise = 10.0;
    if (status != IslandStatus::settled) {
      reject_unsettled(step, status, trial);
      if (static_.holds_bonds) {
        let_bonds_go();
        trial.pairs = make_pairs(found, false);
      }
    } else if (const auto broken = broken_block(trial)) {
      reject(step, *broken);
    } else if (const double motion = largest_motion(trial); motion > settings_.static_motion) {
      raise = std::clamp(1.1 * motion / settings_.static_motion, 2.0, 1e4);
    } else if (const auto passing = check_motion(trial, found); !passing.empty()) {
      rejections_.push_back({time(), step, RejectionReason::passing});
      if (passing.front().touch.share <= settings_.smallest_cut) {
        add_contacts(passing, found);
        counts_.passing_contacts += passing.size();
        trial.pairs = make_pairs(found, false);
        raise = 1.0;
      } else {
        // Blocks that roll meet again and again shortly before where they met.
        raise = std::max(1.0 / passing.front().touch.share, cut_to_touch ? 2.0 : 1.0);
        cut_to_touch = true;
      }
    } else if (const auto deep = audit_depths(trial, true); deep && !has_set_off()) {
      reject(step, *deep);
    } else {
      const std::array<int, 3> before = contact_states(report_);
      const bool balanced = note_balance(scheme, trial);
      if (balanced) {
        forget_accelerations();
      } else {
        note_accelerations(scheme, trial);
      }
      const bool repeat = multipliers_repeat(trial);
      accept(scheme, trial);
      report_.step = step;
      if (static_.holds_bonds && (balanced || has_set_off())) let_bonds_go();
      if (!cut) static_.inertia = std::max(0.1 * scheme.inertia, least);
      const bool still = balanced && (scheme.inertia <= least || least == 0.0) &&
                         (before == contact_states(report_) || motion <= settings_.static_stillness);
      if (still && !repeat) ++static_.multiplier_iterations;
      const bool settled =
          still && (repeat || static_.multiplier_iterations > settings_.static_multiplier_iterations);
      static_.still_iterations = settled ? static_.still_iterations + 1 : 0;
      static_.balanced = static_.still_iterations >= 2;
      if (static_.balanced && deep) {
        // Blocks that have set off are followed only roughly; where they come to rest is an answer.
        reject(step, *deep);
        return give_up();
      }
      if (static_.balanced) return reached(end_time) ? StaticStatus::equilibrium : StaticStatus::balancing;
      return static_.moving ? StaticStatus::moving : StaticStatus::balancing;
    }
    static_.inertia = raise * scheme.inertia;
    cut = cut || raise > 1.0;
  }
  return give_up();
}

bool Simulation::has_set_off() const {
  return std::any_of(static_.travels.begin(), static_.travels.end(),
                     [&](double travel) { return travel > taken_along_share * settings_.static_travel; });
}

void Simulation::let_bonds_go() {
  static_.holds_bonds = false;
  // What bonds that do not fail do is no motion of these blocks.
  forget_accelerations();
  // How multipliers share a force is left from the way here; springs share it as stiff joints would.
  for (auto& [blocks, memory] : memory_) {
    std::vector<ContactMemory::Entry> entries = memory.entries();
    for (ContactMemory::Entry& entry : entries) {
      entry.memory.normal_multiplier = 0.0;
      entry.memory.shear_multiplier.setZero();
    }
    memory =
        ContactMemory(std::move(entries), memory.cuts(), memory.deepest(), memory.held(), memory.bulge());
  }
}

bool Simulation::multipliers_repeat(const Trial& trial) const {
  double change = 0.0;
  double largest = 0.0;
  for (const IslandResult& result : trial.results) {
    for (std::size_t pair = 0; pair < result.laws.size(); ++pair) {
      for (std::size_t k = 0; k < result.laws[pair].size(); ++k) {
        const PointLaw& law = result.laws[pair][k];
        const Eigen::Vector3d& force = result.responses[pair].points[k].force;
        largest = std::max(largest, force.norm());
        if (!law.augmented) continue;
        const Eigen::Vector3d held(law.normal_multiplier, law.shear_multiplier[0], law.shear_multiplier[1]);
        change = std::max(change, (force - held).norm());
      }
    }
  }
  return change <= settings_.static_multiplier_tolerance * largest;
}

StaticStatus Simulation::give_up() {
  // What little a block lacks may take it far only slowly.
  const std::vector<bool> held = held_without_contacts();
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    static_.moving =
        static_.moving || (!held[k] && static_.travels[k] > slow_share * settings_.static_travel);
  return static_.moving ? StaticStatus::moving : StaticStatus::not_converged;
}

double Simulation::largest_motion(const Trial& trial) {
  double most = 0.0;
  for (const Island& island : trial.islands) most = std::max(most, largest_motion(island, trial.bodies));
  return most;
}

double Simulation::largest_motion(const Island& island, const std::vector<BodyStep>& bodies) {
  double most = 0.0;
  for (const int k : island.bodies) {
    const BodyStep& body = bodies[static_cast<std::size_t>(k)];
    const double motion = mean_motion(*body.model, body.model->space().expand(body.change));
    most = std::max(most, motion / block_size(*body.model));
  }
  return most;
}

Simulation::Joints Simulation::joints(const Trial& trial) const {
  Joints joints;
  const double tearing_gap = settings_.tearing_share * settings_.contact_distance;
  const auto change = [&](int block) { return trial.bodies[static_cast<std::size_t>(block)].change; };
  for (std::size_t i = 0; i < trial.islands.size(); ++i) {
    for (std::size_t n = 0; n < trial.islands[i].pairs.size(); ++n) {
      const ContactPair& pair = trial.pairs[static_cast<std::size_t>(trial.islands[i].pairs[n])];
      if (pair.tied()) continue;
      const PairResponse& response = trial.results[i].responses[n];
      const auto any = [&](ContactState state) {
        return std::any_of(response.points.begin(), response.points.end(),
                           [&](const PointResponse& point) { return point.state == state; });
      };
      // Where pressure ends, some points slide whatever the blocks do.
      if (any(ContactState::sliding) && !any(ContactState::locked))
        joints.sliding.push_back({pair.a(), pair.b()});
      joints.fail =
          joints.fail || pair.fails(pair.memory_after(response, trial.results[i].laws[n], change(pair.a()),
                                                      change(pair.b()), tearing_gap));
    }
  }
  std::sort(joints.sliding.begin(), joints.sliding.end());
  return joints;
}

bool Simulation::note_balance(const TimeScheme& scheme, const Trial& trial) {
  bool balanced = true;
  const std::vector<bool> held = held_without_contacts();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k]) continue;
    const BodyStep& body = trial.bodies[k];
    const BlockModel& block = blocks_[k];
    const double lacking = block.material().density * scheme.inertia * body.change.norm();
    const Eigen::MatrixX3d position = states_[k].position + body.motion();
    if (lacking <= settings_.static_tolerance * body.largest_force + body.roundoff_force) {
      static_.travels[k] = 0.0;
      static_.milestones[k] = position;
      static_.milestone_forces[k] = lacking;
      continue;
    }
    balanced = false;
    if (lacking < 0.5 * static_.milestone_forces[k]) {
      static_.milestones[k] = position;
      static_.milestone_forces[k] = lacking;
    }
    static_.travels[k] = mean_motion(block, position - static_.milestones[k]) / block_size(block);
    if (static_.travels[k] > settings_.static_travel && !held[k]) static_.moving = true;
  }
  return balanced;
}

void Simulation::forget_accelerations() {
  static_.least_lacking = std::numeric_limits<double>::infinity();
  static_.unbalanced.clear();
  static_.rigid = false;
  static_.gives_way.assign(blocks_.size(), 0);
  static_.starts.clear();
  for (const BlockState& state : states_) static_.starts.push_back(state.position);
}

double Simulation::travel(std::size_t block) const {
  return mean_motion(blocks_[block], states_[block].position - static_.starts[block]);
}

void Simulation::note_accelerations(const TimeScheme& scheme, const Trial& trial) {
  auto [sliding, fail] = joints(trial);
  if (fail) forget_accelerations();
  const bool settled = sliding == static_.sliding;
  static_.sliding = std::move(sliding);
  if (!static_.unbalanced.empty() && !settled) return;
  bool near_start = true;
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    near_start = near_start && !(moving_[k] && travel(k) > settings_.contact_distance);
  if (!near_start && static_.rigid) return;
  std::vector<Eigen::MatrixX3d> accelerations(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    if (moving_[k]) accelerations[k] = scheme.inertia * blocks_[k].space().expand(trial.bodies[k].change);
  if (settled) {
    const bool rigid = set_off(scheme, trial, accelerations);
    double lacking = 0.0;
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      lacking += std::pow(blocks_[k].material().density * accelerations[k].norm(), 2);
    if (!(lacking < static_.least_lacking)) return;
    static_.least_lacking = lacking;
    static_.rigid = rigid;
  }
  static_.unbalanced = std::move(accelerations);
}

std::vector<MovingBlock> Simulation::moving_blocks() const {
  const std::vector<bool> held = held_without_contacts();
  std::vector<MovingBlock> result;
  std::vector<MovingBlock> later;
  for (std::size_t k = 0; k < static_.travels.size(); ++k) {
    const BlockModel& block = blocks_[k];
    if (!moving_[k] || held[k] || static_.travels[k] <= taken_along_share * settings_.static_travel) continue;
    const Eigen::MatrixX3d& a = static_.unbalanced[k];
    const Eigen::Matrix3d gradient = a.transpose() * block.basis().gradients(block.basis().centroid());
    const Vector3 turn = 0.5 * Vector3(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                                       gradient(1, 0) - gradient(0, 1));
    (a.isZero(0.0) ? later : result)
        .push_back({static_cast<int>(k), mean_of(a, block.basis().volume()), turn});
  }
  return result.empty() ? later : result;
}

}  // namespace ashlar
