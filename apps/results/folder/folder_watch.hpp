// A folder that must remain the same during a run that writes into it.
#pragma once

#include <filesystem>

#include "apps/results/system/named_file.hpp"

namespace ashlar {

class FolderWatch {
 public:
  /// @throws std::system_error if there is no folder of that name, or a link to one
  explicit FolderWatch(std::filesystem::path folder);

  /// @throws std::system_error if the name no longer refers to that folder: it was removed, or replaced by another
  /// one or by a link, which would redirect files
  void check() const;

 private:
  std::filesystem::path folder_;
  NamedFile known_;
};

}  // namespace ashlar
