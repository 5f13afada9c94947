// What the program is at before the first step, told on stderr where that takes more than a second or so.
#pragma once

#include <chrono>
#include <condition_variable>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>

namespace ashlar {

/// Tells the present phase after `patience` and then after twice the last wait each: a line a time, from a
/// thread of its own. Nothing else may write to the stream until it is destroyed.
class Preparation {
 public:
  /// @param quiet nothing is told. @param err stderr, or what stands for it
  Preparation(bool quiet, std::ostream& err, std::chrono::milliseconds patience = std::chrono::seconds(1));
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// What comes now: "solid of block A (3 of 10)".
  void phase(std::string words);

 private:
  void tell(std::chrono::milliseconds patience);

  std::ostream& err_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::string words_ = "scene";  ///< guarded by mutex_
  bool over_ = false;            ///< guarded by mutex_
  std::thread teller_;
};

}  // namespace ashlar
