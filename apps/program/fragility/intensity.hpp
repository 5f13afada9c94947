// Intensity of a record, the abscissa of fragility curves.
//
// Records have one to three components along x, y and z. The intensity is the geometric mean of those of its components
// across gravity that are not zero throughout (Baker and Cornell 2006); a record with none has that of its vertical one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_block.hpp"

namespace ashlar {

struct IntensityMeasure {
  enum class Kind {
    pga,    ///< largest acceleration by its amount, m/s^2
    sa,     ///< pseudo-acceleration of a period at 5 % of critical damping, m/s^2
    scale,  ///< factor of the record, without unit
  };
  Kind kind = Kind::pga;
  double period = 0.0;  ///< s, of sa

  [[nodiscard]] std::string name() const;  ///< "pga", "sa(0.5)", "scale"
  [[nodiscard]] std::string unit() const;  ///< "m/s^2" or ""
};

/// "pga", "scale" or "sa(PERIOD)". @throws std::invalid_argument with the fault and the requirement
[[nodiscard]] IntensityMeasure parse_intensity(const std::string& text);

/// Intensity of a record as it is; that of the record times a factor is this times the factor.
/// @param rows accelerations, m/s^2, at increasing times. @param up unit vector against gravity
/// @return empty if all accelerations are zero
[[nodiscard]] std::optional<double> intensity_of(const IntensityMeasure& measure,
                                                 const std::vector<SceneFix::Motion>& rows,
                                                 const Vector3& up);

}  // namespace ashlar
