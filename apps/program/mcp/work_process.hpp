// A copy of this process that works for a client, with files for its output.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/results/system/process_copy.hpp"

namespace ashlar {

class WorkProcess {
 public:
  /// @param work prints to std::cout and std::cerr; what it throws is printed, and its exit status is then 1
  /// @param name path of its files, without their endings. @param reads folders that its reading of input is limited to;
  /// none: it is not. @throws std::system_error as ProcessCopy
  WorkProcess(const std::function<int()>& work, const std::filesystem::path& name,
              const std::vector<std::filesystem::path>& reads, CopyEnd end);
  /// Ends it at once if it works, and removes its files.
  ~WorkProcess();
  WorkProcess(const WorkProcess&) = delete;
  WorkProcess& operator=(const WorkProcess&) = delete;

  /// Empty while it works; then its exit status, -1 if a signal ended it.
  [[nodiscard]] std::optional<int> status();
  void ask_to_end() const { copy_.ask_to_end(); }
  void end_at_once() const { copy_.end_at_once(); }
  /// s from its start to its end, or to the present.
  [[nodiscard]] double seconds();

  /// Its output so far.
  [[nodiscard]] std::string out() const;
  [[nodiscard]] std::string err() const;

 private:
  CopyStreams streams_;
  std::chrono::steady_clock::time_point started_, ended_;
  ProcessCopy copy_;
  std::optional<int> status_;
};

}  // namespace ashlar
