#include <bit>
#include <cstdint>
#include <functional>
#include <unordered_map>

#include "geometry/mesh/binary_values.hpp"
#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

constexpr std::size_t header_size = 84;  // 80 bytes of free text and the number of triangles
constexpr std::size_t record_size = 50;  // normal, three points, two bytes of attributes

// Points by their bits, numbered as they first appear.
class PointWelder {
 public:
  explicit PointWelder(std::size_t triangles) {
    soup_.face_ends.reserve(triangles);
    soup_.corners.reserve(3 * triangles);
    number_.reserve(triangles);
  }

  void add_corner(const Vector3& p) {
    const Bits bits{std::bit_cast<std::uint64_t>(p.x()), std::bit_cast<std::uint64_t>(p.y()),
                    std::bit_cast<std::uint64_t>(p.z())};
    const auto [place, is_new] = number_.try_emplace(bits, static_cast<int>(soup_.points.size()));
    if (is_new) soup_.points.push_back(p);
    soup_.corners.push_back(place->second);
  }
  void end_face() { soup_.face_ends.push_back(static_cast<int>(soup_.corners.size())); }

  [[nodiscard]] PolygonSoup take() { return std::move(soup_); }

 private:
  using Bits = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Bits& bits) const {
      // Coordinates of equal exponent differ in their upper bits only, hence the odd factors and the fold.
      std::uint64_t h = bits[0] * 0x9e3779b97f4a7c15U ^ std::rotl(bits[1] * 0xc2b2ae3d27d4eb4fU, 21) ^
                        std::rotl(bits[2] * 0x165667b19e3779f9U, 42);
      return h ^ (h >> 32U);
    }
  };

  PolygonSoup soup_;
  std::unordered_map<Bits, int, Hash> number_;
};

std::uint32_t stated_triangles(std::string_view bytes) {
  return read_binary<std::uint32_t>(bytes.substr(header_size - 4), std::endian::little);
}

bool has_binary_size(std::string_view bytes) {
  return bytes.size() >= header_size &&
         bytes.size() == header_size + record_size * std::size_t{stated_triangles(bytes)};
}

PolygonSoup read_binary_stl(std::string_view bytes) {
  const std::uint32_t triangles = stated_triangles(bytes);
  if (triangles == 0) throw MeshFileError("file has no faces", 0, 0);
  PointWelder welder(triangles);
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::string_view record = bytes.substr(header_size + record_size * t, record_size);
    const auto value = [record](std::size_t i) {
      return static_cast<double>(read_binary<float>(record.substr(4 * i), std::endian::little));
    };
    for (std::size_t i = 3; i < 12; i += 3) welder.add_corner({value(i), value(i + 1), value(i + 2)});
    welder.end_face();
  }
  return welder.take();
}

void read_facet(TextScanner& scan, PointWelder& welder) {
  scan.expect({"normal"});
  for (int d = 0; d < 3; ++d) (void)scan.number("normal");
  scan.expect_end_of_line();
  scan.require_line("\"outer loop\"");
  scan.expect({"outer", "loop"});
  scan.expect_end_of_line();
  for (int corner = 0; corner < 3; ++corner) {
    scan.require_line("\"vertex\"");
    scan.expect({"vertex"});
    const double x = scan.coordinate("x coordinate");
    const double y = scan.coordinate("y coordinate");
    const double z = scan.coordinate("z coordinate");
    scan.expect_end_of_line();
    welder.add_corner({x, y, z});
  }
  for (const std::string_view word : {"endloop", "endfacet"}) {
    scan.require_line(word);
    scan.expect({word});
    scan.expect_end_of_line();
  }
  welder.end_face();
}

// A file may hold several solids; the reader does not check that they form one body.
PolygonSoup read_text_stl(std::string_view text) {
  TextScanner scan(text, '\0');
  constexpr std::size_t bytes_of_a_facet = 100;
  PointWelder welder(text.size() / bytes_of_a_facet);
  bool inside = false;
  while (scan.next_line()) {
    const std::string_view word = scan.word();
    if (!inside) {
      if (!equal_ignoring_case(word, "solid")) scan.fail("unexpected word", "\"solid\" must be here");
      inside = true;
    } else if (equal_ignoring_case(word, "endsolid")) {
      inside = false;
    } else if (equal_ignoring_case(word, "facet")) {
      read_facet(scan, welder);
    } else {
      scan.fail("unexpected word", "\"facet\" or \"endsolid\" must be here");
    }
  }
  if (inside) throw MeshFileError("file ends before \"endsolid\"", scan.line(), 0);
  PolygonSoup soup = welder.take();
  if (soup.face_ends.empty()) throw MeshFileError("file has no faces", scan.line(), 0);
  return soup;
}

}  // namespace

PolygonSoup read_stl(std::string_view text) {
  if (has_binary_size(text)) return read_binary_stl(text);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin != std::string_view::npos && equal_ignoring_case(text.substr(begin, 5), "solid")) {
    return read_text_stl(text);
  }
  if (text.size() < header_size) {
    throw MeshFileError("file of " + std::to_string(text.size()) +
                            " bytes, needs \"solid\" (text) or at least 84 bytes (binary)",
                        0, 0);
  }
  throw MeshFileError("binary file of " + std::to_string(text.size()) +
                          " bytes, needs 84 + 50 for each of its " + std::to_string(stated_triangles(text)) +
                          " triangles",
                      0, 0);
}

}  // namespace ashlar
