// Tables of measured joints (`[[cut]] file`): a line of column names, then a joint in each line.
//
//   x,y,z,dip,dip_direction,radius
//   12.5,3.0,101.2,65,140,4
//
// Columns may come in any order; other columns are passed over. Without the column radius, and where its field is empty
// or inf, joints are infinite. Blank lines and lines that begin with # are passed over; fields are separated by commas,
// semicolons, tabs or blanks, as in the first line.
#pragma once

#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A measured joint: a disc about its center.
struct MeasuredJoint {
  Vector3 center = Vector3::Zero();   ///< m
  double dip = 0.0;                   ///< deg, 0 to 90
  double dip_direction = 0.0;         ///< deg from north (y) towards east (x)
  std::optional<double> radius = {};  ///< m, > 0; empty: infinite
};

/// @param place of the file's name in the scene, for a file that cannot be read
/// @return empty if there is a fault, each reported with its line and column: a missing column, a field that is not a
/// number, a dip outside 0 to 90, a radius that is not positive, no joint
[[nodiscard]] std::optional<std::vector<MeasuredJoint>> read_disc_table(const std::filesystem::path& file,
                                                                        const Place& place,
                                                                        Diagnostics& diagnostics);

/// The same for the content of a file. @param name of the file, for messages
[[nodiscard]] std::optional<std::vector<MeasuredJoint>> parse_disc_table(std::istream& content,
                                                                         const std::string& name,
                                                                         Diagnostics& diagnostics);

}  // namespace ashlar
