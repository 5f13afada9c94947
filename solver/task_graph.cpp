#include "solver/task_graph.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include "geometry/index.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

/// Tries of a waiting thread before it lets others run: more end chains of short tasks sooner where cores are idle, and hold
/// others up where they are not.
constexpr int tries_before_yield = 64;

/// The tasks of one run that may start, and those that wait.
class ReadyTasks {
 public:
  ReadyTasks(const std::vector<double>& chains, const std::vector<std::vector<int>>& next,
             std::vector<int> waits)
      : chains_(chains), next_(next), waits_(std::move(waits)), left_(static_cast<int>(waits_.size())) {
    for (int task = 0; task < left_; ++task)
      if (waits_[at(task)] == 0) push(task);
  }

  /// Waits for a task that may start. @return none: all have ended, or one has failed
  [[nodiscard]] std::optional<int> take() {
    // A waiting thread spins: a chain of short tasks ends sooner than a thread wakes. Between tries it lets others run.
    for (int n = 0; left_.load() > 0; ++n) {
      if (count_.load() > 0) {
        const std::scoped_lock lock(mutex_);
        if (!ready_.empty()) return pop();
      }
      if (n % tries_before_yield == tries_before_yield - 1) std::this_thread::yield();
    }
    return std::nullopt;
  }

  void note_end_of(int task) {
    const std::scoped_lock lock(mutex_);
    for (const int other : next_[at(task)])
      if (--waits_[at(other)] == 0) push(other);
    --left_;
  }

  /// No task starts from here on.
  void stop() { left_ = 0; }

 private:
  [[nodiscard]] bool less(int a, int b) const {
    return chains_[at(a)] < chains_[at(b)] || (chains_[at(a)] == chains_[at(b)] && a > b);
  }
  void push(int task) {
    ready_.push_back(task);
    std::push_heap(ready_.begin(), ready_.end(), [this](int a, int b) { return less(a, b); });
    ++count_;
  }
  [[nodiscard]] int pop() {
    std::pop_heap(ready_.begin(), ready_.end(), [this](int a, int b) { return less(a, b); });
    const int task = ready_.back();
    ready_.pop_back();
    --count_;
    return task;
  }

  const std::vector<double>& chains_;
  const std::vector<std::vector<int>>& next_;
  std::mutex mutex_;
  std::vector<int> ready_;  ///< a heap, the longest chain on top
  std::vector<int> waits_;
  std::atomic<int> count_ = 0;  ///< of ready tasks
  std::atomic<int> left_;       ///< tasks that have not ended
};

}  // namespace

int TaskGraph::add(double cost, const std::vector<int>& after) {
  const int task = size();
  costs_.push_back(cost);
  next_.emplace_back();
  waits_.push_back(static_cast<int>(after.size()));
  for (const int other : after) next_[at(other)].push_back(task);
  return task;
}

void TaskGraph::run(int threads, const std::function<void(int task, int worker)>& work) const {
  if (threads == 1) {
    for (int task = 0; task < size(); ++task) work(task, 0);
    return;
  }
  std::vector<double> chains = costs_;
  for (int task = size() - 1; task >= 0; --task) {
    double longest = 0.0;
    for (const int other : next_[at(task)]) longest = std::max(longest, chains[at(other)]);
    chains[at(task)] += longest;
  }
  ReadyTasks tasks(chains, next_, waits_);
  parallel_for(threads, at(threads), [&](std::size_t worker) {
    while (const std::optional<int> task = tasks.take()) {
      try {
        work(*task, static_cast<int>(worker));
      } catch (...) {
        tasks.stop();
        throw;
      }
      tasks.note_end_of(*task);
    }
  });
}

}  // namespace ashlar
