// Blocks, loads, records and summaries of a run.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "apps/results/columns/history_columns.hpp"
#include "apps/results/columns/summary_units.hpp"
#include "apps/results/folder/error_summary.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/folder/run_summary.hpp"
#include "apps/results/folder/verdict_json.hpp"
#include "apps/results/tables/contact_state.hpp"
#include "apps/results/tables/measure_goals.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/accuracy_choice.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/answers/answer_summary.hpp"
#include "apps/run/checkpoint_saver.hpp"
#include "apps/run/folder_recorder.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_setup.hpp"
#include "apps/run/stored_run.hpp"
#include "geometry/index.hpp"
#include "solver/ranks/rank_messages.hpp"
#include "solver/state/step_clock.hpp"

namespace ashlar {

int Run::block(const std::string& name) const {
  const std::vector<BlockModel>& blocks = simulation().blocks();
  const auto found = std::find_if(blocks.begin(), blocks.end(),
                                  [&](const BlockModel& block) { return block.name() == name; });
  if (found == blocks.end()) throw std::out_of_range(fmt::format("no block is called {}", name));
  return static_cast<int>(found - blocks.begin());
}

void Run::require_present(int index) const {
  if (present(index)) return;
  throw std::logic_error(fmt::format("block {} is not there in stage {} ({})",
                                     simulation().blocks()[at(index)].name(), place_.stage,
                                     whole().stage[at(place_.stage - 1)].name));
}

std::vector<PointMotion> Run::motions(int index, const std::vector<Vector3>& points,
                                      OutsidePoints outside) const {
  require_present(index);
  const BlockModel& model = simulation().blocks()[at(index)];
  const Vector3& origin = whole().origin;
  std::vector<Vector3> of_model = points;
  for (Vector3& point : of_model) point -= origin;
  if (outside == OutsidePoints::refused) points_->require(index, model, of_model, origin);
  std::vector<PointMotion> motions = model.motions_of(simulation().states()[at(index)], of_model);
  for (PointMotion& motion : motions) motion.place += origin;
  return motions;
}

PointMotion Run::motion(const std::string& name, const Vector3& point, OutsidePoints outside) const {
  return motions(block(name), {point}, outside).front();
}

void Run::set_load_factor(const std::string& name, int load, double factor) {
  if (seeks_answer(whole().analysis))
    throw std::logic_error(
        "loads of a search (analysis.type) are those of its scene, static or dynamic is needed");
  const int index = block(name);
  const std::size_t loads = simulation().blocks()[at(index)].loads().size();
  if (load < 0 || at(load) >= loads)
    throw std::out_of_range(fmt::format("block {} has {} loads, there is no load {}", name, loads, load));
  begin();
  built_.simulation.set_load_factor(index, load, factor);
  if (!is_static(scene().analysis) || status_ == RunStatus::failed) return;
  status_.reset();
  if (phase_ == Phase::stage_over) phase_ = Phase::in_stage;
}

std::vector<std::string> Run::columns() const {
  return names_of(history_columns(measures_, stage() > 0));
}

std::string Run::column_units() const {
  return ashlar::column_units(history_columns(measures_, stage() > 0));
}

void Run::observe(std::shared_ptr<RunObserver> observer) {
  if (phase_ != Phase::preparing) observer->run_begins(*this);
  if (phase_ == Phase::in_stage) observer->stage_begins(*this);
  observers_.add(std::move(observer));
}

/// False if an observer of any rank ends the run.
bool Run::goes_on() const {
  const bool here = observers_.go_on();
  return shared() ? !any_rank(manner_.ranks->ranks, !here) : here;
}

/// @return false if results could not be written on any rank: the run has failed on all
bool Run::told_on_all(bool told) {
  if (!shared() || !any_rank(manner_.ranks->ranks, !told)) return told;
  if (!told) return false;
  status_ = stage_status_ = RunStatus::failed;
  message_ = "results could not be written";
  return false;
}

/// Shows the next state that the answer speaks of, as a step.
void Run::show_state() {
  Simulation& simulation = built_.simulation;
  const auto next = static_cast<std::size_t>(simulation.steps());
  if (next < answer_.states.size()) {
    show(answer_.states[next], scene().analysis.end_time, simulation);
    if (!accept_step() || next + 1 < answer_.states.size()) return;
  }
  AnsweredEnd end = shown_end(answer_, scene().analysis, simulation);
  end_stage(end.status, std::move(end.message));
}

/// True if the present stage is a motion in time.
bool Run::moves_in_time() const {
  return scene().analysis.type == SceneAnalysis::Type::dynamic;
}

/// Of all ranks; collective.
FallRecord Run::falls_of_run() const {
  return shared() ? merged(values_of_ranks(manner_.ranks->ranks, falls_)) : falls_;
}

/// Sets the verdict, which is the message of a stage that has none. Collective.
void Run::judge_motion() {
  falls_ = falls_of_run();
  verdict_ = verdict_of(simulation(), falls_);
  if (shared()) verdict_ = merged(values_of_ranks(manner_.ranks->ranks, *verdict_));
  if (message_.empty()) message_ = describe(*verdict_, simulation());
}

/// Ends a static analysis that has no result with the factors that bracket one.
void Run::end_undecided() {
  const std::string factors = answer_.bracket
                                  ? ""
                                  : undecided_factors(simulation(), scene().analysis.end_time,
                                                      manner_.threads, [this] { return goes_on(); });
  end_stage(RunStatus::not_converged, describe_unconverged(simulation(), changes_) +
                                          (factors.empty() ? "" : "; by limit analysis, " + factors));
}

ResultFolder::Due Run::due() const {
  if (recorder_) return recorder_->due(*this);
  return manner_.keeps_history ? ResultFolder::Due::row : ResultFolder::Due::nothing;
}

/// Gathers results of the last step that the first rank writes.
void Run::gather_due() {
  const ResultFolder::Due due = values_of_ranks(manner_.ranks->ranks, this->due()).front();
  ResultNeeds needs = due == ResultFolder::Due::row ? row_needs_ : ResultNeeds{false, {}, {}};
  needs.all = due == ResultFolder::Due::frame;
  built_.simulation.gather_results(
      needs, due == ResultFolder::Due::nothing ? ShownContacts{} : own_contact_counts(simulation()));
}

void Run::record(const std::filesystem::path& folder, ClaimPurpose purpose) {
  if (claim_) throw std::logic_error("the run is recorded already, into " + claim_->folder().string());
  if (status_)
    throw std::logic_error("the run has ended, nothing is left to record: write() writes what it has");
  record(std::make_shared<const FolderClaim>(folder, purpose), {}, false);
}

void Run::record(std::shared_ptr<const FolderClaim> claim, std::optional<double> interval, bool kept) {
  if (!claim) {
    saver_ = std::make_shared<CheckpointSaver>(nullptr, interval, earlier_ != nullptr, &manner_.ranks->ranks);
    return;
  }
  auto recorder = std::make_shared<FolderRecorder>(
      claim, earlier_ ? std::optional(earlier_->folder) : std::optional<ResultFolderState>());
  auto saver = std::make_shared<CheckpointSaver>(recorder, interval, earlier_ != nullptr,
                                                 shared() ? &manner_.ranks->ranks : nullptr);
  observe(recorder);
  // On several ranks it is called once all have their results (Run::tell).
  if (!shared()) observe(saver);
  recorder_ = std::move(recorder);
  saver_ = std::move(saver);
  claim_ = std::move(claim);
  checkpoint_interval_ = interval;
  keeps_trials_ = kept;
}

void Run::resume(const std::filesystem::path& folder) {
  if (claim_) throw std::logic_error("the run is recorded already, into " + claim_->folder().string());
  auto claim = std::make_shared<const FolderClaim>(folder, ClaimPurpose::resume);
  if (!holds_open_search(folder, whole())) resume(stored_checkpoint(folder, whole(), identity_));
  record(std::move(claim), {}, true);
}

void Run::resume(RunCheckpoint checkpoint) {
  if (phase_ != Phase::preparing || started_)
    throw std::logic_error("the run has begun, a new one is needed");
  if (!checkpoint.stages.empty()) {
    present_ = stage_scene(scene_, checkpoint.stages.size());
    built_ = built_stage(present_, manner_.threads, manner_.ranks);
  }
  if (whole().analysis.accuracy) {
    accuracy_ = checkpoint.accuracy;
    chosen_ = true;
    present_ = with_choice(*scene_, accuracy_);
    built_ = built_or_thrown(*present_, manner_.threads);
    if (accuracy_.motion.time_step > 0.0) built_.simulation.set_time_step(accuracy_.motion.time_step);
  }
  built_.simulation.restore(checkpoint.simulation);
  const SceneAnalysis& analysis = scene().analysis;
  if (simulation().time() - analysis.end_time > time_rounding(analysis.time_step, analysis.end_time))
    throw std::invalid_argument(fmt::format(
        "end_time ({} s) is before the time that the run has reached ({} s), a later one, or a new "
        "folder, is needed",
        analysis.end_time, simulation().time()));
  finished_ = checkpoint.stages;
  changes_ = checkpoint.changes;
  falls_ = checkpoint.falls;
  place_ = {static_cast<int>(finished_.size()) + 1, checkpoint.folder.progress.elapsed,
            checkpoint.folder.progress.origin};
  clock_.add_earlier(checkpoint.seconds);
  earlier_ = std::make_unique<RunCheckpoint>(std::move(checkpoint));
}

bool Run::saved() const {
  return saver_ && saver_->saved();
}

RunCheckpoint Run::checkpoint() const {
  return {built_.simulation.snapshot(), finished_, {}, clock_.seconds(), changes_, accuracy_, falls_of_run()};
}

RunCheckpoint Run::checkpoint_without_pairs() const {
  return {built_.simulation.snapshot_without_pairs(),
          finished_,
          {},
          clock_.seconds(),
          changes_,
          accuracy_,
          falls_of_run()};
}

LargestValues Run::largest() const {
  if (recorder_ && recorder_->begun()) return recorder_->largest(simulation());
  return largest_values(simulation(), drawn_blocks(simulation().blocks(), whole().output).surfaces,
                        place_.origin.surfaces);
}

std::vector<OrderError> Run::order_errors() const {
  const SceneAnalysis& analysis = scene().analysis;
  const bool known = analysis.type == SceneAnalysis::Type::dynamic ||
                     (analysis.type == SceneAnalysis::Type::statics && status_ == RunStatus::equilibrium);
  // A rank knows the contacts of its own blocks only.
  return known && !shared() ? ashlar::order_errors(simulation()) : std::vector<OrderError>{};
}

std::string Run::summary() const {
  return summary(recorder_ ? recorder_->frames() : 0, largest());
}

std::string Run::summary(int frames, const LargestValues& largest) const {
  const RunStatus status = status_.value_or(RunStatus::interrupted);
  std::vector<FinishedStage> begun;
  if (stage() > 0) {
    begun = finished_;
    begun.push_back(finished(phase_ == Phase::stage_over && !status_ ? stage_status_ : status));
  }
  auto summary =
      run_summary(whole(), identity_, built_,
                  {status, message_, clock_.seconds(), frames, largest, std::move(begun), rank_work_});
  if (accuracy() != nullptr)
    summary["error"] = accuracy_summary(whole(), simulation(), *accuracy());
  else if (const std::vector<OrderError> errors = order_errors(); !errors.empty())
    summary["error"] = error_summary(simulation(), errors);
  if (!measure_errors_.empty()) add_measure_errors(scene(), measure_errors_, summary["error"]);
  add_answer(summary, answer_, whole().analysis, simulation());
  if (verdict_) summary["verdict"] = verdict_json(*verdict_, simulation());
  if (recorder_) recorder_->add_peaks(summary);
  add_origin(summary, whole().origin);
  summary["units"] = summary_units(summary);
  return json_text(summary, 2) + "\n";
}

GoalValues Run::goals_of_measures() const {
  return [this](const Simulation& now) { return goals_of(now, measures_); };
}

void Run::add_row() {
  rows_.push_back({static_cast<double>(simulation().steps())});
  const std::vector<double> values = history_row(simulation(), measures_, place_.origin, stage());
  rows_.back().insert(rows_.back().end(), values.begin(), values.end());
}

FinishedStage Run::finished(RunStatus status) const {
  return {to_string(status), message_, simulation().steps(), simulation().time()};
}

void Run::estimate_measures() {
  // A rank knows the contacts of its own blocks only.
  if (shared()) return;
  if (scene().analysis.type == SceneAnalysis::Type::statics && status_ == RunStatus::equilibrium &&
      !whole().analysis.accuracy)
    measure_errors_ = goal_errors(simulation(), goals_of_measures());
}

void Run::write_summary() const {
  if (recorder_) recorder_->write_summary(*this);
}

void Run::write(const std::filesystem::path& folder) const {
  const FolderClaim claim(folder, ClaimPurpose::replacement);
  ResultFolder results(folder, whole(), simulation(), place_);
  // The present state, whether a frame of it is due or not.
  results.add_end(simulation());
  HistoryWriter history(folder / "history.csv", columns());
  for (const std::vector<double>& row : rows_)
    history.append(static_cast<std::int64_t>(row.front()), std::vector<double>(row.begin() + 1, row.end()));
  draw_answer(answer_, whole(), simulation(), folder);
  write_file_atomically(folder / "summary.json", summary(results.frames(), results.largest(simulation())),
                        Durability::process);
}

}  // namespace ashlar
