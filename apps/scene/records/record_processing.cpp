#include "apps/scene/records/record_processing.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ashlar {

void remove_baseline(std::vector<std::vector<double>>& rows, int order) {
  const double middle = 0.5 * (rows.front()[0] + rows.back()[0]);
  const double half = std::max(0.5 * (rows.back()[0] - rows.front()[0]), std::numeric_limits<double>::min());
  const auto count = static_cast<Eigen::Index>(rows.size());
  const auto width = static_cast<Eigen::Index>(rows.front().size()) - 1;
  Eigen::MatrixXd powers(count, order + 1), values(count, width);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::vector<double>& row = rows[static_cast<std::size_t>(k)];
    double power = 1.0;
    for (Eigen::Index n = 0; n <= order; ++n, power *= (row[0] - middle) / half) powers(k, n) = power;
    for (Eigen::Index j = 0; j < width; ++j) values(k, j) = row[static_cast<std::size_t>(j) + 1];
  }
  values -= powers * powers.householderQr().solve(values);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index j = 0; j < width; ++j)
      rows[static_cast<std::size_t>(k)][static_cast<std::size_t>(j) + 1] = values(k, j);
}

std::vector<std::vector<double>> resampled(const std::vector<std::vector<double>>& rows, double interval) {
  const double first = rows.front()[0], last = rows.back()[0];
  std::vector<std::vector<double>> result;
  std::size_t segment = 0;
  for (double k = 0.0; first + k * interval < last; ++k) {
    const double time = first + k * interval;
    while (rows[segment + 1][0] <= time) ++segment;
    const std::vector<double>&before = rows[segment], &after = rows[segment + 1];
    const double share = (time - before[0]) / (after[0] - before[0]);
    std::vector<double> row = {time};
    for (std::size_t j = 1; j < before.size(); ++j)
      row.push_back(share == 0.0 ? before[j] : (1.0 - share) * before[j] + share * after[j]);
    result.push_back(std::move(row));
  }
  result.push_back(rows.back());
  return result;
}

}  // namespace ashlar
