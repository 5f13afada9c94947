#include "apps/scene/import/model_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

#include "apps/scene/import/compas_reader.hpp"
#include "apps/scene/import/lmgc90_reader.hpp"
#include "apps/scene/import/model_scene.hpp"
#include "apps/scene/import/poly_reader.hpp"
#include "apps/scene/import/unblocks_reader.hpp"
#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

namespace fs = std::filesystem;

struct TextFormat {
  const char* ending;
  ImportedModel (*read)(std::string_view text);
};
constexpr std::array<TextFormat, 5> text_formats = {{{".json", read_compas},
                                                     {".dat", read_poly},
                                                     {".3ddat", read_poly},
                                                     {".3dec", read_poly},
                                                     {".dda", read_unblocks}}};

struct MeshFormat {
  const char* ending;
  const char* split;
};
constexpr std::array<MeshFormat, 9> mesh_formats = {{{".obj", "groups"},
                                                     {".msh", "groups"},
                                                     {".3mf", "groups"},
                                                     {".dxf", "groups"},
                                                     {".gltf", "groups"},
                                                     {".glb", "groups"},
                                                     {".stl", "components"},
                                                     {".ply", "components"},
                                                     {".off", "components"}}};

struct ForeignFormat {
  const char* ending;
  const char* instead;
};
constexpr std::array<ForeignFormat, 7> foreign_formats = {
    {{".ifc", "IFC files are not read: IfcConvert writes OBJ with an object for each element"},
     {".3dm", "3DM files are not read: Rhino, or rhino3dm for Python, writes OBJ or COMPAS JSON"},
     {".step", "STEP files are not read: Gmsh writes MSH with a group for each solid"},
     {".stp", "STEP files are not read: Gmsh writes MSH with a group for each solid"},
     {".iges", "IGES files are not read: Gmsh writes MSH with a group for each solid"},
     {".brep", "BREP files are not read: Gmsh writes MSH with a group for each solid"},
     {".blend", "Blender's files are not read: Blender writes OBJ with an object for each stone"}}};

template <class Formats>
auto* format_of(const fs::path& file, const Formats& formats) {
  const std::string ending = file.extension().string();
  const auto found = std::find_if(formats.begin(), formats.end(), [&](const auto& format) {
    return equal_ignoring_case(ending, format.ending);
  });
  return found == formats.end() ? nullptr : &*found;
}

/// The file with the bodies, if this is a model of LMGC90.
std::optional<fs::path> bodies_file(const fs::path& file) {
  constexpr const char* bodies = "BODIES.DAT";
  if (equal_ignoring_case(file.filename().string(), bodies)) return file;
  std::error_code ignored;
  if (!fs::is_directory(file, ignored)) return std::nullopt;
  for (const fs::path& candidate : {file / bodies, file / "DATBOX" / bodies})
    if (fs::exists(candidate, ignored)) return candidate;
  throw ImportError({file.string(), 0, 0},
                    "folder has no BODIES.DAT, a folder of LMGC90 or a file is needed");
}

ImportedModel read_model(const fs::path& file) {
  if (const std::optional<fs::path> bodies = bodies_file(file)) return read_lmgc90(*bodies);
  if (const ForeignFormat* foreign = format_of(file, foreign_formats))
    throw ImportError({file.string(), 0, 0},
                      fmt::format("{}; `ashlar import` reads these", foreign->instead));
  const TextFormat* format = format_of(file, text_formats);
  if (format == nullptr)
    throw ImportError(
        {file.string(), 0, 0},
        fmt::format("unknown kind of model ({}), allowed are .json of COMPAS, .dat, .3ddat and .3dec of "
                    "3DEC, .dda of UnBlocks, BODIES.DAT of LMGC90, and .obj, .msh, .3mf, .dxf, .gltf, "
                    ".glb, .stl, .ply, .off",
                    file.filename().string()));
  try {
    return format->read(read_mesh_bytes(file, "model"));
  } catch (const MeshFileError& error) {
    throw ImportError({file.string(), error.line(), error.column()}, error.what());
  }
}

ImportedScene scene_of_mesh(const fs::path& file, const fs::path& scene, const MeshFormat& format) {
  try {
    (void)read_mesh_bytes(file);
  } catch (const MeshFileError& error) {
    throw ImportError({file.string(), error.line(), error.column()}, error.what());
  }
  ImportedModel model;
  model.title = file.stem().string();
  model.gravity = Vector3(0, 0, -9.81);
  model.contact.friction_angle = 30.0;
  const fs::path mesh = fs::proximate(file, scene.has_parent_path() ? scene.parent_path() : fs::path("."));
  ImportedScene result;
  result.scene = scene_of(model, file.string(), mesh, format.split);
  result.notes = {
      "the file gives blocks alone: the scene assumes density and friction (30 degrees), and lengths in m "
      "(mesh.scale)"};
  return result;
}

}  // namespace

ImportedScene import_model(const fs::path& file, const fs::path& scene,
                           const std::vector<std::string>& fixed) {
  ImportedScene result;
  bool held = !fixed.empty();
  if (const MeshFormat* mesh = format_of(file, mesh_formats)) {
    result = scene_of_mesh(file, scene, *mesh);
  } else {
    ImportedModel model = read_model(file);
    if (model.title.empty()) model.title = file.stem().string();
    result.scene =
        scene_of(model, file.string(), fs::path(scene).replace_extension(".obj").filename(), "groups");
    result.blocks = obj_of(model);
    result.count = model.blocks.size();
    result.left_out = std::move(model.left_out);
    result.notes = std::move(model.notes);
    held = held || std::any_of(model.blocks.begin(), model.blocks.end(), [](const ImportedBlock& block) {
             return block.fixed || block.displacement.has_value();
           });
  }
  if (!fixed.empty()) result.scene += fixed_blocks(fixed);
  if (!held) result.notes.emplace_back("no block is held: --fixed names those that never move");
  return result;
}

}  // namespace ashlar
