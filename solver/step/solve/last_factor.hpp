// Reuse of a factor in the iteration of contact (open_close.hpp): a factor costs more than the solutions with it.
#pragma once

#include <limits>
#include <utility>

namespace ashlar {

/// Decides whether the last factor is used for another residual.
class LastFactor {
 public:
  /// @param rows_updated since the factor, otherwise a new one begins
  explicit LastFactor(bool rows_updated)
      : last_(rows_updated ? std::numeric_limits<double>::infinity() : 0.0) {}

  /// @param as_before the states are those of the factor. @param nearly_converged residual from which one more use is enough
  [[nodiscard]] bool is_good_enough(double residual, bool as_before, double nearly_converged) {
    // Updated rows differ little: the last factor is used while it reduces the residual by nine tenths each time.
    constexpr double most_of_it = 0.1;
    // With unchanged states, a system that has reduced the residual so far will do so again.
    constexpr double nearly_all = 1e-2;
    const bool falls = residual < most_of_it * last_;
    last_ = falls ? residual : 0.0;
    const double before = std::exchange(before_, residual);
    const bool contracts = as_before && residual < nearly_all * before;
    used_again_ = falls || contracts || (as_before && !used_again_ && residual <= nearly_converged);
    return used_again_;
  }

 private:
  double before_ = 0.0;  ///< residual
  double last_;          ///< the same, while each use of the factor reduces it enough; 0: it did not
  bool used_again_ = false;
};

}  // namespace ashlar
