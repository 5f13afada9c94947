// Reads the frames of a result folder: .vtu files of vtu_writer and .pvd files of pvd_writer, not VTK's formats in
// general.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "apps/results/frames/vtu/pvd_writer.hpp"
#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

/// The grid whose to_vtu is `bytes`, except for its time: every number is read back bit for bit. The claimed sizes of
/// arrays are checked against the file's bytes before memory is allocated: at most 16 MiB plus 256 bytes for each
/// byte.
/// @throws std::runtime_error with the reason if the file is truncated, damaged or of another kind.
[[nodiscard]] UnstructuredGrid from_vtu(std::string_view bytes);

/// @throws std::runtime_error "cannot read <path>: <reason>"
[[nodiscard]] UnstructuredGrid read_vtu(const std::filesystem::path& path);

/// The frames of a .pvd file in their order. @throws std::runtime_error with the reason
[[nodiscard]] std::vector<PvdFrame> from_pvd(std::string_view text);

/// The same for a file. @throws as read_vtu.
[[nodiscard]] std::vector<PvdFrame> read_pvd(const std::filesystem::path& path);

}  // namespace ashlar
