// Targets of fuzzing: every reader of a file of foreign origin. A target returns true if the reader accepts the
// bytes, and then checks the guarantees of the reader. Errors
// that readers document are caught; any other exception, a failed check, a sanitizer's report, a hang or too
// much memory is a find.
#pragma once

#include <array>
#include <string_view>

namespace ashlar::fuzz {

/// A violated guarantee of a reader. Not derived from std::exception, so that no reader handles it as bad
/// input.
struct BrokenPromise {
  const char* what;
};

inline void require(bool holds, const char* what) {
  if (!holds) throw BrokenPromise{what};
}

bool scene(std::string_view bytes);       ///< the text of a scene, up to the keys
bool include(std::string_view bytes);     ///< a scene, a line "# part.toml", and a file that it may include
bool formula(std::string_view bytes);     ///< the text after the "=" of a formula of h, n and lost
bool record(std::string_view bytes);      ///< a CSV file with columns t, a and b
bool volume2(std::string_view bytes);     ///< a record of strong motion, its accelerations and velocities
bool smc(std::string_view bytes);         ///< the other kind
bool joints(std::string_view bytes);      ///< a table of measured joints
bool grid(std::string_view bytes);        ///< terrain: an ESRI grid, or points x, y, z
bool off(std::string_view bytes);         ///< each of the meshes: points, faces, triangles
bool obj(std::string_view bytes);         //
bool stl(std::string_view bytes);         //
bool ply(std::string_view bytes);         //
bool groups(std::string_view bytes);      ///< an OBJ file of many blocks
bool gltf(std::string_view bytes);        ///< each of the imported meshes, without files beside it
bool glb(std::string_view bytes);         //
bool dxf(std::string_view bytes);         //
bool package(std::string_view bytes);     ///< a 3MF file, which is a zip archive
bool model(std::string_view bytes);       ///< its model part, without the archive's checksums around it
bool compas(std::string_view bytes);      ///< a model of COMPAS
bool poly(std::string_view bytes);        ///< blocks of a 3DEC data file
bool unblocks(std::string_view bytes);    ///< blocks of UnBlocks-gen
bool checkpoint(std::string_view bytes);  ///< the stored state of a simulation, without header and hash
bool vtu(std::string_view bytes);         ///< a frame, and its curved cells divided for the page
bool pvd(std::string_view bytes);         ///< the list of frames
bool summary(std::string_view bytes);     ///< summary.json

struct Target {
  std::string_view name;  ///< of its folder in corpus/ too
  bool (*run)(std::string_view bytes);
  /// True if its format is stable, so that the corpus must have files that the reader accepts. Stored states are
  /// those of one version of the program.
  bool lasting = true;
};

inline constexpr std::array<Target, 25> targets = {{{"scene", scene},       {"include", include},
                                                    {"formula", formula},   {"record", record},
                                                    {"volume2", volume2},   {"smc", smc},
                                                    {"joints", joints},     {"grid", grid},
                                                    {"off", off},           {"obj", obj},
                                                    {"stl", stl},           {"ply", ply},
                                                    {"groups", groups},     {"gltf", gltf},
                                                    {"glb", glb},           {"dxf", dxf},
                                                    {"package", package},   {"model", model},
                                                    {"compas", compas},     {"poly", poly},
                                                    {"unblocks", unblocks}, {"checkpoint", checkpoint, false},
                                                    {"vtu", vtu},           {"pvd", pvd},
                                                    {"summary", summary}}};

}  // namespace ashlar::fuzz
