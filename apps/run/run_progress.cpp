#include "apps/run/run_progress.hpp"

#include <fmt/format.h>

#include <ostream>

#include "apps/run/run.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

constexpr double seconds_between_lines = 5.0;  // as ProgressLine if stderr is no terminal

ProgressState progress_of(const Simulation& simulation) {
  const StepReport& report = simulation.report();
  return {simulation.steps(), simulation.time(), report.step, report.locked + report.sliding,
          report.iterations};
}

}  // namespace

RunProgress::RunProgress(std::ostream& out, bool quiet) : out_(out), quiet_(quiet), told_(RunClock::now()) {}

void RunProgress::method_chosen(bool limit, const std::string& reason) {
  if (quiet_) return;
  out_ << fmt::format("chosen: analysis.method = \"{}\": {}\n", limit ? "limit" : "elastic", reason);
}

void RunProgress::limits_found(const LimitFindings& findings) {
  if (quiet_) return;
  for (const LimitTrial& trial : findings.answer.trials)
    out_ << fmt::format(
        "factor {:.5g}, {}: {} ({} iterations)\n", trial.factors.strength * trial.factors.load,
        trial.released ? "released" : "associated", to_string(trial.outcome), trial.iterations);
  for (const LimitTrial& trial : findings.path.answer.trials)
    out_ << fmt::format("factor {:.5g}, path: {} ({} iterations)\n",
                        trial.factors.strength * trial.factors.load, to_string(trial.outcome),
                        trial.iterations);
}

void RunProgress::trial_continues(double factor, int iterations) {
  const double now = RunClock::now();
  if (quiet_ || now - told_ < seconds_between_lines) return;
  out_ << fmt::format("factor {:.5g}: iteration {}\n", factor, iterations);
  out_.flush();
  told_ = now;
}

void RunProgress::trial_ends(const FactorTrial& trial, const std::string& reason) {
  told_ = RunClock::now();
  if (quiet_) return;
  out_ << fmt::format("factor {:.5g}: {} ({} iterations){}{}\n", trial.factor, to_string(trial.outcome),
                      trial.iterations, reason.empty() ? "" : ": ", reason);
}

void RunProgress::trial_stops(double factor, int iterations) {
  out_ << fmt::format("factor {:.5g}: stopped after {} iterations\n", factor, iterations);
}

void RunProgress::stage_begins(const Run& run) {
  line_.emplace(run.scene().analysis.end_time, quiet_, out_);
  told_cracks_ = run.cracks().events.size();
}

void RunProgress::step_taken(const Run& run) {
  if (run.answer().shows_states()) {
    const auto step = static_cast<std::size_t>(run.simulation().steps());
    if (!quiet_) out_ << fmt::format("step {}: {}\n", step, run.answer().states.at(step - 1).name);
    return;
  }
  if (line_) line_->update(progress_of(run.simulation()));
}

void RunProgress::blocks_crack(const Run& run) {
  const std::vector<CrackEvent>& events = run.cracks().events;
  const std::vector<BlockModel>& blocks = run.simulation().blocks();
  if (!quiet_ && line_) line_->pause();
  for (; told_cracks_ < events.size(); ++told_cracks_) {
    if (quiet_) continue;
    const CrackEvent& crack = events[told_cracks_];
    std::string parts;
    for (const int part : crack.parts) parts += (parts.empty() ? "" : ", ") + blocks[at(part)].name();
    out_ << fmt::format("t = {:.6g} s: crack of {:.4g} m^2 at {:.4g} Pa: {}\n", crack.time, crack.area,
                        crack.stress, parts);
  }
}

void RunProgress::stage_ends(const Run& run) {
  finish();
  if (quiet_ || !run.stage_follows()) return;
  out_ << fmt::format("stage {}: {} after {} steps{}{}\n",
                      run.whole().stage[static_cast<std::size_t>(run.stage() - 1)].name,
                      to_string(run.stage_status()), run.simulation().steps(),
                      run.message().empty() ? "" : ": ", run.message());
}

void RunProgress::save_after_failure(const Run& /*run*/) {
  finish();
}

}  // namespace ashlar
