// Reads the frames of a result folder back: the .vtu files of vtu_writer and the .pvd files of pvd_writer,
// not VTK's formats in general.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "apps/results/pvd_writer.hpp"
#include "apps/results/vtu_writer.hpp"

namespace ashlar {

/// The grid whose to_vtu is `bytes`, but for its time: every number is read back bit for bit. What the file claims of its
/// arrays is held against its bytes before memory is taken: no more than 16 MiB and 256 bytes for each byte.
/// @throws std::runtime_error saying what is wrong if the file is cut, damaged or of another kind.
[[nodiscard]] UnstructuredGrid from_vtu(std::string_view bytes);

/// @throws std::runtime_error "cannot read <path>: <reason>"
[[nodiscard]] UnstructuredGrid read_vtu(const std::filesystem::path& path);

/// The frames of a .pvd file in their order. @throws std::runtime_error saying what is wrong
[[nodiscard]] std::vector<PvdFrame> from_pvd(std::string_view text);

/// The same of a file. @throws as read_vtu.
[[nodiscard]] std::vector<PvdFrame> read_pvd(const std::filesystem::path& path);

}  // namespace ashlar
