// `ashlar study`: convergence and run-time-against-error studies. Those for developers are in tests/benchmarks/studies.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "apps/program/command_line.hpp"
#include "apps/program/study/study.hpp"

namespace ashlar {

struct StudyOptions {
  std::string name;
  std::optional<std::filesystem::path> folder;  ///< default: NAME.study
};

/// Declares `ashlar study`.
void declare_study_command(CLI::App& program, CommandContext& context);

/// The studies of `ashlar study`.
[[nodiscard]] std::span<const Study> studies();

/// Runs one of the known studies: prints its table and findings on out, and writes them with its picture to FOLDER/NAME.csv,
/// FOLDER/NAME.svg and, if a browser is available, FOLDER/NAME.png.
/// @return exit_status::done; failed if a finding violates a requirement; bad_input for an unknown name.
[[nodiscard]] int study_command(const StudyOptions& options, std::span<const Study> known, std::ostream& out,
                                std::ostream& err);

}  // namespace ashlar
