#include "solver/statics/least_strength.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "geometry/index.hpp"
#include "solver/statics/crushing_joints.hpp"
#include "solver/statics/released_motion.hpp"

namespace ashlar {
namespace {

/// Relative error by the parts of joints, and change of the strength at which its iteration ends.
constexpr double enough = 0.02;
constexpr int most_divisions = 40, most_steps = 10;
/// Bounds of the load a, and great strengths, in their units.
constexpr std::array most_loads = {3.0, 50.0, 1000.0};
constexpr double most_strength = 1e6, no_load = 1e-4;
/// Load from which on strengths are not scaled again.
constexpr double least_factor = 0.2;
constexpr std::array great_strengths = {20.0, 400.0, 8000.0};
/// Residual of the balance of forces, and its part of the velocity in a programme.
constexpr double balance = 1e-4, penalty = 1e-9;

/// The programme (least).
class LeastProgram {
 public:
  LeastProgram(const RigidModel& model, const std::vector<bool>& reduced, const LimitFactors& factors,
               int threads)
      : model_(model), factors_(factors), threads_(threads) {
    for (std::size_t k = 0; k < model.points.size(); ++k)
      if (reduced[k]) reduced_.insert(key_of(model.points[k].blocks));
    set_unit();
    load_ = model_.steady;
    for (std::size_t b = 0; b < load_.size(); ++b) load_[b] += factors.load * model_.multiplied[b];
  }

  /// Pa
  [[nodiscard]] double unit() const { return unit_; }
  [[nodiscard]] BlockPair joint() const { return joint_; }
  /// True if strengths do not grow with pressure alone.
  [[nodiscard]] bool has_other_strength() const {
    return std::any_of(model_.points.begin(), model_.points.end(), [](const RigidPoint& point) {
      return point.bar || point.law.cohesion > 0.0 || point.law.tensile_strength > 0.0;
    });
  }

  /// The right side of (least). @param strength of the left side, in units. @return infinite: none is enough
  double needed(double strength) {
    double least = 0.0;
    for (const FrictionAt friction : {FrictionAt::uniform_pressure, FrictionAt::corners}) {
      const double own = needed(friction, strength, least > 0.0 ? least : 1.0);
      if (own > least) joint_ = joint_of_last_;
      least = std::max(least, own);
      if (!std::isfinite(least)) break;
    }
    return least;
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

  /// @param crushing,others factors on the compressive strength of the unit, and on all strengths but friction
  void set_strengths(const RigidModel& model, double crushing, double others, ConeProgram& program) const {
    for (std::size_t k = 0; k < model.points.size(); ++k) {
      const RigidPoint& point = model.points[k];
      const bool reduced = !point.bar && reduced_.contains(key_of(point.blocks));
      ConeStrength own = strength_of(model, point, reduced ? factors_.strength : 1.0);
      own.cohesion *= others;
      own.tension *= others;
      own.compression *= point.bar ? others : crushing;
      program.set_strength(k, own);
    }
  }

  double needed(FrictionAt friction, double strength, double scale) {
    ConeQuestion asked;
    asked.load.assign(load_.size(), BodyVelocity::Zero());
    asked.grows = load_;
    // Scaled such that a is near 1, as the residuals of balance are relative to the loads.
    for (int n = 0; n < most_divisions; ++n) {
      ConeProgram program = program_of(model_, threads_, friction);
      set_strengths(model_, scale, scale / strength, program);
      const ConeAnswer found = most_load(program, asked);
      if (!is_found(found)) {
        // Parts may be too coarse for any load.
        if (divide_for_balance(friction)) continue;
        if (scale >= most_strength) break;
        scale *= great_strengths.front();
        continue;
      }
      if (found.factor < least_factor || found.factor > 1.0 / least_factor) {
        scale /= found.factor;
        continue;
      }
      note_joint(program, found);
      const CornerModel corners = corner_model(model_);
      const ConeProgram at_corners = program_of(corners.model, threads_, friction);
      const CornerVelocities velocity = corner_velocities(corners, at_corners, found.velocity);
      const std::vector<ConeStrength> strengths = strengths_of(program);
      const bool fine = bound_difference(model_, strengths, velocity) <= enough * found.factor;
      if (fine || refine_parts(model_, strengths, velocity).empty()) return scale / found.factor;
      scale /= found.factor;
    }
    return std::numeric_limits<double>::infinity();
  }

  /// True if forces balance the load: the penalty of the programme leaves a small share of the velocity unbalanced.
  [[nodiscard]] bool is_found(const ConeAnswer& found) const {
    double velocity = 0.0, load = 0.0;
    for (std::size_t b = 0; b < load_.size(); ++b) {
      velocity = std::max(velocity, found.velocity[b].norm());
      load = std::max(load, load_[b].norm());
    }
    return found.status == ConeStatus::solved && found.residual < balance && found.factor > no_load &&
           penalty * velocity < balance * found.factor * load;
  }

  /// The answer with the first bound of the load that is far enough: programmes lose digits by a bound far above.
  ConeAnswer most_load(ConeProgram& program, ConeQuestion& asked) const {
    ConeAnswer found;
    for (const double most : most_loads) {
      asked.most = most;
      found = program.solve(asked);
      if (is_found(found) && found.factor < 0.5 * most) break;
    }
    return found;
  }

  /// Divides parts for the motion under the loads with the least of some great strengths with which the joints stand
  /// at all. @return false: they stand as they are, or nothing helps
  bool divide_for_balance(FrictionAt friction) {
    const CornerModel corners = corner_model(model_);
    for (const double strength : great_strengths) {
      ConeProgram program = program_of(model_, threads_, friction);
      const std::vector<BodyVelocity> velocity = motion(model_, strength, program);
      if (!moves(velocity)) return false;
      ConeProgram at_corners = program_of(corners.model, threads_, friction);
      if (moves(motion(corners.model, strength, at_corners))) continue;
      return !refine_parts(model_, strengths_of(program), corner_velocities(corners, at_corners, velocity))
                  .empty();
    }
    return false;
  }

  /// Motion under the loads. @param strength of joints in compression
  std::vector<BodyVelocity> motion(const RigidModel& model, double strength, ConeProgram& program) const {
    set_strengths(model, strength, 1.0, program);
    ConeQuestion asked;
    asked.load = load_;
    return program.solve(asked).velocity;
  }

  [[nodiscard]] bool moves(const std::vector<BodyVelocity>& velocity) const {
    return largest_motion(velocity, load_, loaded_bodies(model_)) > balance;
  }

  /// The joint whose strength limits the load most.
  void note_joint(const ConeProgram& program, const ConeAnswer& found) {
    std::map<PairKey, double> dissipated;
    for (std::size_t k = 0; k < model_.points.size(); ++k)
      if (model_.points[k].part)
        dissipated[key_of(model_.points[k].blocks)] +=
            found.opening[k][2] * program.points()[k].strength.compression;
    double most = -1.0;
    for (const auto& [joint, power] : dissipated) {
      if (power <= most) continue;
      most = power;
      joint_of_last_ = joint;
    }
  }

  RigidModel model_;
  LimitFactors factors_;
  int threads_;
  std::set<PairKey> reduced_;
  std::vector<BodyVelocity> load_;
  double unit_ = 0.0;
  BlockPair joint_ = {-1, -1}, joint_of_last_ = {-1, -1};
};

}  // namespace

std::optional<LeastStrength> least_strength(const RigidModel& model, const std::vector<bool>& reduced,
                                            const LimitFactors& factors, int threads) {
  LeastProgram program(model, reduced, factors, threads);
  if (!(program.unit() > 0.0)) return std::nullopt;
  const auto result = [&](double strength) -> std::optional<LeastStrength> {
    if (!std::isfinite(strength) || strength >= most_strength) return std::nullopt;
    return LeastStrength{strength * program.unit(), program.joint()};
  };
  if (!program.has_other_strength()) return result(program.needed(1.0));
  // A strength that is enough, which (least) reduces.
  double strength = 1.0, needed = program.needed(strength);
  while (needed > strength && strength < most_strength) needed = program.needed(strength *= 10.0);
  if (needed > strength) return std::nullopt;
  for (int n = 0; n < most_steps && needed < (1.0 - enough) * strength; ++n) {
    strength = needed;
    needed = program.needed(strength);
  }
  return result(needed);
}

}  // namespace ashlar
