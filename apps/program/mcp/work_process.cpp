#include "apps/program/mcp/work_process.hpp"

#include <exception>
#include <iostream>
#include <new>
#include <system_error>
#include <thread>

#include "apps/program/command_line.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "geometry/text/reading_folder.hpp"

namespace ashlar {
namespace {

std::filesystem::path with_ending(std::filesystem::path name, const char* ending) {
  name += ending;
  return name;
}

/// In the copy.
int printed_work(const std::function<int()>& work, const std::vector<std::filesystem::path>& reads) {
  int status = exit_status::failed;
  try {
    limit_reading_to(reads);
    status = work();
  } catch (const std::bad_alloc& error) {
    std::cerr << "ashlar: error: " << missing_memory(error) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "ashlar: error: " << fault_text(error) << '\n';
  }
  std::cout.flush();
  std::cerr.flush();
  return status;
}

/// Empty if it cannot be read.
std::string printed_text(const std::filesystem::path& file) {
  try {
    return whole_file(file, most_input_bytes);
  } catch (const std::runtime_error&) {
    return "";
  }
}

}  // namespace

WorkProcess::WorkProcess(const std::function<int()>& work, const std::filesystem::path& name,
                         const std::vector<std::filesystem::path>& reads, CopyEnd end)
    : streams_{with_ending(name, ".out"), with_ending(name, ".err")},
      started_(std::chrono::steady_clock::now()),
      copy_([&] { return printed_work(work, reads); }, streams_, end) {}

WorkProcess::~WorkProcess() {
  constexpr std::chrono::milliseconds pause(1);
  if (!status()) copy_.end_at_once();
  while (!status()) std::this_thread::sleep_for(pause);
  std::error_code ignored;
  std::filesystem::remove(streams_.out, ignored);
  std::filesystem::remove(streams_.err, ignored);
}

std::optional<int> WorkProcess::status() {
  if (status_) return status_;
  status_ = copy_.ended();
  if (status_) ended_ = std::chrono::steady_clock::now();
  return status_;
}

double WorkProcess::seconds() {
  const auto now = status() ? ended_ : std::chrono::steady_clock::now();
  return std::chrono::duration<double>(now - started_).count();
}

std::string WorkProcess::out() const {
  return printed_text(streams_.out);
}

std::string WorkProcess::err() const {
  return printed_text(streams_.err);
}

}  // namespace ashlar
