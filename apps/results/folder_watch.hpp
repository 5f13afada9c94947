// A folder that must stay the one that it was while a run writes into it.
#pragma once

#include <cstdint>
#include <filesystem>

namespace ashlar {

class FolderWatch {
 public:
  /// @throws std::system_error if there is no folder of that name, or a link to one
  explicit FolderWatch(std::filesystem::path folder);

  /// @throws std::system_error if the name is not that folder's any more: it was removed, or replaced by another one or
  /// by a link, through which files would go elsewhere
  void check() const;

 private:
  std::filesystem::path folder_;
  std::uint64_t device_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace ashlar
