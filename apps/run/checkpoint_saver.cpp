#include "apps/run/checkpoint_saver.hpp"

#include <numeric>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/folder/run_clock.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/read/scene_json.hpp"

namespace ashlar {
namespace {

/// On several ranks those of the last step's report: records of other ranks have not been gathered.
std::size_t contact_points(const Simulation& simulation, bool shared) {
  const StepReport& report = simulation.report();
  if (shared) return static_cast<std::size_t>(report.open + report.locked + report.sliding);
  const std::vector<PairRecord>& records = simulation.contacts();
  return std::accumulate(records.begin(), records.end(), std::size_t{0},
                         [](std::size_t sum, const PairRecord& pair) { return sum + pair.points.size(); });
}

}  // namespace

CheckpointSaver::CheckpointSaver(std::shared_ptr<FolderRecorder> recorder, std::optional<double> interval,
                                 bool saved, Ranks* ranks)
    : recorder_(std::move(recorder)),
      interval_(interval),
      ranks_(ranks),
      saved_(saved),
      schedule_(interval, RunClock::now()) {}

bool CheckpointSaver::agreed(bool first) const {
  return ranks_ == nullptr ? first : any_rank(*ranks_, first && ranks_->own() == 0);
}

void CheckpointSaver::run_begins(const Run& run) {
  if (recorder_) scene_bytes_ = json_text(to_json(run.whole()), 2).size();
}

void CheckpointSaver::stage_begins(const Run& run) {
  save(run);
  schedule_ = CheckpointSchedule(interval_, RunClock::now());
}

void CheckpointSaver::step_taken(const Run& run) {
  if (agreed(schedule_.due(RunClock::now()))) {
    save(run);
    schedule_.saved(RunClock::now());
  } else if (agreed(contact_points(run.simulation(), ranks_ != nullptr) > 2 * contact_points_)) {
    // The reserved space may be too small for this state.
    try {
      save(run);
    } catch (const std::system_error&) {
      // The reserve was for later; the failure to write the last files is reported at the end.
    }
  }
}

void CheckpointSaver::stage_stops(const Run& run) {
  save(run);
}

void CheckpointSaver::save_after_failure(const Run& run) {
  // The other ranks have no failure: the state saved last stays.
  if (ranks_ != nullptr) return;
  recorder_->reserve().release();
  write(run);
}

void CheckpointSaver::save(const Run& run) {
  write(run);
  if (!recorder_) return;
  contact_points_ = contact_points(run.simulation(), ranks_ != nullptr);
  // A state with twice the contact points, which requires another checkpoint, and the summary fit in beside the
  // present state.
  constexpr std::uintmax_t states = 4, scenes = 2, rest = 1U << 18U;
  recorder_->reserve().hold(states * state_bytes_ + scenes * scene_bytes_ + rest);
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
