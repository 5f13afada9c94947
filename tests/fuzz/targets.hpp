// What fuzzing feeds with bytes: every reader of a file that a user may have from somewhere else. A target
// returns whether the reader took the bytes, and checks what a reader promises of those that it took. Errors
// that readers document are caught; any other exception, a failed check, a sanitizer's report, a hang or too
// much memory is a find.
#pragma once

#include <array>
#include <string_view>

namespace ashlar::fuzz {

/// What a reader promises does not hold. Not derived from std::exception, so that no reader's handler takes
/// it for bad input.
struct BrokenPromise {
  const char* what;
};

inline void require(bool holds, const char* what) {
  if (!holds) throw BrokenPromise{what};
}

bool scene(std::string_view bytes);       ///< the text of a scene, up to the keys
bool include(std::string_view bytes);     ///< a scene, a line "# part.toml", and a file that it may include
bool formula(std::string_view bytes);     ///< what follows the "=" of a formula of h, n and lost
bool record(std::string_view bytes);      ///< a CSV file with columns t, a and b
bool volume2(std::string_view bytes);     ///< a record of strong motion, its accelerations and velocities
bool smc(std::string_view bytes);         ///< the other kind
bool joints(std::string_view bytes);      ///< a table of measured joints
bool grid(std::string_view bytes);        ///< terrain: an ESRI grid, or points x, y, z
bool off(std::string_view bytes);         ///< each of the meshes: points, faces, triangles
bool obj(std::string_view bytes);         //
bool stl(std::string_view bytes);         //
bool ply(std::string_view bytes);         //
bool groups(std::string_view bytes);      ///< an OBJ file of many stones
bool gltf(std::string_view bytes);        ///< each of the imported meshes, without files beside it
bool glb(std::string_view bytes);         //
bool dxf(std::string_view bytes);         //
bool package(std::string_view bytes);     ///< a 3MF file, which is a zip archive
bool model(std::string_view bytes);       ///< its model part, without the archive's checksums around it
bool checkpoint(std::string_view bytes);  ///< the stored state of a simulation, without header and hash
bool vtu(std::string_view bytes);         ///< a frame, and its curved cells divided for the page
bool pvd(std::string_view bytes);         ///< the list of frames
bool summary(std::string_view bytes);     ///< summary.json

struct Target {
  std::string_view name;  ///< of its folder in corpus/ too
  bool (*run)(std::string_view bytes);
  /// Whether its format stays, so that the corpus must have files that the reader takes. Stored states are
  /// those of one version of the program.
  bool lasting = true;
};

inline constexpr std::array<Target, 22> targets = {{{"scene", scene},
                                                    {"include", include},
                                                    {"formula", formula},
                                                    {"record", record},
                                                    {"volume2", volume2},
                                                    {"smc", smc},
                                                    {"joints", joints},
                                                    {"grid", grid},
                                                    {"off", off},
                                                    {"obj", obj},
                                                    {"stl", stl},
                                                    {"ply", ply},
                                                    {"groups", groups},
                                                    {"gltf", gltf},
                                                    {"glb", glb},
                                                    {"dxf", dxf},
                                                    {"package", package},
                                                    {"model", model},
                                                    {"checkpoint", checkpoint, false},
                                                    {"vtu", vtu},
                                                    {"pvd", pvd},
                                                    {"summary", summary}}};

}  // namespace ashlar::fuzz
