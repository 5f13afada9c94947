#include "solver/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

/// Rounding of times that are sums of steps, in parts of a step: a remainder of this length is none.
constexpr double step_rounding = 1e-9;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Adds the time since its construction to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_;
};

/// How far any surface point of a block can move in a step under its velocity and gravity.
double motion_bound(const Eigen::MatrixXd& phi, const BlockState& state, const Vector3& gravity,
                    double step) {
  const double speed = std::sqrt((phi * state.velocity).rowwise().squaredNorm().maxCoeff());
  return step * speed + 0.5 * step * step * gravity.norm();
}

/// phi at the middle of every cell side less the mean of phi at its ends: times q, how far the curved surface
/// is off the flat cells there.
Eigen::MatrixXd chord_rows(const PolynomialBasis& basis, const SubFaceSurface& surface) {
  if (!surface.divided) return {};
  std::vector<Vector3> middles;
  std::vector<Vector3> starts;
  std::vector<Vector3> ends;
  for (const SurfaceCell& cell : surface.cells) {
    for (std::size_t k = 0; k < cell.corners.size(); ++k) {
      starts.push_back(surface.points[at(cell.corners[k])]);
      ends.push_back(surface.points[at(cell.corners[(k + 1) % cell.corners.size()])]);
      middles.emplace_back(0.5 * (starts.back() + ends.back()));
    }
  }
  return basis.values(middles) - 0.5 * (basis.values(starts) + basis.values(ends));
}

/// How far the flat cells may be off the curved surface: inside a cell the error of a quadratic is at most
/// 4/3 of the largest one at its sides' middles; twice that leaves room for higher orders.
double chord_error(const Eigen::MatrixXd& rows, const BlockState& state) {
  if (rows.size() == 0) return 0.0;
  return 8.0 / 3.0 * std::sqrt((rows * state.position).rowwise().squaredNorm().maxCoeff());
}

/// Size of the rounding errors in the internal force K (R' q - q0) of a block at rest.
double roundoff_of(const BlockModel& block) {
  const Eigen::Index p = block.basis().size();
  const Eigen::MatrixXd tangent = block.tangent(Eigen::Matrix3d::Identity());
  // The mean position drops out of K exactly, so only the linear coefficients carry rounding errors.
  Eigen::MatrixX3d size = block.basis().identity_map().cwiseAbs();
  size.row(0).setZero();
  if (p == 0) return 0.0;
  const Eigen::VectorXd reduced = block.space().restrict(size);
  return 4.0 * std::numeric_limits<double>::epsilon() * (tangent.cwiseAbs() * reduced.cwiseAbs()).norm();
}

}  // namespace

std::string to_string(RejectionReason reason) {
  switch (reason) {
    case RejectionReason::open_close_not_settled:
      return "open-close iteration did not settle";
    case RejectionReason::not_positive_definite:
      return "system not positive definite";
  }
  return "unknown";
}

Simulation::Simulation(std::vector<BlockModel> blocks, std::vector<InitialMotion> motions, LawOfPair law,
                       SimulationSettings settings)
    : blocks_(std::move(blocks)), law_(std::move(law)), settings_(settings), next_step_(settings.time_step) {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockModel& block = blocks_[k];
    states_.push_back(block.initial_state());
    moving_.push_back(!block.fixed());
    surfaces_.push_back(
        divide_surface(block.solid(), block.order() >= 2 && !block.fixed() ? settings.subdivisions : 0));
    surface_phi_.push_back(block.basis().values(surfaces_.back().points));
    chord_phi_.push_back(chord_rows(block.basis(), surfaces_.back()));
    roundoff_force_.push_back(block.fixed() ? 0.0 : roundoff_of(block));
    if (block.fixed()) continue;
    states_.back().velocity = block.rigid_velocity(motions[k].velocity, motions[k].angular_velocity);
  }
  measure_energies(ledger_);
  start_balance_ = ledger_.balance();
}

void Simulation::settle_supported_blocks() {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k] || !blocks_[k].supported()) continue;
    if (auto position = blocks_[k].equilibrium(settings_.gravity, 0.0)) {
      states_[k].position = std::move(*position);
    }
  }
  measure_energies(ledger_);
  start_balance_ = ledger_.balance();
}

bool Simulation::reached(double end_time) const {
  return end_time - time_ <= step_rounding * settings_.time_step;
}

StepStatus Simulation::step(double end_time) {
  double step = next_step_;
  const double left = end_time - time_;
  if (left < step * (1.0 - step_rounding)) step = left;
  const std::vector<ContactPair> pairs = find_contact_pairs(step);
  const std::vector<Island> islands = find_islands(moving_, pairs);
  for (int cut = 0; cut <= settings_.max_step_cuts; ++cut, step *= 0.5) {
    Stopwatch watch(seconds_.solve);
    std::vector<BodyStep> bodies = prepare_bodies(step);
    std::vector<IslandResult> results;
    IslandStatus worst = IslandStatus::settled;
    for (const Island& island : islands) {
      results.push_back(solve_island(island, bodies, pairs, step, settings_, solvers_));
      counts_.open_close_iterations += static_cast<std::uint64_t>(results.back().iterations);
      worst = results.back().status;
      if (worst != IslandStatus::settled) break;
    }
    if (worst == IslandStatus::settled) {
      solvers_.drop_unused();
      accept(step, bodies, pairs, islands, results);
      next_step_ = std::min(settings_.time_step, cut == 0 ? 2.0 * next_step_ : step);
      return StepStatus::accepted;
    }
    rejections_.push_back({time_, step,
                           worst == IslandStatus::not_settled ? RejectionReason::open_close_not_settled
                                                              : RejectionReason::not_positive_definite});
  }
  return StepStatus::too_many_cuts;
}

std::vector<ContactPair> Simulation::find_contact_pairs(double step) {
  std::vector<PlacedSurface> placed;
  std::vector<double> motion;
  std::vector<double> chord;
  std::vector<Box> boxes;
  std::vector<std::array<int, 2>> candidates;
  std::vector<PairContacts> found;
  {
    Stopwatch watch(seconds_.contact_search);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      placed.emplace_back(surfaces_[k], placed_points(surface_phi_[k], states_[k]));
      motion.push_back(moving_[k] ? motion_bound(surface_phi_[k], states_[k], settings_.gravity, step) : 0.0);
      chord.push_back(chord_error(chord_phi_[k], states_[k]));
      const Vector3 margin = Vector3::Constant(motion.back() + chord.back() + settings_.contact_distance);
      boxes.push_back({placed.back().box().low - margin, placed.back().box().high + margin});
    }
    for (const auto& pair : meeting_boxes(boxes)) {
      if (moving_[at(pair[0])] || moving_[at(pair[1])]) candidates.push_back(pair);
    }
    counts_.block_pairs_tested += candidates.size();
    counts_.block_pairs_skipped += blocks_.size() * (blocks_.size() - 1) / 2 - candidates.size();
    found.resize(candidates.size());
    const auto search = [&](std::size_t k) {
      const auto& [a, b] = candidates[k];
      const auto known = memory_.find(candidates[k]);
      ContactLimits limits;
      const double resolution = settings_.contact_distance + chord[at(a)] + chord[at(b)];
      limits.reach = resolution + motion[at(a)] + motion[at(b)];
      limits.penetration = resolution + (known == memory_.end() ? 0.0 : 2.0 * known->second.deepest());
      limits.angle = settings_.contact_angle;
      found[k] = find_contacts(placed[at(a)], placed[at(b)], limits);
    };
    parallel_for(settings_.threads, candidates.size(), search);
  }
  Stopwatch watch(seconds_.contact_points);
  std::vector<ContactPair> pairs;
  const ContactPointSettings point_settings{settings_.area_springs, settings_.curved_surface};
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    counts_.predicates += found[k].counts;
    if (found[k].empty()) continue;
    const auto& [a, b] = candidates[k];
    const ContactBody body_a{&blocks_[at(a)], &states_[at(a)], &placed[at(a)]};
    const ContactBody body_b{&blocks_[at(b)], &states_[at(b)], &placed[at(b)]};
    auto points = contact_points(body_a, body_b, found[k], point_settings);
    counts_.contact_points += points.size();
    auto memory = memory_[candidates[k]].recall(
        points, steps_ == 0 ? settings_.contact_distance : -std::numeric_limits<double>::infinity());
    pairs.emplace_back(a, b, blocks_[at(a)], blocks_[at(b)], law_(a, b), std::move(points),
                       std::move(memory));
  }
  return pairs;
}

std::vector<BodyStep> Simulation::prepare_bodies(double step) const {
  std::vector<BodyStep> bodies(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockModel& block = blocks_[k];
    BodyStep& body = bodies[k];
    body.model = &block;
    body.state = &states_[k];
    body.roundoff_force = roundoff_force_[k];
    if (block.fixed()) continue;
    body.velocity = block.space().restrict(states_[k].velocity);
    Eigen::MatrixX3d force = block.external_force(settings_.gravity, time_ + step);
    if (settings_.integrator == Integrator::average_acceleration) {
      force = 0.5 * (force + block.external_force(settings_.gravity, time_));
    }
    body.external_force = block.space().restrict(force);
  }
  return bodies;
}

void Simulation::accept(double step, std::vector<BodyStep>& bodies, const std::vector<ContactPair>& pairs,
                        const std::vector<Island>& islands, const std::vector<IslandResult>& results) {
  const double last_residual = ledger_.residual;
  const bool averaged = settings_.integrator == Integrator::average_acceleration;
  double potential_work = 0.0;
  double potential_change = 0.0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k]) continue;
    const BlockModel& block = blocks_[k];
    BlockState& state = states_[k];
    const Eigen::MatrixX3d change = block.space().expand(bodies[k].change);
    potential_work -= change.cwiseProduct(bodies[k].elastic.force).sum();
    potential_change -= block.elastic(state.position).energy;
    Eigen::MatrixX3d load = block.load_force(time_ + step);
    if (averaged) load = 0.5 * (load + block.load_force(time_));
    ledger_.applied += change.cwiseProduct(load).sum();
    state.position += change;
    state.velocity = (2.0 / step) * change - state.velocity;
    potential_change += block.elastic(state.position).energy;
  }

  report_ = StepReport{};
  report_.step = step;
  records_.clear();
  ledger_.contact = 0.0;
  double friction = 0.0;
  std::map<PairKey, ContactMemory> memory;
  for (std::size_t i = 0; i < islands.size(); ++i) {
    report_.iterations = std::max(report_.iterations, results[i].iterations);
    for (std::size_t n = 0; n < islands[i].pairs.size(); ++n) {
      const ContactPair& pair = pairs[at(islands[i].pairs[n])];
      const PairResponse& after = results[i].responses[n];
      const Eigen::VectorXd& ya = bodies[at(pair.a())].change;
      const Eigen::VectorXd& yb = bodies[at(pair.b())].change;
      const double work =
          (ya.size() > 0 ? ya.dot(after.force_on_a) : 0.0) + (yb.size() > 0 ? yb.dot(after.force_on_b) : 0.0);
      potential_work += work;
      potential_change += ContactPair::energy(after) - pair.start_energy();
      ledger_.contact += ContactPair::energy(after);
      friction += pair.friction_work(after, ya, yb);
      auto gaps = pair.gaps(ya, yb);
      double deepest = 0.0;
      for (std::size_t k = 0; k < gaps.size(); ++k) {
        if (after.points[k].state == ContactState::open) {
          ++report_.open;
          continue;
        }
        ++(after.points[k].state == ContactState::locked ? report_.locked : report_.sliding);
        deepest = std::max(deepest, -gaps[k]);
      }
      report_.penetration = std::max(report_.penetration, deepest);
      memory[{pair.a(), pair.b()}].store(pair.points(), pair.memory_after(after, ya, yb), deepest);
      records_.push_back({pair.a(), pair.b(), pair.points(), after.points, std::move(gaps),
                          contact_work_[{pair.a(), pair.b()}] += work});
    }
  }
  memory_ = std::move(memory);
  ledger_.friction += friction;
  ledger_.numerical -= potential_work + potential_change + friction;

  time_ += step;
  ++steps_;
  measure_energies(ledger_);
  ledger_.residual = ledger_.balance() - start_balance_;
  largest_step_residual_ = std::max(largest_step_residual_, std::abs(ledger_.residual - last_residual));
  largest_energy_ = std::max({largest_energy_, ledger_.kinetic, ledger_.elastic, ledger_.contact,
                              std::abs(ledger_.friction), std::abs(ledger_.applied)});
  largest_penetration_ = std::max(largest_penetration_, report_.penetration);
}

void Simulation::measure_energies(Ledger& ledger) const {
  ledger.kinetic = ledger.elastic = ledger.gravity = 0.0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k]) continue;
    ledger.kinetic += blocks_[k].kinetic_energy(states_[k]);
    ledger.elastic += blocks_[k].elastic(states_[k].position).energy;
    ledger.gravity += blocks_[k].gravity_energy(states_[k], settings_.gravity);
  }
}

std::vector<Vector3> Simulation::surface_points(int block) const {
  return placed_points(surface_phi_[at(block)], states_[at(block)]);
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
  result.factors += solvers_.counts();
  return result;
}

}  // namespace ashlar
