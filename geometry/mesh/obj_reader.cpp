#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>

#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

// Statements without influence on the surface made of v and f.
constexpr std::array<std::string_view, 19> passed_over = {
    "vt",     "vn",    "vp",       "s",        "mg",  "l",          "p",         "usemtl", "mtllib", "usemap",
    "maplib", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "cstype", "deg"};

class ObjReader {
 public:
  explicit ObjReader(std::string_view text) : scan_(text, '#') {}

  PolygonSoup run() {
    while (scan_.next_line()) {
      const std::string_view statement = scan_.word();
      if (statement == "v") {
        read_point();
      } else if (statement == "f") {
        read_face();
      } else if (statement == "o" || statement == "g") {
        read_group();
      } else if (std::find(passed_over.begin(), passed_over.end(), statement) == passed_over.end()) {
        scan_.fail("unknown statement", "known are v, vt, vn, f, o, g, s, l, p, usemtl, mtllib");
      }
    }
    if (soup_.face_ends.empty()) throw MeshFileError("file has no faces", scan_.line(), 0);
    if (largest_ >= static_cast<int>(soup_.points.size())) {
      throw MeshFileError("point index (" + std::to_string(largest_ + 1) + "), allowed 1 to " +
                              std::to_string(soup_.points.size()),
                          largest_line_, largest_column_);
    }
    return std::move(soup_);
  }

 private:
  // A fourth number is a weight; six or seven are a point with its colour.
  void read_point() {
    const double x = scan_.coordinate("x coordinate");
    const double y = scan_.coordinate("y coordinate");
    const double z = scan_.coordinate("z coordinate");
    soup_.points.emplace_back(x, y, z);
    TextScanner ahead = scan_;
    if (ahead.word().empty()) return;
    const double fourth = scan_.number("weight or colour");
    TextScanner further = scan_;
    if (further.word().empty() && fourth != 1.0) scan_.fail("weight", "must be 1");
  }

  // A group of several names has one name of several words.
  void read_group() {
    group_name_.clear();
    for (std::string_view word = scan_.word(); !word.empty(); word = scan_.word()) {
      if (!group_name_.empty()) group_name_ += ' ';
      group_name_ += word;
    }
    if (group_name_.empty()) group_name_ = "default";
  }

  void read_face() {
    const std::size_t begin = soup_.corners.size();
    for (std::string_view corner = scan_.word(); !corner.empty(); corner = scan_.word()) {
      soup_.corners.push_back(read_corner(corner));
    }
    if (soup_.corners.size() < begin + 3) {
      throw MeshFileError(
          "face with " + std::to_string(soup_.corners.size() - begin) + " corners, needs at least 3",
          scan_.line(), 1);
    }
    soup_.face_ends.push_back(static_cast<int>(soup_.corners.size()));
    const auto [group, is_new] = groups_.emplace(group_name_, static_cast<int>(soup_.groups.size()));
    if (is_new) soup_.groups.push_back(group_name_);
    soup_.group_of_face.push_back(group->second);
  }

  // Positive indices count from 1 and may name a point that follows; negative ones count back from the last.
  int read_corner(std::string_view corner) {
    constexpr long long most = std::numeric_limits<int>::max();
    const std::string_view part = corner.substr(0, corner.find('/'));
    const auto known = static_cast<long long>(soup_.points.size());
    const long long index = scan_.to_integer(part, "point index", -known, most);
    if (index == 0) scan_.fail("point index", "counts from 1, or from -1 backwards");
    check_other_indices(corner.substr(part.size()));
    const int point = static_cast<int>(index > 0 ? index - 1 : known + index);
    if (point > largest_) {
      largest_ = point;
      largest_line_ = scan_.line();
      largest_column_ = scan_.column();
    }
    return point;
  }

  // After the point: /vt, /vt/vn or //vn.
  void check_other_indices(std::string_view others) const {
    constexpr long long most = std::numeric_limits<int>::max();
    if (others.empty()) return;
    const std::string_view texture = others.substr(1, others.find('/', 1) - 1);
    const std::string_view normal = others.substr(std::min(others.size(), texture.size() + 2));
    if (!texture.empty()) (void)scan_.to_integer(texture, "texture index", -most, most);
    if (!normal.empty()) (void)scan_.to_integer(normal, "normal index", -most, most);
    if (texture.empty() && normal.empty())
      scan_.fail("corner of a face", "must be v, v/vt, v//vn or v/vt/vn");
  }

  TextScanner scan_;
  PolygonSoup soup_;
  std::string group_name_ = "default";
  std::map<std::string, int> groups_;
  int largest_ = -1;
  int largest_line_ = 0;
  int largest_column_ = 0;
};

}  // namespace

PolygonSoup read_obj(std::string_view text) {
  return ObjReader(text).run();
}

}  // namespace ashlar
