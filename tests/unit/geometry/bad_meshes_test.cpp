// Every file of data/corpora/bad_meshes is refused for the reason the corpus states; see make_bad_meshes.py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_io.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar::bad_meshes_test {
namespace {

const std::filesystem::path folder = std::filesystem::path(ASHLAR_DATA_DIR) / "corpora" / "bad_meshes";

struct Case {
  std::string file;
  std::set<std::string> found;
  bool others_allowed = false;
  std::string mention;
};

std::vector<Case> read_index() {
  std::vector<Case> cases;
  std::ifstream index(folder / "index.tsv");
  for (std::string line; std::getline(index, line);) {
    std::istringstream columns(line);
    Case c;
    std::string found;
    std::getline(columns, c.file, '\t');
    std::getline(columns, found, '\t');
    std::getline(columns, c.mention, '\t');
    c.others_allowed = found.ends_with("...");
    if (c.others_allowed) found.resize(found.size() - 3);
    for (std::size_t begin = 0; begin < found.size();) {
      const std::size_t end = std::min(found.find(", ", begin), found.size());
      c.found.insert(found.substr(begin, end - begin));
      begin = end + 2;
    }
    if (c.mention == "-") c.mention.clear();
    cases.push_back(c);
  }
  return cases;
}

void expect_defects(const Case& c, const TriangleMesh& mesh) {
  std::set<std::string> kinds;
  bool mentioned = false;
  // The smallest example must be found for any limit, hence one of each kind here and all there.
  for (const MeshDefect& defect : Polyhedron::find_defects(mesh, 1)) {
    kinds.insert(to_string(defect.kind));
    EXPECT_FALSE(defect.element.empty());
  }
  for (const MeshDefect& defect : Polyhedron::find_defects(mesh, 1000)) {
    EXPECT_TRUE(kinds.contains(to_string(defect.kind)));
    const std::string message = to_string(defect.kind) + ": " + defect.element;
    mentioned = mentioned || message.find(c.mention) != std::string::npos;
  }
  if (c.others_allowed) {
    EXPECT_TRUE(std::includes(kinds.begin(), kinds.end(), c.found.begin(), c.found.end()))
        << testing::PrintToString(kinds);
  } else {
    EXPECT_EQ(kinds, c.found);
  }
  EXPECT_TRUE(mentioned) << c.mention;
  EXPECT_THROW(Polyhedron{mesh}, MeshError);
}

void expect_refusal(const Case& c) {
  const bool unreadable = c.found.contains("unreadable");
  try {
    const TriangleMesh mesh = read_mesh(folder / c.file);
    ASSERT_FALSE(unreadable) << "was read as " << mesh.points.size() << " points and "
                             << mesh.triangles.size() << " triangles";
    expect_defects(c, mesh);
  } catch (const MeshFileError& error) {
    EXPECT_TRUE(unreadable) << error.what();
    EXPECT_THAT(error.what(), testing::HasSubstr(c.mention));
  }
}

TEST(BadMeshes, are_refused_for_the_stated_reason) {
  const std::vector<Case> cases = read_index();
  ASSERT_GE(cases.size(), 200U);
  for (const Case& c : cases) {
    SCOPED_TRACE(c.file);
    expect_refusal(c);
  }
}

TEST(BadMeshes, index_lists_every_file) {
  std::set<std::string> listed{"index.tsv"};
  for (const Case& c : read_index()) listed.insert(c.file);
  std::set<std::string> present;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    present.insert(entry.path().filename());
  EXPECT_EQ(listed, present);
}

}  // namespace
}  // namespace ashlar::bad_meshes_test
