// Numbers of this process as the system has them, and its standard streams.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

[[nodiscard]] std::int64_t process_number();
/// Empty if the system has none.
[[nodiscard]] std::string host_name();
/// True if it may do everything (root).
[[nodiscard]] bool has_all_rights();
/// Most memory that it has taken so far.
[[nodiscard]] std::uint64_t peak_memory_bytes();
/// Processor time of all its threads so far, s. Other programs hardly change it.
[[nodiscard]] double processor_time();

/// File of its program, links followed; empty if the system does not tell.
[[nodiscard]] std::filesystem::path program_file();

[[nodiscard]] bool errors_go_to_a_terminal();
/// Writes to standard error at once, without allocating anything: in signal handlers too. Failures are ignored.
void write_to_errors(std::string_view text) noexcept;
/// Ends this process without destructors and without writing what streams hold.
[[noreturn]] void end_at_once(int exit_status) noexcept;
/// Words of the command line after the program's name, in UTF-8. @param count,arguments of main
[[nodiscard]] std::vector<std::string> command_words(int count, char** arguments);
/// Opens standard streams that the caller has closed, on nothing. Otherwise their numbers would be those of the first
/// opened files, and messages would be written into these. On Windows streams and files then pass all bytes as they
/// are, and texts and names of files are UTF-8.
void prepare_streams();

/// A new folder, readable by its owner only. @param start of its path, to which letters are added
/// @throws std::system_error if it cannot be created
[[nodiscard]] std::filesystem::path new_private_folder(const std::filesystem::path& start);

}  // namespace ashlar
