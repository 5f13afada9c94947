// `ashlar spectrum`: response spectrum of a record, or of a measured point of a run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct SpectrumOptions {
  std::filesystem::path input;             ///< a record, or the folder of a run
  std::string column;                      ///< of a record: its column of accelerations; of a run: NAME.vx
  std::string time = "time";               ///< column of times of a record with column names
  std::string scale = "1";                 ///< of a record: a number, or "g"
  std::optional<int> baseline;             ///< of a record: order of the polynomial that is removed
  std::optional<int> stage;                ///< of a run in stages: its number from 1 on; default: the last
  double damping = 5.0;                    ///< percent of critical
  double shortest = 0.01, longest = 10.0;  ///< s
  int periods = 151;
  std::optional<std::filesystem::path>
      out;  ///< table; the picture beside it is .svg (and .png, with a browser)
};

/// Declares `ashlar spectrum`.
void declare_spectrum_command(CLI::App& program, CommandContext& context);

/// Prints the table on out, or writes it and a picture. @return exit_status::done or exit_status::bad_input
[[nodiscard]] int spectrum_command(const SpectrumOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
