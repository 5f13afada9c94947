// Reading whole files, with errors that name the file.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iosfwd>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/scene/fault_text.hpp"

namespace ashlar {

/// Refuses folders, and devices and pipes, of which some have no end.
/// @throws std::runtime_error with the reason alone if `path` is no regular file
void require_regular_file(const std::filesystem::path& path);

/// Bytes of a scene with all files that it includes, or of a record: 500,000 blocks, 3,000,000 rows.
inline constexpr std::size_t most_input_bytes = 100'000'000;

/// "too large (30.0 GB), at most 100 MB are allowed" @param bytes that there are, or are known to be at least
[[nodiscard]] std::string too_large(std::uintmax_t bytes);

/// All bytes. @throws std::runtime_error with the reason alone, too_large() where there are more than `most`
[[nodiscard]] std::string whole_file(const std::filesystem::path& path,
                                     std::size_t most = std::numeric_limits<std::size_t>::max());

/// The same of a stream, which may come from a pipe.
[[nodiscard]] std::string whole_stream(std::istream& input, std::size_t most);

/// @return the value of `read`. @throws std::runtime_error "cannot read <path>: <reason>" where `read` throws; std::bad_alloc
template <class Read>
auto naming_the_file(const std::filesystem::path& path, Read read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), fault_text(error)));
  }
}

}  // namespace ashlar
