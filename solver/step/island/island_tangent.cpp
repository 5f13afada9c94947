#include "solver/step/island/island_tangent.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "solver/linear/gmres.hpp"
#include "solver/linear/tree_factor.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

/// Projects a tangent on the unknowns of two blocks to their equations.
PairTangent in_equations(PairTangent tangent, const BodyStep& a, const BodyStep& b) {
  if (a.model->rigid()) {
    if (tangent.aa.size() > 0) tangent.aa = a.fields.transpose() * tangent.aa * a.fields;
    if (tangent.ab.size() > 0) tangent.ab = a.fields.transpose() * tangent.ab;
  }
  if (b.model->rigid()) {
    if (tangent.bb.size() > 0) tangent.bb = b.fields.transpose() * tangent.bb * b.fields;
    if (tangent.ab.size() > 0) tangent.ab = tangent.ab * b.fields;
  }
  return tangent;
}

/// @param x,y (9, #points) or without columns: nothing
PointStiffnesses sum(PointStiffnesses x, const PointStiffnesses& y) {
  if (x.cols() == 0) return y;
  if (y.cols() > 0) x += y;
  return x;
}

}  // namespace

double IslandTangent::weight_of_blocks() const {
  const TimeScheme& scheme = problem_.scheme();
  return scheme.force_weight * scheme.end_share * (1.0 + scheme.stiffness_share);
}

double IslandTangent::weight_of_dashpots() const {
  return problem_.scheme().force_weight * problem_.scheme().dashpot_velocity.change;
}

void IslandTangent::assemble(bool positive) {
  const TimeScheme& scheme = problem_.scheme();
  BlockMatrix& matrix = solver_.matrix;
  matrix.set_zero();
  parallel_for(problem_.threads(), problem_.bodies(), [&](std::size_t k) {
    const BodyStep& body = problem_.body(k);
    if (scheme.force_weight > 0.0 && !body.model->rigid()) {
      matrix.add_diagonal(
          static_cast<int>(k),
          weight_of_blocks() * body.model->tangent(problem_.taken_at(body), body.elastic, positive));
    }
    if (body.dashpots != nullptr)
      matrix.add_diagonal(static_cast<int>(k), weight_of_dashpots() * *body.dashpots);
    matrix.add_to_diagonal(static_cast<int>(k), body.model->material().density * scheme.inertia);
  });
  // Few at a time, added in the order of pairs: tangents of all would take more memory than all points.
  constexpr std::size_t together = 128;
  std::vector<PairTangent> tangents(std::min(together, problem_.pairs()));
  for (std::size_t first = 0; first < problem_.pairs(); first += together) {
    const std::size_t count = std::min(together, problem_.pairs() - first);
    parallel_for(problem_.threads(), count, [&](std::size_t n) {
      const ContactPair& pair = problem_.pair(first + n);
      tangents[n] = in_equations(pair.rows().tangent(problem_.derivatives(first + n)),
                                 problem_.block(pair.a()), problem_.block(pair.b()));
    });
    for (std::size_t n = 0; n < count; ++n) {
      const auto& [a, b] = problem_.places(first + n);
      if (a >= 0) matrix.add_diagonal(a, tangents[n].aa);
      if (b >= 0) matrix.add_diagonal(b, tangents[n].bb);
      if (a >= 0 && b >= 0) matrix.add_pair(a, b, tangents[n].ab);
    }
  }
  problem_.bolts().add_tangents(matrix);
  assembled_ = true;
}

void IslandTangent::prepare_factor() const {
  // Bodies have inertia in steps. Tangents of statics may be nearly singular.
  const auto precision =
      problem_.scheme().is_static() ? FactorPrecision::in_double : FactorPrecision::in_single;
  set_use(*solver_.factor, {precision, problem_.threads()});
}

FactorStatus IslandTangent::factorize_assembled(bool kept) {
  prepare_factor();
  factor_is_old_ = false;
  solver_.inertia = 0.0;
  FactorStatus status = solver_.factor->factorize(solver_.matrix.matrix());
  if (status == FactorStatus::not_positive_definite) {
    // Compressed St.-Venant-Kirchhoff blocks: a positive tangent still leads to the balance of forces.
    assemble(true);
    status = solver_.factor->factorize(solver_.matrix.matrix());
  }
  const bool is_dear = solver_.factor->cost_in_solves() > problem_.settings().iteration.old_factor_gain;
  if (kept && is_dear && status == FactorStatus::success) solver_.inertia = problem_.scheme().inertia;
  return status;
}

FactorStatus IslandTangent::factorize() {
  assemble(false);
  return factorize_assembled(false);
}

FactorStatus IslandTangent::update_factor() {
  const TimeScheme& scheme = problem_.scheme();
  factor_is_old_ = !scheme.is_static() && solver_.inertia == scheme.inertia;
  assembled_ = false;
  prepare_factor();
  if (factor_is_old_ && products_pay()) return FactorStatus::success;
  assemble(false);
  return factor_is_old_ ? FactorStatus::success : factorize_assembled(!scheme.is_static());
}

bool IslandTangent::products_pay() const {
  double to_assemble = 0.0;  // multiplications
  double product = 0.0;
  double unable = 0.0;  // bodies whose tangent is not known as a product
  for (std::size_t k = 0; k < problem_.bodies(); ++k) {
    if (!problem_.sums().owns_body(k)) continue;
    const BlockModel& model = *problem_.body(k).model;
    if (!model.tangent_turns()) unable += 1.0;
    const auto n = static_cast<double>(model.unknowns());
    to_assemble += 6.0 * n * n;  // two halves of R K R'
    product += n * n;
  }
  for (std::size_t k = 0; k < problem_.pairs(); ++k) {
    if (!problem_.sums().owns_pair(k)) continue;
    const auto unknowns = [&](int place) {
      return place < 0 ? 0.0 : static_cast<double>(problem_.body(at(place)).model->unknowns());
    };
    const double a = unknowns(problem_.places(k)[0]);
    const double b = unknowns(problem_.places(k)[1]);
    const auto points = static_cast<double>(problem_.laws()[k].size());
    to_assemble += points * 2.0 / 3.0 * (a * a + a * b + b * b);
    product += points * 2.0 * (a + b);
  }
  const std::vector<double> all = problem_.sums().sum({to_assemble, product, unable});
  return all[2] == 0.0 && all[0] > problem_.settings().iteration.old_factor_iterations * all[1];
}

void IslandTangent::add_blocks(const Eigen::VectorXd& x, Eigen::VectorXd& force) const {
  const TimeScheme& scheme = problem_.scheme();
  parallel_for(problem_.threads(), problem_.bodies(), [&](std::size_t k) {
    const BodyStep& body = problem_.body(k);
    const int offset = solver_.matrix.offset(static_cast<int>(k));
    const Eigen::VectorXd of_body = x.segment(offset, body.model->freedom());
    force.segment(offset, of_body.size()) += body.model->material().density * scheme.inertia * of_body;
    if (scheme.force_weight > 0.0 && !body.model->rigid()) {
      force.segment(offset, of_body.size()) +=
          weight_of_blocks() * body.model->tangent_times(body.elastic.rotation, of_body);
    }
    if (body.dashpots != nullptr)
      force.segment(offset, of_body.size()) += weight_of_dashpots() * (*body.dashpots * of_body);
  });
}

void IslandTangent::add_pairs(std::vector<PairProduct>& products, bool with_bolts, const Eigen::VectorXd& x,
                              Eigen::VectorXd& force) const {
  const std::vector<Eigen::VectorXd> changes = problem_.changes(x);
  const Eigen::VectorXd none;  // of fixed blocks
  const auto change_of = [&](int place) -> const Eigen::VectorXd& {
    return place < 0 ? none : changes[at(place)];
  };
  parallel_for(problem_.threads(), products.size(), [&](std::size_t k) {
    PairProduct& one = products[k];
    if (one.points.cols() == 0) return;
    const auto& [a, b] = problem_.places(k);
    one.on_a.setZero(change_of(a).size());
    one.on_b.setZero(change_of(b).size());
    problem_.pair(k).rows().add_product(one.points, change_of(a), change_of(b), one.on_a, one.on_b);
  });
  std::vector<Eigen::VectorXd> forces(problem_.bodies());  // of each body, in its unknowns
  parallel_for(problem_.threads(), forces.size(), [&](std::size_t body) {
    forces[body].setZero(changes[body].size());
    for (const std::size_t k : problem_.pairs_of(body)) {
      if (products[k].points.cols() == 0) continue;
      forces[body] += problem_.places(k)[0] == static_cast<int>(body) ? products[k].on_a : products[k].on_b;
    }
  });
  if (with_bolts) problem_.bolts().add_products(changes, forces);
  parallel_for(problem_.threads(), forces.size(), [&](std::size_t body) {
    force.segment(solver_.matrix.offset(static_cast<int>(body)), problem_.body(body).model->freedom()) +=
        problem_.body(body).in_equations(forces[body]);
  });
}

std::vector<IslandTangent::PairProduct> IslandTangent::products_of(
    const std::function<PointStiffnesses(std::size_t)>& stiffnesses) const {
  std::vector<PairProduct> products(problem_.pairs());
  parallel_for(problem_.threads(), products.size(),
               [&](std::size_t k) { products[k].points = stiffnesses(k); });
  return products;
}

std::optional<Eigen::VectorXd> IslandTangent::solve_with_old(const Eigen::VectorXd& right_side,
                                                             bool coupled) const {
  const IterationSettings& settings = problem_.settings().iteration;
  std::vector<PairProduct> products = products_of([&](std::size_t k) {
    const std::span<const PointDerivative> derivatives = problem_.derivatives(k);
    const PairRows& rows = problem_.pair(k).rows();
    PointStiffnesses points;
    if (!assembled_) points = rows.stiffnesses(derivatives);
    return coupled ? sum(std::move(points), rows.couplings(derivatives)) : points;
  });
  const auto preconditioned = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    Eigen::VectorXd force = assembled_ ? times(solver_.matrix.matrix(), x) : Eigen::VectorXd::Zero(x.size());
    if (!assembled_) add_blocks(x, force);
    add_pairs(products, !assembled_, x, force);
    return solver_.factor->solve(force, false);
  };
  const KrylovSolution found =
      gmres(preconditioned, solver_.factor->solve(right_side, false), settings.krylov_tolerance,
            settings.old_factor_iterations, KrylovEnd::if_slow, inner_products());
  if (!found.converged) return std::nullopt;
  const bool has_bodies = problem_.sums().shared() || right_side.size() > 0;
  if (has_bodies && !(problem_.dot(right_side, found.x) > 0.0)) return std::nullopt;
  return found.x;
}

InnerProducts IslandTangent::inner_products() const {
  if (!problem_.sums().shared()) return {};
  return [this](const Eigen::Ref<const Eigen::MatrixXd>& columns, const Eigen::VectorXd& x) {
    return problem_.sums().dot(columns, x);
  };
}

Eigen::VectorXd IslandTangent::solve(const Eigen::VectorXd& right_side, bool coupled) {
  if (factor_is_old_) {
    if (std::optional<Eigen::VectorXd> found = solve_with_old(right_side, coupled)) return *std::move(found);
    if (!assembled_) assemble(false);
    if (factorize_assembled(true) != FactorStatus::success)
      return Eigen::VectorXd::Constant(right_side.size(), std::numeric_limits<double>::quiet_NaN());
  }
  std::vector<PairProduct> couplings;
  if (coupled)
    couplings = products_of(
        [&](std::size_t k) { return problem_.pair(k).rows().couplings(problem_.derivatives(k)); });
  const bool any = std::any_of(couplings.begin(), couplings.end(),
                               [](const PairProduct& one) { return one.points.cols() > 0; });
  if (!problem_.sums().any(any)) return solver_.factor->solve(right_side);
  const auto with_couplings = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
    add_pairs(couplings, false, x, force);
    return x + solver_.factor->solve(force, false);
  };
  const IterationSettings& settings = problem_.settings().iteration;
  return gmres(with_couplings, solver_.factor->solve(right_side), settings.krylov_tolerance,
               settings.krylov_iterations, KrylovEnd::after_all, inner_products())
      .x;
}

}  // namespace ashlar
