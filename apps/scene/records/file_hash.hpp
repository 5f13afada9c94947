// Hash of a file when it was read, to detect later changes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ashlar {

/// SHA-256 of all bytes as 64 hexadecimal digits, as printed by the command sha256sum; empty if the file cannot be
/// read.
[[nodiscard]] std::string sha256_of(const std::filesystem::path& file);

/// The same for a text.
[[nodiscard]] std::string sha256_of_text(std::string_view text);

}  // namespace ashlar
