#include "mechanics/bolt/bolt_chain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ashlar {
namespace {

using Eigen::Index;

/// Balance of a grouted bar, whose potential is piecewise quadratic: iterations end in far fewer than these, and halvings of
/// a step too.
constexpr int most_balance_iterations = 200, most_step_halvings = 40;
/// Residual over the largest force: smaller values are within rounding error, larger ones leave the bar unbalanced.
constexpr double balance_tolerance = 1e-13;
/// Slope of the potential at the end of a step, over that at its start: larger values need more iterations, smaller ones
/// more halvings.
constexpr double line_overshoot = 0.1;

/// Solves a symmetric positive definite tridiagonal system in place. @param right (n, #columns)
void solve_tridiagonal(Eigen::VectorXd diagonal, const Eigen::VectorXd& beside, Eigen::MatrixXd& right) {
  const Index n = diagonal.size();
  for (Index i = 0; i + 1 < n; ++i) {
    const double factor = beside[i] / diagonal[i];
    diagonal[i + 1] -= factor * beside[i];
    right.row(i + 1) -= factor * right.row(i);
  }
  for (Index i = n; i-- > 0;) {
    right.row(i) /= diagonal[i];
    if (i > 0) right.row(i - 1) -= beside[i - 1] * right.row(i);
  }
}

}  // namespace

/// Springs of a grouted bar at some places of its stations.
struct BoltChain::Springs {
  std::vector<SpringPoint> bar;
  std::vector<SpringPoint> bond;
  std::vector<double> idle;  ///< by station: restoring stiffness where there is no grout, N/m

  /// Residual of the stations, N: derivative of the potential. @param moved of each station since the memory, m
  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::VectorXd& moved) const {
    Eigen::VectorXd result(static_cast<Index>(bond.size()));
    for (std::size_t i = 0; i < bond.size(); ++i) {
      const auto k = static_cast<Index>(i);
      result[k] = bond[i].force + idle[i] * moved[k];
      if (i > 0) result[k] += bar[i - 1].force;
      if (i < bar.size()) result[k] -= bar[i].force;
    }
    return result;
  }
  [[nodiscard]] Eigen::VectorXd diagonal() const {
    Eigen::VectorXd result(static_cast<Index>(bond.size()));
    for (std::size_t i = 0; i < bond.size(); ++i) {
      result[static_cast<Index>(i)] = bond[i].tangent + idle[i] + (i > 0 ? bar[i - 1].tangent : 0.0) +
                                      (i < bar.size() ? bar[i].tangent : 0.0);
    }
    return result;
  }
  [[nodiscard]] Eigen::VectorXd beside() const {
    Eigen::VectorXd result(static_cast<Index>(bar.size()));
    for (std::size_t i = 0; i < bar.size(); ++i) result[static_cast<Index>(i)] = -bar[i].tangent;
    return result;
  }
  [[nodiscard]] double largest_force() const {
    double largest = 0.0;
    for (const auto* springs : {&bar, &bond})
      for (const SpringPoint& spring : *springs) largest = std::max(largest, std::abs(spring.force));
    return largest;
  }
  [[nodiscard]] bool same_sides(const Springs& other) const {
    const auto same = [](const SpringPoint& x, const SpringPoint& y) { return x.side == y.side; };
    return std::equal(bar.begin(), bar.end(), other.bar.begin(), same) &&
           std::equal(bond.begin(), bond.end(), other.bond.begin(), same);
  }
};

BoltChain::BoltChain(const BoltLaw& law, BoltShape shape, std::vector<bool> present)
    : law_(law), shape_(std::move(shape)), present_(std::move(present)) {
  const auto add_bar = [&](double length) {
    YieldingSpring spring;
    spring.stiffness = law.axial_stiffness / length;
    spring.lower = law.compression ? -law.yield_force : 0.0;
    spring.upper = law.tension ? law.yield_force : 0.0;
    spring.slack_below = !law.compression;
    spring.slack_above = !law.tension;
    bar_.push_back(spring);
    lengths_.push_back(length);
  };
  if (law.anchorage == BoltAnchorage::ends) {
    add_bar(shape_.length());
    return;
  }
  const std::vector<BoltStation>& stations = shape_.stations();
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (i > 0) add_bar(stations[i].place - stations[i - 1].place);
    YieldingSpring spring;
    spring.stiffness = law.bond_stiffness * stations[i].length;
    spring.upper = law.bond_strength * stations[i].length;
    spring.lower = -spring.upper;
    bond_.push_back(spring);
  }
  for (std::size_t k = 0; k < shape_.crossings().size(); ++k)
    if (shape_.crossings()[k].dowelled) dowels_.push_back(static_cast<int>(k));
}

BoltMemory BoltChain::installed_at(const Eigen::VectorXd& deformation) const {
  BoltMemory memory;
  const bool ends = law_.anchorage == BoltAnchorage::ends;
  memory.installed = ends ? deformation[0] : 0.0;
  for (const YieldingSpring& spring : bar_)
    memory.bar.push_back(memory.installed - law_.pretension / spring.stiffness);
  memory.ruptured.assign(bar_.size(), 0);
  if (ends) return memory;
  const Eigen::VectorXd rock = shape_.interpolation() * deformation.head(shape_.point_count());
  memory.places.assign(bond_.size(), 0.0);
  for (const double place : rock) memory.bond.push_back(-place);
  const Eigen::VectorXd shear = deformation.tail(deformation.size() - shape_.point_count());
  memory.dowels.assign(shear.begin(), shear.end());
  memory.sheared.assign(bond_.size() + dowels_.size(), 0);
  return memory;
}

BoltChain::Springs BoltChain::springs_at(const std::vector<double>& places, const Eigen::VectorXd& rock,
                                         const BoltMemory& memory) const {
  Springs springs;
  springs.bar.reserve(bar_.size());
  springs.bond.reserve(bond_.size());
  for (std::size_t i = 0; i < bar_.size(); ++i) {
    springs.bar.push_back(memory.ruptured[i] != 0
                              ? SpringPoint{}
                              : ashlar::respond(bar_[i], places[i + 1] - places[i] - memory.bar[i]));
  }
  springs.idle.assign(bond_.size(), 0.0);
  for (std::size_t i = 0; i < bond_.size(); ++i) {
    if (present_[static_cast<std::size_t>(shape_.stations()[i].piece)]) {
      springs.bond.push_back(
          ashlar::respond(bond_[i], places[i] - rock[static_cast<Index>(i)] - memory.bond[i]));
    } else {
      springs.bond.emplace_back();
      springs.idle[i] = YieldingSpring::hardening * bond_[i].stiffness;
    }
  }
  return springs;
}

std::vector<double> BoltChain::balance(const Eigen::VectorXd& rock, const BoltMemory& memory,
                                       Springs& springs) const {
  const auto count = static_cast<Index>(bond_.size());
  std::vector<double> places = memory.places;
  const Eigen::Map<const Eigen::VectorXd> before(memory.places.data(), count);
  Eigen::Map<Eigen::VectorXd> now(places.data(), count);
  springs = springs_at(places, rock, memory);
  Eigen::VectorXd gradient = springs.gradient(now - before);
  for (int k = 0; k < most_balance_iterations; ++k) {
    if (gradient.cwiseAbs().maxCoeff() <= balance_tolerance * springs.largest_force()) break;
    Eigen::MatrixXd step = -gradient;
    solve_tridiagonal(springs.diagonal(), springs.beside(), step);
    const Eigen::VectorXd start = now;
    const double slope = gradient.dot(step.col(0));
    const Springs last = std::move(springs);
    double low = 0.0;
    double high = 1.0;
    double share = 1.0;
    for (int n = 0;; ++n) {
      now = start + share * step;
      springs = springs_at(places, rock, memory);
      gradient = springs.gradient(now - before);
      const double end_slope = gradient.dot(step.col(0));
      if (n == 0 && springs.same_sides(last)) return places;
      if (n >= most_step_halvings || std::abs(end_slope) <= -line_overshoot * slope ||
          (n == 0 && end_slope < 0.0))
        break;
      (end_slope < 0.0 ? low : high) = share;
      share = 0.5 * (low + high);
    }
  }
  return places;
}

BoltResponse BoltChain::respond_between_ends(double elongation, const BoltMemory& memory) const {
  BoltResponse response;
  const SpringPoint spring = memory.ruptured[0] != 0 || !present_.front() || !present_.back()
                                 ? SpringPoint{}
                                 : ashlar::respond(bar_[0], elongation - memory.bar[0]);
  response.force = Eigen::VectorXd::Constant(1, spring.force);
  response.tangent = Eigen::MatrixXd::Constant(1, 1, spring.tangent);
  response.stored = spring.stored;
  response.dissipated = spring.dissipated;
  response.bar = {spring};
  return response;
}

void BoltChain::add_dowels(const Eigen::VectorXd& deformation, const BoltMemory& memory,
                           BoltResponse& response, bool with_tangent) const {
  YieldingSpring spring;
  spring.stiffness = law_.shear_stiffness;
  spring.upper = law_.shear_strength;
  for (std::size_t n = 0; n < dowels_.size(); ++n) {
    const Index row = shape_.point_count() + static_cast<Index>(2 * n);
    const auto crossing = static_cast<std::size_t>(dowels_[n]);
    response.dowels.emplace_back(Eigen::Vector2d::Zero());
    response.sheared.emplace_back(Eigen::Vector2d::Zero());
    // A bar that has broken at the joint is no dowel.
    std::size_t across = 0;
    while (shape_.stations()[across + 1].piece <= dowels_[n]) ++across;
    if (!present_[crossing] || !present_[crossing + 1] || memory.ruptured[across] != 0) continue;
    const Eigen::Vector2d shear =
        deformation.segment<2>(row) - Eigen::Vector2d(memory.dowels[2 * n], memory.dowels[2 * n + 1]);
    const double length = shear.norm();
    const SpringPoint point = ashlar::respond(spring, length);
    const Eigen::Vector2d along = length > 0.0 ? Eigen::Vector2d(shear / length) : Eigen::Vector2d::Zero();
    response.dowels.back() = point.force * along;
    response.sheared.back() = point.yielded * along;
    response.force.segment<2>(row) = response.dowels.back();
    response.stored += point.stored;
    response.dissipated += point.dissipated;
    if (!with_tangent) continue;
    const double secant = length > 0.0 ? point.force / length : spring.stiffness;
    response.tangent.block<2, 2>(row, row) =
        secant * Eigen::Matrix2d::Identity() + (point.tangent - secant) * along * along.transpose();
  }
}

BoltResponse BoltChain::respond(const Eigen::VectorXd& deformation, const BoltMemory& memory,
                                bool with_tangent) const {
  if (law_.anchorage == BoltAnchorage::ends) return respond_between_ends(deformation[0], memory);
  const Index points = shape_.point_count();
  const Eigen::MatrixXd& interpolation = shape_.interpolation();
  const Eigen::VectorXd rock = interpolation * deformation.head(points);
  BoltResponse response;
  Springs springs;
  response.places = balance(rock, memory, springs);
  Eigen::VectorXd bond(rock.size());
  Eigen::VectorXd tangents(rock.size());
  for (std::size_t i = 0; i < springs.bond.size(); ++i) {
    bond[static_cast<Index>(i)] = springs.bond[i].force;
    tangents[static_cast<Index>(i)] = springs.bond[i].tangent;
  }
  for (const auto* all : {&springs.bar, &springs.bond}) {
    for (const SpringPoint& spring : *all) {
      response.stored += spring.stored;
      response.dissipated += spring.dissipated;
    }
  }
  response.force = Eigen::VectorXd::Zero(deformation.size());
  response.force.head(points) = -interpolation.transpose() * bond;
  if (with_tangent) {
    response.tangent = Eigen::MatrixXd::Zero(deformation.size(), deformation.size());
    const Eigen::MatrixXd held = tangents.asDiagonal() * interpolation;
    Eigen::MatrixXd followed = held;
    solve_tridiagonal(springs.diagonal(), springs.beside(), followed);
    response.tangent.topLeftCorner(points, points) =
        interpolation.transpose() * held - held.transpose() * followed;
  }
  response.bar = std::move(springs.bar);
  response.bond = std::move(springs.bond);
  add_dowels(deformation, memory, response, with_tangent);
  return response;
}

BoltMemory BoltChain::memory_after(const BoltResponse& response, const BoltMemory& memory) const {
  BoltMemory after = memory;
  after.places = response.places;
  for (std::size_t i = 0; i < after.bar.size(); ++i) after.bar[i] += response.bar[i].yielded;
  for (std::size_t i = 0; i < after.bond.size(); ++i) {
    after.bond[i] += response.bond[i].yielded;
    if (response.bond[i].yielded != 0.0) after.sheared[i] = 1;
  }
  for (std::size_t n = 0; n < response.sheared.size(); ++n) {
    for (const std::size_t axis : {0U, 1U})
      after.dowels[2 * n + axis] += response.sheared[n][static_cast<Index>(axis)];
    if (!response.sheared[n].isZero(0.0)) after.sheared[after.bond.size() + n] = 1;
  }
  return after;
}

bool BoltChain::has_yielded(const BoltMemory& memory) const {
  for (std::size_t i = 0; i < bar_.size(); ++i)
    if (has_yielded(memory, i)) return true;
  return false;
}

bool BoltChain::has_yielded(const BoltMemory& memory, std::size_t spring) const {
  return memory.bar[spring] != memory.installed - law_.pretension / bar_[spring].stiffness;
}

bool BoltChain::rupture(const Eigen::VectorXd& deformation, const BoltResponse& response,
                        BoltMemory& memory) const {
  bool any = false;
  if (law_.rupture_strain == BoltLaw::unlimited) return any;
  for (std::size_t i = 0; i < bar_.size(); ++i) {
    const double elongation = law_.anchorage == BoltAnchorage::ends
                                  ? deformation[0] - memory.installed
                                  : response.places[i + 1] - response.places[i];
    const double strain = (elongation + law_.pretension / bar_[i].stiffness) / lengths_[i];
    if (memory.ruptured[i] != 0 || !(strain > law_.rupture_strain)) continue;
    memory.ruptured[i] = 1;
    any = true;
  }
  return any;
}

}  // namespace ashlar
