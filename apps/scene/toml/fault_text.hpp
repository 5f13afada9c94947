// Text of exceptions for messages.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <string_view>

namespace ashlar {

/// Text of an exception for a message: "out of memory"; "cannot open directory PATH: REASON" for exceptions of the
/// file system library; the reason alone for a failed stream; what() otherwise.
[[nodiscard]] std::string fault_text(const std::exception& error);

/// Text of a failed allocation, without another allocation: "out of memory", and the requirement if known.
[[nodiscard]] std::string_view missing_memory(const std::bad_alloc& error);

}  // namespace ashlar
