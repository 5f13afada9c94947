#include "apps/run/folder_recorder.hpp"

#include <utility>

#include "apps/results/folder/verdict_json.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/run/answers/answer_summary.hpp"
#include "apps/run/run.hpp"

namespace ashlar {

FolderRecorder::FolderRecorder(std::shared_ptr<const FolderClaim> claim,
                               std::optional<ResultFolderState> earlier)
    : claim_(std::move(claim)), earlier_(std::move(earlier)), reserve_(claim_->folder()) {}

void FolderRecorder::run_begins(const Run& run) {
  if (earlier_)
    files_.emplace(claim_->folder(), run.whole(), run.simulation(), *earlier_, run.answer().shows_states());
  else
    files_.emplace(claim_->folder(), run.whole(), run.simulation(), run.place());
  earlier_.reset();
  stage_ = run.stage();
}

void FolderRecorder::stage_begins(const Run& run) {
  if (run.stage() == stage_) return;
  stage_ = run.stage();
  files_->begin_stage(run.simulation(), run.place().elapsed,
                      run.whole().stage[static_cast<std::size_t>(stage_ - 1)].reset_displacement);
}

ResultFolder::Due FolderRecorder::due(const Run& run) const {
  return run.answer().shows_states() ? ResultFolder::Due::frame : files_->due(run.simulation());
}

void FolderRecorder::step_taken(const Run& run) {
  claim_->check();
  run.answer().shows_states() ? files_->add_state(run.simulation()) : files_->add_step(run.simulation());
}

void FolderRecorder::blocks_crack(const Run& run) {
  files_->divide_blocks(run.whole(), run.simulation());
}

void FolderRecorder::stage_ends(const Run& run) {
  draw_answer(run.answer(), run.scene(), run.simulation(), claim_->folder());
  files_->add_end(run.simulation());
}

void FolderRecorder::run_ends(const Run& run) {
  write_summary(run);
}

void FolderRecorder::save_after_failure(const Run& run) {
  reserve_.release();
  write_summary(run);
}

ResultFolderState FolderRecorder::synced_state() {
  return files_->synced_state();
}

void FolderRecorder::add_peaks(nlohmann::ordered_json& summary) const {
  if (!files_) return;
  if (const std::vector<MeasurePeak> peaks = files_->peaks(); !peaks.empty())
    summary["peaks"] = peaks_json(peaks);
}

void FolderRecorder::write_summary(const Run& run) const {
  claim_->check();
  write_file_atomically(claim_->folder() / "summary.json",
                        run.summary(frames(), files_->largest(run.simulation())), Durability::process);
}

}  // namespace ashlar
