#include "apps/results/frames/frame_precision.hpp"

#include <algorithm>
#include <limits>

namespace ashlar {
namespace {

constexpr double most_shift = 1e-4;  // of the smallest block's size
/// Rounding to single precision changes a number by at most this share.
constexpr double rounding = std::numeric_limits<float>::epsilon() / 2.0;

}  // namespace

FramePrecision frame_precision(const SceneOutput& output, const std::vector<BlockModel>& blocks,
                               const Vector3& origin) {
  const bool automatic = output.precision == SceneOutput::Precision::automatic;
  if (output.precision == SceneOutput::Precision::of_double ||
      (automatic && output.format == SceneOutput::Format::vtu))
    return {};
  FramePrecision precision{StoredReal::float32, StoredReal::float64};
  double farthest = 0.0, smallest = std::numeric_limits<double>::infinity();
  for (const BlockModel& block : blocks) {
    if (block.incremental() != nullptr) return precision;
    smallest = std::min(smallest, block.size());
    for (const Vector3& point : block.solid().mesh().points)
      farthest = std::max(farthest, (origin + point).cwiseAbs().maxCoeff());
  }
  if (rounding * farthest <= most_shift * smallest) precision.places = StoredReal::float32;
  return precision;
}

void set_precision(UnstructuredGrid& grid, const std::string& series, const FramePrecision& precision) {
  const bool of_blocks = series == "blocks" || series == "surfaces";
  grid.stored_points = of_blocks ? StoredReal::float64 : precision.places;
  for (auto* data : {&grid.point_data, &grid.cell_data})
    for (DataArray& array : *data) array.stored = precision.fields;
}

}  // namespace ashlar
