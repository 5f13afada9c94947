#include "apps/run/checkpoint_saver.hpp"

#include <algorithm>
#include <numeric>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/folder/run_clock.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/json/scene_json.hpp"

namespace ashlar {
namespace {

/// Of a shared run those of the last step's report: records of other processes have not been gathered.
std::size_t contact_points(const Simulation& simulation, bool shared) {
  const StepReport& report = simulation.report();
  if (shared) return static_cast<std::size_t>(report.open + report.locked + report.sliding);
  const std::vector<PairRecord>& records = simulation.contacts();
  return std::accumulate(records.begin(), records.end(), std::size_t{0},
                         [](std::size_t sum, const PairRecord& pair) { return sum + pair.points.size(); });
}

}  // namespace

CheckpointSaver::CheckpointSaver(std::shared_ptr<FolderRecorder> recorder, std::optional<double> interval,
                                 bool saved, const RunGroup& group)
    : recorder_(std::move(recorder)), group_(group), saved_(saved), schedule_(interval, RunClock::now()) {}

void CheckpointSaver::run_begins(const Run& run) {
  if (recorder_) scene_bytes_ = json_text(to_json(run.whole()), 2).size();
}

void CheckpointSaver::stage_begins(const Run& run) {
  save(run);
  schedule_.begin(RunClock::now());
}

void CheckpointSaver::step_taken(const Run& run) {
  const std::size_t points = contact_points(run.simulation(), group_.shared());
  if (group_.as_first(schedule_.due(RunClock::now(), expected_growth(points)))) {
    save(run);
  } else if (recorder_ && points > 2 * reserved_points_) {
    // The reserved space may be too small for this state.
    try {
      reserve_for(points);
    } catch (const std::system_error&) {
      // The reserve was for later; the failure to write the last files is reported at the end.
    }
  }
}

void CheckpointSaver::stage_stops(const Run& run) {
  save(run);
}

void CheckpointSaver::save_after_failure(const Run& run) {
  // The other processes have no failure: the state saved last stays.
  if (group_.shared()) return;
  recorder_->reserve().release();
  write(run);
}

void CheckpointSaver::save(const Run& run) {
  const double began = RunClock::now();
  write(run);
  if (recorder_) {
    contact_points_ = contact_points(run.simulation(), group_.shared());
    reserve_for(contact_points_);
  }
  schedule_.saved(began, RunClock::now());
}

std::uintmax_t CheckpointSaver::expected_bytes(std::size_t contact_points) const {
  // Measured with area springs: 1.9 kB.
  constexpr std::uintmax_t bytes_of_point = 2048;
  return state_bytes_ + bytes_of_point * (contact_points - std::min(contact_points, contact_points_));
}

double CheckpointSaver::expected_growth(std::size_t contact_points) const {
  // Of a slow disk; the time of the checkpoint itself counts once it is written.
  constexpr double bytes_per_second = 2e8;
  return static_cast<double>(expected_bytes(contact_points) - state_bytes_) / bytes_per_second;
}

void CheckpointSaver::reserve_for(std::size_t contact_points) {
  reserved_points_ = contact_points;
  // A state with twice the contact points, from which on more is reserved, and the summary fit in beside the present
  // state.
  constexpr std::uintmax_t states = 4, scenes = 2, rest = 1U << 18U;
  recorder_->reserve().hold(states * expected_bytes(contact_points) + scenes * scene_bytes_ + rest);
}

void CheckpointSaver::write(const Run& run) {
  RunCheckpoint checkpoint = run.checkpoint_without_pairs();
  PairsOfRun pairs = run.simulation().pairs_of_run();
  if (!recorder_) return pairs.finish();
  try {
    recorder_->claim().check();
    checkpoint.folder = recorder_->synced_state();
  } catch (...) {
    pairs.finish();
    throw;
  }
  state_bytes_ = write_checkpoint(recorder_->claim().folder() / checkpoint_name, run.identity().scene,
                                  checkpoint, &pairs);
  saved_ = true;
}

}  // namespace ashlar
