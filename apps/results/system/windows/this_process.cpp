#include "apps/results/system/this_process.hpp"

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <psapi.h>
#include <shellapi.h>
#include <stdlib.h>

#include <array>
#include <cstdio>
#include <random>
#include <system_error>

#include "apps/results/system/windows/open_file.hpp"
#include "apps/results/system/windows/utf8_names.hpp"

namespace ashlar {
namespace {

/// s
double seconds_of(const FILETIME& time) {
  constexpr double unit = 1e-7;
  return unit * static_cast<double>((std::uint64_t{time.dwHighDateTime} << 32U) | time.dwLowDateTime);
}

}  // namespace

std::int64_t process_number() {
  return ::GetCurrentProcessId();
}

std::string host_name() {
  std::array<wchar_t, 256> host{};
  DWORD size = host.size();
  if (::GetComputerNameExW(ComputerNameDnsHostname, host.data(), &size) == 0) return "";
  return utf8_text({host.data(), size});
}

// An administrator's rights do not keep a browser from using its sandbox.
bool has_all_rights() {
  return false;
}

std::uint64_t peak_memory_bytes() {
  PROCESS_MEMORY_COUNTERS used{};
  ::GetProcessMemoryInfo(::GetCurrentProcess(), &used, sizeof used);
  return used.PeakWorkingSetSize;
}

double processor_time() {
  FILETIME created{}, exited{}, kernel{}, user{};
  ::GetProcessTimes(::GetCurrentProcess(), &created, &exited, &kernel, &user);
  return seconds_of(kernel) + seconds_of(user);
}

std::filesystem::path program_file() {
  std::wstring name(MAX_PATH, L'\0');
  while (true) {
    const DWORD size = ::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size()));
    if (size == 0) return {};
    if (size < name.size()) return name.substr(0, size);
    name.resize(2 * name.size());
  }
}

bool errors_go_to_a_terminal() {
  DWORD mode = 0;
  return ::GetConsoleMode(::GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

void write_to_errors(std::string_view text) noexcept {
  DWORD written = 0;
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), text.data(), static_cast<DWORD>(text.size()), &written,
              nullptr);
}

void end_at_once(int exit_status) noexcept {
  ::TerminateProcess(::GetCurrentProcess(), static_cast<UINT>(exit_status));
  std::abort();  // not reached
}

std::vector<std::string> command_words(int count, char** arguments) {
  int all = 0;
  wchar_t** wide = ::CommandLineToArgvW(::GetCommandLineW(), &all);
  if (wide == nullptr) return {arguments + 1, arguments + count};
  std::vector<std::string> words;
  for (int k = 1; k < all; ++k) words.push_back(utf8_text(wide[k]));
  ::LocalFree(wide);
  return words;
}

void prepare_streams() {
  const std::array streams = {stdin, stdout, stderr};
  constexpr std::array numbers = {STD_INPUT_HANDLE, STD_OUTPUT_HANDLE, STD_ERROR_HANDLE};
  for (std::size_t k = 0; k < streams.size(); ++k) {
    if (::_fileno(streams[k]) < 0) (void)std::freopen("NUL", k == 0 ? "r" : "w", streams[k]);
    if (::_fileno(streams[k]) >= 0) ::_setmode(::_fileno(streams[k]), _O_BINARY);
    const HANDLE handle = ::GetStdHandle(numbers[k]);
    if (handle == nullptr || handle == INVALID_HANDLE_VALUE) (void)std::freopen("NUL", "w", streams[k]);
  }
  // Files are read and written as they are; consoles show texts of this program as they are meant.
  _fmode = _O_BINARY;
  ::SetConsoleOutputCP(CP_UTF8);
  ::SetConsoleCP(CP_UTF8);
  // A fault ends the program with a message, not with a window that somebody has to close.
  ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);
  use_utf8_names();
}

std::filesystem::path new_private_folder(const std::filesystem::path& start) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  constexpr int tries = 100;
  std::random_device random;
  for (int k = 0; k < tries; ++k) {
    std::string ending;
    for (int letter = 0; letter < 8; ++letter) ending += letters[random() % letters.size()];
    const std::filesystem::path folder = start.native() + wide_text(ending);
    // Folders of the user, in which this is, are not open to others.
    if (::CreateDirectoryW(name_for_windows(folder).c_str(), nullptr) != 0) return folder;
    if (::GetLastError() != ERROR_ALREADY_EXISTS)
      throw std::system_error(reason_of_windows(), folder.string());
  }
  throw std::system_error(std::make_error_code(std::errc::file_exists), start.string());
}

}  // namespace ashlar
