// The header of a PLY file: which elements follow, with which properties of which types.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {

enum class PlyFormat { text, little_endian, big_endian };

/// Every type fits into a double exactly.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] int size_of(PlyType type);  ///< bytes
[[nodiscard]] bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;  ///< made printable, for messages
  PlyType type;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;  ///< made printable, for messages
  long long count;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format;
  std::vector<PlyElement> elements;  ///< in the order of the file
};

/// Reads up to end_header; scan.rest() is then the body. @throws MeshFileError.
[[nodiscard]] PlyHeader read_ply_header(TextScanner& scan);

}  // namespace ashlar
