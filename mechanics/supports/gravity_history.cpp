#include "mechanics/supports/gravity_history.hpp"

#include <algorithm>

#include "mechanics/supports/linear_rows.hpp"

namespace ashlar {

Vector3 GravityHistory::at(double time) const {
  return linear_between_rows(times, values, time);
}

bool GravityHistory::changes_between(double start, double end) const {
  return rows_change_between(times, start, end);
}

double GravityHistory::largest() const {
  // Between two rows its norm does not exceed the larger one.
  double most = 0.0;
  for (const Vector3& value : values) most = std::max(most, value.norm());
  return most;
}

}  // namespace ashlar
