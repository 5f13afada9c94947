#include "apps/program/study/orders_study.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "apps/program/study/error_time_problems.hpp"
#include "apps/program/verify/verification_blocks.hpp"
#include "mechanics/basis/quadrature.hpp"

namespace ashlar {
namespace {

class Clock {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct Solved {
  int unknowns;
  double error;
  double seconds;
};

/// Reference tip deflection of the converged cantilever, 8 by 1 by 3 with the long side of its section vertical,
/// computed independently of this program.
constexpr double converged_tip = -2.7131353e-3;

BlockDefinition cantilever(int order) {
  BlockDefinition definition =
      define_block(Polyhedron(make_box({0, -0.5, -1.5}, {8, 0.5, 1.5})), {3600, 1e10, 0.2}, order);
  definition.supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
  return definition;
}

const Vector3 tip_of_cantilever(8, 0, 0);

Solved solve_cantilever(int order) {
  const Clock clock;
  const BlockModel block(cantilever(order));
  const auto position = block.equilibrium({0, 0, -9.81}, 0.0);
  if (!position) throw std::runtime_error("the cantilever is not held");
  const double tip = displacement(block, *position, tip_of_cantilever).z();
  return {block.unknowns(), std::abs(tip / converged_tip - 1.0), clock.seconds()};
}

/// u_i = (constant_i + slope_i . X + X' curvature_i X / 2) exp(rate . X), with derivatives by hand.
struct SmoothField {
  Vector3 rate{0.6, -0.5, 0.4};
  Vector3 constant{0.3, -0.2, 0.5};
  Eigen::Matrix3d slope = (Eigen::Matrix3d() << 1.0, 0.4, -0.3, 0.2, -0.8, 0.5, -0.6, 0.7, 0.9).finished();
  std::array<Eigen::Matrix3d, 3> curvature = {
      (Eigen::Matrix3d() << 0.5, 0.2, 0.0, 0.2, -0.4, 0.3, 0.0, 0.3, 0.6).finished(),
      (Eigen::Matrix3d() << -0.3, 0.1, 0.4, 0.1, 0.7, -0.2, 0.4, -0.2, 0.2).finished(),
      (Eigen::Matrix3d() << 0.4, -0.5, 0.1, -0.5, 0.3, 0.2, 0.1, 0.2, -0.6).finished()};

  /// Row i: gradient of u_i.
  [[nodiscard]] Eigen::Matrix3d gradient(const Vector3& x) const {
    Eigen::Matrix3d result;
    for (int i = 0; i < 3; ++i)
      result.row(i) = (polynomial_gradient(i, x) + polynomial(i, x) * rate) * std::exp(rate.dot(x));
    return result;
  }
  /// Second derivatives of u_i.
  [[nodiscard]] Eigen::Matrix3d hessian(int i, const Vector3& x) const {
    const Vector3 g = polynomial_gradient(i, x);
    return (curvature[static_cast<std::size_t>(i)] + g * rate.transpose() + rate * g.transpose() +
            polynomial(i, x) * rate * rate.transpose()) *
           std::exp(rate.dot(x));
  }

 private:
  [[nodiscard]] double polynomial(int i, const Vector3& x) const {
    return constant[i] + slope.row(i).dot(x) + 0.5 * x.dot(curvature[static_cast<std::size_t>(i)] * x);
  }
  [[nodiscard]] Vector3 polynomial_gradient(int i, const Vector3& x) const {
    return slope.row(i).transpose() + curvature[static_cast<std::size_t>(i)] * x;
  }
};

/// -div sigma: the body force in equilibrium with a field.
Vector3 body_force(const SmoothField& field, const Material& material, const Vector3& x) {
  Vector3 force = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Matrix3d second = field.hessian(i, x);
    force -= (material.lame_lambda() + material.lame_mu()) * second.row(i).transpose();
    force[i] -= material.lame_mu() * second.trace();
  }
  return force;
}

Eigen::Matrix3d stress_of(const Eigen::Matrix3d& gradient, const Material& material) {
  return linear_stress(material, gradient, Eigen::Matrix3d::Identity());
}

/// Calls a function with every batch of points, its basis values (#batch, p) and its first index.
template <class Use>
void for_batches(const PolynomialBasis& basis, const std::vector<Vector3>& points, Use use) {
  constexpr std::size_t batch = 2048;
  for (std::size_t start = 0; start < points.size(); start += batch) {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(start);
    const std::vector<Vector3> some(
        first, first + static_cast<std::ptrdiff_t>(std::min(batch, points.size() - start)));
    use(some, basis.values(some), start);
  }
}

/// Work of body force and tractions on the basis functions. @return (p, 3)
Eigen::MatrixX3d load_of(const SmoothField& field, const BlockModel& block, const VolumeRule& inside,
                         int degree) {
  Eigen::MatrixX3d load = Eigen::MatrixX3d::Zero(block.basis().size(), 3);
  for_batches(block.basis(), inside.points,
              [&](const std::vector<Vector3>& points, const Eigen::MatrixXd& phi, std::size_t start) {
                Eigen::MatrixX3d forces(phi.rows(), 3);
                for (std::size_t k = 0; k < points.size(); ++k) {
                  forces.row(static_cast<Eigen::Index>(k)) =
                      inside.weights[start + k] * body_force(field, block.material(), points[k]);
                }
                load += phi.transpose() * forces;
              });
  for (std::size_t f = 0; f < block.solid().faces().size(); ++f) {
    const SurfaceRule rim = surface_rule(block.solid(), {static_cast<int>(f)}, degree);
    const Eigen::MatrixXd phi = block.basis().values(rim.points);
    Eigen::MatrixX3d tractions(phi.rows(), 3);
    for (std::size_t k = 0; k < rim.points.size(); ++k) {
      tractions.row(static_cast<Eigen::Index>(k)) =
          rim.weights[k] * stress_of(field.gradient(rim.points[k]), block.material()) *
          block.solid().faces()[f].normal;
    }
    load += phi.transpose() * tractions;
  }
  return load;
}

/// Solves K d = f for a free block, f balanced: adds stiffness to rigid motions.
Eigen::MatrixX3d solve_free(const BlockModel& block, const Eigen::MatrixX3d& load) {
  const Eigen::Index p = block.basis().size();
  Eigen::MatrixXd stiffness = elastic_stiffness(block.basis(), block.material());
  const Eigen::MatrixXd rigid = block.basis().rigid_motions(1.0).colwise().normalized();
  stiffness += stiffness.diagonal().mean() * rigid * rigid.transpose();
  const Eigen::LLT<Eigen::MatrixXd> factor(stiffness);
  Eigen::MatrixX3d solution(p, 3);
  Eigen::Map<Eigen::VectorXd>(solution.data(), 3 * p) =
      factor.solve(Eigen::Map<const Eigen::VectorXd>(load.data(), 3 * p));
  return solution;
}

/// Relative error in the energy norm.
double energy_error(const SmoothField& field, const BlockModel& block, const Eigen::MatrixX3d& solution,
                    const VolumeRule& inside) {
  std::array<Eigen::MatrixX3d, 3> derivative;  // of the solution by X_j, as coefficients
  for (int j = 0; j < 3; ++j)
    derivative[static_cast<std::size_t>(j)] = block.basis().derivative(j).transpose() * solution;
  double wrong = 0.0;
  double all = 0.0;
  for_batches(block.basis(), inside.points,
              [&](const std::vector<Vector3>& points, const Eigen::MatrixXd& phi, std::size_t start) {
                std::array<Eigen::MatrixX3d, 3> slopes;
                for (std::size_t j = 0; j < 3; ++j) slopes[j] = phi * derivative[j];
                for (std::size_t k = 0; k < points.size(); ++k) {
                  const Eigen::Matrix3d exact = field.gradient(points[k]);
                  Eigen::Matrix3d difference = exact;
                  for (int j = 0; j < 3; ++j)
                    difference.col(j) -=
                        slopes[static_cast<std::size_t>(j)].row(static_cast<Eigen::Index>(k));
                  const double weight = inside.weights[start + k];
                  wrong += weight * stress_of(difference, block.material()).cwiseProduct(difference).sum();
                  all += weight * stress_of(exact, block.material()).cwiseProduct(exact).sum();
                }
              });
  return std::sqrt(std::abs(wrong) / all);
}

Solved solve_smooth(int order) {
  const SmoothField field;
  const int degree = 2 * order + 10;
  const Clock clock;
  const BlockModel block(define_block(notched_block(), {2000, 1e9, 0.25}, order));
  const VolumeRule inside = volume_rule(block.solid().mesh(), block.basis().centroid(), degree);
  const Eigen::MatrixX3d solution = solve_free(block, load_of(field, block, inside, degree));
  const double seconds = clock.seconds();
  return {3 * block.basis().size(), energy_error(field, block, solution, inside), seconds};
}

}  // namespace

double cantilever_error(const ErrorTimeSetting& setting) {
  const GoalValues tip = [](const Simulation& now) {
    return std::vector<Goal>{
        {"tip", {displacement(now.blocks()[0], now.states()[0].position, tip_of_cantilever).z()}}};
  };
  return error_in_equilibrium(lone_block(cantilever(setting.accuracy > 0.0 ? 1 : setting.order), {}, {}), tip,
                              converged_tip, setting);
}

StudyResult study_orders() {
  return study_orders_to(PolynomialBasis::max_order);
}

StudyResult study_orders_to(int most_order) {
  StudyResult result;
  result.columns = {"problem", "order", "unknowns", "error", "seconds"};
  result.plot = {"Error of one block against its unknowns, n = 1, 2, ...", "unknowns", "relative error", {}};
  PlotSeries cantilever{"clamped cantilever", {}, {}};
  PlotSeries smooth{"smooth field", {}, {}};
  for (int order = 1; order <= most_order; ++order) {
    int problem = 0;
    for (auto* series : {&cantilever, &smooth}) {
      const Solved solved = problem == 0 ? solve_cantilever(order) : solve_smooth(order);
      ++problem;
      result.rows.push_back({static_cast<double>(problem), static_cast<double>(order),
                             static_cast<double>(solved.unknowns), solved.error, solved.seconds});
      series->x.push_back(solved.unknowns);
      series->y.push_back(solved.error);
    }
  }
  std::stable_sort(result.rows.begin(), result.rows.end(),
                   [](const auto& a, const auto& b) { return a[0] < b[0]; });
  const double least = smooth.y.back();
  const double factor = std::pow(least / smooth.y[smooth.y.size() - 5], 0.25);
  result.findings.push_back(
      fmt::format("Problem 2, a smooth displacement on a block that is not convex: each order more leaves "
                  "{:.3f} of the error; "
                  "{:.1e} at n = {} (promised: 1e-9). That is exponential convergence.",
                  factor, least, most_order));
  result.findings.push_back(
      fmt::format("Problem 1, the clamped cantilever: algebraic, error ~ unknowns^{:.2f}. Along the clamped "
                  "edges the stress of the "
                  "true solution is singular (nu > 0 keeps the section from shrinking there), and "
                  "polynomials of one block cannot "
                  "follow it faster.",
                  last_slope(cantilever, 5)));
  result.plot.series = {std::move(cantilever), std::move(smooth)};
  result.holds = most_order < PolynomialBasis::max_order || least <= 1e-9;
  return result;
}

}  // namespace ashlar
