#include "apps/results/system/child_program.hpp"

#include <fmt/format.h>
#include <io.h>
#include <stdlib.h>
#include <windows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "apps/results/system/windows/open_file.hpp"

namespace ashlar {
namespace {

/// Owns a handle of Windows.
class Handle {
 public:
  explicit Handle(HANDLE handle = nullptr) : handle_(handle == INVALID_HANDLE_VALUE ? nullptr : handle) {}
  ~Handle() {
    if (handle_ != nullptr) ::CloseHandle(handle_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] HANDLE get() const { return handle_; }

 private:
  HANDLE handle_;
};

[[noreturn]] void fail_to_start(const std::string& name) {
  throw std::runtime_error(fmt::format("cannot start {}: {}", name, reason_of_windows().message()));
}

/// A file, or NUL, that a child process inherits.
HANDLE inherited_file(const std::filesystem::path& path, DWORD access, DWORD creation) {
  SECURITY_ATTRIBUTES inherits{sizeof inherits, nullptr, TRUE};
  return ::CreateFileW(name_for_windows(path).c_str(), access, FILE_SHARE_READ | FILE_SHARE_DELETE, &inherits,
                       creation, FILE_ATTRIBUTE_NORMAL, nullptr);
}

/// An argument as programs take it from a command line: in quotation marks, and a backslash before each one in it.
std::wstring quoted(const std::wstring& argument) {
  std::wstring text = L"\"";
  std::size_t slashes = 0;
  for (const wchar_t letter : argument) {
    if (letter == L'"') text.append(slashes + 1, L'\\');
    slashes = letter == L'\\' ? slashes + 1 : 0;
    text += letter;
  }
  return text.append(slashes, L'\\') + L'"';
}

std::wstring command_line(const std::vector<std::string>& command) {
  std::wstring line = quoted(std::filesystem::absolute(command.front()).native());
  for (std::size_t k = 1; k < command.size(); ++k) line += L' ' + quoted(wide_text(command[k]));
  return line;
}

/// Variables of this process, with one thread for linear algebra.
std::wstring environment_of_child() {
  constexpr std::array threads = {L"OPENBLAS_NUM_THREADS=", L"OMP_NUM_THREADS=", L"MKL_NUM_THREADS="};
  std::wstring block;
  wchar_t* const all = ::GetEnvironmentStringsW();
  for (const wchar_t* variable = all; *variable != L'\0';
       variable += std::wstring_view(variable).size() + 1) {
    const std::wstring_view text(variable);
    const bool sets =
        std::any_of(threads.begin(), threads.end(), [&](auto name) { return text.starts_with(name); });
    if (!sets) block.append(text).push_back(L'\0');
  }
  ::FreeEnvironmentStringsW(all);
  for (const wchar_t* name : threads) block.append(name).append(L"1").push_back(L'\0');
  block.push_back(L'\0');
  return block;
}

/// A job ends all processes in it with its last handle, however this process ends.
HANDLE ending_job() {
  const HANDLE job = ::CreateJobObjectW(nullptr, nullptr);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
  return job;
}

/// A file that PATH, or the list of installed programs, has for a name.
std::optional<std::filesystem::path> installed_program(const std::wstring& file) {
  const std::wstring key = LR"(SOFTWARE\Microsoft\Windows\CurrentVersion\App Paths\)" + file;
  for (const HKEY root : {HKEY_CURRENT_USER, HKEY_LOCAL_MACHINE}) {
    std::array<wchar_t, 1024> value{};
    DWORD bytes = sizeof value;
    if (::RegGetValueW(root, key.c_str(), nullptr, RRF_RT_REG_SZ, nullptr, value.data(), &bytes) !=
        ERROR_SUCCESS)
      continue;
    std::filesystem::path found(value.data());
    if (found.is_absolute() && is_executable(found)) return found;
  }
  return std::nullopt;
}

/// Waits for the end of a program that has been started. @return as run_program
std::optional<int> wait_for_end(HANDLE process, HANDLE job, std::chrono::duration<double> limit) {
  constexpr double milliseconds = 1e3;
  constexpr DWORD first_fault = 0xC0000000;  // statuses of processes that Windows has ended begin here
  const double most = std::min(limit.count() * milliseconds, static_cast<double>(INFINITE - 1));
  const bool ended = ::WaitForSingleObject(process, static_cast<DWORD>(std::ceil(most))) == WAIT_OBJECT_0;
  if (!ended) {
    ::TerminateJobObject(job, 1);
    ::WaitForSingleObject(process, INFINITE);
    return std::nullopt;
  }
  DWORD status = 0;
  ::GetExitCodeProcess(process, &status);
  return status >= first_fault ? -1 : static_cast<int>(status);
}

}  // namespace

bool is_executable(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::wstring ending = file.extension().native();
  return std::filesystem::is_regular_file(file, ignored) && ::_wcsicmp(ending.c_str(), L".exe") == 0;
}

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const std::wstring file = wide_text(name + ".exe");
  const wchar_t* path = ::_wgetenv(L"PATH");
  std::wstring_view folders(path == nullptr ? L"" : path);
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(L';'), folders.size());
    const std::filesystem::path folder(folders.substr(0, end));
    if (folder.is_absolute() && is_executable(folder / file)) return folder / file;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return installed_program(file);
}

std::optional<int> run_program(const std::vector<std::string>& command, const std::filesystem::path& out,
                               const std::filesystem::path& err, std::chrono::duration<double> limit) {
  const Handle input(inherited_file("NUL", GENERIC_READ, OPEN_EXISTING));
  const Handle output(inherited_file(out, GENERIC_WRITE, CREATE_ALWAYS));
  const Handle errors(inherited_file(err, GENERIC_WRITE, CREATE_ALWAYS));
  const Handle job(ending_job());
  if (input.get() == nullptr || output.get() == nullptr || errors.get() == nullptr || job.get() == nullptr)
    fail_to_start(command.front());
  STARTUPINFOW start{};
  start.cb = sizeof start;
  start.dwFlags = STARTF_USESTDHANDLES;
  start.hStdInput = input.get();
  start.hStdOutput = output.get();
  start.hStdError = errors.get();
  std::wstring line = command_line(command);
  std::wstring variables = environment_of_child();
  const std::wstring folder = std::filesystem::absolute(out).parent_path().native();
  const std::wstring program = std::filesystem::absolute(command.front()).native();
  PROCESS_INFORMATION made{};
  // It runs once it is in the job.
  if (::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE,
                       CREATE_SUSPENDED | CREATE_UNICODE_ENVIRONMENT | CREATE_NO_WINDOW, variables.data(),
                       folder.c_str(), &start, &made) == 0)
    fail_to_start(command.front());
  const Handle process(made.hProcess);
  const Handle thread(made.hThread);
  if (::AssignProcessToJobObject(job.get(), process.get()) == 0 ||
      ::ResumeThread(thread.get()) == static_cast<DWORD>(-1)) {
    ::TerminateProcess(process.get(), 1);
    fail_to_start(command.front());
  }
  return wait_for_end(process.get(), job.get(), limit);
}

}  // namespace ashlar
