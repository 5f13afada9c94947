#include "apps/scene/toml/fault_text.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <ios>
#include <new>
#include <string_view>

namespace ashlar {
namespace {

/// "cannot open directory" from "filesystem error: directory iterator cannot open directory: REASON [PATH]"; some are
/// shorter.
std::string_view action_of(std::string_view what) {
  const std::size_t start = what.find("cannot ");
  if (start == std::string_view::npos) return "cannot use";
  what.remove_prefix(start);
  return what.substr(0, what.find(": "));
}

}  // namespace

std::string fault_text(const std::exception& error) {
  if (const auto* of_memory = dynamic_cast<const std::bad_alloc*>(&error))
    return std::string(missing_memory(*of_memory));
  if (const auto* of_files = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    const std::string other = of_files->path2().empty() ? "" : " to " + of_files->path2().string();
    return fmt::format("{} {}{}: {}", action_of(of_files->what()), of_files->path1().string(), other,
                       of_files->code().message());
  }
  // "basic_filebuf::underflow error reading the file: Is a directory"
  if (const auto* of_stream = dynamic_cast<const std::ios_base::failure*>(&error))
    return of_stream->code().category() == std::iostream_category() ? "it cannot be read"
                                                                    : of_stream->code().message();
  return error.what();
}

std::string_view missing_memory(const std::bad_alloc& error) {
  // Text of more detailed messages begins with these words.
  constexpr std::string_view words = "out of memory";
  const std::string_view what = error.what();
  return what.starts_with(words) ? what : words;
}

}  // namespace ashlar
