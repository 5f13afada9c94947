// The folder that a server works in: paths of its clients are relative to it, and lead nowhere else.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace ashlar {

/// A call that the server refuses. what() says what is wrong, and what to do instead.
struct ToolRefusal : std::runtime_error {
  using runtime_error::runtime_error;
};

class SharedFolder {
 public:
  /// @throws std::filesystem::filesystem_error if there is no such folder
  explicit SharedFolder(const std::filesystem::path& folder);

  /// Absolute, links followed.
  [[nodiscard]] const std::filesystem::path& root() const { return root_; }

  /// A path of a client, which may not exist: relative to the root, without "." and "..".
  /// Refused: absolute paths, "..", names that begin with - or . (options and hidden files), control characters,
  /// links that lead out of the folder, text longer than a path may be. @throws ToolRefusal
  [[nodiscard]] std::filesystem::path inside(const std::string& said) const;

  /// The same for an existing plain file. @throws ToolRefusal
  [[nodiscard]] std::filesystem::path file(const std::string& said) const;
  /// The same for a folder with results of a run. @throws ToolRefusal
  [[nodiscard]] std::filesystem::path results(const std::string& said) const;
  /// The same for a file to write. Its folder is created. Refused: files in result folders, which belong to their runs;
  /// an existing file unless `replace`. @throws ToolRefusal
  [[nodiscard]] std::filesystem::path new_file(const std::string& said, bool replace) const;

 private:
  std::filesystem::path root_;
};

}  // namespace ashlar
