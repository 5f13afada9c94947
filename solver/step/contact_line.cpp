#include "solver/step/contact_line.hpp"

#include <numeric>

#include "solver/parallel_for.hpp"

namespace ashlar {

ContactLine::ContactLine(const IslandProblem& problem, const Eigen::VectorXd& change, double share)
    : problem_(problem), lines_(problem.pairs()) {
  const std::vector<Eigen::VectorXd> changes = problem.changes(change);
  parallel_for(problem.threads(), problem.pairs(), [&](std::size_t k) {
    const ContactPair& pair = problem.pair(k);
    PairLine& line = lines_[k];
    line.way = problem.motion(k, changes);
    line.start =
        pair.places(problem.block(pair.a()).change, problem.block(pair.b()).change) - share * line.way;
  });
}

double ContactLine::work(double share) const {
  const bool averaged = problem_.scheme().mean_contacts;
  std::vector<double> by_pair(lines_.size(), 0.0);
  parallel_for(problem_.threads(), lines_.size(), [&](std::size_t k) {
    const auto& [start, way] = lines_[k];
    const std::vector<PointLaw>& laws = problem_.laws()[k];
    for (std::size_t point = 0; point < laws.size(); ++point) {
      const auto column = static_cast<Eigen::Index>(point);
      const Eigen::Vector3d place = start.col(column) + share * way.col(column);
      by_pair[k] +=
          problem_.pair(k).respond(point, place, averaged, laws[point]).mean.force.dot(way.col(column));
    }
  });
  return std::accumulate(by_pair.begin(), by_pair.end(), 0.0);
}

}  // namespace ashlar
