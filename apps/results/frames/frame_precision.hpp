// How the files of a run store the numbers of frames (notes/vtkhdf.md, Precision).
#pragma once

#include <string>
#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "apps/scene/model/scene.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Of the numbers of all frames of a run.
struct FramePrecision {
  StoredReal fields = StoredReal::float64;
  /// Of places of contacts, joints, supports and loads. Those of blocks are doubles always: their differences are shown
  /// enlarged.
  StoredReal places = StoredReal::float64;
};

/// @return with "single", and with "auto" in results.vtkhdf, fields of single precision; places too if that moves none of
/// the blocks' corners by more than 1e-4 of the size of the smallest block (block_size), and none is incremental: their
/// shape is not that of the start if the run goes on from a checkpoint.
/// @param origin of the model, Scene::origin
[[nodiscard]] FramePrecision frame_precision(const SceneOutput& output, const std::vector<BlockModel>& blocks,
                                             const Vector3& origin = Vector3::Zero());

/// Declares how a grid is to be stored. @param series its name
void set_precision(UnstructuredGrid& grid, const std::string& series, const FramePrecision& precision);

}  // namespace ashlar
