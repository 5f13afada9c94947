#include <limits>

#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

// Returns true if points may have further columns.
bool read_keyword(TextScanner& scan) {
  scan.require_line("the header \"OFF\"");
  const std::string_view keyword = scan.require_word("the header \"OFF\"");
  for (const std::string_view plain :
       {"OFF", "NOFF", "COFF", "CNOFF", "STOFF", "STNOFF", "STCOFF", "STCNOFF"}) {
    if (keyword == plain) return plain != "OFF";
  }
  scan.fail("header", "must be OFF, NOFF, COFF, STOFF or their combinations");
}

// Every item needs a line of at least two bytes, which limits the sizes claimed by the header.
int read_count(TextScanner& scan, std::string_view what) {
  const long long count = scan.integer(what, 1, std::numeric_limits<int>::max());
  if (static_cast<std::size_t>(count) > scan.rest().size() / 2 + 1) {
    scan.fail(what, "the file is too short for them");
  }
  return static_cast<int>(count);
}

void read_point(TextScanner& scan, bool more_columns, PolygonSoup& soup) {
  scan.require_line("point " + std::to_string(soup.points.size()));
  const double x = scan.coordinate("x coordinate");
  const double y = scan.coordinate("y coordinate");
  const double z = scan.coordinate("z coordinate");
  soup.points.emplace_back(x, y, z);
  if (!more_columns) scan.expect_end_of_line();
}

void read_face(TextScanner& scan, int most_corners, PolygonSoup& soup) {
  scan.require_line("face " + std::to_string(soup.face_ends.size()));
  const auto count = scan.integer("number of corners", 3, most_corners);
  const auto last = static_cast<long long>(soup.points.size()) - 1;
  for (long long i = 0; i < count; ++i) {
    soup.corners.push_back(static_cast<int>(scan.integer("point index", 0, last)));
  }
  soup.face_ends.push_back(static_cast<int>(soup.corners.size()));
}

}  // namespace

PolygonSoup read_off(std::string_view text) {
  TextScanner scan(text, '#');
  const bool more_columns = read_keyword(scan);
  const auto most = static_cast<int>(text.size());
  PolygonSoup soup;
  // The counts may follow the keyword on its line.
  TextScanner ahead = scan;
  if (ahead.word().empty()) scan.require_line("the numbers of points and faces");
  const int points = read_count(scan, "number of points");
  const int faces = read_count(scan, "number of faces");
  soup.points.reserve(points);
  soup.face_ends.reserve(faces);
  soup.corners.reserve(3 * static_cast<std::size_t>(faces));
  while (static_cast<int>(soup.points.size()) < points) read_point(scan, more_columns, soup);
  while (static_cast<int>(soup.face_ends.size()) < faces) read_face(scan, most, soup);
  if (scan.next_line()) {
    scan.word();
    scan.fail("text after the last face", "the header announces " + std::to_string(faces) + " faces");
  }
  return soup;
}

}  // namespace ashlar
