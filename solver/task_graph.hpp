// Tasks that wait for others, on several threads: each writes only what no other task writes before it has ended.
#pragma once

#include <functional>
#include <vector>

namespace ashlar {

/// Tasks are numbered so that each one waits for lower numbers only. May be run several times.
class TaskGraph {
 public:
  /// @param cost time of the task in any unit, >= 0: of the tasks that may start, the one at the head of the longest
  /// chain is started first. @param after tasks that it waits for, each added before
  /// @return number of the task
  int add(double cost, const std::vector<int>& after);
  [[nodiscard]] int size() const { return static_cast<int>(costs_.size()); }

  /// Calls work(task, worker) once for each task, on up to `threads` threads. Calls with the same worker do not
  /// overlap. On one thread the tasks run in the order of their numbers. Rethrows the first exception of a task; tasks
  /// that have not started are then skipped.
  /// @param threads >= 1; workers are 0 to threads - 1
  void run(int threads, const std::function<void(int task, int worker)>& work) const;

 private:
  std::vector<double> costs_;
  std::vector<std::vector<int>> next_;  ///< for each task those that wait for it
  std::vector<int> waits_;              ///< for each task the number of tasks it waits for
};

}  // namespace ashlar
