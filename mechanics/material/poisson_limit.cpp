#include "mechanics/material/poisson_limit.hpp"

#include <limits>

namespace ashlar {
namespace {

constexpr double unit_rounding = 0.5 * std::numeric_limits<double>::epsilon();
/// Strain whose stress a false pressure must not blur, and its share that it may have: larger values allow ratios nearer to
/// 0.5, with stresses less exact.
constexpr double resolved_strain = 1e-6, blurred_share = 1e-2;

}  // namespace

// With p functions, the false pressure of rounded coefficients is at most  4 p eps lambda, eps the unit rounding
// (notes/poisson_limit.md); it has to stay below `blurred_share` of  E `resolved_strain`. Near 0.5,  lambda / E = 1 / (3 (1 -
// 2 nu)).
double largest_poisson_ratio(int order) {
  const double functions = (order + 1.0) * (order + 2.0) * (order + 3.0) / 6.0;
  const double most_lambda = blurred_share * resolved_strain / (4.0 * functions * unit_rounding);
  return 0.5 - 0.5 / (3.0 * most_lambda);
}

}  // namespace ashlar
