#include "benchmarks/studies/conditioning_study.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/program/verify/verification_blocks.hpp"
#include "apps/program/verify/verification_values.hpp"
#include "mechanics/basis/monomial_basis.hpp"

namespace ashlar {
namespace {

const Material cantilever_rock{3600, 1e9, 0.2};
constexpr int digits_of_a_double = 16;
constexpr std::array<const char*, 4> basis_names = {"global", "centred", "scaled", "orthonormal"};

Polyhedron cantilever_at(double distance) {
  return Polyhedron(make_box({distance, -1.5, -0.5}, {distance + 8, 1.5, 0.5}));
}

/// The matrices of one basis for a clamped block.
struct Matrices {
  Eigen::MatrixXd gram;
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd integrals;
  Eigen::MatrixXd clamp;      ///< values at points of the clamped face
  Eigen::RowVectorXd at_tip;  ///< values at the tip
};

struct SolvedSystem {
  double mass_condition;
  double stiffness_condition;
  double deflection;
};

double condition(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues()[0];
  const double most = solver.eigenvalues()[matrix.rows() - 1];
  // A matrix that is singular or indefinite by rounding has an infinite condition number.
  return least > 0.0 ? most / least : std::numeric_limits<double>::infinity();
}

/// Null space of the clamp for one component, as in supports.cpp.
Eigen::MatrixXd free_motions(const Eigen::MatrixXd& clamp) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(clamp.transpose());
  qr.setThreshold(1e-10);
  const Eigen::Index p = clamp.cols();
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(p, p);
  return q.rightCols(p - qr.rank());
}

SolvedSystem solve(const Matrices& matrices) {
  const Eigen::Index p = matrices.gram.rows();
  const Eigen::MatrixXd motions = free_motions(matrices.clamp);
  const Eigen::Index m = motions.cols();
  Eigen::MatrixXd stiffness(3 * m, 3 * m);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      stiffness.block(i * m, j * m, m, m) =
          motions.transpose() * matrices.stiffness.block(i * p, j * p, p, p) * motions;
    }
  }
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * m);
  load.tail(m) = -cantilever_rock.density * earth_gravity * motions.transpose() * matrices.integrals;
  const Eigen::VectorXd y = stiffness.ldlt().solve(load);
  return {condition(matrices.gram), condition(stiffness), (matrices.at_tip * motions).dot(y.tail(m))};
}

std::vector<Vector3> clamp_points(const Polyhedron& solid, double distance, int order) {
  const Plane plane{{distance, 0, 0}, {1, 0, 0}};
  return surface_rule(solid, faces_in_plane(solid, plane), 2 * order).points;
}

Matrices monomial_matrices(double distance, int order, MonomialOrigin origin) {
  const Polyhedron solid = cantilever_at(distance);
  const MonomialBasis basis(solid, order, origin);
  return {basis.gram(), basis.stiffness(cantilever_rock), basis.integrals(),
          basis.values(clamp_points(solid, distance, order)),
          basis.values({Vector3(distance + 8, 0, 0)}).row(0)};
}

Matrices orthonormal_matrices(double distance, int order) {
  const Polyhedron solid = cantilever_at(distance);
  const PolynomialBasis basis(solid, order);
  Eigen::VectorXd integrals = Eigen::VectorXd::Zero(basis.size());
  integrals[0] = std::sqrt(basis.volume());
  return {Eigen::MatrixXd::Identity(basis.size(), basis.size()), elastic_stiffness(basis, cantilever_rock),
          integrals, basis.values(clamp_points(solid, distance, order)),
          basis.values(Vector3(distance + 8, 0, 0)).transpose()};
}

double digits_lost(double value, double reference) {
  const double error = std::abs(value / reference - 1.0);
  if (!std::isfinite(error)) return digits_of_a_double;
  return std::clamp(digits_of_a_double + std::log10(std::max(error, 1e-16)), 0.0, 1.0 * digits_of_a_double);
}

}  // namespace

StudyResult study_conditioning() {
  return study_conditioning_to(8);
}

StudyResult study_conditioning_to(int most_order) {
  StudyResult result;
  result.columns = {"basis", "half_widths", "order", "condition_mass", "condition_stiffness", "digits_lost"};
  result.plot = {"Condition of the mass matrix, block at 0 and 10 half-widths (dashed)",
                 "order",
                 "condition",
                 {},
                 false};
  constexpr double half_width = 4.0;
  double worst_orthonormal = 0.0;
  double worst_paper = 0.0;
  // The orthonormal basis at the origin is the reference; its own error appears at the other places.
  std::vector<double> references;
  for (int order = 1; order <= most_order; ++order)
    references.push_back(solve(orthonormal_matrices(-half_width, order)).deflection);
  for (int kind = 0; kind < 4; ++kind) {
    for (const double half_widths : {0.0, 10.0, 1000.0}) {
      PlotSeries series{fmt::format("{}, {}", basis_names[static_cast<std::size_t>(kind)], half_widths),
                        {},
                        {},
                        half_widths > 0.0,
                        half_widths > 0.0};
      for (int order = 1; order <= most_order; ++order) {
        const double distance = half_widths * half_width - half_width;
        const SolvedSystem outcome =
            solve(kind == 3 ? orthonormal_matrices(distance, order)
                            : monomial_matrices(distance, order, static_cast<MonomialOrigin>(kind)));
        const double lost = digits_lost(outcome.deflection, references[static_cast<std::size_t>(order) - 1]);
        result.rows.push_back({static_cast<double>(kind), half_widths, static_cast<double>(order),
                               outcome.mass_condition, outcome.stiffness_condition, lost});
        series.x.push_back(order);
        series.y.push_back(outcome.mass_condition);
        if (kind == 3) worst_orthonormal = std::max(worst_orthonormal, lost);
        if (kind == 0 && half_widths == 10.0) worst_paper = std::max(worst_paper, lost);
      }
      if (half_widths < 1000.0) result.plot.series.push_back(std::move(series));
    }
  }
  result.findings.push_back(
      fmt::format("Orthonormal: {:.1f} digits lost at most, wherever the block is. Monomials of the global "
                  "coordinates, ten "
                  "half-widths off the origin: {:.1f} of 16.",
                  worst_orthonormal, worst_paper));
  result.findings.emplace_back(
      "basis: 0 global, 1 centred, 2 scaled monomials, 3 orthonormal; inf: rounding has made the matrix "
      "indefinite.");
  return result;
}

}  // namespace ashlar
