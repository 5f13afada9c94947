// Progress messages on stderr before the first step, if that takes more than about a second.
#pragma once

#include <chrono>
#include <condition_variable>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>

namespace ashlar {

/// Prints the present phase after `patience` and then after twice the last interval each, one line a time, from a
/// thread of its own. Nothing else may write to the stream until this is destroyed.
class Preparation {
 public:
  /// @param quiet no output. @param err stderr or its substitute
  Preparation(bool quiet, std::ostream& err, std::chrono::milliseconds patience = std::chrono::seconds(1));
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// Sets the present phase: "solid of block A (3 of 10)".
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
