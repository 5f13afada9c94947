#include "apps/results/text/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace ashlar {
namespace {

/// A file to write to. The rest of a killed run is replaced. Anything else of that name, e.g. a link made by another
/// user of the folder, is left alone.
OutputFile temporary_file(const std::filesystem::path& path) {
  try {
    return {path, OutputFile::Start::created};
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::file_exists) throw;
  }
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path))) {
    throw std::system_error(std::make_error_code(std::errc::file_exists),
                            "cannot write " + path.string() + ", which is no regular file");
  }
  std::filesystem::remove(path);
  return {path, OutputFile::Start::created};
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view content,
                           Durability durability) {
  write_file_atomically(path, durability, [content](OutputFile& file) { file.write(content); });
}

void write_file_atomically(const std::filesystem::path& path, Durability durability,
                           const std::function<void(OutputFile&)>& write) {
  if (path.empty()) {
    throw std::system_error(std::make_error_code(std::errc::invalid_argument),
                            "cannot write a file without a name (\"\")");
  }
  // A rename would replace a device or a pipe.
  if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path)) {
    throw std::system_error(std::make_error_code(std::errc::invalid_argument),
                            "cannot write " + path.string() + ", which is no regular file");
  }
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  OutputFile file = temporary_file(temporary);
  try {
    write(file);
    if (durability == Durability::power) file.sync();
    file.close();
    rename_over(temporary, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  // The new name is an entry of the folder, which is written to the disk separately.
  if (durability == Durability::power) sync_folder(path.parent_path());
}

void refuse_other_file(const std::filesystem::path& path, const FileKind& kind) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;  // writing reports other obstacles
  std::string head(1000, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  const bool same = std::any_of(kind.marks.begin(), kind.marks.end(),
                                [&](std::string_view mark) { return head.find(mark) != std::string::npos; });
  if (!same && !head.empty())
    throw std::invalid_argument(
        fmt::format("{} is in the way: it is no {}, another name is needed", path.string(), kind.name));
}

void write_file_of_kind(const std::filesystem::path& path, std::string_view content, const FileKind& kind) {
  refuse_other_file(path, kind);
  write_file_atomically(path, content, Durability::process);
}

}  // namespace ashlar
