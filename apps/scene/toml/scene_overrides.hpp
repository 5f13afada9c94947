// `--set key.path=value`: changes a scene after parsing and before reading, so that an override passes the same
// checks as a line of the file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"

namespace ashlar {

/// Applies overrides in order. Each is "key.path=value":
/// - the path is a dotted TOML key; an entry of an array of tables is identified by its `name` or, if none has that
///   name, by its
///   0-based index ("block.B.order", "block.0.order"); an entry of a plain array by its index;
/// - the value is a TOML value; invalid ones without an initial bracket or quote are read as text;
/// - missing tables of the path are created;
/// - a key that excludes others replaces them (interval and every; the shapes; chord_tolerance and subdivisions;
///   traction and
///   force; plane and point).
/// The new nodes have the source "--set key.path=value". Faults of the form or the path go to diagnostics at that
/// place and leave the scene unchanged; the reader checks keys and values.
void apply_overrides(toml::table& scene, const std::vector<std::string>& overrides, Diagnostics& diagnostics);

}  // namespace ashlar
