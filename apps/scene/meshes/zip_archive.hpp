// Reads zip archives in memory, inflated by zlib: stored and deflated entries, ZIP64 and streamed ones, as in 3MF
// files. Memory is not allocated by sizes that the archive merely claims.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

class ZipArchive {
 public:
  struct Entry {
    std::string_view name;
    std::uint64_t packed_size;
    std::uint64_t size;
    std::uint64_t header;  ///< start of its local header
    std::uint32_t checksum;
    std::uint16_t method;
    std::uint16_t flags;
  };

  /// Reads the directory. @param bytes must outlive this. @throws MeshFileError
  explicit ZipArchive(std::string_view bytes);

  /// The entry of a name, regardless of case, as for part names of packages; null if there is none.
  [[nodiscard]] const Entry* find(std::string_view name) const;

  /// Passes on the content in parts, at most `most` bytes of it.
  /// @throws MeshFileError: more than that, damaged, encrypted, another method, and exceptions of `use`
  void read(const Entry& entry, std::uint64_t most, const std::function<void(std::string_view)>& use) const;

 private:
  [[nodiscard]] std::string_view packed(const Entry& entry) const;

  std::string_view bytes_;
  std::vector<Entry> entries_;
};

}  // namespace ashlar
