// The result folder of a run: history.csv, contacts.csv, frames for ParaView and summary.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/results/frames/block_frames.hpp"
#include "apps/results/frames/contact_frame.hpp"
#include "apps/results/frames/frame_files.hpp"
#include "apps/results/frames/frame_precision.hpp"
#include "apps/results/frames/joint_faces.hpp"
#include "apps/results/frames/largest_values.hpp"
#include "apps/results/frames/load_frames.hpp"
#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "apps/results/tables/history_writer.hpp"
#include "apps/results/tables/measure.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Start of the results in a staged analysis.
struct StagePlace {
  int stage = 1;         ///< 1-based; unused if the scene has no stages
  double elapsed = 0.0;  ///< s, of all stages before
  /// Subtracted from displacements unless empty; otherwise as the first stage specifies.
  DisplacementOrigin origin;
};

/// The present displacements of the points of measures and of drawn points.
[[nodiscard]] DisplacementOrigin origin_of(const Simulation& simulation, const std::vector<Measure>& measures,
                                           const DrawnBlocks& drawn);

/// Extremes of a column of the history so far, with their times, s; nan: it has had no value.
struct ColumnPeak {
  double least = std::numeric_limits<double>::quiet_NaN();
  double least_time = 0.0;
  double largest = std::numeric_limits<double>::quiet_NaN();
  double largest_time = 0.0;
};

struct MeasurePeak {
  std::string column;
  std::string unit;
  ColumnPeak peak;
};

/// Progress of the files.
struct ResultProgress {
  int last_row_step = -1;  ///< in history.csv
  int last_frame_step = -1;
  int intervals_written = 0;  ///< output.interval: frames due by time
  int stage = 0;              ///< 1-based; 0: the run has none
  double elapsed = 0.0;       ///< s, of all stages before
  DisplacementOrigin origin;
  std::vector<ColumnPeak> peaks;  ///< by value of a row of the history
};

/// State of the files, stored in a checkpoint.
struct ResultFolderState {
  std::vector<FrameTime> frames;
  std::uint64_t contact_bytes = 0;  ///< in contacts.csv
  ResultProgress progress;
};

/// Writes all results except the summary and the checkpoint. Errors are std::runtime_error with path and reason.
class ResultFolder {
 public:
  /// Removes the results of an earlier run in the folder except for its checkpoint, which the first one of this run
  /// replaces, and adds the simulation's present step.
  /// @param folder claimed by the program (folder_claim.hpp). @param scene the whole one, of all stages
  ResultFolder(std::filesystem::path folder, const Scene& scene, const Simulation& simulation,
               const StagePlace& place = {});

  /// Continues in the folder of an earlier run: removes data written after `state`, and writes data of its step that
  /// could not be written then.
  /// @param simulation at that time. @param shows_state true: its step is that of add_state()
  ResultFolder(std::filesystem::path folder, const Scene& scene, const Simulation& simulation,
               const ResultFolderState& state, bool shows_state = false);

  /// Files that add_step() adds to.
  enum class Due { nothing, row, frame };
  [[nodiscard]] Due due(const Simulation& simulation) const;
  /// Adds the last accepted step. Data that cannot be written are not in state() either.
  /// @throws std::runtime_error also if a table or the folder of frames no longer exists, or was changed by others
  void add_step(const Simulation& simulation);
  /// Starts another stage of a staged analysis. The frame of its start is that of add_end() for the last one.
  /// @param simulation at the start of the stage. @param elapsed s, of all stages before
  void begin_stage(const Simulation& simulation, double elapsed, bool reset_displacement);
  /// Blocks have cracked: later rows and frames show the parts. @param scene the whole one
  void divide_blocks(const Scene& scene, const Simulation& simulation);
  /// Adds row and frame of the end of a run or stage, whether they are due or not. A run continued from an earlier
  /// checkpoint removes them.
  void add_end(const Simulation& simulation);

  /// Adds row and frame of a state of an answer: it has the time of its loads and then of its number, so that frames have
  /// different times.
  void add_state(const Simulation& simulation);

  /// Largest values, with displacements relative to the last reset by a stage.
  [[nodiscard]] LargestValues largest(const Simulation& simulation) const {
    return largest_values(simulation, drawn_.surfaces, progress_.origin.surfaces);
  }

  /// Waits until the tables are on the disk, as a checkpoint relies on them.
  [[nodiscard]] ResultFolderState synced_state();

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  /// Extremes of the columns of measures.
  [[nodiscard]] std::vector<MeasurePeak> peaks() const;
  [[nodiscard]] int frames() const { return static_cast<int>(frames_->frames().size()); }

 private:
  [[nodiscard]] bool frame_is_due(const Simulation& simulation) const;
  void check_in_place() const;
  void add_row(const Simulation& simulation);
  void add_frame(const Simulation& simulation);

  std::filesystem::path folder_;
  SceneOutput output_;
  Vector3 model_origin_;  ///< m, Scene::origin, of the places in frames
  std::vector<Measure> measures_;
  DrawnBlocks drawn_;
  std::vector<SubFaceSurface> joint_surfaces_;
  bool softens_;  ///< joints have fracture energy, in one process
  DrawnActions actions_;
  HistoryWriter history_;
  std::vector<std::string> series_;  ///< of frames
  FramePrecision precision_;         ///< the same
  std::unique_ptr<FrameFiles> frames_;
  OutputFile contact_rows_;
  ResultProgress progress_;
};

}  // namespace ashlar
