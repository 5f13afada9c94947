// `--set key.path=value`: changing a scene after it is parsed and before it is read, so that an override
// passes through the same checks as a line of the file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "apps/scene/diagnostics.hpp"

namespace ashlar {

/// Applies overrides in order. Each is "key.path=value":
/// - the path is a dotted TOML key; an entry of an array of tables is named by its `name` or, if none is
///   called so, by its 0-based index ("block.B.order", "block.0.order"); an entry of a plain array by its
///   index;
/// - the value is a TOML value; what is none and starts like no bracket or quote is taken as a text;
/// - tables that are missing on the way are made;
/// - a key that excludes others takes their place (interval and every; the shapes; chord_tolerance and
///   subdivisions; traction and force; plane and point).
/// The new nodes have the source "--set key.path=value". Faults of the form or the path go to diagnostics at
/// that place and leave the scene as it was; whether keys and values are allowed is for the reader to say.
void apply_overrides(toml::table& scene, const std::vector<std::string>& overrides, Diagnostics& diagnostics);

}  // namespace ashlar
