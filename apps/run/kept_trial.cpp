#include "apps/run/kept_trial.hpp"

#include <fmt/format.h>

#include <ostream>

#include "apps/results/folder/contact_changes.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/folder/run_clock.hpp"
#include "apps/run/factor_analysis.hpp"
#include "apps/scene/build/build_simulation.hpp"

namespace ashlar {
namespace {

constexpr double seconds_between_lines = 5.0;  // as ProgressLine if stderr is no terminal

/// Restores the state of an interrupted trial. Without a complete state of this factor the trial starts from the
/// beginning.
void restore(Simulation& simulation, ContactChanges& changes, const std::filesystem::path& path,
             std::uint64_t hash) {
  if (!std::filesystem::exists(path)) return;
  try {
    const RunCheckpoint state = read_checkpoint(path, hash);
    simulation.restore(state.simulation);
    changes = state.changes;
  } catch (const CheckpointError&) {
    std::filesystem::remove(path);
  }
}

}  // namespace

std::uint64_t KeptTrial::hash_of(double factor) const {
  ByteWriter writer;
  writer(factor);
  return hash_bytes(writer.take(), hash_);
}

std::optional<FactorTrial> KeptTrial::run(double factor, const std::function<bool()>& goes_on,
                                          std::ostream& err) {
  Diagnostics ignored;  // the same as without a factor
  std::optional<BuiltSimulation> built = build_simulation(scene_, manner_.threads, ignored, nullptr,
                                                          trial_factors(scene_.scene.analysis, factor));
  iterations_ = 0;
  reason_.clear();
  if (!built) return FactorTrial{factor, TrialOutcome::unknown, 0};
  Simulation& simulation = built->simulation;
  ContactChanges changes;
  restore(simulation, changes, path_, hash_of(factor));
  const int restored = simulation.steps();
  const auto save = [&] {
    RunCheckpoint state;
    state.simulation = simulation.snapshot();
    state.changes = changes;
    write_checkpoint(path_, hash_of(factor), state);
  };
  CheckpointSchedule schedule(manner_.checkpoint_interval, RunClock::now());
  double told = RunClock::now();
  const auto at_iteration = [&] {
    iterations_ = simulation.steps();
    if (iterations_ > restored) changes.note(simulation);
    if (!goes_on()) {
      save();
      return false;
    }
    const double now = RunClock::now();
    if (!manner_.quiet && now - told >= seconds_between_lines) {
      err << fmt::format("factor {:.5g}: iteration {}\n", factor, iterations_);
      err.flush();
      told = now;
    }
    if (schedule.due(now)) {
      save();
      schedule.saved(RunClock::now());
    }
    return true;
  };
  const std::optional<FactorTrial> trial =
      run_trial(simulation, factor, scene_.scene.analysis.end_time, at_iteration);
  iterations_ = simulation.steps();
  if (trial && trial->outcome == TrialOutcome::unknown) reason_ = describe_unconverged(simulation, changes);
  return trial;
}

}  // namespace ashlar
