// What a file was when it was read, so that a result tells whether it is still the same.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ashlar {

/// SHA-256 of all bytes as 64 hexadecimal digits, as the command sha256sum prints it; empty if the file
/// cannot be read.
[[nodiscard]] std::string sha256_of(const std::filesystem::path& file);

/// The same of a text.
[[nodiscard]] std::string sha256_of_text(std::string_view text);

}  // namespace ashlar
