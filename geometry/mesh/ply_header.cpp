#include "geometry/mesh/ply_header.hpp"

#include <limits>
#include <utility>

namespace ashlar {
namespace {

PlyType read_type(TextScanner& scan) {
  static constexpr std::pair<std::string_view, PlyType> names[] = {
      {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64},
  };
  const std::string_view word = scan.require_word("a type");
  for (const auto& [name, type] : names) {
    if (word == name) return type;
  }
  scan.fail("type", "must be char, uchar, short, ushort, int, uint, float or double");
}

PlyFormat read_format(TextScanner& scan) {
  scan.require_line("\"format\"");
  scan.expect({"format"});
  const std::string_view word = scan.require_word("the format");
  const PlyFormat format = word == "ascii"                  ? PlyFormat::text
                           : word == "binary_little_endian" ? PlyFormat::little_endian
                                                            : PlyFormat::big_endian;
  if (format == PlyFormat::big_endian && word != "binary_big_endian") {
    scan.fail("format", "must be ascii, binary_little_endian or binary_big_endian");
  }
  scan.expect({"1.0"});
  scan.expect_end_of_line();
  return format;
}

PlyElement read_element(TextScanner& scan) {
  const std::string name = printable(scan.require_word("the element's name"));
  const long long count = scan.integer("number of elements", 0, std::numeric_limits<int>::max());
  scan.expect_end_of_line();
  return {name, count, {}};
}

PlyProperty read_property(TextScanner& scan) {
  PlyProperty property;
  TextScanner ahead = scan;
  property.is_list = ahead.word() == "list";
  if (property.is_list) {
    scan.word();
    property.count_type = read_type(scan);
    if (!is_integer(property.count_type)) scan.fail("type of a list's length", "must be an integer type");
  }
  property.type = read_type(scan);
  property.name = printable(scan.require_word("the property's name"));
  scan.expect_end_of_line();
  return property;
}

}  // namespace

int size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 8;
}

bool is_integer(PlyType type) {
  return type != PlyType::float32 && type != PlyType::float64;
}

PlyHeader read_ply_header(TextScanner& scan) {
  scan.require_line("the header \"ply\"");
  if (scan.word() != "ply") scan.fail("header", "must be \"ply\"");
  PlyHeader header;
  header.format = read_format(scan);
  for (;;) {
    scan.require_line("\"end_header\"");
    const std::string_view keyword = scan.word();
    if (keyword == "end_header") return header;
    if (keyword == "element") {
      header.elements.push_back(read_element(scan));
    } else if (keyword == "property") {
      if (header.elements.empty()) scan.fail("property", "must follow an element");
      header.elements.back().properties.push_back(read_property(scan));
    } else if (keyword != "comment" && keyword != "obj_info") {
      scan.fail("keyword", "must be element, property, comment, obj_info or end_header");
    }
  }
}

}  // namespace ashlar
