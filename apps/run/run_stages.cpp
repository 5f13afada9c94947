#include "apps/run/run_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

#include "apps/run/accuracy_choice.hpp"
#include "apps/run/run_setup.hpp"
#include "apps/scene/assemble/cracking_blocks.hpp"
#include "apps/scene/check/added_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "solver/state/step_clock.hpp"

namespace ashlar {

RunStages::RunStages(std::shared_ptr<const LoadedScene> whole, BuiltSimulation first, int threads,
                     const RunGroup& group)
    : whole_(std::move(whole)),
      present_(first.scene ? first.scene : stage_scene(whole_, 0)),
      identity_(scene_identity(*whole_)),
      threads_(threads),
      group_(group),
      built_(std::move(first)),
      cracks_(cracked_blocks(present_, built_.simulation)) {}

bool RunStages::end(bool done) {
  const bool follows = done && static_cast<std::size_t>(place_.stage) < stage_count(whole());
  if (follows) next_ = Next::next_stage;
  return follows;
}

void RunStages::reopen() {
  if (next_ == Next::next_stage) next_ = Next::step;
}

std::optional<std::string> RunStages::begin_next(const FinishedStage& last) {
  const std::vector<bool> was_absent = simulation().system().absent();
  const auto next = static_cast<std::size_t>(place_.stage);
  const auto refusal = [&](const std::string& reason) {
    return fmt::format("stage {} cannot begin: {}", whole().stage[next].name, reason);
  };
  try {
    std::shared_ptr<const LoadedScene> scene = stage_scene(whole_, next);
    BuiltSimulation stage = built_stage(scene, threads_, group_);
    std::unique_ptr<CrackedBlocks> cracks = cracked_blocks(scene, stage.simulation);
    if (cracks) {
      cracks->repeat(cracks_->record(), stage.simulation);
      cracks->begin_stage();
    }
    stage.simulation.start_stage(simulation());
    if (const auto overlap = overlap_of_added(stage.simulation, was_absent)) return refusal(*overlap);
    finished_.push_back(last);
    place_.elapsed += simulation().time();
    present_ = std::move(scene);
    built_ = std::move(stage);
    cracks_ = std::move(cracks);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return refusal(fault_text(error));
  }
  ++place_.stage;
  next_ = Next::first_step;
  return std::nullopt;
}

void RunStages::rebuild(const TrialFactors& factors) {
  built_ = built_stage(present_, threads_, group_, factors);
  cracks_ = cracked_blocks(present_, simulation());
}

void RunStages::rebuild(const AccuracyState& choice) {
  present_ = with_choice(*whole_, choice);
  built_ = built_or_thrown(*present_, threads_);
}

void RunStages::resume(const RunCheckpoint& checkpoint) {
  if (!checkpoint.stages.empty()) {
    present_ = stage_scene(whole_, checkpoint.stages.size());
    rebuild();
  }
  if (whole().analysis.accuracy) {
    rebuild(checkpoint.accuracy);
    const double time_step = checkpoint.accuracy.motion.time_step;
    if (time_step > 0.0) simulation().set_time_step(time_step);
  }
  if (cracks_) cracks_->repeat(checkpoint.cracks, simulation());
  simulation().restore(checkpoint.simulation);
  const SceneAnalysis& analysis = scene().analysis;
  if (simulation().time() - analysis.end_time > time_rounding(analysis.time_step, analysis.end_time))
    throw std::invalid_argument(fmt::format(
        "end_time ({} s) is before the time that the run has reached ({} s), a later one, or a new "
        "folder, is needed",
        analysis.end_time, simulation().time()));
  finished_ = checkpoint.stages;
  place_ = {static_cast<int>(finished_.size()) + 1, checkpoint.folder.progress.elapsed,
            checkpoint.folder.progress.origin};
  cracks_are_due_ = cracks_ && simulation().time() > 0.0;
}

bool RunStages::cracks_are_due() {
  return std::exchange(cracks_are_due_, false);
}

bool RunStages::divide_cracked() {
  if (!cracks_) return false;
  const bool level = is_static(scene().analysis);
  if (level && !simulation().snapshot_without_pairs().run.statics.balanced) return false;
  return cracks_->divide(simulation(), static_cast<int>(finished_.size()), level) > 0;
}

double RunStages::end_of_loads() const {
  const double end_time = scene().analysis.end_time;
  const std::optional<double> crack =
      cracks_ ? cracks_->time_of_next_crack(simulation().system().settings().time_step) : std::nullopt;
  return crack ? std::min(*crack, end_time) : end_time;
}

const CrackRecord& RunStages::cracks() const {
  static const CrackRecord none;
  return cracks_ ? cracks_->record() : none;
}

void RunStages::reset_displacement(const std::vector<Measure>& measures) {
  place_.origin = origin_of(simulation(), measures, drawn_blocks(simulation().blocks(), whole().output));
}

void RunStages::gather() {
  gather({}, ResultFolder::Due::row);
}

void RunStages::gather(const ResultNeeds& needs, ResultFolder::Due due) {
  group_.gather(simulation(), needs, due != ResultFolder::Due::nothing);
}

}  // namespace ashlar
