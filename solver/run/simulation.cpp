#include "solver/run/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/contact/contact_master.hpp"
#include "mechanics/contact/overlap_outline.hpp"
#include "solver/contact/energy_bounds.hpp"
#include "solver/contact/surface_continuation.hpp"
#include "solver/run/automatic.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/step/angular_momentum.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

/// Takes the slip of a load level so far for good: what comes counts from there.
void take_slip(const std::vector<ContactPoint>& points, const std::vector<Vector3>& moved,
               std::vector<PointMemory>& memory) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!memory[k].in_level) continue;
    const Vector3 slid = memory[k].level_slip + moved[k] - memory[k].slip;
    memory[k].level_slip -= slid - points[k].normal.dot(slid) * points[k].normal;
  }
}

}  // namespace

std::string to_string(RejectionReason reason) {
  switch (reason) {
    case RejectionReason::open_close_not_settled:
      return "open-close iteration did not settle";
    case RejectionReason::not_positive_definite:
      return "system not positive definite";
    case RejectionReason::passing:
      return "blocks would have passed through each other";
    case RejectionReason::no_shape:
      return "an incremental block would have turned inside out";
    case RejectionReason::not_finite:
      return "a block's state would not have been finite";
    case RejectionReason::inside_out:
      return "a block would have turned inside out";
    case RejectionReason::too_deep:
      return "blocks would have been deeper in each other than is allowed";
  }
  return "unknown";
}

Vector3 force_on_a(const PairRecord& record) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < record.points.size(); ++k) {
    const ContactPoint& point = record.points[k];
    const Eigen::Vector3d& force = record.responses[k].force;
    sum += force[0] * point.normal + force[1] * point.tangent_1 + force[2] * point.tangent_2;
  }
  return sum;
}

Simulation::Simulation(std::vector<BlockModel> blocks, std::vector<InitialMotion> motions, LawOfPair law,
                       const SimulationSettings& settings)
    : blocks_(std::move(blocks)),
      law_(std::move(law)),
      settings_(settings),
      finder_(blocks_, settings),
      next_step_(settings.time_step),
      audit_(blocks_.size()) {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockModel& block = blocks_[k];
    states_.push_back(block.initial_state());
    moving_.push_back(!block.fixed());
    spin_debts_.push_back(0.0);
    roundoff_force_.push_back(block.fixed() ? 0.0 : block.force_rounding());
    if (block.fixed()) continue;
    states_.back().velocity = block.rigid_velocity(motions[k].velocity, motions[k].angular_velocity);
  }
  for (std::size_t k = 0; k < blocks_.size(); ++k) note_gradients(k);
  free_bodies_ = free_bodies(blocks_, {});
  // The surface of an incremental block is its sub-faces.
  if (any_incremental()) settings_.curved_surface = false;
  note_elastic_energies();
  measure_energies(ledger_);
  start_balance_ = ledger_.balance();
}

bool Simulation::tie_blocks(int a, int b, double stiffness) {
  for (const int block : {a, b}) {
    if (blocks_[at(block)].incremental() != nullptr)
      throw std::invalid_argument("blocks of the incremental formulation cannot be tied");
  }
  finder_.leave_out(a, b);
  const BlockModel& block_a = blocks_[at(a)];
  const BlockModel& block_b = blocks_[at(b)];
  Tie tie = tie_between(block_a.solid(), block_a.basis(), block_b.solid(), block_b.basis());
  if (tie.area == 0.0) return false;
  ties_.push_back({a, b, std::move(tie), stiffness});
  std::vector<std::array<int, 2>> tied;
  for (const TiedBlocks& blocks : ties_) tied.push_back({blocks.a, blocks.b});
  free_bodies_ = free_bodies(blocks_, tied);
  return true;
}

bool Simulation::is_tied(std::size_t block) const {
  const int index = static_cast<int>(block);
  return std::any_of(ties_.begin(), ties_.end(),
                     [&](const TiedBlocks& tie) { return tie.a == index || tie.b == index; });
}

std::vector<int> Simulation::settle_supported_blocks() {
  std::vector<int> settled;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k] || !blocks_[k].supported() || is_tied(k)) continue;
    auto position = blocks_[k].equilibrium(settings_.gravity, 0.0);
    if (!position) continue;
    settled.push_back(static_cast<int>(k));
    if (blocks_[k].incremental() == nullptr) {
      states_[k].position = std::move(*position);
      continue;
    }
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < settings_.settling_steps; ++step) {
      const double way = (*position - states_[k].position).norm();
      start_carried_step(k, blocks_[k].carried_on(*position));
      // Rounding is all that is left when steps no longer shrink.
      if (!(way < last)) break;
      last = way;
      position = blocks_[k].equilibrium(settings_.gravity, 0.0);
    }
  }
  note_elastic_energies();
  measure_energies(ledger_);
  start_balance_ = ledger_.balance();
  return settled;
}

double Simulation::time_rounding(double end_time) const {
  constexpr double ulps = 4.0;
  return std::max(step_rounding * settings_.time_step,
                  ulps * std::numeric_limits<double>::epsilon() * std::abs(end_time));
}

bool Simulation::reached(double end_time) const {
  return end_time - time() <= time_rounding(end_time);
}

StepStatus Simulation::step(double end_time) {
  double step = next_step_;
  const double left = end_time - time();
  if (left < step - time_rounding(end_time)) step = left;
  if (settings_.integrator == Integrator::generalized_alpha && accelerations_.empty())
    accelerations_ = smooth_accelerations();
  std::vector<FoundContacts> found = find_contacts(step);
  Trial trial;
  int moves = 0;
  std::optional<SimulationSnapshot> unmoved;
  const auto pair_up = [&] {
    trial.results.clear();
    trial.pairs = make_pairs(found, true);
    while (moves < settings_.moves_apart && too_deep(trial.pairs)) {
      if (!unmoved) unmoved = snapshot();
      if (!move_apart(step, trial.pairs, found, settings_.moves_apart)) break;
      ++moves;
      found = find_contacts(step);
      trial.pairs = make_pairs(found, true);
    }
  };
  pair_up();
  int cuts = 0;
  int additions = 0;
  bool unsettled = false;
  while (cuts <= settings_.max_step_cuts && additions <= settings_.max_step_cuts) {
    const TimeScheme scheme = time_scheme(settings_, step);
    const IslandStatus status = try_step(scheme, trial);
    if (status != IslandStatus::settled) {
      reject_unsettled(step, status, trial);
      unsettled = true;
      step *= 0.5;
      ++cuts;
      continue;
    }
    if (const auto broken = broken_block(trial)) {
      reject(step, *broken);
      step *= 0.5;
      ++cuts;
      continue;
    }
    const std::vector<PassingBlocks> passing = check_motion(trial, found);
    if (passing.empty() && !carry_blocks(trial)) {
      rejections_.push_back({time(), step, RejectionReason::no_shape});
      step *= 0.5;
      ++cuts;
      continue;
    }
    if (passing.empty()) {
      if (const auto deep = audit_depths(trial, (steps_ + 1) % settings_.fine_audit_interval == 0)) {
        reject(step, *deep);
        step *= 0.5;
        ++cuts;
        continue;
      }
      accept(scheme, trial);
      next_step_ = std::min(settings_.time_step, unsettled ? step : 2.0 * next_step_);
      return StepStatus::accepted;
    }
    const double first = passing.front().touch.share;
    if (first > settings_.smallest_cut && cuts < settings_.max_step_cuts) {
      rejections_.push_back({time(), step, RejectionReason::passing});
      step *= first;
      ++cuts;
      continue;
    }
    ++additions;
    add_contacts(passing, found);
    counts_.passing_contacts += passing.size();
    pair_up();
  }
  if (moves > 0) {
    unmoved->rejections = rejections_;
    unmoved->counts = counts();
    unmoved->seconds = seconds_;
    restore(*unmoved);
  }
  return StepStatus::too_many_cuts;
}

void Simulation::add_contacts(const std::vector<PassingBlocks>& passing, std::vector<FoundContacts>& found) {
  for (const PassingBlocks& blocks : passing) {
    auto place = std::lower_bound(
        found.begin(), found.end(), blocks.blocks,
        [](const FoundContacts& contacts, const std::array<int, 2>& pair) { return contacts.blocks < pair; });
    if (place == found.end() || place->blocks != blocks.blocks)
      place = found.insert(place, FoundContacts{blocks.blocks, {}});
    if (const auto* vertex = std::get_if<VertexContact>(&blocks.touch.contact)) {
      place->contacts.vertices.push_back(*vertex);
    } else {
      place->contacts.edges.push_back(std::get<EdgeContact>(blocks.touch.contact));
    }
  }
}

IslandStatus Simulation::try_step(const TimeScheme& scheme, Trial& trial) {
  const Stopwatch watch(seconds_.solve);
  const auto swap_followed = [&](IslandResult& result) {
    for (auto& [index, pair] : result.followed) std::swap(trial.pairs[at(index)], pair);
  };
  // Of the last try.
  for (IslandResult& result : trial.results) swap_followed(result);
  trial.results.clear();
  trial.islands = find_islands(moving_, trial.pairs);
  trial.bodies = prepare_bodies(scheme);
  for (ContactPair& pair : trial.pairs) {
    pair.prescribe(blocks_[at(pair.a())], trial.bodies[at(pair.a())].prescribed, blocks_[at(pair.b())],
                   trial.bodies[at(pair.b())].prescribed);
    if (settings_.augmented && !scheme.from_rest && !pair.tied()) pair.rub_impulses(scheme.step);
  }
  for (const Island& island : trial.islands) {
    std::optional<IslandResult> lone;
    if (island.bodies.size() == 1 && island.pairs.empty())
      lone = solve_lone_body(trial.bodies[at(island.bodies[0])], scheme, settings_, lone_factors_);
    trial.results.push_back(
        lone ? std::move(*lone)
             : solve_island(island, trial.bodies, trial.pairs, scheme, settings_, solvers_));
    swap_followed(trial.results.back());
    counts_.open_close_iterations += static_cast<std::uint64_t>(trial.results.back().iterations);
    counts_.open_close_fallbacks += static_cast<std::uint64_t>(trial.results.back().fallbacks);
    if (trial.results.back().status != IslandStatus::settled) return trial.results.back().status;
  }
  return IslandStatus::settled;
}

ContactBody Simulation::body_at_start(int block) const {
  return {&blocks_[at(block)], &states_[at(block)], &finder_.placed(block)};
}

std::vector<FoundContacts> Simulation::find_contacts(double step) {
  const Stopwatch watch(seconds_.contact_search);
  const std::vector<BlockState> driven = driven_states(step);
  const ExpectedMotion motion = driven.empty() ? finder_.expected_motion(states_, step)
                                               : finder_.expected_motion(driven, step > 0.0 ? step : 1.0);
  std::vector<FoundContacts> found = finder_.find(states_, motion, [&](int a, int b) {
    const auto known = memory_.find({a, b});
    const double of_contacts = known == memory_.end() ? 0.0 : known->second.deepest() + known->second.bulge();
    // What contacts did not know of is looked for as deep as it is.
    const auto audited = true_depths_.find({a, b});
    return audited == true_depths_.end() ? of_contacts : std::max(of_contacts, audited->second);
  });
  ways_out_ = WaysOut(memory_);
  for (const auto& [blocks, contacts] : found) {
    const auto known = memory_.find(blocks);
    if (known == memory_.end() || !(known->second.deepest() > 0.0))
      ways_out_.add_touching(blocks, finder_.placed(blocks[0]), finder_.placed(blocks[1]), contacts);
  }
  const auto stands = standing_ways(found);
  for (auto& [pair, contacts] : found)
    leave_out_seams(finder_.placed(pair[0]), finder_.placed(pair[1]), ways_out(pair[0], pair[1]), stands,
                    contacts);
  return found;
}

GivenWay Simulation::blocks_given_way() const {
  return [this](int block, const Vector3& direction) { return given_way(block, direction); };
}

std::vector<WayOut> Simulation::ways_out(int a, int b) const {
  return ways_out_.of_pair(a, b, blocks_given_way());
}

double Simulation::given_way(int block, const Vector3& direction) const {
  const BlockModel& model = blocks_[at(block)];
  if (!moving_[at(block)] || model.incremental() != nullptr) return 0.0;
  const Eigen::Matrix3d gradient = states_[at(block)].position.transpose() * model.parts()->mean_gradients;
  // F maps lines along F^-1 n to lines along n and stretches them by 1/|F^-1 n|.
  const Vector3 undeformed = gradient.inverse() * direction;
  const double stretch = 1.0 / undeformed.norm();
  const Vector3 along = stretch * undeformed;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vector3& point : model.solid().mesh().points) {
    low = std::min(low, along.dot(point));
    high = std::max(high, along.dot(point));
  }
  return std::abs(stretch - 1.0) * (high - low);
}

std::function<bool(const WayOut&)> Simulation::standing_ways(const std::vector<FoundContacts>& found) const {
  return [this, &found](const WayOut& way) {
    const auto placed = [this](int block) -> const PlacedSurface& { return finder_.placed(block); };
    return ways_out_.stands(way, found, placed, blocks_given_way());
  };
}

std::vector<ContactPair> Simulation::make_pairs(const std::vector<FoundContacts>& found, bool hold_energy) {
  const Stopwatch watch(seconds_.contact_points);
  std::vector<ContactPair> pairs;
  const CoveredFaces covered(
      found, [this](int block) -> const PlacedSurface& { return finder_.placed(block); },
      settings_.contact_distance);
  for (const auto& [blocks, contacts] : found) {
    const int a = blocks[0];
    const int b = blocks[1];
    const ContactBody body_a = body_at_start(a);
    const ContactBody body_b = body_at_start(b);
    const ContactMemory& known = memory_[blocks];
    JointLaw law = law_(a, b);
    law.augmented = settings_.augmented && !law.gives_way;
    const ContactPointSettings point_settings{settings_.area_springs, settings_.curved_surface,
                                              law.augmented};
    const std::vector<bool> masters =
        first_is_master(body_a, body_b, contacts.overlaps, [&](const RimPlace& rim) {
          return rim.of_a ? covered.goes_on(b, a, rim) : covered.goes_on(a, b, rim);
        });
    auto [points, cuts] = contact_points(body_a, body_b, contacts, masters, point_settings, known.cuts());
    counts_.contact_points += points.size();
    // Faces that share no area to the last bit are found, but have no points.
    if (points.empty()) continue;
    auto memory = known.recall(
        points, has_begun() ? -std::numeric_limits<double>::infinity() : settings_.contact_distance,
        !hold_energy && settings_.area_springs);
    law.rounding = coordinate_rounding(*body_a.placed, *body_b.placed);
    std::vector<Vector3> moved;
    if (!hold_energy && !static_.level_start.empty()) {
      moved = moved_in_level(a, b, points);
      // Blocks that have gone far are on a way of their own, not on that of an iteration to balance.
      const auto is_far = [&](int block) {
        const BlockModel& model = blocks_[at(block)];
        const Eigen::MatrixX3d way = states_[at(block)].position - static_.level_start[at(block)];
        return moving_[at(block)] && mean_motion(model, way) > settings_.static_motion * block_size(model);
      };
      if (is_far(a) || is_far(b)) take_slip(points, moved, memory);
    }
    pairs.emplace_back(a, b, body_a, body_b, law, points, std::move(memory), std::move(cuts));
    if (hold_energy && has_begun() && law.augmented) pairs.back().hold_where_found(taken_[blocks]);
    if (!moved.empty()) pairs.back().count_slip(moved);
    if (!hold_energy && static_.holds_bonds) pairs.back().hold_bonds();
  }
  if (hold_energy && has_begun()) {
    const std::vector<SpringEnergy> bounds = energy_bounds(pairs, memory_, moving_);
    for (std::size_t k = 0; k < pairs.size(); ++k) pairs[k].hold_at_most(bounds[k]);
  }
  for (const TiedBlocks& tied : ties_) {
    pairs.emplace_back(tied.a, tied.b, ContactBody{&blocks_[at(tied.a)], &states_[at(tied.a)], nullptr},
                       ContactBody{&blocks_[at(tied.b)], &states_[at(tied.b)], nullptr}, tied.tie,
                       tied.stiffness);
  }
  return pairs;
}

std::vector<PassingBlocks> Simulation::check_motion(const Trial& trial,
                                                    const std::vector<FoundContacts>& found) {
  const Stopwatch watch(seconds_.motion_check);
  const std::vector<BlockState> after = states_after(trial);
  std::vector<PassingBlocks> passing = finder_.check_motion(states_, after, found);
  const auto stands = standing_ways(found);
  std::erase_if(passing, [&](const PassingBlocks& pair) {
    const auto& [a, b] = pair.blocks;
    return at_seam(finder_.placed(a), finder_.placed(b), ways_out(a, b), stands, pair.touch);
  });
  return passing;
}

std::vector<BodyStep> Simulation::prepare_bodies(const TimeScheme& scheme) const {
  std::vector<BodyStep> bodies(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockModel& block = blocks_[k];
    BodyStep& body = bodies[k];
    body.model = &block;
    body.state = &states_[k];
    body.roundoff_force = roundoff_force_[k];
    if (block.fixed()) continue;
    body.change = Eigen::VectorXd::Zero(block.unknowns());
    const Eigen::MatrixX3d still = Eigen::MatrixX3d::Zero(block.basis().size(), 3);
    body.free_change = block.space().restrict(
        scheme.free_change(still, states_[k].velocity, accelerations_.empty() ? still : accelerations_[k]));
    body.external_force = block.space().restrict(external_force(block, scheme));
    body.prescribed = block.prescribed_change(states_[k].position, time(), clock_.time_after(scheme.step));
  }
  return bodies;
}

Eigen::MatrixX3d Simulation::external_force(const BlockModel& block, const TimeScheme& scheme) const {
  Eigen::MatrixX3d end = block.external_force(settings_.gravity, clock_.time_after(scheme.step));
  if (scheme.end_share >= 1.0) return end;
  return scheme.end_share * end + (1.0 - scheme.end_share) * block.external_force(settings_.gravity, time());
}

std::vector<BlockState> Simulation::driven_states(double step) const {
  std::vector<BlockState> states;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockModel& block = blocks_[k];
    const Eigen::MatrixX3d prescribed =
        block.prescribed_change(states_[k].position, time(), clock_.time_after(step));
    if (prescribed.size() == 0 || prescribed.isZero(0.0)) continue;
    if (states.empty()) states = states_;
    states[k].velocity = block.space().expand(block.space().restrict(states_[k].velocity)) +
                         prescribed / (step > 0.0 ? step : 1.0);
  }
  return states;
}

std::vector<Eigen::MatrixX3d> Simulation::smooth_accelerations() const {
  std::vector<Eigen::MatrixX3d> result;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockModel& block = blocks_[k];
    result.emplace_back(Eigen::MatrixX3d::Zero(block.basis().size(), 3));
    if (!moving_[k]) continue;
    const Eigen::MatrixX3d force =
        block.external_force(settings_.gravity, time()) - block.elastic(states_[k].position).force;
    result.back() = block.space().expand(block.space().restrict(force)) / block.material().density -
                    settings_.mass_damping * states_[k].velocity;
  }
  return result;
}

Vector3 Simulation::momentum() const {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (moving_[k]) sum += blocks_[k].momentum(states_[k]);
  }
  return sum;
}

Vector3 Simulation::angular_momentum() const {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (moving_[k]) sum += blocks_[k].angular_momentum(states_[k]);
  }
  return sum;
}

int Simulation::unknowns() const {
  int sum = 0;
  for (const BlockModel& block : blocks_) sum += block.unknowns();
  return sum;
}

SimulationCounts Simulation::counts() const {
  SimulationCounts result = counts_;
  result.finder = finder_.counts();
  result.factors += solvers_.counts();
  result.factors += lone_factors_.counts();
  return result;
}

}  // namespace ashlar
