#include "apps/run/run_record.hpp"

#include <fmt/format.h>

#include <new>
#include <stdexcept>
#include <utility>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

void save_after_failure(RunObserver& observer, const Run& run, RunEnd& end) {
  try {
    observer.save_after_failure(run);
  } catch (const std::exception& error) {
    if (end.unsaved.empty()) end.unsaved = fault_text(error);
  }
}

}  // namespace

void RunRecord::begin(const Run& run) const {
  group_.do_on_each([&] {
    observers_.tell(&RunObserver::run_begins, run);
    if (last_) last_->run_begins(run);
  });
}

bool RunRecord::tell(RunEvent event, const Run& run, RunEnd& end) const {
  const auto all_told = [&](const auto& telling) {
    try {
      telling();
      return told_everywhere(true, end);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      fail_to_write(error, run, end);
      return told_everywhere(false, end);
    }
  };
  if (!all_told([&] { observers_.tell(event, run); })) return false;
  return !last_ || all_told([&] { ((*last_).*event)(run); });
}

/// @return false if results could not be written on any process: the run has failed on all
bool RunRecord::told_everywhere(bool told, RunEnd& end) const {
  if (!group_.any(!told)) return true;
  if (told) end.fail("results could not be written");
  return false;
}

/// E.g. on a full disk.
void RunRecord::fail_to_write(const std::exception& error, const Run& run, RunEnd& end) const {
  end.fail(fmt::format("results of step {} at t = {:.9g} s could not be written: {}",
                       run.simulation().steps(), run.simulation().time(), fault_text(error)));
  for (auto observer = observers_.all().rbegin(); observer != observers_.all().rend(); ++observer)
    save_after_failure(**observer, run, end);
}

void RunRecord::tell_end(const Run& run, RunEnd& end) const {
  for (auto observer = observers_.all().rbegin(); observer != observers_.all().rend(); ++observer) {
    try {
      (*observer)->run_ends(run);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      end.fail(fmt::format("{}{}the summary could not be written: {}", end.message,
                           end.message.empty() ? "" : "; ", fault_text(error)));
      save_after_failure(**observer, run, end);
    }
  }
}

void RunRecord::record(Run& run, std::shared_ptr<const FolderClaim> claim, std::optional<double> interval,
                       bool keeps_trials, const RunCheckpoint* earlier) {
  if (!claim) {
    last_ = saver_ = std::make_shared<CheckpointSaver>(nullptr, interval, earlier != nullptr, group_);
    return;
  }
  auto recorder = std::make_shared<FolderRecorder>(
      claim, earlier != nullptr ? std::optional(earlier->folder) : std::optional<ResultFolderState>());
  auto saver = std::make_shared<CheckpointSaver>(recorder, interval, earlier != nullptr, group_);
  run.observe(recorder);
  if (group_.shared())
    last_ = saver;
  else
    run.observe(saver);
  recorder_ = std::move(recorder);
  saver_ = std::move(saver);
  trials_ = {std::move(claim), keeps_trials, interval};
}

void RunRecord::require_unrecorded() const {
  if (trials_.claim)
    throw std::logic_error("the run is recorded already, into " + trials_.claim->folder().string());
}

ResultFolder::Due RunRecord::due(const Run& run, bool keeps_rows) const {
  const ResultFolder::Due of_memory = keeps_rows ? ResultFolder::Due::row : ResultFolder::Due::nothing;
  return group_.value_of_first(recorder_ ? recorder_->due(run) : of_memory);
}

std::optional<LargestValues> RunRecord::largest(const Simulation& simulation) const {
  if (!recorder_ || !recorder_->begun()) return std::nullopt;
  return recorder_->largest(simulation);
}

void RunRecord::add_peaks(nlohmann::ordered_json& summary) const {
  if (recorder_) recorder_->add_peaks(summary);
}

void RunRecord::write_summary(const Run& run) const {
  if (recorder_) recorder_->write_summary(run);
}

}  // namespace ashlar
