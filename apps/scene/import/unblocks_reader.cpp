#include "apps/scene/import/unblocks_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

constexpr long long most = std::numeric_limits<int>::max();

/// Consecutive entries of another list.
struct Part {
  std::size_t start = 0, length = 0;
};

class UnblocksReader {
 public:
  explicit UnblocksReader(std::string_view text) : scan_(text, '\0') {}

  ImportedModel read() {
    scan_.require_line("the name of the format");
    scan_.expect({"#_DDA_DataFile_Version_1.0"});
    while (scan_.next_line()) read_section(std::string(scan_.word()));
    make_blocks();
    model_.notes.emplace_back("densities and friction are not in the file");
    return std::move(model_);
  }

 private:
  void read_section(const std::string& name) {
    // A second EDGES has the edges of each block: neither is needed.
    if (name == "POINTS_START_LENGTH")
      points_of_ = parts();
    else if (name == "POINTS")
      read_points();
    else if (name == "FACES_NODELIST")
      read_corners();
    else if (name == "FACES")
      corners_of_ = parts();
    else if (name == "BLOCK_FACES")
      faces_of_ = parts();
    else if (name == "SCALARS" && scan_.word() == "fixedFlag")
      read_flags();
    else if (name == "Bond:")
      read_bonds();
    else if (name == "Viscous:" || name == "Roller:" || name == "Input:" || name == "FixFace:")
      leave_out(name);
    // All other lines are numbers of sections that are passed over.
  }

  std::vector<Part> parts() {
    const long long count = scan_.integer("number of entries", 0, most);
    std::vector<Part> all;
    for (long long k = 0; k < count; ++k) {
      scan_.require_line("the last entry");
      const auto start = static_cast<std::size_t>(scan_.integer("start", 0, most));
      all.push_back({start, static_cast<std::size_t>(scan_.integer("length", 0, most))});
    }
    return all;
  }

  void read_points() {
    const long long count = scan_.integer("number of points", 0, most);
    for (long long k = 0; k < count; ++k) {
      scan_.require_line("the last point");
      Vector3 point;
      for (double& coordinate : point) coordinate = scan_.coordinate("coordinate");
      points_.push_back(point);
    }
  }

  // A line for each block, which has no meaning.
  void read_corners() {
    const auto count = static_cast<std::size_t>(scan_.integer("number of corners", 0, most));
    while (corners_.size() < count) {
      scan_.require_line("the last corner");
      for (std::string_view word = scan_.word(); !word.empty(); word = scan_.word())
        corners_.push_back(static_cast<int>(scan_.to_integer(word, "corner", 0, most)));
    }
  }

  void read_flags() {
    for (std::size_t k = 0; k < points_of_.size(); ++k) {
      scan_.require_line("the last flag");
      fixed_.push_back(scan_.integer("flag", 0, 1) == 1);
    }
  }

  void read_bonds() {
    const long long count = scan_.integer("number of bonds", 0, most);
    for (long long k = 0; k < count; ++k) {
      scan_.require_line("the last bond");
      ImportedJoint joint;
      const long long last = static_cast<long long>(points_of_.size()) - 1;
      joint.first = std::to_string(scan_.integer("block of a bond", 0, last));
      joint.second = std::to_string(scan_.integer("block of a bond", 0, last));
      joint.tied = true;
      model_.joints.push_back(std::move(joint));
    }
  }

  void leave_out(const std::string& name) {
    const long long count = scan_.integer("number of boundaries", 0, most);
    if (count > 0)
      model_.left_out.push_back(fmt::format("{} boundaries \"{}\" (line {})", count,
                                            name.substr(0, name.size() - 1), scan_.line()));
  }

  /// Entries of a list that has `size`. @throws MeshFileError
  void check(const Part& part, std::size_t size, const char* what) const {
    if (part.start > size || part.length > size - part.start)
      throw MeshFileError(fmt::format("{} {} to {} of a block or face, the file has {} of them", what,
                                      part.start, part.start + part.length, size),
                          scan_.line(), 0);
  }

  void make_blocks() {
    if (points_of_.empty())
      throw MeshFileError("file has no POINTS_START_LENGTH, blocks are needed", scan_.line(), 0);
    if (faces_of_.size() != points_of_.size())
      throw MeshFileError(
          fmt::format("BLOCK_FACES has {} blocks, POINTS_START_LENGTH has {}, the same number is needed",
                      faces_of_.size(), points_of_.size()),
          scan_.line(), 0);
    for (std::size_t k = 0; k < points_of_.size(); ++k) {
      ImportedBlock block;
      block.name = std::to_string(k);
      check(points_of_[k], points_.size(), "points");
      check(faces_of_[k], corners_of_.size(), "faces");
      const auto first = points_.begin() + static_cast<std::ptrdiff_t>(points_of_[k].start);
      block.points.assign(first, first + static_cast<std::ptrdiff_t>(points_of_[k].length));
      for (std::size_t f = 0; f < faces_of_[k].length; ++f)
        add_face(corners_of_[faces_of_[k].start + f], block);
      if (block.faces.empty()) throw MeshFileError(fmt::format("block {} has no faces", k), scan_.line(), 0);
      if (k < fixed_.size()) block.fixed = fixed_[k];
      model_.blocks.push_back(std::move(block));
    }
  }

  void add_face(const Part& part, ImportedBlock& block) const {
    check(part, corners_.size(), "corners");
    if (part.length < 3)
      throw MeshFileError(
          fmt::format("a face of block {} has {} corners, at least 3 are needed", block.name, part.length),
          scan_.line(), 0);
    const auto first = corners_.begin() + static_cast<std::ptrdiff_t>(part.start);
    std::vector<int> face(first, first + static_cast<std::ptrdiff_t>(part.length));
    for (const int corner : face)
      if (at(corner) >= block.points.size())
        throw MeshFileError(fmt::format("a face of block {} has corner {}, allowed are 0 to below {}",
                                        block.name, corner, block.points.size()),
                            scan_.line(), 0);
    block.faces.push_back(std::move(face));
  }

  TextScanner scan_;
  ImportedModel model_;
  std::vector<Vector3> points_;
  std::vector<int> corners_;      ///< indices into the points of a block
  std::vector<Part> points_of_;   ///< (#blocks)
  std::vector<Part> corners_of_;  ///< (#faces)
  std::vector<Part> faces_of_;    ///< (#blocks)
  std::vector<bool> fixed_;
};

}  // namespace

ImportedModel read_unblocks(std::string_view text) {
  return UnblocksReader(text).read();
}

}  // namespace ashlar
