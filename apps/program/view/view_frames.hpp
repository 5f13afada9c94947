// The frames of a result folder in the format of the page of `ashlar view`: constant data once, varying data frame by
// frame, packed.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/view/block_union.hpp"
#include "apps/program/view/curved_cells.hpp"
#include "apps/program/view/page_blocks.hpp"
#include "apps/results/frames/stored_frames.hpp"

namespace ashlar {

/// Data that are the same in all frames.
struct ViewSurface {
  std::vector<Vector3> reference;   ///< present places minus displacements, m
  std::vector<int> block_of_point;  ///< -1: unused
  std::vector<std::int32_t> cells;  ///< block, order, face, number of corners, corners; cell after cell
  std::vector<std::int32_t> fixed;  ///< numbers of fixed blocks, increasing
  bool velocity = false;
  bool stress = false;
  bool water = false;     ///< pressure of water in joints
  bool fracture = false;  ///< fracture energy of joints
};

struct ViewFrameData {
  nlohmann::ordered_json head;  ///< index, step, time (s) and the counts of ViewFrames::read
  std::string data;             ///< base64 of a zlib stream of PackedNumbers
};

/// Contact points contained in a page.
enum class ViewPoints {
  few,  ///< those of frames with at most most_few_points: more would hide the blocks, and dominate the size
        ///< of the page
  all,
};
inline constexpr std::size_t most_few_points = 500;

/// The frames of a result folder. Functions throw std::runtime_error with path and reason if a file cannot be read or
/// is not from a run.
class ViewFrames {
 public:
  explicit ViewFrames(const std::filesystem::path& folder, ViewPoints points = ViewPoints::few);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const ViewSurface& surface() const { return surface_; }
  /// m, in the user's coordinates: all places are relative to it, as a page has single precision. Zero near the user's
  /// origin (origin_for, model_position.hpp)
  [[nodiscard]] const Vector3& origin() const { return origin_; }
  /// Names by number, of all blocks of any frame; empty: from a version without names.
  [[nodiscard]] const std::vector<std::string>& block_names() const { return block_names_; }

  /// Packed one after the other, #p points of the surface:
  ///   displacements; velocities and stresses (xx, yy, zz, xy, yz, xz) if the run has them
  ///   joints, faces of joints.pvd: numbers of corners, states (3 more: broken), blocks a, blocks b; opening, slip (its
  ///   length), normal_traction, shear_traction, area, water_pressure and fracture_energy if the run has them; places of the corners, face
  ///   after face
  ///   links, joint_resultants: blocks a, b, states; forces; places
  ///   bolts, lines of bolts.pvd: states, bolts; axial forces; places of both ends
  ///   loads, points of loads.pvd: blocks; forces; places
  ///   supports, cells of it: held components, blocks, corners (1 or 3); places of the corners, cell after cell
  ///   points, contact points: types, states, blocks a, blocks b; forces, normals, gaps, areas; places
  /// An empty part (joints and those after it) needs no bytes.
  /// head: joints (faces), corners (of all of them), links, bolts, loads, supports, support_corners, points (in the data),
  /// contacts (all points)
  [[nodiscard]] ViewFrameData read(std::size_t index) const;

 private:
  /// For versions without array "fixed": blocks of order 0, fixed or rigid, with the same places in all frames.
  [[nodiscard]] std::vector<std::int32_t> blocks_that_never_move() const;

  /// False, too, of a series that versions before did not write.
  [[nodiscard]] bool written(const std::string& series) const;

  /// Adds the blocks of all frames, of which some come, go or crack. @return all of them
  UnstructuredGrid all_blocks();

  /// A frame of a series relative to the origin, with the numbers of blocks of the page.
  [[nodiscard]] UnstructuredGrid grid_of(const std::string& series, std::size_t frame) const;

  ViewPoints points_;
  Vector3 origin_ = Vector3::Zero();
  std::unique_ptr<const StoredFrames> stored_;
  std::string blocks_ = "blocks";  ///< series with the surfaces of blocks
  std::size_t count_ = 0;
  BlockUnion all_blocks_;                  ///< empty unless blocks are added, removed or cracked
  std::optional<PageBlocks> page_blocks_;  ///< of a run with cracks
  std::unique_ptr<const CurvedCells> curved_;
  ViewSurface surface_;
  std::vector<std::string> block_names_;
};

}  // namespace ashlar
