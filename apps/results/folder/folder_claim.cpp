#include "apps/results/folder/folder_claim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "apps/results/system/named_file.hpp"
#include "apps/results/system/output_file.hpp"
#include "apps/results/system/this_process.hpp"

namespace ashlar {
namespace {

constexpr const char* marker_name = ".ashlar";
constexpr std::string_view marker_text = "This folder was made by ashlar; it keeps other runs out.\n";

/// Files of a run besides the folder `frames`.
constexpr std::array run_files = {"history.csv",
                                  "history.units.json",
                                  "history.units.json.tmp",
                                  "contacts.csv",
                                  "blocks.pvd",
                                  "contacts.pvd",
                                  "summary.json",
                                  "checkpoint",
                                  "view.html",
                                  "summary.json.tmp",
                                  "checkpoint.tmp",
                                  "factor_trials.json",
                                  "factor_trials.json.tmp",
                                  "joints.pvd",
                                  "bolts.pvd",
                                  "surfaces.pvd",
                                  "results.vtkhdf",
                                  "results.vtkhdf.next",
                                  "results.vtkhdf.old",
                                  "factor_trial.checkpoint",
                                  "factor_trial.checkpoint.tmp"};

std::filesystem::file_status status_of(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::symlink_status(path, ignored);
}

/// The first bytes of a regular file; empty for anything else.
std::string start_of(const std::filesystem::path& path, std::size_t bytes) {
  if (!std::filesystem::is_regular_file(status_of(path))) return "";
  std::string text(bytes, '\0');
  std::ifstream input(path, std::ios::binary);
  input.read(text.data(), static_cast<std::streamsize>(bytes));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(input.gcount(), 0)));
  return text;
}

/// True if a folder without marker has the files of a run, as written by earlier versions.
bool looks_like_results(const std::filesystem::path& folder) {
  constexpr std::string_view checkpoint = "ashlar checkpoint\n";
  constexpr std::string_view history = "step,time,dt,";
  if (start_of(folder / "checkpoint", checkpoint.size()) == checkpoint) return true;
  return start_of(folder / "history.csv", history.size()) == history &&
         (std::filesystem::exists(status_of(folder / "blocks.pvd")) ||
          std::filesystem::exists(status_of(folder / "results.vtkhdf"))) &&
         std::filesystem::exists(status_of(folder / "contacts.csv"));
}

void refuse_other_kinds(const std::filesystem::path& folder) {
  const auto refuse = [](const std::filesystem::path& path, const char* needed) {
    throw ClaimRefused(fmt::format("{} is in the way: it is a link, a pipe or the like, {} is written there",
                                   path.string(), needed));
  };
  for (const char* name : run_files) {
    const std::filesystem::file_status status = status_of(folder / name);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
      refuse(folder / name, "a plain file");
  }
  const std::filesystem::file_status frames = status_of(folder / "frames");
  if (std::filesystem::exists(frames) && !std::filesystem::is_directory(frames))
    refuse(folder / "frames", "a folder");
}

void refuse_results(const std::filesystem::path& folder) {
  if (!holds_results(folder)) return;
  const bool ended = std::filesystem::exists(status_of(folder / "summary.json"));
  throw ClaimRefused(fmt::format(
      "result folder {} holds {}: --resume goes on with it, --force replaces it, or choose another by --out",
      folder.string(), ended ? "the results of a run" : "the checkpoint of a run that did not end"));
}

/// Refuses a folder without marker unless it may be used.
void refuse_strange_folder(const std::filesystem::path& folder, ClaimPurpose purpose) {
  if (names_in(folder).empty()) return;
  if (!looks_like_results(folder)) {
    throw ClaimRefused(fmt::format(
        "folder {} is not empty and was not made by ashlar: choose another by --out", folder.string()));
  }
  if (purpose == ClaimPurpose::replacement || purpose == ClaimPurpose::resume) return;
  throw ClaimRefused(
      fmt::format("folder {} holds results of an earlier version of ashlar, or a copy: --force replaces "
                  "them, or choose another by --out",
                  folder.string()));
}

/// @throws std::system_error if the device fails, ClaimRefused otherwise
[[noreturn]] void refuse(const std::string& action, const std::error_code& reason) {
  if (is_fault_of_device(reason)) throw std::system_error(reason, action);
  throw ClaimRefused(fmt::format("{}: {}", action, reason.message()));
}

/// "process 1234 on host here" as signed by the holder of the lock.
std::string holder_of(const LockFile& lock) {
  constexpr std::size_t most_bytes = 512;
  const std::string text = lock.start(most_bytes);
  std::string_view signature = text;
  if (!signature.starts_with(marker_text)) return "another process";
  signature.remove_prefix(marker_text.size());
  signature = signature.substr(0, signature.find('\n'));
  return signature.starts_with("process ") ? std::string(signature) : "another process";
}

}  // namespace

bool holds_results(const std::filesystem::path& folder) {
  return std::filesystem::exists(status_of(folder / "summary.json")) ||
         std::filesystem::exists(status_of(folder / "checkpoint"));
}

FolderClaim::FolderClaim(std::filesystem::path folder, ClaimPurpose purpose)
    : folder_(std::move(folder)), marker_(folder_ / marker_name) {
  if (folder_.empty()) throw ClaimRefused("a result folder without a name (\"\"), a name is needed");
  std::error_code error;
  if (purpose == ClaimPurpose::resume && !std::filesystem::exists(folder_, error))
    throw ClaimRefused(fmt::format("no result folder {} to resume a run of, the folder of a run is needed",
                                   folder_.string()));
  if (purpose != ClaimPurpose::resume) std::filesystem::create_directories(folder_, error);
  if (!error && !std::filesystem::is_directory(folder_, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) {
    refuse(fmt::format("cannot {} the result folder {}", purpose == ClaimPurpose::resume ? "use" : "create",
                       folder_.string()),
           error);
  }
  try {
    do {
      open_marker(purpose);
      lock();
    } while (!lock_.is_at(marker_));
    if (purpose == ClaimPurpose::new_run) refuse_results(folder_);
    refuse_other_kinds(folder_);
    sign();
  } catch (const std::filesystem::filesystem_error& fault) {
    refuse(fmt::format("cannot use the result folder {}", folder_.string()), fault.code());
  }
}

void FolderClaim::open_marker(ClaimPurpose purpose) {
  const auto fail = [&](const std::error_code& reason) {
    refuse(fmt::format("cannot open {}", marker_.string()), reason);
  };
  while (const std::error_code reason = lock_.open(marker_, LockFile::Start::existing)) {
    if (reason != std::errc::no_such_file_or_directory) fail(reason);
    refuse_strange_folder(folder_, purpose);
    const std::error_code created = lock_.open(marker_, LockFile::Start::created);
    if (!created) return;
    if (created != std::errc::file_exists) fail(created);
  }
  bool plain = false;
  std::uint64_t bytes = 0;
  if (const std::error_code reason = lock_.find_kind(plain, bytes)) fail(reason);
  const std::string start = start_of(marker_, marker_text.size());
  // A marker without all of its text was just created, or the program was killed or had no space then.
  const bool begun = bytes < marker_text.size() && marker_text.starts_with(start);
  if (!plain || (start != marker_text && !begun))
    throw ClaimRefused(fmt::format("{} is in the way: it was not made by ashlar", marker_.string()));
}

void FolderClaim::lock() {
  unlocked_.clear();
  const std::error_code reason = lock_.lock();
  if (reason == std::errc::resource_unavailable_try_again || reason == std::errc::operation_would_block) {
    throw ClaimRefused(
        fmt::format("result folder {} is in use by {}: wait until it ends, or choose another folder by --out",
                    folder_.string(), holder_of(lock_)));
  }
  if (reason) unlocked_ = reason.message();
}

void FolderClaim::sign() {
  const std::string text =
      fmt::format("{}process {} on host {}\n", marker_text, process_number(), host_name());
  if (const std::error_code reason = lock_.replace(text))
    refuse(fmt::format("cannot write {}", marker_.string()), reason);
}

void FolderClaim::check() const {
  if (!lock_.is_at(marker_)) {
    throw std::runtime_error(
        fmt::format("{} was removed or replaced while the run was writing there", marker_.string()));
  }
}

}  // namespace ashlar
