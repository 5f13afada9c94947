// Exceptions in the words of messages.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <string_view>

namespace ashlar {

/// Text of an exception in a message: "out of memory"; "cannot open directory PATH: REASON" of what the library for
/// file systems throws, and the reason alone where a stream failed; what() of all others.
[[nodiscard]] std::string fault_text(const std::exception& error);

/// Text of an allocation that failed, without another one: "out of memory", and what was needed where that is known.
[[nodiscard]] std::string_view missing_memory(const std::bad_alloc& error);

}  // namespace ashlar
