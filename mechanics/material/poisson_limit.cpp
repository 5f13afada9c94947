#include "mechanics/material/poisson_limit.hpp"

#include <limits>

namespace ashlar {

// With p functions, the false pressure of rounded coefficients is at most  4 p eps lambda
// (notes/poisson_limit.md); it has to stay below `share` of  E `strain`. Near 0.5,  lambda / E = 1 / (3 (1 -
// 2 nu)).
double largest_poisson_ratio(int order) {
  constexpr double eps = 0.5 * std::numeric_limits<double>::epsilon();
  constexpr double strain = 1e-6, share = 1e-2;
  const double functions = (order + 1.0) * (order + 2.0) * (order + 3.0) / 6.0;
  const double most_lambda = share * strain / (4.0 * functions * eps);
  return 0.5 - 0.5 / (3.0 * most_lambda);
}

}  // namespace ashlar
