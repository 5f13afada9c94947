// Reader of 3MF: meshes of the objects that the build places, directly or as components of others. Coordinates are those of
// the file, in its unit.
//
// Materials, pictures, and kinds of objects are passed over. Refused by name: required extensions other than materials and
// production, parts of the model in other files of the package.
#pragma once

#include <functional>
#include <string_view>

#include "apps/scene/shape_layout.hpp"

namespace ashlar {

/// Bytes that a part of a package of `bytes` may inflate to. Meshes as text are packed to a tenth.
[[nodiscard]] std::size_t most_inflated(std::size_t bytes);

/// An object for each placement of a mesh, under the name Object_ID. An object stands above those that have it as a
/// component, as the standard demands; so none is below itself.
/// @param bytes of a .3mf file, a zip archive. @throws MeshFileError; places are those in the model part
[[nodiscard]] ShapeLayout read_3mf(std::string_view bytes);

/// The same of the model part alone.
[[nodiscard]] ShapeLayout read_3mf_model(std::string_view xml);

}  // namespace ashlar
