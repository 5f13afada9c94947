// Reading whole files of a result folder, with errors that name the file.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace ashlar {

/// Refuses folders, and devices and pipes, of which some have no end.
/// @throws std::runtime_error with the reason alone if `path` is no regular file
void require_regular_file(const std::filesystem::path& path);

/// All bytes. @throws std::runtime_error with the reason alone
[[nodiscard]] std::string whole_file(const std::filesystem::path& path);

/// What `read` returns. @throws std::runtime_error "cannot read <path>: <reason>" where `read` throws
template <class Read>
auto naming_the_file(const std::filesystem::path& path, Read read) {
  try {
    return read();
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

}  // namespace ashlar
