#include "benchmarks/studies/sub_face_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "geometry/solid/shapes.hpp"
#include "geometry/subfaces/sub_face_refinement.hpp"

namespace ashlar {
namespace {

constexpr int least_order = 2;
constexpr int most_order = 8;
constexpr double arc_radius = 5.0;     ///< m, of the bent middle plane
constexpr double twist = 0.02;         ///< 1/m
constexpr int samples_along_side = 8;  ///< along each side of a sub-face
/// The ratio of bound and error is required where the error is below this share of the block's length.
constexpr double small_error = 1e-3;
constexpr double promised_ratio = 3.0;

/// sin(t) or cos(t) as a polynomial of a degree.
double truncated(bool sine, double t, int degree) {
  double sum = 0.0;
  double term = 1.0;
  for (int k = 0; k <= degree; ++k) {
    if (k > 0) term *= t / k;
    if ((k % 2 == 1) == sine) sum += (k / 2) % 2 == 0 ? term : -term;
  }
  return sum;
}

/// The bent and twisted place of a material point: a polynomial of the given order in it.
Vector3 bent_place(const Vector3& x, int order) {
  const double angle = x.x() / arc_radius;
  return {arc_radius * truncated(true, angle, order) + x.z() * truncated(true, angle, order - 1), x.y(),
          arc_radius * (truncated(false, angle, order) - 1.0) + x.z() * truncated(false, angle, order - 1) +
              twist * x.x() * x.y()};
}

struct Measured {
  double error = 0.0;
  double bound = 0.0;
  double least_margin = std::numeric_limits<double>::infinity();  ///< bound less error of any sub-face
};

Measured measure(const AdaptiveSurface& surface) {
  Measured measured;
  for (std::size_t cell = 0; cell < surface.cell_shapes().size(); ++cell) {
    const auto& rim = surface.surface().cells[cell].rim;
    const double error = sampled_chord_error(surface.patch(static_cast<int>(cell)),
                                             {rim[0] >= 0, rim[1] >= 0, rim[2] >= 0}, samples_along_side);
    const double bound = surface.cell_shapes()[cell].chord_bound;
    measured.error = std::max(measured.error, error);
    measured.bound = std::max(measured.bound, bound);
    measured.least_margin = std::min(measured.least_margin, bound - error);
  }
  return measured;
}

}  // namespace

StudyResult study_sub_faces() {
  const Vector3 high(8, 3, 1);
  const Polyhedron solid(make_box({0, 0, 0}, high));
  const std::vector<Box> everywhere = {{Vector3::Constant(-1e3), Vector3::Constant(1e3)}};
  StudyResult result;
  result.columns = {"order", "tolerance", "sub_faces", "chord_error", "chord_bound", "ratio", "seconds"};
  result.plot = {
      "Chord error of sub-faces (lines) and its certified bound (dashed)", "sub-faces", "chord error, m", {}};
  double worst_ratio = 0.0;
  bool below = false;
  for (int order = least_order; order <= most_order; ++order) {
    PlotSeries errors{fmt::format("n = {}", order), {}, {}};
    PlotSeries bounds{"bound", {}, {}, true, true, true};
    for (const double tolerance : {0.3, 0.1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4}) {
      AdaptiveSurface surface(solid, order, 0);
      Eigen::Matrix3Xd values(3, static_cast<Eigen::Index>(surface.domain_points().size()));
      for (Eigen::Index k = 0; k < values.cols(); ++k)
        values.col(k) = bent_place(surface.domain_points()[static_cast<std::size_t>(k)], order);
      const auto start = std::chrono::steady_clock::now();
      surface.move(values);
      (void)surface.divide({tolerance, everywhere});
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const Measured measured = measure(surface);
      const auto count = static_cast<double>(surface.surface().cells.size());
      result.rows.push_back({static_cast<double>(order), tolerance, count, measured.error, measured.bound,
                             measured.bound / measured.error, seconds});
      errors.x.push_back(count);
      errors.y.push_back(measured.error);
      bounds.x.push_back(count);
      bounds.y.push_back(measured.bound);
      if (measured.error < small_error * high.x())
        worst_ratio = std::max(worst_ratio, measured.bound / measured.error);
      below = below || measured.least_margin < 0.0;
    }
    result.plot.series.push_back(std::move(errors));
    result.plot.series.push_back(std::move(bounds));
  }
  result.findings.push_back(below ? "The bound is BELOW the error of a sub-face."
                                  : "The bound is nowhere below the error sampled on a sub-face.");
  result.findings.push_back(
      fmt::format("Bound over error, where the error is below {} of the length: {:.2f} at "
                  "most (promised: {}).",
                  small_error, worst_ratio, promised_ratio));
  result.holds = !below && worst_ratio <= promised_ratio;
  return result;
}

}  // namespace ashlar
