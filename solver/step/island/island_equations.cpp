#include "solver/step/island/island_equations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

std::vector<int> places_of(const Island& island, std::size_t blocks) {
  std::vector<int> place(blocks, -1);
  for (std::size_t k = 0; k < island.bodies.size(); ++k) place[at(island.bodies[k])] = static_cast<int>(k);
  return place;
}

}  // namespace

IslandProblem::IslandProblem(const Island& island, std::vector<BodyStep>& bodies,
                             const std::vector<ContactPair>& pairs, const TimeScheme& scheme,
                             const SimulationSettings& settings, IslandSolvers::Entry& solver,
                             const IslandSums& sums)
    : island_(island),
      bodies_(bodies),
      pairs_(pairs),
      settings_(settings),
      scheme_(scheme),
      solver_(solver),
      sums_(sums),
      bolts_(island, bodies, island.bolts.empty() ? std::vector<int>() : places_of(island, bodies.size())) {
  const std::vector<int> place = places_of(island, bodies.size());
  for (const int pair : island.pairs) {
    laws_.push_back(pairs[at(pair)].laws());
    places_.push_back({place[at(pairs[at(pair)].a())], place[at(pairs[at(pair)].b())]});
  }
  pairs_of_.resize(island.bodies.size());
  for (std::size_t k = 0; k < places_.size(); ++k)
    for (const int body : places_[k])
      if (body >= 0) pairs_of_[at(body)].push_back(k);
  std::size_t own_pairs = 0;
  for (std::size_t k = 0; k < island.pairs.size(); ++k) own_pairs += sums.owns_pair(k) ? 1 : 0;
  all_pairs_ = static_cast<std::size_t>(sums.sum(static_cast<double>(own_pairs)));
  follow_rigid_bodies();
}

void IslandProblem::follow_rigid_bodies() {
  for (const int index : island_.bodies) bodies_[at(index)].follow_rigid(scheme_);
}

int IslandProblem::threads() const {
  constexpr std::size_t worth_it = 32;  // pairs: below it threads cost more than they save
  return pairs() < worth_it ? 1 : settings_.threads;
}

const ContactPair& IslandProblem::pair(std::size_t k) const {
  if (const auto replaced = replaced_.find(k); replaced != replaced_.end()) return replaced->second;
  return pairs_[at(island_.pairs[k])];
}

void IslandProblem::predict(Predictor guess) {
  for (const int index : island_.bodies) {
    BodyStep& body = bodies_[at(index)];
    const double mass = scheme_.inertia * body.model->material().density;
    body.change = body.free_change;
    if (guess == Predictor::at_rest) body.change.setZero();
    if (guess != Predictor::free_motion || scheme_.is_static()) continue;
    body.change += scheme_.force_weight / mass * body.external_force;
  }
  follow_rigid_bodies();
}

Eigen::MatrixX3d IslandProblem::taken_at(const BodyStep& body) const {
  return body.state->position + scheme_.end_share * body.motion();
}

void IslandProblem::respond() {
  parallel_for(threads(), island_.bodies.size(), [&](std::size_t k) {
    BodyStep& body = bodies_[at(island_.bodies[k])];
    body.elastic = body.model->elastic(taken_at(body));
  });
  renew_contacts();
  parallel_for(threads(), pairs(), [&](std::size_t k) {
    const std::span<const FrequentLaw> laws = table_.frequent(k);
    if (laws.empty()) {
      pair(k).respond(change_a(k), change_b(k), scheme_.mean_contacts, laws_[k], contacts_.pairs[k]);
      note_points(k);
    } else {
      const std::span<ContactState> states(contacts_.states.data() + table_.first_point(k), laws.size());
      contacts_.in_doubt[k] = pair(k).press(change_a(k), change_b(k), laws, states,
                                            places_of_points(k, laws.size()), contacts_.pairs[k]);
    }
  });
  bolts_.respond(scheme_.mean_contacts, bolts_.size() < 32 ? 1 : settings_.threads);
}

void IslandProblem::renew_contacts() {
  if (std::exchange(laws_changed_, false)) table_.set(laws_, scheme_.mean_contacts);
  contacts_.complete = false;
  contacts_.derived.assign(pairs(), 0);
  contacts_.pairs.resize(pairs());
  contacts_.in_doubt.resize(pairs());
  contacts_.states.resize(table_.first_point(pairs()));
  contacts_.places.resize(3, static_cast<Eigen::Index>(contacts_.states.size()));
  derivatives_.resize(contacts_.states.size());
}

std::span<const PointDerivative> IslandProblem::derivatives(std::size_t k) const {
  const std::span<PointDerivative> result(derivatives_.data() + table_.first_point(k), laws_[k].size());
  if (std::exchange(contacts_.derived[k], 1) != 0) return result;
  const PairResponse& response = contacts_.pairs[k];
  if (!response.means.empty()) {
    for (auto to = result.begin(); const PointDerivative& mean : derivatives_of(response)) *to++ = mean;
    return result;
  }
  const std::span<const FrequentLaw> laws = table_.frequent(k);
  const auto places = places_of_points(k, laws.size());
  for (std::size_t n = 0; n < laws.size(); ++n) {
    const auto at = places.col(static_cast<Eigen::Index>(n));
    result[n] = point_derivative(laws[n], point_force(laws[n], at[0], at.tail<2>()));
  }
  return result;
}

void IslandProblem::note_points(std::size_t k) {
  const std::vector<PointResponse>& points = contacts_.pairs[k].points;
  for (std::size_t n = 0; n < points.size(); ++n)
    contacts_.states[table_.first_point(k) + n] = points[n].state;
  contacts_.in_doubt[k] = pair(k).force_in_doubt(change_a(k), change_b(k), laws_[k], contacts_.pairs[k]);
}

void IslandProblem::set_responses(std::vector<PairResponse> responses) {
  renew_contacts();
  contacts_.pairs = std::move(responses);
  contacts_.complete = true;
  for (std::size_t k = 0; k < pairs(); ++k) note_points(k);
}

const std::vector<PairResponse>& IslandProblem::responses() const {
  if (!contacts_.complete) {
    parallel_for(threads(), pairs(), [&](std::size_t k) {
      if (!table_.frequent(k).empty())
        pair(k).respond(change_a(k), change_b(k), scheme_.mean_contacts, laws_[k], contacts_.pairs[k]);
    });
    contacts_.complete = true;
  }
  return contacts_.pairs;
}

void IslandProblem::add_force(Residual& residual, int place, const Eigen::VectorXd& on_unknowns) const {
  const auto add = [&](const Eigen::VectorXd& force) {
    residual.force.segment(solver_.matrix.offset(place), force.size()) += force;
    residual.scales[at(place)] = std::max(residual.scales[at(place)], force.norm());
  };
  const BodyStep& body = this->body(at(place));
  if (body.model->rigid())
    add(body.in_equations(on_unknowns));
  else
    add(on_unknowns);
}

void IslandProblem::add_contacts(Residual& residual, std::vector<ForceErrors>& errors) const {
  std::vector<double> roundings(pairs());
  parallel_for(threads(), pairs(), [&](std::size_t k) {
    roundings[k] = pair(k).force_rounding(table_.stiffness(k), change_a(k).norm(), change_b(k).norm());
  });
  parallel_for(threads(), bodies(), [&](std::size_t place) {
    Eigen::VectorXd force;
    for (const std::size_t k : pairs_of_[place]) {
      const bool is_a = places_[k][0] == static_cast<int>(place);
      contacts_.pairs[k].set_total(is_a, force);
      add_force(residual, static_cast<int>(place), force);
      errors[place].rounding += roundings[k];
      errors[place].within_rounding += contacts_.in_doubt[k];
    }
  });
}

void IslandProblem::add_bolts(Residual& residual, std::vector<ForceErrors>& errors) const {
  for (std::size_t k = 0; k < bolts_.responses().size(); ++k) {
    const double rounding = bolts_.bolt(k).force_rounding(bolts_.responses()[k]);
    for (std::size_t n = 0; n < bolts_.places(k).size(); ++n) {
      const int body = bolts_.places(k)[n];
      if (body < 0) continue;
      add_force(residual, body, bolts_.responses()[k].on_blocks[n]);
      errors[at(body)].rounding += rounding;
    }
  }
}

void IslandProblem::judge(Residual& residual, const std::vector<ForceErrors>& errors) const {
  const double tolerance =
      scheme_.is_static() ? settings_.statics.residual_tolerance : settings_.iteration.residual_tolerance;
  for (std::size_t k = 0; k < island_.bodies.size(); ++k) {
    if (!sums_.owns_body(k)) continue;
    BodyStep& body = bodies_[at(island_.bodies[k])];
    const double scale = residual.scales[k];
    const double rounding = body.roundoff_force + errors[k].rounding +
                            std::min(errors[k].within_rounding, settings_.iteration.doubt_share * scale) +
                            8.0 * std::numeric_limits<double>::epsilon() * body.model->material().density *
                                scheme_.inertia * (body.change.norm() + body.free_change.norm());
    const double left =
        residual.force.segment(solver_.matrix.offset(static_cast<int>(k)), body.model->freedom()).norm();
    if (left == 0.0) continue;
    const double share = left / (tolerance * scale + rounding);
    // An overflow is never converged, and comparisons with it are unreliable.
    const bool finite = std::isfinite(share) && std::isfinite(scale);
    residual.relative[k] = finite ? share : std::numeric_limits<double>::infinity();
    residual.largest = std::max(residual.largest, residual.relative[k]);
    residual.sum += residual.relative[k];
    residual.largest_by_force =
        std::max(residual.largest_by_force, finite ? left / scale : residual.relative[k]);
  }
  if (sums_.shared()) {
    const std::vector<double> most = sums_.largest({residual.largest, residual.largest_by_force});
    residual.largest = most[0];
    residual.largest_by_force = most[1];
    residual.sum = sums_.sum(residual.sum);
  }
  recall(residual);
}

Residual IslandProblem::residual() const {
  const std::size_t bodies = island_.bodies.size();
  Residual result;
  result.force = Eigen::VectorXd::Zero(solver_.matrix.matrix().size);
  result.relative.assign(bodies, 0.0);
  result.scales.assign(bodies, 0.0);
  parallel_for(threads(), bodies, [&](std::size_t k) {
    const BodyStep& body = bodies_[at(island_.bodies[k])];
    const int place = static_cast<int>(k);
    add_force(result, place, scheme_.force_weight * body.external_force);
    add_force(result, place,
              -scheme_.force_weight * body.model->space().restrict(body.internal_force(scheme_)));
    if (body.dashpots != nullptr)
      add_force(result, place, -scheme_.force_weight * body.dashpot_force(scheme_));
    add_force(result, place,
              -body.model->material().density * scheme_.inertia * (body.change - body.free_change));
  });
  std::vector<ForceErrors> errors(bodies);
  add_contacts(result, errors);
  add_bolts(result, errors);
  judge(result, errors);
  return result;
}

void IslandProblem::recall(const Residual& residual) const {
  for (std::size_t k = 0; k < island_.bodies.size(); ++k) {
    BodyStep& body = bodies_[at(island_.bodies[k])];
    body.largest_force = residual.scales[k];
    body.residual =
        residual.relative[k] <= 1.0
            ? 0.0
            : residual.force.segment(solver_.matrix.offset(static_cast<int>(k)), body.model->freedom())
                  .norm();
  }
}

Eigen::VectorXd IslandProblem::contact_forces() const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(solver_.matrix.matrix().size);
  add_contact_forces(contacts_.pairs, sum);
  return sum;
}

void IslandProblem::add_contact_forces(const std::vector<PairResponse>& responses,
                                       Eigen::VectorXd& sum) const {
  parallel_for(threads(), bodies(), [&](std::size_t place) {
    Eigen::VectorXd force;
    auto of_body = sum.segment(solver_.matrix.offset(static_cast<int>(place)), body(place).model->freedom());
    for (const std::size_t k : pairs_of_[place]) {
      responses[k].set_total(places_[k][0] == static_cast<int>(place), force);
      of_body += body(place).in_equations(force);
    }
  });
}

std::vector<Eigen::VectorXd> IslandProblem::changes(const Eigen::VectorXd& change) const {
  std::vector<Eigen::VectorXd> result(bodies());
  parallel_for(threads(), result.size(), [&](std::size_t k) {
    const int offset = solver_.matrix.offset(static_cast<int>(k));
    result[k] = body(k).of_unknowns(change.segment(offset, body(k).model->freedom()));
  });
  return result;
}

Eigen::Matrix3Xd IslandProblem::motion(std::size_t k, const std::vector<Eigen::VectorXd>& changes) const {
  const auto change_of = [&](int place, int block) -> Eigen::VectorXd {
    return place < 0 ? Eigen::VectorXd::Zero(bodies_[at(block)].change.size()) : changes[at(place)];
  };
  return pair(k).rows().free_motion(change_of(places_[k][0], pair(k).a()),
                                    change_of(places_[k][1], pair(k).b()));
}

void IslandProblem::apply(const Eigen::VectorXd& change, double share) {
  const std::vector<Eigen::VectorXd> of_bodies = changes(change);
  for (std::size_t k = 0; k < bodies(); ++k) bodies_[at(island_.bodies[k])].change += share * of_bodies[k];
  follow_rigid_bodies();
}

std::vector<Eigen::VectorXd> IslandProblem::guess() const {
  std::vector<Eigen::VectorXd> result;
  for (const int index : island_.bodies) result.push_back(bodies_[at(index)].change);
  return result;
}

void IslandProblem::set_guess(const std::vector<Eigen::VectorXd>& guess) {
  for (std::size_t k = 0; k < guess.size(); ++k) bodies_[at(island_.bodies[k])].change = guess[k];
  follow_rigid_bodies();
}

Evaluation IslandProblem::set_aside() {
  Evaluation result{guess(), {}, std::exchange(contacts_, {}), bolts_.set_aside()};
  for (const int index : island_.bodies) result.elastic.push_back(std::move(bodies_[at(index)].elastic));
  return result;
}

void IslandProblem::take_back(Evaluation evaluation) {
  set_guess(evaluation.guess);
  contacts_ = std::move(evaluation.contacts);
  contacts_.derived.assign(pairs(), 0);
  bolts_.take_back(std::move(evaluation.bolts));
  for (std::size_t k = 0; k < island_.bodies.size(); ++k)
    bodies_[at(island_.bodies[k])].elastic = std::move(evaluation.elastic[k]);
}

std::vector<double> IslandProblem::gaps(std::size_t k) const {
  return pair(k).gaps(change_a(k), change_b(k));
}

double IslandProblem::given(std::size_t k) const {
  const Eigen::VectorXd &ya = change_a(k), &yb = change_b(k);
  const PairResponse& response = responses()[k];
  return pair(k).spring_work(response, ya, yb) + pair(k).friction_work(response, laws_[k], ya, yb);
}

BlockInStep IslandProblem::placed(const BodyStep& body) const {
  if (body.model->fixed()) return {body.model, body.state->position, body.state->position, {}};
  const Eigen::MatrixX3d motion = body.motion();
  return {body.model, body.state->position + 0.5 * motion, body.state->position + motion, body.prescribed};
}

double IslandProblem::left_out(std::size_t k) const {
  const BodyStep& a = bodies_[at(pair(k).a())];
  const BodyStep& b = bodies_[at(pair(k).b())];
  const Eigen::Matrix3Xd motion = pair(k).motion(a.change, b.change);
  const auto slip = [&](const Eigen::Matrix3Xd& displacement) {
    double most = 0.0;
    for (std::size_t n = 0; n < laws_[k].size(); ++n) {
      if (contacts_.states[table_.first_point(k) + n] == ContactState::open) continue;
      most = std::max(most, displacement.col(static_cast<Eigen::Index>(n)).tail<2>().norm());
    }
    return most;
  };
  const auto turn = [](const BlockModel& model, const Eigen::MatrixX3d& displacement) {
    return (displacement.transpose() * model.parts()->mean_gradients).norm();
  };
  const auto turned = [&](const BodyStep& body) {
    return body.model->fixed() ? 0.0 : turn(*body.model, body.motion());
  };
  const auto found = followed_.find(k);
  const double slipped = slip(motion);
  if (slipped == 0.0) return 0.0;
  const double turns = std::max(turned(a), turned(b));
  if (found == followed_.end()) return turns * slipped;
  const auto turned_since = [&](const BodyStep& body, const Eigen::VectorXd& change) {
    return body.model->fixed() ? 0.0 : turn(*body.model, body.model->space().expand(body.change - change));
  };
  return turns * slip(motion - found->second.motion) +
         std::max(turned_since(a, found->second.change_a), turned_since(b, found->second.change_b)) * slipped;
}

bool IslandProblem::follow_contacts(double tolerance) {
  bool any = bolts_.follow(tolerance);
  for (std::size_t k = 0; k < pairs(); ++k) {
    if (pair(k).tied() || !(left_out(k) > tolerance)) continue;
    const BodyStep& a = bodies_[at(pair(k).a())];
    const BodyStep& b = bodies_[at(pair(k).b())];
    ContactPair& moved = replaced_.try_emplace(k, pair(k)).first->second;
    moved.follow(placed(a), placed(b), a.change, b.change);
    followed_.insert_or_assign(k, Followed{a.change, b.change, moved.motion(a.change, b.change)});
    any = true;
  }
  return any;
}

void IslandProblem::hand_over(IslandResult& result) {
  static_cast<void>(responses());
  for (auto& [k, pair] : replaced_) result.followed.emplace_back(island_.pairs[k], std::move(pair));
  for (std::size_t k = 0; k < bolts_.responses().size(); ++k) {
    const StepBoltResponse& response = bolts_.responses()[k];
    result.bolts.push_back({response, bolts_.bolt(k).work(response, bolts_.changes(k)),
                            bolts_.bolt(k).prescribed_work(response)});
  }
  result.responses = std::move(contacts_.pairs);
  result.laws = std::move(laws_);
}

}  // namespace ashlar
