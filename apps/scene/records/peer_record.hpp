// Acceleration records of the PEER ground motion database (.AT2): four header lines, the last with the number of
// values and the time between them, then the values in the order of time, several a line.
//
//   PEER NGA STRONG MOTION DATABASE RECORD
//   (event, date, station, component)
//   ACCELERATION TIME SERIES IN UNITS OF G
//   NPTS=   4000, DT=   .0100 SEC,            or   4000  .0100  NPTS, DT
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene_record.hpp"

namespace ashlar {

/// True if a file with this first line is a PEER record.
[[nodiscard]] bool begins_peer_record(std::string_view line);

/// The rows [time, values...] of a record: the first value is at time 0. Every column named by `record` has the
/// values of the file times `record.scale`, the others are 0.
/// @param content after its first line. @param name of the file, for messages
/// @return empty if there is a fault, each reported with its line and column: no NPTS and DT in the header, a field
/// that is not a number, more or fewer values than NPTS
[[nodiscard]] std::optional<std::vector<std::vector<double>>> parse_peer_record(const SceneRecord& record,
                                                                                std::istream& content,
                                                                                const std::string& name,
                                                                                Diagnostics& diagnostics);

}  // namespace ashlar
