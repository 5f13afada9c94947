// Observer that tells the progress of a run: lines of a search for a factor, the progress line of each stage, and how
// stages end.
#pragma once

#include <iosfwd>
#include <optional>

#include "apps/run/progress.hpp"
#include "apps/run/run_observer.hpp"

namespace ashlar {

class RunProgress : public RunObserver {
 public:
  /// @param out stderr or its substitute; must outlive this. @param quiet only interrupted trials
  RunProgress(std::ostream& out, bool quiet);

  void method_chosen(bool limit, const std::string& reason) override;
  void limits_found(const LimitFindings& findings) override;
  void trial_continues(double factor, int iterations) override;
  void trial_ends(const FactorTrial& trial, const std::string& reason) override;
  void trial_stops(double factor, int iterations) override;
  void stage_begins(const Run& run) override;
  void step_taken(const Run& run) override;
  void blocks_crack(const Run& run) override;
  void stage_ends(const Run& run) override;
  void save_after_failure(const Run& run) override;
  /// Ends the progress line, so that a message starts on a new one.
  void finish() { line_.reset(); }

 private:
  std::ostream& out_;
  bool quiet_;
  double told_;  ///< time of the last line of a trial
  std::size_t told_cracks_ = 0;
  std::optional<ProgressLine> line_;
};

}  // namespace ashlar
