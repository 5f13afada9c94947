// Windows has no copies of processes. A function runs in a thread of this process instead: it sees the same data, but
// cannot be ended from outside, and has the standard streams of this process.
#include "apps/results/system/process_copy.hpp"

#include <exception>
#include <future>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace ashlar {
namespace {

/// Threads that have not been joined, by number.
struct Threads {
  struct Started {
    std::future<int> status;
    std::thread thread;
  };
  std::mutex mutex;
  std::map<std::int64_t, Started> started;
  std::int64_t last = 0;
};

// Never destroyed: threads that still run at the end of the program use it.
Threads& all_threads() {
  static auto& all = *new Threads;
  return all;
}

}  // namespace

bool copies_have_streams() {
  return false;
}

ProcessCopy::ProcessCopy(const std::function<int()>& run, const std::optional<CopyStreams>& streams,
                         CopyEnd /*end*/) {
  if (streams)
    throw std::system_error(std::make_error_code(std::errc::function_not_supported),
                            "a process for a run cannot be made");
  std::packaged_task<int()> task([run] { return run(); });
  Threads& all = all_threads();
  const std::lock_guard lock(all.mutex);
  process_ = ++all.last;
  Threads::Started& started = all.started[process_];
  started.status = task.get_future();
  started.thread = std::thread(std::move(task));
}

std::optional<int> ProcessCopy::ended() const {
  Threads& all = all_threads();
  const std::lock_guard lock(all.mutex);
  const auto found = all.started.find(process_);
  if (found == all.started.end()) return -1;
  if (found->second.status.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return std::nullopt;
  Threads::Started done = std::move(found->second);
  all.started.erase(found);
  done.thread.join();
  try {
    return done.status.get();
  } catch (const std::exception&) {
    return -1;
  }
}

// Who asks has been interrupted, and all threads of this process see that too.
void ProcessCopy::ask_to_end() const {}

void ProcessCopy::end_at_once() const {}

std::optional<std::string> told_by_copy(const std::function<std::optional<std::string>()>& tell) {
  try {
    return tell();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace ashlar
