// Records of samples at equal intervals in columns of fixed width.
//
// CSMIP and USGS strong motion volume 2 (.V2): channel after channel, each with a head of text and numbers, then
// accelerations, velocities and displacements. A line before each series has its number of values and its interval;
// the format in brackets may be left out (8f10.3):
//   4000 points of accel data equally spaced at  .010 sec, in cm/sec2.   (8f10.3)
//
// USGS SMC (.smc): one series. Its head has 11 lines of text, the first with the kind of data ("2 CORRECTED
// ACCELEROGRAM"), 48 whole numbers of ten columns (the 16th is the number of lines of comments, the 17th that of
// values), 50 numbers of fifteen columns (the second is the number of values in a second), and the comments. Values
// are 1p8e10.4e1, in files of high precision 1p5e14.7.
//
// Fields of fixed width may follow each other without a blank ("-101.234-102.345").
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene_record.hpp"

namespace ashlar {

/// The rows [time, values...] of a volume 2 record, from time 0, values times `record.scale`. Names of values are
/// "acceleration", "velocity" and "displacement", those of the second channel "acceleration.2" and so on; an empty name
/// stands for zero.
/// @param name of the file, for messages
/// @return empty if there is a fault, each reported with its line and column: no series of a name, a field that is not
/// a number, more or fewer values than the line before them says, chosen series of different numbers or intervals
[[nodiscard]] std::optional<std::vector<std::vector<double>>> parse_volume2_record(const SceneRecord& record,
                                                                                   std::istream& content,
                                                                                   const std::string& name,
                                                                                   Diagnostics& diagnostics);

/// The same for an SMC record; every name that is not empty stands for its values. Response and Fourier spectra
/// (kinds 5 and 6) are refused.
[[nodiscard]] std::optional<std::vector<std::vector<double>>> parse_smc_record(const SceneRecord& record,
                                                                               std::istream& content,
                                                                               const std::string& name,
                                                                               Diagnostics& diagnostics);

}  // namespace ashlar
