// Reads 3MF: meshes of the objects placed by the build, directly or as components of others. Coordinates are those of
// the file, in its unit.
//
// Materials, pictures, and kinds of objects are ignored. Rejected with a message: required extensions other than
// materials and production, parts of the model in other files of the package.
#pragma once

#include <functional>
#include <string_view>

#include "apps/scene/meshes/shape_layout.hpp"

namespace ashlar {

/// Largest inflated size of a part of a package of `bytes`. Text of meshes is compressed to a tenth.
[[nodiscard]] std::size_t most_inflated(std::size_t bytes);

/// One object for each placement of a mesh, with the name Object_ID. An object precedes those that have it as a
/// component, as the standard requires; so none contains itself.
/// @param bytes of a .3mf file, a zip archive. @throws MeshFileError; places are those in the model part
[[nodiscard]] ShapeLayout read_3mf(std::string_view bytes);

/// The same for the model part alone.
[[nodiscard]] ShapeLayout read_3mf_model(std::string_view xml);

}  // namespace ashlar
