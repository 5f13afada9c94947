#include "mechanics/contact/laws/crushed_point.hpp"

#include <algorithm>

namespace ashlar {

void set_mean_crushing(const PointLaw& law, double start, double end, MeanResponse& mean) {
  const auto force = [&](double gap) {
    const double normal = -law.normal_stiffness * gap;
    return std::min(law.tension > 0.0 ? normal : std::max(normal, 0.0), law.crushing);
  };
  const auto [low, high] = std::minmax(start, end);
  double sum = 0.0, last = low;
  for (const double kink : {-law.crushing / law.normal_stiffness, 0.0}) {
    if (!(kink > last && kink < high)) continue;
    sum += 0.5 * (force(last) + force(kink)) * (kink - last);
    last = kink;
  }
  const double at_end = force(end);
  if (last > low) {
    sum += 0.5 * (force(last) + force(high)) * (high - last);
    mean.force[0] = sum / (high - low);
    mean.tangent(0, 0) = (mean.force[0] - at_end) / (end - start);
    return;
  }
  mean.force[0] = 0.5 * (force(start) + at_end);
  const bool elastic = at_end < law.crushing && (at_end > 0.0 || law.tension > 0.0);
  mean.tangent(0, 0) = elastic ? 0.5 * law.normal_stiffness : 0.0;
}

}  // namespace ashlar
