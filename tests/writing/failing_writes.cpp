// A library for LD_PRELOAD: the n-th call that changes a file fails, as on a disk that is full.
//
// FAILING_WRITES_FOLDER  only files below this folder count (an absolute path)
// FAILING_WRITES_AT      n, from 1 on; 0: none fails
// FAILING_WRITES_ON      1: all later ones fail too; 0: the next ones succeed
// FAILING_WRITES_LOG     a file that gets the name of each call that fails, one a line; not below the folder
//
// Counted are write, pwrite, writev, copy_file_range, sendfile, ftruncate, fsync, fdatasync, rename, link, mkdir, opening
// with O_CREAT, and close of a file that was opened for writing. A write of several bytes writes half of them first, and
// fails when it is continued, as the system does. Processes count for themselves.
#include <fcntl.h>
#include <limits.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace {

std::atomic<long> calls = 0;
std::atomic<bool> half_written = false;

long number_of(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 0 : std::strtol(text, nullptr, 10);
}

bool counts(std::string_view path) {
  const char* folder = std::getenv("FAILING_WRITES_FOLDER");
  return folder != nullptr && path.starts_with(folder);
}

/// A name is resolved against the working folder only.
bool counts_name(const char* path) {
  if (path[0] == '/') return counts(path);
  std::array<char, PATH_MAX> here{};
  return ::getcwd(here.data(), here.size()) != nullptr && counts(std::string(here.data()) + "/");
}

bool counts_open(int descriptor) {
  std::array<char, 64> link{};
  std::array<char, PATH_MAX> path{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
  const ssize_t size = ::readlink(link.data(), path.data(), path.size());
  return size > 0 && counts({path.data(), static_cast<std::size_t>(size)});
}

/// True if the present call is one that fails.
/// @param needs_space false: it succeeds on a full disk, and fails only as the n-th itself
bool fails(const char* call, bool needs_space = true) {
  static const long at = number_of("FAILING_WRITES_AT");
  static const bool on = number_of("FAILING_WRITES_ON") != 0;
  const long mine = ++calls;
  if (at == 0 || (on && needs_space ? mine < at : mine != at)) return false;
  if (const char* log = std::getenv("FAILING_WRITES_LOG")) {
    const int file =
        static_cast<int>(::syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND, 0600));
    std::string line = std::string(call) + "\n";
    (void)!::syscall(SYS_write, file, line.data(), line.size());
    ::syscall(SYS_close, file);
  }
  errno = ENOSPC;
  return true;
}

/// Bytes of a write that are written. @return -1: it fails
ssize_t allowed(const char* call, int file, std::size_t size) {
  if (!counts_open(file)) return static_cast<ssize_t>(size);
  if (half_written.exchange(false)) {
    errno = ENOSPC;
    return -1;
  }
  if (!fails(call)) return static_cast<ssize_t>(size);
  if (size < 2) return -1;
  half_written = true;
  return static_cast<ssize_t>(size / 2);
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, std::size_t size) {
  const ssize_t part = allowed("write", file, size);
  return part < 0 ? -1 : ::syscall(SYS_write, file, bytes, part);
}

ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t offset) {
  const ssize_t part = allowed("pwrite", file, size);
  return part < 0 ? -1 : ::syscall(SYS_pwrite64, file, bytes, part, offset);
}

ssize_t pwrite64(int file, const void* bytes, std::size_t size, off64_t offset) {
  return pwrite(file, bytes, size, offset);
}

ssize_t writev(int file, const iovec* parts, int count) {
  if (counts_open(file) && fails("writev")) return -1;
  return ::syscall(SYS_writev, file, parts, count);
}

ssize_t copy_file_range(int from, off64_t* from_offset, int to, off64_t* to_offset, std::size_t size,
                        unsigned flags) {
  if (counts_open(to) && fails("copy_file_range")) return -1;
  return ::syscall(SYS_copy_file_range, from, from_offset, to, to_offset, size, flags);
}

ssize_t sendfile(int to, int from, off_t* offset, std::size_t size) noexcept {
  if (counts_open(to) && fails("sendfile")) return -1;
  return ::syscall(SYS_sendfile, to, from, offset, size);
}

int ftruncate(int file, off_t size) noexcept {
  struct stat now {};
  const bool grows = ::fstat(file, &now) != 0 || size > now.st_size;
  if (counts_open(file) && fails("ftruncate", grows)) return -1;
  return static_cast<int>(::syscall(SYS_ftruncate, file, size));
}

int ftruncate64(int file, off64_t size) noexcept {
  return ftruncate(file, size);
}

int fsync(int file) {
  if (counts_open(file) && fails("fsync")) return -1;
  return static_cast<int>(::syscall(SYS_fsync, file));
}

int fdatasync(int file) {
  if (counts_open(file) && fails("fdatasync")) return -1;
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}

int rename(const char* from, const char* to) noexcept {
  if (counts_name(to) && fails("rename")) return -1;
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int link(const char* from, const char* to) noexcept {
  if (counts_name(to) && fails("link")) return -1;
  return static_cast<int>(::syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int mkdir(const char* path, mode_t mode) noexcept {
  if (counts_name(path) && fails("mkdir")) return -1;
  return static_cast<int>(::syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  if ((flags & O_CREAT) != 0 && counts_name(path) && fails("open")) return -1;
  return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open(path, flags | O_LARGEFILE, mode);
}

// The system closes the file in any case.
int close(int file) {
  const long how = ::syscall(SYS_fcntl, file, F_GETFL);
  const bool failed = how >= 0 && (how & O_ACCMODE) != O_RDONLY && counts_open(file) && fails("close");
  const long result = ::syscall(SYS_close, file);
  if (!failed) return static_cast<int>(result);
  errno = ENOSPC;
  return -1;
}

}  // extern "C"
