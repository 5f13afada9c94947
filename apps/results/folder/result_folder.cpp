#include "apps/results/folder/result_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "apps/results/frames/bolt_frames.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/csv_text.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// "blocks_0000010.vtu" and the like, or an incomplete one of a killed run
bool is_frame_name(std::string_view name) {
  for (const std::string_view start : {"blocks_", "surfaces_", "contacts_", "joints_", "bolts_", "loads_"}) {
    if (!name.starts_with(start)) continue;
    const std::string_view rest = name.substr(start.size());
    const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
    return digits >= 7 && (rest.substr(digits) == ".vtu" || rest.substr(digits) == ".vtu.tmp");
  }
  return false;
}

void remove_frames_but(const std::filesystem::path& folder, const std::set<std::filesystem::path>& kept) {
  for (const auto& entry : std::filesystem::directory_iterator(folder / "frames")) {
    if (entry.symlink_status().type() == std::filesystem::file_type::regular &&
        is_frame_name(entry.path().filename().string()) && !kept.contains(entry.path()))
      std::filesystem::remove(entry.path());
  }
}

/// Results of an earlier run must not be mistaken for those of the new one. Its checkpoint is replaced by the first
/// one of this run. Until then it cannot be used without its tables, so that these are removed before the frames that
/// it relies on.
std::filesystem::path emptied(std::filesystem::path folder) {
  std::error_code error;
  std::filesystem::create_directories(folder / "frames", error);
  if (error) {
    throw std::runtime_error(
        fmt::format("cannot create the folder {}: {}", (folder / "frames").string(), error.message()));
  }
  // Removed, not emptied: other names of these files keep their content.
  for (const char* name :
       {"history.csv", "contacts.csv", "summary.json", "view.html", "surfaces.pvd", "bolts.pvd", "loads.pvd"})
    std::filesystem::remove(folder / name);
  remove_frames_but(folder, {});
  return folder;
}

constexpr const char* contact_columns =
    "step,time,block_a,block_b,points.face_face,points.vertex_face,points.edge_edge,area,normal_force.x,"
    "normal_force.y,"
    "normal_force.z,shear_force.x,shear_force.y,shear_force.z,work\n";

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
      frames_(folder_ / "frames"),
      output_(scene.output),
      measures_(measures_of(scene, simulation.blocks())),
      drawn_(drawn_blocks(simulation.blocks(), output_)),
      joint_surfaces_(joint_surfaces(simulation.blocks())),
      actions_(drawn_actions(scene, simulation.blocks())),
      history_(folder_ / "history.csv", history_columns(measures_, !scene.stage.empty())),
      blocks_(folder_ / "blocks.pvd"),
      contacts_(folder_ / "contacts.pvd"),
      joints_(folder_ / "joints.pvd"),
      contact_rows_(folder_ / "contacts.csv", OutputFile::Start::empty) {
  progress_.stage = scene.stage.empty() ? 0 : place.stage;
  progress_.elapsed = place.elapsed;
  progress_.origin = place.origin;
  if (output_.solid) surfaces_.emplace(folder_ / "surfaces.pvd");
  if (!simulation.system().bolts().empty()) bolts_.emplace(folder_ / "bolts.pvd");
  if (has_loads_or_supports(scene)) loads_.emplace(folder_ / "loads.pvd");
  if (progress_.stage == 1 && scene.stage.front().reset_displacement)
    progress_.origin = origin_of(simulation, measures_, drawn_);
  contact_rows_.write(contact_columns);
  add_step(simulation);
}

ResultFolder::ResultFolder(std::filesystem::path folder, const Scene& scene, const Simulation& simulation,
                           const ResultFolderState& state)
    : folder_(std::move(folder)),
      frames_(folder_ / "frames"),
      output_(scene.output),
      measures_(measures_of(scene, simulation.blocks())),
      drawn_(drawn_blocks(simulation.blocks(), output_)),
      joint_surfaces_(joint_surfaces(simulation.blocks())),
      actions_(drawn_actions(scene, simulation.blocks())),
      history_(HistoryWriter::resume(folder_ / "history.csv",
                                     history_columns(measures_, !scene.stage.empty()),
                                     state.progress.last_row_step)),
      blocks_(folder_ / "blocks.pvd", state.block_frames),
      contacts_(folder_ / "contacts.pvd", state.contact_frames),
      joints_(folder_ / "joints.pvd", state.joint_frames),
      contact_rows_(folder_ / "contacts.csv", OutputFile::Start::at_end),
      progress_(state.progress) {
  if (output_.solid) surfaces_.emplace(folder_ / "surfaces.pvd", state.surface_frames);
  if (!simulation.system().bolts().empty()) bolts_.emplace(folder_ / "bolts.pvd", state.bolt_frames);
  if (has_loads_or_supports(scene)) loads_.emplace(folder_ / "loads.pvd", state.load_frames);
  if (contact_rows_.size() < state.contact_bytes) {
    throw std::runtime_error(fmt::format("cannot resume {}: {} bytes, at least {} were written",
                                         contact_rows_.path().string(), contact_rows_.size(),
                                         state.contact_bytes));
  }
  contact_rows_.truncate(state.contact_bytes);
  std::set<std::filesystem::path> kept;
  for (const auto* frames : {&state.block_frames, &state.surface_frames, &state.contact_frames,
                             &state.joint_frames, &state.bolt_frames, &state.load_frames}) {
    for (const PvdFrame& frame : *frames) kept.insert(folder_ / frame.file);
  }
  remove_frames_but(folder_, kept);
  add_step(simulation);
}

ResultFolderState ResultFolder::synced_state() {
  check_in_place();
  history_.sync();
  contact_rows_.sync();
  return {.block_frames = blocks_.frames(),
          .surface_frames = surfaces_ ? surfaces_->frames() : std::vector<PvdFrame>(),
          .contact_frames = contacts_.frames(),
          .joint_frames = joints_.frames(),
          .bolt_frames = bolts_ ? bolts_->frames() : std::vector<PvdFrame>(),
          .load_frames = loads_ ? loads_->frames() : std::vector<PvdFrame>(),
          .contact_bytes = contact_rows_.size(),
          .progress = progress_};
}

void ResultFolder::begin_stage(const Simulation& simulation, double elapsed, bool reset_displacement) {
  ++progress_.stage;
  progress_.elapsed = elapsed;
  progress_.intervals_written = 1;  // That of its start is the end of the last stage.
  if (reset_displacement) progress_.origin = origin_of(simulation, measures_, drawn_);
}

void ResultFolder::check_in_place() const {
  history_.check_in_place();
  contact_rows_.check_in_place();
  frames_.check();
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

bool ResultFolder::frame_is_due(const Simulation& simulation) const {
  if (simulation.steps() == progress_.last_frame_step) return false;
  if (output_.every) return simulation.steps() % *output_.every == 0;
  // Half a step early is as close as half a step late.
  const double due = progress_.intervals_written * output_.interval.value_or(0.0);
  return simulation.time() + 0.5 * simulation.report().step >= due;
}

void ResultFolder::add_row(const Simulation& simulation) {
  if (simulation.steps() == progress_.last_row_step) return;
  history_.append(simulation.steps(), history_row(simulation, measures_, progress_.origin, progress_.stage));
  progress_.last_row_step = simulation.steps();
}

void ResultFolder::add_frame(const Simulation& simulation) {
  if (simulation.steps() == progress_.last_frame_step) return;
  const auto file_of = [&](const char* series) {
    return fmt::format("frames/{}_{:07}.vtu", series, simulation.steps());
  };
  std::vector<std::string> names;
  for (const BlockModel& block : simulation.blocks()) names.push_back(block.name());
  // Checked before each file, when all of its bytes are ready: detects a folder replaced by another one.
  const auto write = [&](const std::string& name, UnstructuredGrid grid) {
    grid.time = progress_.elapsed + simulation.time();
    grid.block_names = names;
    const std::string bytes = to_vtu(grid);
    check_in_place();
    write_file_atomically(folder_ / name, bytes, Durability::process);
  };
  std::vector<std::pair<PvdWriter*, std::string>> series;
  const auto add = [&](PvdWriter& to, const char* name, UnstructuredGrid grid) {
    write(series.emplace_back(&to, file_of(name)).second, std::move(grid));
  };
  const std::vector<bool>& absent = simulation.system().absent();
  const auto shown = [&](const auto& frame, const auto& drawn) {
    return frame(simulation.blocks(), simulation.states(), drawn, output_.fields, absent, progress_.origin);
  };
  if (surfaces_) add(blocks_, "blocks", shown(solid_frame, drawn_.solids));
  add(surfaces_ ? *surfaces_ : blocks_, surfaces_ ? "surfaces" : "blocks",
      shown(block_frame, drawn_.surfaces));
  add(contacts_, "contacts", contact_frame(simulation));
  add(joints_, "joints", joint_frame(simulation, joint_surfaces_));
  if (bolts_) add(*bolts_, "bolts", bolt_frame(simulation));
  if (loads_) add(*loads_, "loads", load_frame(simulation, actions_, progress_.stage));
  // After a failure none of them remains.
  std::vector<PvdWriter*> added;
  try {
    for (const auto& [to, file] : series) {
      check_in_place();
      to->add_frame(progress_.elapsed + simulation.time(), file);
      added.push_back(to);
    }
    add_contact_rows(simulation);
  } catch (...) {
    for (PvdWriter* to : added) to->drop_last();
    throw;
  }
  progress_.last_frame_step = simulation.steps();
}

void ResultFolder::add_contact_rows(const Simulation& simulation) {
  std::string rows;
  for (const PairRecord& pair : simulation.contacts()) {
    std::array<int, 3> count = {0, 0, 0};
    double area = 0.0;
    Vector3 normal = Vector3::Zero();
    Vector3 shear = Vector3::Zero();
    for (std::size_t k = 0; k < pair.points.size(); ++k) {
      const ContactPoint& point = pair.points[k];
      const PointResponse& response = pair.responses[k];
      // A point that is open at the end may have transmitted force in the step.
      if (response.state != ContactState::open) {
        ++count[static_cast<std::size_t>(point.type)];
        area += point.area;
      }
      normal += response.force[0] * point.normal;
      shear += response.force[1] * point.tangent_1 + response.force[2] * point.tangent_2;
    }
    rows += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", simulation.steps(),
                        simulation.time(), quote_csv_field(simulation.blocks()[at(pair.a)].name()),
                        quote_csv_field(simulation.blocks()[at(pair.b)].name()), count[0], count[1], count[2],
                        area, normal.x(), normal.y(), normal.z(), shear.x(), shear.y(), shear.z(), pair.work);
  }
  contact_rows_.write(rows);
}

}  // namespace ashlar
