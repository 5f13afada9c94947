#include "apps/program/sweep/run_processes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "apps/program/command_line.hpp"
#include "apps/results/folder/run_clock.hpp"
#include "apps/results/system/interrupt_guard.hpp"
#include "apps/results/system/process_copy.hpp"
#include "apps/results/text/output_stream.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

constexpr auto poll_interval = std::chrono::milliseconds(20);

/// s; a run that ends sooner was kept, and tells nothing on the time of others.
constexpr double moment = 0.1;

int logged(const ProcessRun& run, std::ostream& log) {
  try {
    return run.run(log);
  } catch (const std::bad_alloc& error) {
    log << "ashlar: error: " << missing_memory(error) << '\n';
  } catch (const std::exception& error) {
    log << "ashlar: error: " << fault_text(error) << '\n';
  }
  return exit_status::failed;
}

class Processes {
 public:
  Processes(std::vector<ProcessRun> runs, const ProcessOptions& options, std::ostream& err)
      : runs_(std::move(runs)), options_(options), err_(err) {}

  /// @return exit status of all
  int go() {
    const InterruptGuard guard;
    std::size_t next = 0;
    while (next < runs_.size() || !children_.empty()) {
      if (InterruptGuard::interrupted()) {
        stop();
        next = runs_.size();
      }
      while (next < runs_.size() && children_.size() < jobs()) start(next++);
      if (!collect()) std::this_thread::sleep_for(poll_interval);
    }
    return stopped_ ? exit_status::interrupted : status_;
  }

 private:
  struct Child {
    ProcessCopy process;
    std::size_t run;
    double began;  ///< s, RunClock::now()
  };

  [[nodiscard]] std::size_t jobs() const {
    return options_.jobs > 0 ? static_cast<std::size_t>(options_.jobs)
                             : std::max(1U, std::thread::hardware_concurrency());
  }

  void start(std::size_t run) {
    std::shared_ptr<OutputFile> log;
    try {
      log = std::make_shared<OutputFile>(runs_[run].log, OutputFile::Start::empty);
    } catch (const std::runtime_error& fault) {
      err_ << fmt::format("ashlar: error: {}; a plain file is written there\n", fault_text(fault));
      note(run, exit_status::of(fault));
      return;
    }
    try {
      children_.push_back({ProcessCopy([this, run, log] {
                             OutputStreamBuffer buffer(std::move(*log));
                             std::ostream stream(&buffer);
                             return logged(runs_[run], stream);
                           }),
                           run, RunClock::now()});
    } catch (...) {
      stop();
      throw;
    }
  }

  /// Records a finished run. @return true if there was one
  bool collect() {
    for (auto child = children_.begin(); child != children_.end(); ++child) {
      const std::optional<int> status = child->process.ended();
      if (!status) continue;
      if (const double elapsed = RunClock::now() - child->began; elapsed > moment) {
        elapsed_ += elapsed;
        ++timed_;
      }
      const std::size_t run = child->run;
      children_.erase(child);
      note(run, *status >= 0 ? *status : exit_status::failed);
      return true;
    }
    return false;
  }

  void note(std::size_t run, int status) {
    ++done_;
    // Refused is worse than failed; interrupts are recorded in stopped_.
    if (status == exit_status::interrupted)
      stopped_ = true;
    else
      status_ = std::max(status_, status);
    if (options_.quiet && status == exit_status::done) return;
    const char* word = status == exit_status::done          ? "done"
                       : status == exit_status::failed      ? "failed"
                       : status == exit_status::interrupted ? "interrupted"
                                                            : "refused";
    err_ << fmt::format("{} of {}: {}: {}", done_, runs_.size(), runs_[run].name, word);
    if (status != exit_status::done) err_ << fmt::format(", see {}", runs_[run].log.string());
    if (const std::string remark = runs_[run].remark ? runs_[run].remark() : ""; !remark.empty())
      err_ << fmt::format(" ({})", remark);
    err_ << time_left() << std::endl;
  }

  /// "; 12 min left"; empty: not to be told, or unknown
  [[nodiscard]] std::string time_left() const {
    if (!options_.tells_time || timed_ == 0 || stopped_ || done_ == runs_.size()) return "";
    const double mean = elapsed_ / static_cast<double>(timed_);
    const auto open = static_cast<double>(runs_.size() - done_);
    return fmt::format("; {} left", waiting_time(mean * open / std::min(static_cast<double>(jobs()), open)));
  }

  void stop() {
    if (stopped_) return;
    stopped_ = true;
    for (const Child& child : children_) child.process.ask_to_end();
  }

  std::vector<ProcessRun> runs_;
  ProcessOptions options_;
  std::ostream& err_;
  std::vector<Child> children_;
  std::size_t done_ = 0, timed_ = 0;
  double elapsed_ = 0.0;  ///< s, by timed runs in all
  int status_ = exit_status::done;
  bool stopped_ = false;
};

}  // namespace

int run_processes(std::vector<ProcessRun> runs, const ProcessOptions& options, std::ostream& err) {
  return Processes(std::move(runs), options, err).go();
}

std::string waiting_time(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0;
  if (seconds < 2.0 * minute) return fmt::format("{:.0f} s", std::ceil(seconds));
  const double minutes = std::round(seconds / minute);
  if (minutes < minute) return fmt::format("{:.0f} min", minutes);
  return fmt::format("{:.0f} h {:.0f} min", std::floor(minutes * minute / hour), std::fmod(minutes, minute));
}

}  // namespace ashlar
