#include "apps/run/run_record.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/run/run.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/results/ended_run.hpp"

namespace ashlar::run_record_test {
namespace {

Run small_run() {
  return Run(test::loaded_scene(R"(
analysis = { end_time = 0.01, time_step = 1e-3, gravity = [0, 0, 0] }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "cube"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
)"));
}

/// Writes its name into a list for each event, or fails.
class Writer final : public RunObserver {
 public:
  Writer(std::string name, std::vector<std::string>& events, bool fails = false)
      : name_(std::move(name)), events_(events), fails_(fails) {}
  [[nodiscard]] bool may_continue() override { return !fails_; }
  void run_begins(const Run& /*run*/) override { write("begins"); }
  void step_taken(const Run& /*run*/) override { write("steps"); }
  void run_ends(const Run& /*run*/) override { write("ends"); }
  void save_after_failure(const Run& /*run*/) override { write("saves"); }

 private:
  void write(const std::string& event) {
    if (fails_) throw std::runtime_error(name_ + " is full");
    events_.push_back(name_ + " " + event);
  }

  std::string name_;
  std::vector<std::string>& events_;
  bool fails_;
};

TEST(RunRecord, ObserversAreToldInTheirOrderAndEndInReverse) {
  const ashlar::Run run = small_run();
  RunRecord record({});
  std::vector<std::string> events;
  record.add(std::make_shared<Writer>("a", events));
  record.add(std::make_shared<Writer>("b", events));
  RunEnd end;
  EXPECT_TRUE(record.may_continue());
  record.begin(run);
  EXPECT_TRUE(record.tell(&RunObserver::step_taken, run, end));
  record.tell_end(run, end);
  EXPECT_FALSE(end.status);
  EXPECT_EQ(events,
            (std::vector<std::string>{"a begins", "b begins", "a steps", "b steps", "b ends", "a ends"}));
}

TEST(RunRecord, AnObserverThatCannotWriteFailsTheRun) {
  const ashlar::Run run = small_run();
  RunRecord record({});
  std::vector<std::string> events;
  record.add(std::make_shared<Writer>("a", events));
  record.add(std::make_shared<Writer>("b", events, true));
  RunEnd end;
  EXPECT_FALSE(record.may_continue());
  EXPECT_THROW(record.begin(run), std::runtime_error);
  EXPECT_FALSE(record.tell(&RunObserver::step_taken, run, end));
  EXPECT_EQ(end.status, RunStatus::failed);
  EXPECT_EQ(end.stage, RunStatus::failed);
  EXPECT_EQ(end.message, "results of step 0 at t = 0 s could not be written: b is full");
  EXPECT_EQ(end.unsaved, "b is full");
  EXPECT_EQ(events, (std::vector<std::string>{"a begins", "a steps", "a saves"}));
}

TEST(RunRecord, ASummaryThatCannotBeWrittenFailsTheRun) {
  const ashlar::Run run = small_run();
  RunRecord record({});
  std::vector<std::string> events;
  record.add(std::make_shared<Writer>("a", events));
  record.add(std::make_shared<Writer>("b", events, true));
  RunEnd end;
  end.end(RunStatus::completed);
  end.message = "at rest";
  record.tell_end(run, end);
  EXPECT_EQ(end.status, RunStatus::failed);
  EXPECT_EQ(end.message, "at rest; the summary could not be written: b is full");
  EXPECT_EQ(events, std::vector<std::string>{"a ends"}) << "the others end as ever";
}

TEST(RunRecord, AFolderIsForOneRecord) {
  const TemporaryFolder folder;
  ashlar::Run run = small_run();
  RunRecord record({});
  EXPECT_NO_THROW(record.require_unrecorded());
  EXPECT_EQ(record.due(run, true), ResultFolder::Due::row);
  EXPECT_EQ(record.due(run, false), ResultFolder::Due::nothing);
  EXPECT_FALSE(record.largest(run.simulation()));
  record.record(run, std::make_shared<const FolderClaim>(folder / "out", ClaimPurpose::new_run), 0.5, true,
                nullptr);
  EXPECT_THROW(record.require_unrecorded(), std::logic_error);
  EXPECT_FALSE(record.saved());
  EXPECT_EQ(record.frames(), 0);
  const TrialStorage& trials = record.trial_storage();
  EXPECT_NE(trials.claim, nullptr);
  EXPECT_TRUE(trials.resume);
  EXPECT_EQ(trials.interval, 0.5);
}

}  // namespace
}  // namespace ashlar::run_record_test
