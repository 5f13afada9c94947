// Blocks, loads, records and summaries of a run.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>

#include "apps/results/columns/history_columns.hpp"
#include "apps/results/columns/summary_units.hpp"
#include "apps/results/folder/crack_summary.hpp"
#include "apps/results/folder/error_summary.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/folder/run_summary.hpp"
#include "apps/results/folder/verdict_json.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/answers/answer_summary.hpp"
#include "apps/run/answers/trial_folder.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_findings.hpp"
#include "apps/run/run_history.hpp"
#include "apps/run/run_preparation.hpp"
#include "apps/run/run_record.hpp"
#include "apps/run/run_stages.hpp"
#include "apps/run/stored_run.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// `error` of a summary; null: nothing is estimated. @param orders called for a run without analysis.accuracy
nlohmann::ordered_json error_part(const Run& run, const std::function<OrderErrors()>& orders) {
  nlohmann::ordered_json error;
  if (run.accuracy() != nullptr)
    error = accuracy_summary(run.whole(), run.simulation(), *run.accuracy());
  else if (const OrderErrors found = orders(); found.blocks > 0)
    error = error_summary(run.simulation(), found);
  if (!run.measure_errors().empty()) add_measure_errors(run.scene(), run.measure_errors(), error);
  return error;
}

}  // namespace

int Run::stage() const {
  return stages_->number();
}

bool Run::stage_follows() const {
  return stages_->next() == RunStages::Next::next_stage;
}

const Scene& Run::whole() const {
  return stages_->whole();
}

const Scene& Run::scene() const {
  return stages_->scene();
}

const SceneIdentity& Run::identity() const {
  return stages_->identity();
}

const StagePlace& Run::place() const {
  return stages_->place();
}

const CrackRecord& Run::cracks() const {
  return stages_->cracks();
}

const Simulation& Run::simulation() const {
  return stages_->simulation();
}

const BuiltSimulation& Run::built() const {
  return stages_->built();
}

const Answer& Run::answer() const {
  return preparation_->answer();
}

const AccuracyState* Run::accuracy() const {
  return preparation_->accuracy();
}

const std::optional<MotionVerdict>& Run::verdict() const {
  return findings_->verdict();
}

const std::vector<GoalError>& Run::measure_errors() const {
  return findings_->measure_errors();
}

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
                                     simulation().blocks()[at(index)].name(), place().stage,
                                     whole().stage[at(place().stage - 1)].name));
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
  stages_->simulation().set_load_factor(index, load, factor);
  if (!is_static(scene().analysis) || status() == RunStatus::failed) return;
  end_.status.reset();
  findings_->reopen();
  stages_->reopen();
}

std::vector<std::string> Run::columns() const {
  return names_of(history_->columns(stage() > 0));
}

std::string Run::column_units() const {
  return ashlar::column_units(history_->columns(stage() > 0));
}

const std::vector<std::vector<double>>& Run::rows() const {
  return history_->rows();
}

void Run::observe(std::shared_ptr<RunObserver> observer) {
  if (!prepares()) {
    observer->run_begins(*this);
    if (stages_->next() == RunStages::Next::step) observer->stage_begins(*this);
  }
  record_->add(std::move(observer));
}

void Run::record(const std::filesystem::path& folder, ClaimPurpose purpose) {
  record_->require_unrecorded();
  if (status())
    throw std::logic_error("the run has ended, nothing is left to record: write() writes what it has");
  record(std::make_shared<const FolderClaim>(folder, purpose), {}, false);
}

void Run::record(std::shared_ptr<const FolderClaim> claim, std::optional<double> interval, bool kept) {
  record_->record(*this, std::move(claim), interval, kept, preparation_->checkpoint());
}

void Run::resume(const std::filesystem::path& folder) {
  record_->require_unrecorded();
  auto claim = std::make_shared<const FolderClaim>(folder, ClaimPurpose::resume);
  if (!holds_open_search(folder, whole())) resume(stored_checkpoint(folder, whole(), identity()));
  record(std::move(claim), {}, true);
}

void Run::resume(RunCheckpoint checkpoint) {
  if (!preparation_->allows_checkpoint()) throw std::logic_error("the run has begun, a new one is needed");
  stages_->resume(checkpoint);
  if (!checkpoint.cracks.events.empty()) history_->set_measures(measures_of(whole(), simulation().blocks()));
  findings_->resume(checkpoint.changes, checkpoint.falls);
  clock_.add_earlier(checkpoint.seconds);
  preparation_->resume(whole(), std::move(checkpoint));
}

bool Run::saved() const {
  return record_->saved();
}

RunCheckpoint Run::checkpoint() const {
  return checkpoint_with(simulation().snapshot());
}

RunCheckpoint Run::checkpoint_without_pairs() const {
  return checkpoint_with(simulation().snapshot_without_pairs());
}

RunCheckpoint Run::checkpoint_with(SimulationSnapshot simulation) const {
  const AccuracyState* choice = accuracy();
  return {std::move(simulation), stages_->finished(),  {},
          clock_.seconds(),      findings_->changes(), choice != nullptr ? *choice : AccuracyState{},
          findings_->falls(),    stages_->cracks()};
}

LargestValues Run::largest() const {
  if (auto recorded = record_->largest(simulation())) return std::move(*recorded);
  return largest_values(simulation(), drawn_blocks(simulation().blocks(), whole().output).surfaces,
                        place().origin.surfaces);
}

std::vector<OrderError> Run::order_errors() const {
  if (!findings_->has_order_errors(scene().analysis, status())) return {};
  return ashlar::order_errors(simulation());
}

OrderErrors Run::summary_order_errors() const {
  if (!findings_->has_order_errors(scene().analysis, status())) return {};
  if (status() && findings_->order_errors()) return *findings_->order_errors();
  return findings_->estimated_orders(simulation());
}

std::string Run::errors() const {
  return json_text(error_part(*this,
                              [this] {
                                std::vector<OrderError> all = order_errors();
                                const auto blocks = static_cast<int>(all.size());
                                return OrderErrors{std::move(all), blocks};
                              }),
                   2);
}

std::string Run::summary() const {
  return summary(record_->frames(), largest());
}

std::string Run::summary(int frames, const LargestValues& largest) const {
  const RunStatus status = end_.status.value_or(RunStatus::interrupted);
  std::vector<FinishedStage> begun;
  if (stage() > 0) {
    begun = stages_->finished();
    begun.push_back(stage_at_end(stage_follows() && !end_.status ? end_.stage : status));
  }
  auto summary = run_summary(
      whole(), identity(), built(),
      {status, message(), clock_.seconds(), frames, largest, std::move(begun), findings_->work()});
  if (auto error = error_part(*this, [this] { return summary_order_errors(); }); !error.is_null())
    summary["error"] = std::move(error);
  if (!whole().crack.empty()) add_cracks(summary, cracks(), whole(), simulation());
  add_answer(summary, answer(), whole().analysis, simulation());
  if (verdict()) summary["verdict"] = verdict_json(*verdict(), simulation());
  record_->add_peaks(summary);
  add_origin(summary, whole().origin);
  summary["units"] = summary_units(summary);
  return json_text(summary, 2) + "\n";
}

/// The present stage.
FinishedStage Run::stage_at_end(RunStatus status) const {
  return {to_string(status), message(), simulation().steps(), simulation().time()};
}

void Run::write_summary() const {
  record_->write_summary(*this);
}

void Run::write(const std::filesystem::path& folder) const {
  const FolderClaim claim(folder, ClaimPurpose::replacement);
  ResultFolder results(folder, whole(), simulation(), place());
  // The present state, whether a frame of it is due or not.
  results.add_end(simulation());
  HistoryWriter history(folder / "history.csv", columns());
  for (const std::vector<double>& row : rows())
    history.append(static_cast<std::int64_t>(row.front()), std::vector<double>(row.begin() + 1, row.end()));
  draw_answer(answer(), whole(), simulation(), folder);
  write_file_atomically(folder / "summary.json", summary(results.frames(), results.largest(simulation())),
                        Durability::process);
}

}  // namespace ashlar
