// Bytes as text (RFC 4648): numbers inside a page, pictures out of one.
#pragma once

#include <string>
#include <string_view>

namespace ashlar {

[[nodiscard]] std::string to_base64(std::string_view bytes);

/// @throws std::invalid_argument if `text` is not base64 with padding and without line breaks.
[[nodiscard]] std::string from_base64(std::string_view text);

}  // namespace ashlar
