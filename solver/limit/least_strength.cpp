#include "solver/limit/least_strength.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "geometry/index.hpp"
#include "solver/limit/crushing_joints.hpp"
#include "solver/limit/released_motion.hpp"

namespace ashlar {
namespace {

/// Relative width of the bracket of a strength.
constexpr double strength_width = 0.02;
constexpr int most_divisions = 25, most_strength_trials = 40;
/// Motion relative to that by the loads alone that counts as rest.
constexpr double strength_rest = 1e-5;
/// Range of the search, in mean pressures of joints, and its ratio while it has one end.
constexpr double least_pressure = 1e-3, most_pressure = 1e5, strength_stride = 20.0;

/// Trials of strengths of all joints.
class StrengthTrials {
 public:
  StrengthTrials(const RigidModel& model, const std::vector<bool>& reduced, const LimitFactors& factors,
                 int threads)
      : model_(model), factors_(factors), threads_(threads), load_(model.steady) {
    for (std::size_t k = 0; k < model.points.size(); ++k)
      if (reduced[k]) reduced_.insert(key_of(model.points[k].blocks));
    for (std::size_t b = 0; b < load_.size(); ++b) load_[b] += factors.load * model_.multiplied[b];
    set_unit();
  }

  /// Pa, mean pressure of joints; 0: there are none
  [[nodiscard]] double unit() const { return unit_; }
  /// Where the last trial that moved crushed most.
  [[nodiscard]] BlockPair joint() const { return joint_; }
  /// Of the last trial that moved: strength with which its motion would be in balance; 0: none.
  [[nodiscard]] double estimate() const { return estimate_; }

  /// @param strength in units. @return true if forces at centroids of parts balance the loads
  bool stand(double strength) {
    return stand(FrictionAt::uniform_pressure, strength) && stand(FrictionAt::corners, strength);
  }

 private:
  void set_unit() {
    double area = 0.0;
    std::set<PairKey> joints;
    for (const auto* list : {&model_.areas, &model_.points}) {
      for (const RigidPoint& point : *list) {
        if (!point.part) continue;
        area += point.area;
        joints.insert(key_of(point.blocks));
      }
    }
    if (joints.empty()) return;
    unit_ = model_.units.force() * static_cast<double>(joints.size()) / area;
    for (auto* list : {&model_.areas, &model_.points})
      for (RigidPoint& point : *list)
        if (!point.bar) point.law.compressive_strength = unit_;
    divide_joints(model_, [](const RigidPoint&) { return true; });
  }

  [[nodiscard]] ConeProgram program_with(const RigidModel& model, FrictionAt friction,
                                         double strength) const {
    ConeProgram program = program_of(model, threads_, friction);
    for (std::size_t k = 0; k < model.points.size(); ++k) {
      const RigidPoint& point = model.points[k];
      const bool reduced = !point.bar && reduced_.contains(key_of(point.blocks));
      ConeStrength own = strength_of(model, point, reduced ? factors_.strength : 1.0);
      if (!point.bar) own.compression *= strength;
      program.set_strength(k, own);
    }
    return program;
  }

  [[nodiscard]] bool moves(const ConeAnswer& found) const {
    return !(found.residual < strength_rest) ||
           largest_motion(found.velocity, load_, loaded_bodies(model_)) > strength_rest;
  }

  bool stand(FrictionAt friction, double strength) {
    ConeQuestion asked;
    asked.load = load_;
    for (int n = 0; n < most_divisions; ++n) {
      ConeProgram program = program_with(model_, friction, strength);
      const ConeAnswer found = program.solve(asked);
      if (!moves(found)) return true;
      note(program, found, strength);
      const CornerModel corners = corner_model(model_);
      ConeProgram at_corners = program_with(corners.model, friction, strength);
      if (moves(at_corners.solve(asked))) return false;
      if (refine_parts(model_, strengths_of(program), corner_velocities(corners, at_corners, found.velocity))
              .empty())
        return false;
    }
    return false;
  }

  /// Notes the joint that dissipates most by crushing, and the strength for the power of the loads.
  void note(const ConeProgram& program, const ConeAnswer& found, double strength) {
    std::map<PairKey, double> dissipated;
    double all = 0.0, square = 0.0;
    for (std::size_t k = 0; k < model_.points.size(); ++k) {
      if (!model_.points[k].part) continue;
      const double power = found.opening[k][2] * program.points()[k].strength.compression;
      dissipated[key_of(model_.points[k].blocks)] += power;
      all += power;
    }
    for (const BodyVelocity& velocity : found.velocity) square += velocity.squaredNorm();
    estimate_ = all > 0.0 ? strength * (1.0 + square / all) : 0.0;
    double most = 0.0;
    for (const auto& [joint, power] : dissipated) {
      if (power <= most) continue;
      most = power;
      joint_ = joint;
    }
  }

  RigidModel model_;
  LimitFactors factors_;
  int threads_;
  std::vector<BodyVelocity> load_;
  std::set<PairKey> reduced_;
  double unit_ = 0.0, estimate_ = 0.0;
  BlockPair joint_ = {-1, -1};
};

}  // namespace

std::optional<LeastStrength> least_strength(const RigidModel& model, const std::vector<bool>& reduced,
                                            const LimitFactors& factors, int threads) {
  StrengthTrials trials(model, reduced, factors, threads);
  if (!(trials.unit() > 0.0)) return std::nullopt;
  double low = 0.0, high = 0.0, next = 1.0;
  for (int n = 0; n < most_strength_trials; ++n) {
    (trials.stand(next) ? high : low) = next;
    if (high > 0.0 && (high <= least_pressure || (low > 0.0 && high <= low * (1.0 + strength_width)))) break;
    if (high == 0.0 && low >= most_pressure) return std::nullopt;
    if (low == 0.0) {
      next = high / strength_stride;
      continue;
    }
    // The mechanism of a weaker joint bounds the strength from below.
    const double above = trials.estimate() * (1.0 + 0.5 * strength_width);
    const double middle = high > 0.0 ? std::sqrt(low * high) : low * strength_stride;
    const bool helps = above > low && (high == 0.0 || above < high / (1.0 + 0.25 * strength_width));
    next = helps && n % 3 != 2 ? std::min(above, low * strength_stride) : middle;
  }
  if (high == 0.0) return std::nullopt;
  // Nothing is pressed: no strength was too small.
  if (trials.joint()[0] < 0) return LeastStrength{};
  return LeastStrength{high * trials.unit(), trials.joint()};
}

}  // namespace ashlar
