#include "apps/scene/model/preparation.hpp"

#include <fmt/format.h>

#include <new>
#include <ostream>
#include <system_error>

namespace ashlar {

Preparation::Preparation(bool quiet, std::ostream& err, std::chrono::milliseconds patience) : err_(err) {
  if (quiet) return;
  try {
    teller_ = std::thread([this, patience] { tell(patience); });
  } catch (const std::
               system_error&) {  // NOLINT(bugprone-empty-catch): where no thread can be had, nothing is told
  }
}

Preparation::~Preparation() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  ended_.notify_all();
  if (teller_.joinable()) teller_.join();
}

void Preparation::phase(std::string words) {
  const std::lock_guard lock(mutex_);
  words_ = std::move(words);
}

void Preparation::tell(std::chrono::milliseconds patience) {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  for (auto wait = patience;; wait *= 2) {
    if (ended_.wait_for(lock, wait, [this] { return over_; })) return;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    try {
      err_ << fmt::format("preparing: {} ({:.0f} s)\n", words_, passed.count()) << std::flush;
    } catch (const std::
                 bad_alloc&) {  // NOLINT(bugprone-empty-catch): a line that is lost must not end the program
    }
  }
}

}  // namespace ashlar
