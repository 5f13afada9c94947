// A page has one process and one thread.
#include "apps/results/system/process_copy.hpp"

#include <exception>
#include <system_error>

namespace ashlar {

bool copies_have_streams() {
  return false;
}

ProcessCopy::ProcessCopy(const std::function<int()>& /*run*/, const std::optional<CopyStreams>& /*streams*/,
                         CopyEnd /*end*/) {
  throw std::system_error(std::make_error_code(std::errc::function_not_supported),
                          "a process for a run cannot be made in a browser");
}

std::optional<int> ProcessCopy::ended() const {
  return static_cast<int>(process_);  // none was made
}

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
