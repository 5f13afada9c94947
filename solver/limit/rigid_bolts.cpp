#include "solver/limit/rigid_bolts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "solver/bolts/step_bolt.hpp"

namespace ashlar {
namespace {

/// Mass of the bar of a bolt over that of the lightest body that it holds.
constexpr double bar_mass = 0.1;
/// Share of a strength from which on it counts as reached.
constexpr double reached_share = 1.0 - 1e-6;

/// Consecutive pieces of a bar in one body.
struct Group {
  int body;           ///< -1: fixed
  int first, last;    ///< pieces
  double bond = 0.0;  ///< N, strength of the grout
};

/// The crossings of one bolt.
class Bars {
 public:
  Bars(const Bolt& bolt, int index, const Eigen::Matrix3Xd& points, const std::vector<int>& body_of)
      : bolt_(bolt), index_(index), points_(points), strength_(bolt_strength(bolt.chain.law())) {
    const std::vector<BoltSpan>& pieces = shape().pieces();
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (!bolt.chain.present(k)) continue;
      const int body = body_of[at(pieces[k].block)], piece = static_cast<int>(k);
      if (groups_.empty() || groups_.back().body != body) groups_.push_back({body, piece, piece});
      groups_.back().last = piece;
      groups_.back().bond +=
          grouted() ? strength_.bond * (pieces[k].end - pieces[k].start) : BoltLaw::unlimited;
    }
  }

  void add(RigidModel& model, std::vector<RigidPoint>& points) const {
    if (groups_.size() < 2 || strength_.none()) return;
    std::vector<int> bodies;  // on which the bar acts
    for (std::size_t g = 0; g < groups_.size(); ++g)
      bodies.push_back(slips(g) ? add_bar(g, model, points) : groups_[g].body);
    for (std::size_t g = 0; g + 1 < groups_.size(); ++g) {
      add_axial(g, {bodies[g + 1], bodies[g]}, points);
      if (grouted()) add_dowel(g, points);
    }
  }

 private:
  [[nodiscard]] const BoltShape& shape() const { return bolt_.chain.shape(); }
  [[nodiscard]] const BoltLaw& law() const { return bolt_.chain.law(); }
  [[nodiscard]] bool grouted() const { return !shape().stations().empty(); }
  [[nodiscard]] int block(int piece) const { return shape().pieces()[at(piece)].block; }
  [[nodiscard]] Vector3 first_point(int piece) const { return points_.col(shape().first_point(at(piece))); }
  [[nodiscard]] Vector3 last_point(int piece) const {
    return points_.col(shape().first_point(at(piece + 1)) - 1);
  }

  /// Largest tension between a group and the next one, N.
  [[nodiscard]] double tension(std::size_t group) const {
    double before = 0.0, after = 0.0;
    for (std::size_t g = 0; g < groups_.size(); ++g) (g <= group ? before : after) += groups_[g].bond;
    return std::min({strength_.tension, before, after});
  }

  /// m, in the body of a group.
  [[nodiscard]] double grout_length(std::size_t group) const {
    double length = 0.0;
    for (int k = groups_[group].first; k <= groups_[group].last; ++k)
      if (bolt_.chain.present(at(k))) length += shape().pieces()[at(k)].end - shape().pieces()[at(k)].start;
    return length;
  }

  /// N/m, of the bar where it crosses from a group to the next one. In grout of the stiffness b per length the tension of
  /// a bar of E A decays over sqrt(E A / b), so that its pulled end yields by N / (sqrt(E A b) tanh(L sqrt(b / E A))).
  [[nodiscard]] double axial_stiffness(std::size_t group) const {
    if (!grouted()) return law().axial_stiffness / shape().length();
    double compliance = 0.0;
    for (const std::size_t g : {group, group + 1}) {
      const double root = std::sqrt(law().axial_stiffness * law().bond_stiffness);
      compliance += 1.0 / (root * correctly_rounded::tanh(grout_length(g) * root / law().axial_stiffness));
    }
    return 1.0 / compliance;
  }

  /// True if the difference of the tensions on both sides of a body may exceed the strength of its grout.
  [[nodiscard]] bool slips(std::size_t group) const {
    if (group == 0 || group + 1 == groups_.size()) return false;
    return groups_[group].bond < std::max(tension(group - 1), tension(group));
  }

  /// Direction at the crossing between a group and the next one.
  [[nodiscard]] Vector3 direction(std::size_t group) const {
    const int before = groups_[group].last, after = groups_[group + 1].first;
    if (!grouted()) return (first_point(after) - last_point(before)).normalized();
    const Vector3 first = (last_point(before) - first_point(before)).normalized();
    const Vector3 sum = first + (last_point(after) - first_point(after)).normalized();
    return sum.norm() > 0.0 ? Vector3(sum.normalized()) : first;
  }

  /// A point without force between two bodies.
  [[nodiscard]] RigidPoint point_at(const Vector3& place, BlockPair blocks, std::array<int, 2> bodies,
                                    int piece, BarPart part) const {
    RigidPoint point;
    point.blocks = blocks;
    point.bodies = bodies;
    point.place = point.friction_place = place;
    point.frame.setZero();
    point.bar = BarPoint{index_, piece, part, BoltLaw::unlimited, BoltLaw::unlimited, 0.0};
    return point;
  }

  [[nodiscard]] RigidPoint crossing(std::size_t group, std::array<int, 2> bodies, BarPart part) const {
    const int before = groups_[group].last, after = groups_[group + 1].first;
    return point_at(0.5 * (last_point(before) + first_point(after)), {block(after), block(before)}, bodies,
                    before, part);
  }

  void add_axial(std::size_t group, std::array<int, 2> bodies, std::vector<RigidPoint>& points) const {
    if (strength_.tension == 0.0 && strength_.compression == 0.0) return;
    RigidPoint point = crossing(group, bodies, BarPart::axial);
    point.frame.row(0) = direction(group).transpose();
    point.bar->tension = tension(group);
    point.bar->compression = strength_.compression;
    point.spring = {axial_stiffness(group), 0.0, -law().pretension};
    points.push_back(std::move(point));
  }

  void add_dowel(std::size_t group, std::vector<RigidPoint>& points) const {
    const int before = groups_[group].last, after = groups_[group + 1].first;
    if (strength_.shear == 0.0 || after != before + 1 || !shape().crossings()[at(before)].dowelled) return;
    RigidPoint point = crossing(group, {groups_[group + 1].body, groups_[group].body}, BarPart::dowel);
    const Vector3 along = direction(group), across = along.unitOrthogonal();
    const std::array<Vector3, 2> directions = {across, along.cross(across)};
    point.spring = {law().shear_stiffness, law().shear_stiffness, 0.0};
    if (std::isinf(strength_.shear)) {
      for (const Vector3& direction : directions) {
        point.frame.row(0) = direction.transpose();
        points.push_back(point);
      }
      return;
    }
    for (const Eigen::Index k : {0, 1})
      point.frame.row(k + 1) = directions[at(static_cast<int>(k))].transpose();
    point.bar->shear = strength_.shear;
    points.push_back(std::move(point));
  }

  /// The bar in a body whose grout may slip. @return its number
  [[nodiscard]] int add_bar(std::size_t group, RigidModel& model, std::vector<RigidPoint>& points) const {
    const Group& own = groups_[group];
    double lightest = BoltLaw::unlimited;
    for (const std::size_t g : {group - 1, group, group + 1})
      if (groups_[g].body >= 0) lightest = std::min(lightest, model.bodies[at(groups_[g].body)].mass);
    RigidBody bar;
    bar.mass = bar_mass * lightest;
    const Vector3 from = first_point(own.first), to = last_point(own.last);
    const Vector3 along = (to - from).normalized();
    bar.middle = 0.5 * (from + to);
    bar.motion.col(0).head<3>() = std::sqrt(model.units.mass / bar.mass) * along;
    bar.freedom = 1;
    const int number = static_cast<int>(model.bodies.size());
    RigidPoint point = point_at(bar.middle, {block(own.first), block(own.first)}, {number, own.body},
                                own.first, BarPart::bond);
    model.bodies.push_back(std::move(bar));
    point.frame.row(0) = along.transpose();
    point.bar->tension = point.bar->compression = own.bond;
    point.spring.normal = law().bond_stiffness * grout_length(group);
    points.push_back(std::move(point));
    return number;
  }

  const Bolt& bolt_;
  int index_;
  const Eigen::Matrix3Xd& points_;
  BoltStrength strength_;
  std::vector<Group> groups_;
};

/// Tension along a grouted bar: given at its crossings, linear in between, 0 at its ends.
class Tension {
 public:
  Tension(const BoltChain& chain, const std::vector<BarForce>& forces) {
    const std::vector<BoltSpan>& pieces = chain.shape().pieces();
    add(pieces.front().start, 0.0);
    for (const BarForce& bar : forces) {
      if (bar.of.part != BarPart::axial) continue;
      std::size_t after = at(bar.of.piece) + 1;
      while (!chain.present(after)) ++after;
      add(pieces[at(bar.of.piece)].end, bar.force);
      add(pieces[after].start, bar.force);
    }
    add(pieces.back().end, 0.0);
  }

  /// @param place m along the bar
  [[nodiscard]] double at_place(double place) const {
    std::size_t k = 1;
    while (k + 1 < places_.size() && place > places_[k]) ++k;
    const double length = places_[k] - places_[k - 1];
    const double share = length > 0.0 ? std::clamp((place - places_[k - 1]) / length, 0.0, 1.0) : 1.0;
    return (1.0 - share) * values_[k - 1] + share * values_[k];
  }

 private:
  void add(double place, double value) {
    places_.push_back(place);
    values_.push_back(value);
  }

  std::vector<double> places_, values_;
};

void set_grouted(const Bolt& bolt, const std::vector<BarForce>& forces, BoltState& state) {
  const BoltShape& shape = bolt.chain.shape();
  const std::vector<BoltStation>& stations = shape.stations();
  const Tension tension(bolt.chain, forces);
  for (std::size_t i = 0; i < state.axial.size(); ++i) {
    const bool crosses = stations[i].piece != stations[i + 1].piece;
    state.axial[i] = tension.at_place(crosses ? shape.pieces()[at(stations[i].piece)].end
                                              : 0.5 * (stations[i].place + stations[i + 1].place));
  }
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double before = i > 0 ? state.axial[i - 1] : 0.0;
    const double after = i < state.axial.size() ? state.axial[i] : 0.0;
    state.bond[i] = after - before;
    const double strength = bolt.chain.law().bond_strength * stations[i].length;
    state.reached.sheared[i] = std::abs(state.bond[i]) >= reached_share * strength ? 1 : 0;
  }
  std::fill(state.dowels.begin(), state.dowels.end(), 0.0);
  std::size_t n = 0;
  for (const BoltCrossing& crossing : shape.crossings()) {
    if (!crossing.dowelled) continue;
    for (const BarForce& bar : forces) {
      if (bar.of.part != BarPart::dowel || bar.of.piece != crossing.piece) continue;
      state.dowels[2 * n] = bar.force;
      state.reached.sheared[stations.size() + n] = bar.share >= reached_share ? 1 : 0;
    }
    ++n;
  }
}

}  // namespace

void add_bars(const BlockSystem& system, const RunState& state, RigidModel& model,
              std::vector<RigidPoint>& points) {
  for (std::size_t k = 0; k < state.bolts.size(); ++k) {
    const Bolt& bolt = system.bolts()[k];
    const std::vector<int>& ruptured = state.bolts[k].reached.ruptured;
    const bool broken = std::find(ruptured.begin(), ruptured.end(), 1) != ruptured.end();
    if (!state.bolts[k].installed() || broken) continue;
    const Eigen::Matrix3Xd places = points_in(bolt, system.blocks(), state.states);
    Bars(bolt, static_cast<int>(k), places, model.body_of).add(model, points);
  }
}

std::vector<BarForce> bar_forces(const RigidModel& model, const std::vector<Eigen::Vector3d>& force) {
  std::vector<BarForce> forces;
  for (std::size_t k = 0; k < force.size(); ++k) {
    if (!model.points[k].bar) continue;
    const BarPoint& bar = *model.points[k].bar;
    const Eigen::Vector3d f = model.units.force() * force[k];
    BarForce one{bar, 0.0, 0.0};
    if (bar.part != BarPart::dowel) {
      const double limit = f[0] < 0.0 ? bar.tension : bar.compression;
      one.force = bar.part == BarPart::axial ? -f[0] : f[0];
      one.share = std::isfinite(limit) && limit > 0.0 ? std::min(std::abs(f[0]) / limit, 1.0) : 0.0;
      forces.push_back(one);
      continue;
    }
    one.force = std::isinf(bar.shear) || bar.shear == 0.0 ? std::abs(f[0]) : f.tail<2>().norm();
    one.share = bar.shear > 0.0 ? std::min(one.force / bar.shear, 1.0) : 0.0;
    const bool second = !forces.empty() && forces.back().of.bolt == bar.bolt &&
                        forces.back().of.piece == bar.piece && forces.back().of.part == BarPart::dowel;
    if (second) {
      forces.back().force = correctly_rounded::hypot(forces.back().force, one.force);
    } else {
      forces.push_back(one);
    }
  }
  return forces;
}

std::vector<BoltState> bolts_under(const std::vector<BarForce>& forces, const std::vector<Bolt>& bolts,
                                   std::vector<BoltState> present) {
  std::vector<std::vector<BarForce>> by_bolt(bolts.size());
  for (const BarForce& bar : forces) by_bolt[at(bar.of.bolt)].push_back(bar);
  for (std::size_t k = 0; k < bolts.size(); ++k) {
    if (by_bolt[k].empty()) continue;
    std::stable_sort(by_bolt[k].begin(), by_bolt[k].end(),
                     [](const BarForce& a, const BarForce& b) { return a.of.piece < b.of.piece; });
    BoltState& state = present[k];
    const BoltLaw& law = bolts[k].chain.law();
    if (law.anchorage == BoltAnchorage::grouted) {
      set_grouted(bolts[k], by_bolt[k], state);
    } else {
      state.axial[0] = by_bolt[k].front().force;
    }
    for (std::size_t i = 0; i < state.axial.size(); ++i)
      if (std::abs(state.axial[i]) >= reached_share * law.yield_force)
        state.reached.bar[i] += state.axial[i] / law.axial_stiffness * bolts[k].chain.shape().length();
  }
  return present;
}

}  // namespace ashlar
