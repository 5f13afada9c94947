// Exclusive use of a result folder by one run: permission to write, and to replace files.
//
// The file `.ashlar` marks a folder as made by the program. A run holds a lock on that file from before its first
// write to its end; the system releases it with the process in any case. In a folder without the file nothing is
// written unless it is empty or new, or --force is given for results of an earlier version. The claim is refused if a
// link, a pipe or another special file is in the place of a file of the run.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "apps/results/system/lock_file.hpp"

namespace ashlar {

/// Purpose of a claim.
enum class ClaimPurpose {
  new_run,      ///< existing results are kept: the claim is refused
  replacement,  ///< existing results are replaced (--force)
  resume,       ///< existing results are continued
  addition,     ///< other files beside results, e.g. those of a study
};

/// Refusal of a folder. what() is a message to the user.
struct ClaimRefused : std::runtime_error {
  using runtime_error::runtime_error;
};

/// True if a folder holds results. Changes nothing.
[[nodiscard]] bool holds_results(const std::filesystem::path& folder);

class FolderClaim {
 public:
  /// Creates the folder if it does not exist (except for resume) and locks it.
  /// @throws ClaimRefused; std::system_error if the device fails (is_fault_of_device)
  FolderClaim(std::filesystem::path folder, ClaimPurpose purpose);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Reason why the folder could not be locked, on a file system without locks; empty: it is locked.
  [[nodiscard]] const std::string& unlocked() const { return unlocked_; }
  /// @throws std::runtime_error if the folder no longer exists, or is no longer claimed by this
  void check() const;

 private:
  void open_marker(ClaimPurpose purpose);
  void lock();
  void sign();

  std::filesystem::path folder_;
  std::filesystem::path marker_;
  LockFile lock_;  ///< marker_, open
  std::string unlocked_;
};

}  // namespace ashlar
