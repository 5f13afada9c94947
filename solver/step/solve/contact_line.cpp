#include "solver/step/solve/contact_line.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/index.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {

ContactLine::ContactLine(const IslandProblem& problem, const Eigen::VectorXd& change, double share)
    : problem_(problem), lines_(problem.pairs()) {
  const std::vector<Eigen::VectorXd> changes = problem.changes(change);
  parallel_for(problem.threads(), problem.pairs(), [&](std::size_t k) {
    const ContactPair& pair = problem.pair(k);
    PairLine& line = lines_[k];
    line.whole = problem.motion(k, changes);
    line.start =
        pair.places(problem.block(pair.a()).change, problem.block(pair.b()).change) - share * line.whole;
  });
  const IslandBolts& bolts = problem.bolts();
  for (std::size_t k = 0; k < bolts.size(); ++k) {
    const Eigen::VectorXd whole = bolts.bolt(k).motion(bolts.changes(k, changes));
    bolts_.push_back({bolts.bolt(k).deformation(bolts.changes(k)) - share * whole, whole});
  }
}

bool ContactLine::owns_bolt(std::size_t k) const {
  const std::vector<int>& places = problem_.bolts().places(k);
  const auto body = std::find_if(places.begin(), places.end(), [](int place) { return place >= 0; });
  return body != places.end() && problem_.sums().owns_body(at(*body));
}

double ContactLine::work(double share) const {
  const bool averaged = problem_.scheme().mean_contacts;
  std::vector<double> by_pair(lines_.size(), 0.0);
  parallel_for(problem_.threads(), lines_.size(), [&](std::size_t k) {
    const auto& [start, whole] = lines_[k];
    if (!problem_.sums().owns_pair(k)) return;
    const std::vector<PointLaw>& laws = problem_.laws()[k];
    const std::span<const FrequentLaw> frequent = problem_.frequent_laws(k);
    for (std::size_t point = 0; point < laws.size(); ++point) {
      const auto column = static_cast<Eigen::Index>(point);
      const Eigen::Vector3d place = start.col(column) + share * whole.col(column);
      const Eigen::Vector3d force =
          frequent.empty() ? problem_.pair(k).respond(point, place, averaged, laws[point]).mean.force
                           : point_force(frequent[point], place[0], place.tail<2>()).force;
      by_pair[k] += force.dot(whole.col(column));
    }
  });
  double of_bolts = 0.0;
  for (std::size_t k = 0; k < bolts_.size(); ++k) {
    if (!owns_bolt(k)) continue;
    of_bolts -= problem_.bolts()
                    .bolt(k)
                    .force(bolts_[k].start + share * bolts_[k].whole, averaged)
                    .dot(bolts_[k].whole);
  }
  return problem_.sums().sum(std::accumulate(by_pair.begin(), by_pair.end(), of_bolts));
}

}  // namespace ashlar
