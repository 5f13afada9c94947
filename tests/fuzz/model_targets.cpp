#include "apps/scene/import/compas_reader.hpp"
#include "apps/scene/import/model_scene.hpp"
#include "apps/scene/import/poly_reader.hpp"
#include "apps/scene/import/unblocks_reader.hpp"
#include "fuzz/refusal.hpp"
#include "fuzz/targets.hpp"
#include "geometry/mesh/mesh_io.hpp"

namespace ashlar::fuzz {
namespace {

bool model(ImportedModel (*read)(std::string_view), std::string_view bytes) {
  try {
    const ImportedModel model = read(bytes);
    require(!model.blocks.empty(), "a model has blocks");
    std::size_t corners = 0;
    for (const ImportedBlock& block : model.blocks) {
      require(!block.faces.empty(), "a block has faces");
      require(plain_name(block.name) == block.name, "a name can be written");
      require(!block.material || *block.material < model.materials.size(), "materials are in range");
      for (const std::vector<int>& face : block.faces) {
        require(face.size() >= 3, "a face has corners");
        corners += face.size();
        for (const int corner : face)
          require(corner >= 0 && corner < static_cast<int>(block.points.size()), "corners are in range");
      }
    }
    // A corner takes at least two bytes of a file, but six faces of a brick have 24.
    require(corners <= 24 * bytes.size(), "faces are bounded");
    require(!obj_of(model).empty() && !scene_of(model, "file", "file.obj", "groups").empty(),
            "a model is written");
    return true;
  } catch (const MeshFileError& error) {
    return refused(error);
  }
}

}  // namespace

bool compas(std::string_view bytes) {
  return model(read_compas, bytes);
}
bool poly(std::string_view bytes) {
  return model(read_poly, bytes);
}
bool unblocks(std::string_view bytes) {
  return model(read_unblocks, bytes);
}

}  // namespace ashlar::fuzz
