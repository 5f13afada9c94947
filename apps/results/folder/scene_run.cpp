#include "apps/results/folder/scene_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "apps/results/folder/run_summary.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/build/initial_state.hpp"
#include "apps/scene/check/added_blocks.hpp"
#include "apps/scene/check/loose_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "geometry/index.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

BuiltSimulation built(const LoadedScene& stage, int threads, bool first) {
  Diagnostics diagnostics;
  std::optional<BuiltSimulation> result = build_simulation(stage, threads, diagnostics);
  if (result && first && is_static(stage.scene.analysis))
    refuse_loose_blocks(stage.scene, result->simulation, diagnostics);
  for (const Diagnostic& fault : diagnostics.sorted())
    if (fault.severity == Severity::error) throw std::invalid_argument(to_string(fault));
  return std::move(*result);
}

/// @throws std::invalid_argument
std::shared_ptr<const LoadedScene> checked(std::shared_ptr<const LoadedScene> scene, int threads) {
  const SceneAnalysis::Type type = scene->scene.analysis.type;
  if (type != SceneAnalysis::Type::dynamic && type != SceneAnalysis::Type::statics)
    throw std::invalid_argument(
        "limits are found by many analyses (analysis.type), `ashlar run` or ashlar.run() does it; "
        "static or dynamic "
        "is needed here");
  if (threads < 1) throw std::invalid_argument(fmt::format("threads is {}, at least 1 is needed", threads));
  return scene;
}

}  // namespace

SceneRun::SceneRun(std::shared_ptr<const LoadedScene> scene, int threads, double setup_start)
    : scene_(checked(std::move(scene), threads)),
      present_(std::make_shared<const LoadedScene>(stage_of(*scene_, 0))),
      identity_(scene_identity(*scene_)),
      threads_(threads),
      built_(built(*present_, threads, true)),
      measures_(measures_of(scene_->scene, built_.simulation.blocks())),
      points_(std::make_unique<const BlockPoints>()) {
  if (starts_from_statics(present_->scene)) {
    const StaticStart start = start_in_statics(built_.simulation, [] { return true; });
    if (start.end == StaticStart::End::failed) throw std::runtime_error(start.message);
    message_ = start.message;
  }
  if (stage() > 0 && scene_->scene.stage.front().reset_displacement) reset_displacement();
  add_row();
  clock_.note_setup(setup_start);
}

bool SceneRun::step() {
  if (status_ == RunStatus::failed) throw std::runtime_error(message_);
  if (status_) return false;
  const RunClock::Call call(clock_);
  if (stage_has_ended_) begin_next_stage();
  if (is_static(present_->scene.analysis)) {
    take_static_step();
  } else {
    take_step();
  }
  return !status_;
}

void SceneRun::begin_next_stage() {
  const std::vector<bool> was_absent = built_.simulation.system().absent();
  const auto next = static_cast<std::size_t>(place_.stage);
  const auto scene = std::make_shared<const LoadedScene>(stage_of(*scene_, next));
  BuiltSimulation stage = built(*scene, threads_, false);
  stage.simulation.start_stage(built_.simulation.snapshot(), was_absent);
  if (const auto overlap = overlap_of_added(stage.simulation, was_absent))
    fail(fmt::format("stage {} cannot begin: {}", scene_->scene.stage[next].name, *overlap));
  place_.elapsed += built_.simulation.time();
  present_ = scene;
  built_ = std::move(stage);
  ++place_.stage;
  stage_has_ended_ = false;
  changes_.forget();
  message_.clear();
  const bool resets = scene_->scene.stage[next].reset_displacement;
  if (resets) reset_displacement();
  if (results_) results_->begin_stage(built_.simulation, place_.elapsed, resets);
}

void SceneRun::reset_displacement() {
  place_.origin =
      origin_of(simulation(), measures_, drawn_blocks(simulation().blocks(), scene_->scene.output));
}

void SceneRun::take_step() {
  Simulation& simulation = built_.simulation;
  const double end_time = present_->scene.analysis.end_time;
  StepStatus taken = StepStatus::accepted;
  try {
    taken = simulation.step(end_time);
  } catch (const std::exception& error) {
    fail(fmt::format("step {} at t = {:.9g} s cannot be taken: {}", simulation.steps() + 1, simulation.time(),
                     fault_text(error)));
  }
  if (taken != StepStatus::accepted) {
    const Rejection& last = simulation.rejections().back();
    fail(fmt::format("step {} at t = {:.9g} s was rejected down to a time step of {:.3g} s: {}",
                     simulation.steps() + 1, simulation.time(), last.step, reason_of(last, simulation)));
  }
  add_row();
  if (!simulation.reached(end_time)) return;
  if (const auto deep = simulation.audit())
    fail(fmt::format("the run ended at t = {:.9g} s with blocks too deep in each other: {}",
                     simulation.time(), description_of(*deep, simulation)));
  end(RunStatus::completed, "");
}

void SceneRun::take_static_step() {
  Simulation& simulation = built_.simulation;
  const int before = simulation.steps();
  StaticStatus found = StaticStatus::balancing;
  try {
    found = simulation.static_step(present_->scene.analysis.end_time);
  } catch (const std::exception& error) {
    fail(fmt::format("iteration {} cannot be taken: {}", simulation.steps() + 1, fault_text(error)));
  }
  if (simulation.steps() > before) {
    changes_.note(simulation);
    add_row();
  }
  switch (found) {
    case StaticStatus::balancing:
      break;
    case StaticStatus::equilibrium:
      end(RunStatus::equilibrium, describe_displaced(simulation));
      break;
    case StaticStatus::moving:
      end(RunStatus::moving, describe_motion(simulation));
      break;
    case StaticStatus::not_converged:
      end(RunStatus::not_converged, describe_unconverged(simulation, changes_));
      break;
  }
}

void SceneRun::end(RunStatus status, std::string message) {
  message_ = std::move(message);
  if (results_) results_->add_end(built_.simulation);
  const bool goes_on = status == RunStatus::completed || status == RunStatus::equilibrium;
  if (goes_on && static_cast<std::size_t>(place_.stage) < stage_count(scene_->scene)) {
    finished_.push_back(finished(status));
    stage_has_ended_ = true;
    return;
  }
  status_ = status;
  if (results_) write_summary(*results_);
}

void SceneRun::fail(const std::string& message) {
  status_ = RunStatus::failed;
  message_ = message;
  if (results_) write_summary(*results_);
  throw std::runtime_error(message);
}

void SceneRun::add_row() {
  rows_.push_back({static_cast<double>(built_.simulation.steps())});
  const std::vector<double> values = history_row(built_.simulation, measures_, place_.origin, stage());
  rows_.back().insert(rows_.back().end(), values.begin(), values.end());
  if (!results_) return;
  const Stopwatch watch(clock_.output());
  results_->add_step(built_.simulation);
}

int SceneRun::block(const std::string& name) const {
  const std::vector<BlockModel>& blocks = simulation().blocks();
  const auto found = std::find_if(blocks.begin(), blocks.end(),
                                  [&](const BlockModel& block) { return block.name() == name; });
  if (found == blocks.end()) throw std::out_of_range(fmt::format("no block is called {}", name));
  return static_cast<int>(found - blocks.begin());
}

void SceneRun::require_present(int index) const {
  if (present(index)) return;
  throw std::logic_error(fmt::format("block {} is not there in stage {} ({})",
                                     simulation().blocks()[at(index)].name(), place_.stage,
                                     scene_->scene.stage[at(place_.stage - 1)].name));
}

std::vector<PointMotion> SceneRun::motions(int index, const std::vector<Vector3>& points,
                                           OutsidePoints outside) const {
  require_present(index);
  const BlockModel& model = simulation().blocks()[at(index)];
  if (outside == OutsidePoints::refused) points_->require(index, model, points);
  return model.motions_of(simulation().states()[at(index)], points);
}

PointMotion SceneRun::motion(const std::string& name, const Vector3& point, OutsidePoints outside) const {
  return motions(block(name), {point}, outside).front();
}

void SceneRun::set_load_factor(const std::string& name, int load, double factor) {
  const int index = block(name);
  const std::size_t loads = simulation().blocks()[at(index)].loads().size();
  if (load < 0 || at(load) >= loads)
    throw std::out_of_range(fmt::format("block {} has {} loads, there is no load {}", name, loads, load));
  built_.simulation.set_load_factor(index, load, factor);
  if (!is_static(present_->scene.analysis) || status_ == RunStatus::failed) return;
  status_.reset();
  if (stage_has_ended_) finished_.pop_back();
  stage_has_ended_ = false;
}

std::vector<std::string> SceneRun::columns() const {
  return history_columns(measures_, stage() > 0);
}

void SceneRun::record(const std::filesystem::path& folder, ClaimPurpose purpose) {
  if (results_) throw std::logic_error("the run is recorded already, into " + results_->path().string());
  if (status_)
    throw std::logic_error("the run has ended, nothing is left to record: write() writes what it has");
  auto claim = std::make_unique<FolderClaim>(folder, purpose);
  results_ = std::make_unique<ResultFolder>(folder, scene_->scene, simulation(), place_);
  claim_ = std::move(claim);
}

void SceneRun::write_summary() const {
  if (results_) write_summary(*results_);
}

FinishedStage SceneRun::finished(RunStatus status) const {
  return {to_string(status), message_, simulation().steps(), simulation().time()};
}

std::vector<FinishedStage> SceneRun::begun_stages(RunStatus status) const {
  if (stage() == 0) return {};
  std::vector<FinishedStage> begun = finished_;
  if (!stage_has_ended_) begun.push_back(finished(status));
  return begun;
}

void SceneRun::write_summary(const ResultFolder& results) const {
  const RunStatus status = status_.value_or(RunStatus::interrupted);
  const auto summary = run_summary(scene_->scene, identity_, built_,
                                   {status, message_, clock_.seconds(), results.frames(),
                                    results.largest(simulation()), begun_stages(status)});
  write_file_atomically(results.path() / "summary.json", json_text(summary, 2) + "\n", Durability::process);
}

void SceneRun::write(const std::filesystem::path& folder) const {
  const FolderClaim claim(folder, ClaimPurpose::replacement);
  const ResultFolder results(folder, scene_->scene, simulation(), place_);
  HistoryWriter history(folder / "history.csv", columns());
  for (const std::vector<double>& row : rows_)
    history.append(static_cast<std::int64_t>(row.front()), std::vector<double>(row.begin() + 1, row.end()));
  write_summary(results);
}

}  // namespace ashlar
