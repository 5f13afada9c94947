// A result folder that one run has for itself: who may write there, and what may be replaced.
//
// The file `.ashlar` in a folder says that the program made it. A run holds a lock on that file from before
// it writes anything until it ends; the system releases it with the process, however that ends. In a folder
// without the file nothing is written unless it is empty or new, or --force is given for what an earlier
// version left. Links, pipes and other files that are no plain files where a run would write end the claim.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace ashlar {

/// What a folder is claimed for.
enum class ClaimPurpose {
  new_run,      ///< results that are there are kept: the claim is refused
  replacement,  ///< results that are there are replaced (--force)
  resume,       ///< results that are there are gone on with
  addition,     ///< other files beside results, e.g. those of a study
};

/// Why a folder cannot be had. what() reads as a message to the user.
struct ClaimRefused : std::runtime_error {
  using runtime_error::runtime_error;
};

/// What a claim finds; nothing is changed by looking.
[[nodiscard]] bool holds_results(const std::filesystem::path& folder);

class FolderClaim {
 public:
  /// Creates the folder if it is not there (but not for resume) and locks it. @throws ClaimRefused
  FolderClaim(std::filesystem::path folder, ClaimPurpose purpose);
  ~FolderClaim();
  FolderClaim(const FolderClaim&) = delete;
  FolderClaim& operator=(const FolderClaim&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Why the folder could not be locked, where the file system has no locks; empty: it is locked.
  [[nodiscard]] const std::string& unlocked() const { return unlocked_; }
  /// @throws std::runtime_error if the folder is no longer there, or no longer this claim's
  void check() const;

 private:
  void open_marker(ClaimPurpose purpose);
  void lock();
  [[nodiscard]] bool in_place() const;
  void sign() const;
  void close();

  std::filesystem::path folder_;
  std::filesystem::path marker_;
  int descriptor_ = -1;
  std::string unlocked_;
};

}  // namespace ashlar
