#include "apps/results/folder/result_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "apps/results/columns/contact_columns.hpp"
#include "apps/results/columns/history_columns.hpp"
#include "apps/results/frames/bolt_frames.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/csv_text.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Results of an earlier run must not be mistaken for those of the new one. Its checkpoint is replaced by the first
/// one of this run. Until then it cannot be used without its tables, so that these are removed before the frames that
/// it relies on.
std::filesystem::path emptied(std::filesystem::path folder) {
  std::filesystem::create_directories(folder);
  // Removed, not emptied: other names of these files keep their content.
  for (const char* name : {"history.csv", "contacts.csv", "summary.json", "view.html"})
    std::filesystem::remove(folder / name);
  remove_frame_files(folder);
  return folder;
}

/// Names of the series that a run writes.
std::vector<std::string> series_of(const Scene& scene, const Simulation& simulation) {
  std::vector<std::string> series = {"blocks"};
  if (scene.output.solid) series.emplace_back("surfaces");
  series.insert(series.end(), {"contacts", "joints"});
  if (!simulation.system().bolts().empty()) series.emplace_back("bolts");
  if (has_loads_or_supports(scene)) series.emplace_back("loads");
  return series;
}

void note_peaks(const std::vector<double>& row, double time, std::vector<ColumnPeak>& peaks) {
  peaks.resize(row.size());
  for (std::size_t k = 0; k < row.size(); ++k) {
    ColumnPeak& peak = peaks[k];
    if (std::isnan(row[k])) continue;
    if (!(row[k] >= peak.least)) peak.least = row[k], peak.least_time = time;
    if (!(row[k] <= peak.largest)) peak.largest = row[k], peak.largest_time = time;
  }
}

/// True if a joint of any stage softens by fracture energy.
bool has_fracture_energy(const Scene& scene) {
  const auto any = [](const std::vector<SceneJoint>& joints) {
    return std::any_of(joints.begin(), joints.end(),
                       [](const SceneJoint& joint) { return joint.fracture_energy.has_value(); });
  };
  return scene.contact.law.fracture_energy || !scene.crack.empty() || any(scene.joint) ||
         std::any_of(scene.stage.begin(), scene.stage.end(),
                     [&](const SceneStage& stage) { return any(stage.joint); });
}

}  // namespace

DisplacementOrigin origin_of(const Simulation& simulation, const std::vector<Measure>& measures,
                             const DrawnBlocks& drawn) {
  DisplacementOrigin origin;
  const auto displacement = [&](int block, const Vector3& point) {
    return simulation.blocks()[at(block)].motion_of(simulation.states()[at(block)], point).displacement;
  };
  for (const Measure& measure : measures) origin.measures.push_back(measure_origin(simulation, measure));
  const auto displacements = [&](const auto& of_blocks, std::vector<std::vector<Vector3>>& by_block) {
    for (std::size_t b = 0; b < of_blocks.size(); ++b) {
      by_block.emplace_back();
      for (const Vector3& point : of_blocks[b].points)
        by_block.back().push_back(displacement(static_cast<int>(b), point));
    }
  };
  displacements(drawn.surfaces, origin.surfaces);
  displacements(drawn.solids, origin.solids);
  return origin;
}

ResultFolder::ResultFolder(std::filesystem::path folder, const Scene& scene, const Simulation& simulation,
                           const StagePlace& place)
    : folder_(emptied(std::move(folder))),
      output_(scene.output),
      model_origin_(scene.origin),
      measures_(measures_of(scene, simulation.blocks())),
      drawn_(drawn_blocks(simulation.blocks(), output_)),
      joint_surfaces_(joint_surfaces(simulation.blocks())),
      softens_(has_fracture_energy(scene) && simulation.system().exchange().alone()),
      actions_(drawn_actions(scene, simulation.blocks())),
      history_(folder_ / "history.csv", names_of(history_columns(measures_, !scene.stage.empty()))),
      series_(series_of(scene, simulation)),
      precision_(frame_precision(output_, simulation.blocks(), model_origin_)),
      frames_(new_frame_files(folder_, output_.format, series_)),
      contact_rows_(folder_ / "contacts.csv", OutputFile::Start::empty) {
  progress_.stage = scene.stage.empty() ? 0 : place.stage;
  progress_.elapsed = place.elapsed;
  progress_.origin = place.origin;
  if (progress_.stage == 1 && scene.stage.front().reset_displacement)
    progress_.origin = origin_of(simulation, measures_, drawn_);
  contact_rows_.write(contact_header());
  write_file_atomically(folder_ / "history.units.json",
                        column_units(history_columns(measures_, !scene.stage.empty())), Durability::process);
  add_step(simulation);
}

ResultFolder::ResultFolder(std::filesystem::path folder, const Scene& scene, const Simulation& simulation,
                           const ResultFolderState& state, bool shows_state)
    : folder_(std::move(folder)),
      output_(scene.output),
      model_origin_(scene.origin),
      measures_(measures_of(scene, simulation.blocks())),
      drawn_(drawn_blocks(simulation.blocks(), output_)),
      joint_surfaces_(joint_surfaces(simulation.blocks())),
      softens_(has_fracture_energy(scene) && simulation.system().exchange().alone()),
      actions_(drawn_actions(scene, simulation.blocks())),
      history_(HistoryWriter::resume(folder_ / "history.csv",
                                     names_of(history_columns(measures_, !scene.stage.empty())),
                                     state.progress.last_row_step)),
      series_(series_of(scene, simulation)),
      precision_(frame_precision(output_, simulation.blocks(), model_origin_)),
      frames_(resumed_frame_files(folder_, output_.format, series_, state.frames)),
      contact_rows_(folder_ / "contacts.csv", OutputFile::Start::at_end),
      progress_(state.progress) {
  if (contact_rows_.size() < state.contact_bytes) {
    throw std::runtime_error(fmt::format("cannot resume {}: {} bytes, at least {} were written",
                                         contact_rows_.path().string(), contact_rows_.size(),
                                         state.contact_bytes));
  }
  contact_rows_.truncate(state.contact_bytes);
  shows_state&& simulation.steps() > 0 ? add_state(simulation) : add_step(simulation);
}

ResultFolderState ResultFolder::synced_state() {
  check_in_place();
  history_.sync();
  contact_rows_.sync();
  return {.frames = frames_->frames(), .contact_bytes = contact_rows_.size(), .progress = progress_};
}

void ResultFolder::begin_stage(const Simulation& simulation, double elapsed, bool reset_displacement) {
  ++progress_.stage;
  progress_.elapsed = elapsed;
  progress_.intervals_written = 1;  // That of its start is the end of the last stage.
  if (reset_displacement) progress_.origin = origin_of(simulation, measures_, drawn_);
}

void ResultFolder::divide_blocks(const Scene& scene, const Simulation& simulation) {
  measures_ = measures_of(scene, simulation.blocks());
  drawn_ = drawn_blocks(simulation.blocks(), output_);
  joint_surfaces_ = joint_surfaces(simulation.blocks());
  actions_ = drawn_actions(scene, simulation.blocks());
}

void ResultFolder::check_in_place() const {
  history_.check_in_place();
  contact_rows_.check_in_place();
  frames_->check_in_place();
}

ResultFolder::Due ResultFolder::due(const Simulation& simulation) const {
  if (frame_is_due(simulation)) return Due::frame;
  return simulation.steps() % output_.history_every == 0 ? Due::row : Due::nothing;
}

void ResultFolder::add_step(const Simulation& simulation) {
  check_in_place();
  if (simulation.steps() % output_.history_every == 0) add_row(simulation);
  if (!frame_is_due(simulation)) return;
  add_frame(simulation);
  if (!output_.every) ++progress_.intervals_written;
}

void ResultFolder::add_end(const Simulation& simulation) {
  check_in_place();
  add_row(simulation);
  add_frame(simulation);
}

void ResultFolder::add_state(const Simulation& simulation) {
  progress_.elapsed = std::max(simulation.steps() - 1, 0);
  add_end(simulation);
}

bool ResultFolder::frame_is_due(const Simulation& simulation) const {
  if (simulation.steps() == progress_.last_frame_step) return false;
  if (output_.every) return simulation.steps() % *output_.every == 0;
  // Half a step early is as close as half a step late.
  const double due = progress_.intervals_written * output_.interval.value_or(0.0);
  return simulation.time() + 0.5 * simulation.report().step >= due;
}

std::vector<MeasurePeak> ResultFolder::peaks() const {
  std::vector<MeasurePeak> peaks;
  const std::vector<Column> columns = history_columns(measures_, progress_.stage > 0);
  // The first column, the step, is no value of a row.
  for (std::size_t k = 1; k < columns.size() && k <= progress_.peaks.size(); ++k)
    if (!columns[k].measure.empty())
      peaks.push_back({columns[k].name, columns[k].unit, progress_.peaks[k - 1]});
  return peaks;
}

void ResultFolder::add_row(const Simulation& simulation) {
  if (simulation.steps() == progress_.last_row_step) return;
  const std::vector<double> row = history_row(simulation, measures_, progress_.origin, progress_.stage);
  history_.append(simulation.steps(), row);
  note_peaks(row, progress_.elapsed + simulation.time(), progress_.peaks);
  progress_.last_row_step = simulation.steps();
}

void ResultFolder::add_frame(const Simulation& simulation) {
  if (simulation.steps() == progress_.last_frame_step) return;
  std::vector<std::string> names;
  for (const BlockModel& block : simulation.blocks()) names.push_back(block.name());
  const std::vector<bool>& absent = simulation.system().absent();
  const auto shown = [&](const auto& frame, const auto& drawn) {
    return frame(simulation.blocks(), simulation.states(), drawn, output_.fields, absent, progress_.origin);
  };
  std::vector<SeriesGrid> grids;
  for (const std::string& series : series_) {
    const auto grid = [&] {
      if (series == "contacts") return contact_frame(simulation);
      if (series == "joints") return joint_frame(simulation, joint_surfaces_, softens_);
      if (series == "bolts") return bolt_frame(simulation);
      if (series == "loads") return load_frame(simulation, actions_, progress_.stage);
      if (series == "blocks" && output_.solid) return shown(solid_frame, drawn_.solids);
      return shown(block_frame, drawn_.surfaces);
    };
    UnstructuredGrid& added = grids.emplace_back(SeriesGrid{series, grid()}).grid;
    if (!model_origin_.isZero(0.0))
      for (Vector3& point : added.points) point += model_origin_;
    set_precision(added, series, precision_);
  }
  const std::uintmax_t rows = contact_rows_.size();
  contact_rows_.write(contact_rows(simulation));
  try {
    // Checked before each file, when all of its bytes are ready: detects a folder replaced by another one.
    frames_->add({progress_.elapsed + simulation.time(), simulation.steps()}, std::move(grids), names,
                 [this] { check_in_place(); });
  } catch (...) {
    contact_rows_.truncate(rows);
    throw;
  }
  progress_.last_frame_step = simulation.steps();
}

}  // namespace ashlar
