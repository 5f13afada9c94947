// MSH files of Gmsh as text, of versions 2.2 and 4.1. Of both the sections MeshFormat, PhysicalNames, Nodes and
// Elements are read, of 4.1 also Entities, which gives the physical groups of its volumes.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>

#include "geometry/index.hpp"
#include "geometry/mesh/text_scanner.hpp"
#include "geometry/mesh/volume_mesh.hpp"
#include "geometry/solid/exact_surface.hpp"

namespace ashlar {
namespace {

constexpr long long most = std::numeric_limits<int>::max();
constexpr long long volume_dimension = 3;
constexpr long long tetrahedron_of_4_nodes = 4;

// Types of elements of 3 dimensions that Gmsh documents, beside the tetrahedron of 4 nodes.
constexpr std::array<long long, 18> other_volumes = {5,  6,  7,  11, 12, 13, 14, 17, 18,
                                                     19, 29, 30, 31, 71, 79, 92, 90, 118};

class MshReader {
 public:
  explicit MshReader(std::string_view text) : scan_(text, '\0') {}

  VolumeMesh run() {
    read_format();
    while (scan_.next_line()) {
      const std::string section(scan_.word());
      if (section.empty() || section.front() != '$') scan_.fail("section", "a line $NAME is needed");
      if (section == "$PhysicalNames")
        read_names();
      else if (section == "$Entities" && blocks_)
        read_entities();
      else if (section == "$Nodes")
        read_nodes();
      else if (section == "$Elements")
        read_elements();
      else
        skip_to_end_of(section);
    }
    if (mesh_.tetrahedra.empty()) throw MeshFileError("file has no tetrahedra", scan_.line(), 0);
    return std::move(mesh_);
  }

 private:
  void read_format() {
    scan_.require_line("the section $MeshFormat");
    scan_.expect({"$MeshFormat"});
    scan_.require_line("the version of the format");
    const std::string_view version = scan_.require_word("version");
    if (version != "2.2" && version != "4.1") scan_.fail("version of the format", "must be 2.2 or 4.1");
    blocks_ = version == "4.1";
    const std::string_view kind = scan_.require_word("kind of file");
    if (kind != "0") scan_.fail("kind of file", "must be 0: text; gmsh -format msh41 -bin 0 writes it");
    end_section("$MeshFormat");
  }

  // Numbers that follow on the line are the format's business.
  void end_section(const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    scan_.require_line(end);
    scan_.expect({end});
  }

  void skip_to_end_of(const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    do scan_.require_line(end);
    while (scan_.word() != end);
  }

  int count(std::string_view what) { return static_cast<int>(scan_.integer(what, 0, most)); }

  // "my group" is one name in quotes.
  std::string quoted_name() {
    std::string name(scan_.require_word("name of a physical group"));
    while (name.size() < 2 || name.back() != '"')
      name += ' ' + std::string(scan_.require_word("end of the name"));
    if (name.front() != '"') scan_.fail("name of a physical group", "must be in quotes");
    return name.substr(1, name.size() - 2);
  }

  void read_names() {
    scan_.require_line("the number of names");
    const int names = count("number of names");
    for (int k = 0; k < names; ++k) {
      scan_.require_line("name of a physical group");
      const long long dimension = scan_.integer("dimension", 0, 3);
      const long long tag = scan_.integer("number of a physical group", -most, most);
      if (dimension == volume_dimension) names_[tag] = quoted_name();
    }
    end_section("$PhysicalNames");
  }

  // 4.1: points, curves, surfaces, volumes, a line each.
  void read_entities() {
    scan_.require_line("numbers of entities");
    std::array<int, 4> numbers{};
    for (int& number : numbers) number = count("number of entities");
    for (std::size_t dimension = 0; dimension < numbers.size(); ++dimension) {
      for (int k = 0; k < numbers[dimension]; ++k) {
        scan_.require_line("entity");
        if (dimension == volume_dimension) read_volume();
      }
    }
    end_section("$Entities");
  }

  void read_volume() {
    const long long tag = scan_.integer("number of a volume", -most, most);
    for (int k = 0; k < 6; ++k) (void)scan_.number("bound of a volume");
    const int groups = count("number of physical groups");
    if (groups > 1) scan_.fail("physical groups of a volume", "at most one is read");
    if (groups == 1) group_of_volume_[tag] = scan_.integer("physical group", -most, most);
  }

  void read_nodes() {
    scan_.require_line("the number of nodes");
    if (!blocks_) {
      const int nodes = count("number of nodes");
      for (int k = 0; k < nodes; ++k) {
        scan_.require_line("node");
        add_node(scan_.integer("number of a node", 1, most));
      }
    } else {
      const int blocks = count("number of blocks of nodes");
      for (int k = 0; k < blocks; ++k) read_node_block();
    }
    end_section("$Nodes");
  }

  void read_node_block() {
    scan_.require_line("block of nodes");
    (void)scan_.integer("dimension", 0, 3);
    (void)scan_.integer("number of an entity", -most, most);
    (void)scan_.integer("parametric", 0, 1);
    const int nodes = count("number of nodes");
    std::vector<long long> tags;
    for (int k = 0; k < nodes; ++k) {
      scan_.require_line("number of a node");
      tags.push_back(scan_.integer("number of a node", 1, most));
    }
    for (const long long tag : tags) {
      scan_.require_line("node");
      add_node(tag);
    }
  }

  void add_node(long long tag) {
    if (!index_of_.emplace(tag, static_cast<int>(mesh_.points.size())).second)
      scan_.fail("number of a node", "is given twice");
    const double x = scan_.coordinate("x coordinate");
    const double y = scan_.coordinate("y coordinate");
    const double z = scan_.coordinate("z coordinate");
    mesh_.points.emplace_back(x, y, z);
  }

  void read_elements() {
    scan_.require_line("the number of elements");
    if (!blocks_) {
      const int elements = count("number of elements");
      for (int k = 0; k < elements; ++k) read_element();
    } else {
      const int blocks = count("number of blocks of elements");
      for (int k = 0; k < blocks; ++k) read_element_block();
    }
    end_section("$Elements");
  }

  // 2.2: number, type, number of tags, tags (the first is the physical group, 0: none), nodes.
  void read_element() {
    scan_.require_line("element");
    (void)scan_.integer("number of an element", 0, most);
    const long long type = type_of_element();
    const int tags = count("number of tags");
    long long group = 0;
    for (int k = 0; k < tags; ++k) {
      const long long tag = scan_.integer("tag", -most, most);
      if (k == 0) group = tag;
    }
    if (type == tetrahedron_of_4_nodes) add_tetrahedron(group);
  }

  // 4.1: dimension and number of the entity, type, number of elements; then number and nodes of each.
  void read_element_block() {
    scan_.require_line("block of elements");
    (void)scan_.integer("dimension", 0, 3);
    const long long entity = scan_.integer("number of an entity", -most, most);
    const long long type = type_of_element();
    const int elements = count("number of elements");
    const auto group = group_of_volume_.find(entity);
    for (int k = 0; k < elements; ++k) {
      scan_.require_line("element");
      (void)scan_.integer("number of an element", 0, most);
      if (type == tetrahedron_of_4_nodes)
        add_tetrahedron(group == group_of_volume_.end() ? 0 : group->second);
    }
  }

  long long type_of_element() {
    const long long type = scan_.integer("type of an element", 1, most);
    if (std::find(other_volumes.begin(), other_volumes.end(), type) != other_volumes.end())
      scan_.fail("type of an element of the volume", "must be 4: tetrahedra with 4 nodes");
    return type;
  }

  void add_tetrahedron(long long group) {
    std::array<int, 4> corners{};
    for (int& corner : corners) {
      const auto found = index_of_.find(scan_.integer("number of a node", 1, most));
      if (found == index_of_.end()) scan_.fail("number of a node", "no node of $Nodes has it");
      corner = found->second;
    }
    const double volume = volume_of(corners);
    if (volume == 0.0 || volume != volume) scan_.fail("tetrahedron that ends here", "it has no volume");
    if (volume < 0.0) std::swap(corners[2], corners[3]);
    mesh_.tetrahedra.push_back(corners);
    mesh_.group_of.push_back(index_of_group(group));
  }

  [[nodiscard]] double volume_of(const std::array<int, 4>& corners) const {
    TriangleMesh tetrahedron;
    for (const int corner : corners) tetrahedron.points.push_back(mesh_.points[at(corner)]);
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return signed_volume(tetrahedron);
  }

  int index_of_group(long long group) {
    const auto [found, is_new] = index_of_group_.emplace(group, static_cast<int>(mesh_.groups.size()));
    if (is_new) {
      const auto name = names_.find(group);
      mesh_.groups.push_back(name != names_.end() ? name->second
                             : group == 0         ? "default"
                                                  : std::to_string(group));
    }
    return found->second;
  }

  TextScanner scan_;
  VolumeMesh mesh_;
  bool blocks_ = false;  ///< version 4.1
  std::map<long long, std::string> names_;
  std::map<long long, long long> group_of_volume_;
  std::map<long long, int> index_of_group_;
  std::unordered_map<long long, int> index_of_;  ///< of nodes
};

}  // namespace

VolumeMesh read_msh(std::string_view text) {
  return MshReader(text).run();
}

}  // namespace ashlar
