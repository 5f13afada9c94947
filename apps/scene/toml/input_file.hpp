// Reads whole files, with errors that name the file.
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

#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {

/// Refuses folders, and devices and pipes, some of which are unbounded.
/// @throws std::runtime_error with the reason alone if `path` is no regular file
void require_regular_file(const std::filesystem::path& path);

/// Largest size of a scene with all includes, or of a record: 500,000 blocks, 3,000,000 rows.
inline constexpr std::size_t most_input_bytes = 100'000'000;

/// "too large (30.0 GB), at most 100 MB are allowed" @param bytes present, or a lower bound
[[nodiscard]] std::string too_large(std::uintmax_t bytes);

/// All bytes. @throws std::runtime_error with the reason alone, too_large() if there are more than `most`
[[nodiscard]] std::string whole_file(const std::filesystem::path& path,
                                     std::size_t most = std::numeric_limits<std::size_t>::max());

/// The same for a stream, possibly a pipe.
[[nodiscard]] std::string whole_stream(std::istream& input, std::size_t most);

/// @return the value of `read`. @throws std::runtime_error "cannot read <path>: <reason>" if `read` throws;
/// std::bad_alloc
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
