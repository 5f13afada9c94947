#include "apps/program/verify/cases/placed_rows.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <utility>

namespace ashlar {
namespace {

/// A row whose components of one quantity follow each other.
class PlacedRow {
 public:
  explicit PlacedRow(std::vector<double>& values) : values_(values) {}

  [[nodiscard]] Vector3 vector(std::size_t k) const { return {values_[k], values_[k + 1], values_[k + 2]}; }
  void set(std::size_t k, const Vector3& vector) {
    std::copy(vector.begin(), vector.end(), values_.begin() + static_cast<std::ptrdiff_t>(k));
  }
  /// xx, yy, zz, xy, yz, xz.
  [[nodiscard]] Eigen::Matrix3d tensor(std::size_t k) const {
    const double* s = &values_[k];
    return (Eigen::Matrix3d() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished();
  }
  void set(std::size_t k, const Eigen::Matrix3d& tensor) {
    set(k, Vector3(tensor.diagonal()));
    set(k + 3, Vector3(tensor(0, 1), tensor(1, 2), tensor(0, 2)));
  }

 private:
  std::vector<double>& values_;
};

}  // namespace

std::vector<std::vector<double>> turned_back(const std::vector<Column>& columns,
                                             std::vector<std::vector<double>> rows,
                                             const Placement& placement, const Vector3& center) {
  const auto found = [&](const char* name) {
    const auto at = std::find_if(columns.begin(), columns.end(),
                                 [&](const Column& column) { return column.name == name; });
    return static_cast<std::size_t>(at - columns.begin());
  };
  const std::size_t momentum = found("momentum.x"), angular = found("angular_momentum.x");
  for (std::vector<double>& values : rows) {
    PlacedRow row(values);
    if (angular < columns.size())
      row.set(angular, Vector3(row.vector(angular) - center.cross(row.vector(momentum))));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k].component == "x")
        row.set(k, columns[k].group == "position" ? placement.point_back(row.vector(k))
                                                  : placement.direction_back(row.vector(k)));
      if (columns[k].component == "xx") row.set(k, placement.tensor_back(row.tensor(k)));
    }
  }
  return rows;
}

}  // namespace ashlar
