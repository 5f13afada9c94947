// MSH files of Gmsh as text, of versions 2.0 to 2.2 and 4.1. Those from 2.0 to 2.2 differ in one relevant respect:
// 2.0 names physical groups without their dimension. The sections MeshFormat, PhysicalNames, Nodes and Elements are
// read, for 4.1 also Entities, which gives the physical groups of its surfaces and volumes.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "geometry/index.hpp"
#include "geometry/mesh/text_scanner.hpp"
#include "geometry/mesh/volume_mesh.hpp"
#include "geometry/solid/exact_surface.hpp"

namespace ashlar {
namespace {

constexpr long long most = std::numeric_limits<int>::max();
constexpr long long surface_dimension = 2;
constexpr long long volume_dimension = 3;
constexpr long long triangle_of_3_nodes = 2;
constexpr long long tetrahedron_of_4_nodes = 4;

// Gmsh's types of elements of 2 dimensions, except the triangle of 3 nodes.
constexpr std::array<long long, 10> other_surfaces = {3, 9, 10, 16, 20, 21, 22, 23, 24, 25};
// Gmsh's types of elements of 3 dimensions, except the tetrahedron of 4 nodes.
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
      read_section(section);
    }
    if (mesh_.tetrahedra.empty()) take_surfaces();
    return std::move(mesh_);
  }

 private:
  void read_section(const std::string& section) {
    const bool of_groups = section == "$PhysicalNames" || (section == "$Entities" && blocks_);
    if (of_groups && elements_read_) scan_.fail("section", "must come before $Elements");
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

  /// For a file without tetrahedra: bodies are bounded by its triangles.
  void take_surfaces() {
    if (surfaces_.triangles.empty())
      throw MeshFileError("file has no tetrahedra, and no triangles that bound bodies", scan_.line(), 0);
    if (doubtful_line_ > 0)
      throw MeshFileError("file has no tetrahedra, and " + doubt_ +
                              ", surfaces in one group each, of triangles with 3 nodes, are needed",
                          doubtful_line_, 0);
    mesh_.triangles = std::move(surfaces_.triangles);
    mesh_.groups = std::move(surfaces_.groups);
    mesh_.group_of = std::move(surfaces_.group_of);
  }

  /// Data needed only if there are triangles but no tetrahedra.
  void doubt(const char* what) {
    if (doubtful_line_ > 0) return;
    doubtful_line_ = scan_.line();
    doubt_ = what;
  }

  void read_format() {
    scan_.require_line("the section $MeshFormat");
    scan_.expect({"$MeshFormat"});
    scan_.require_line("the version of the format");
    const std::string_view version = scan_.require_word("version");
    const bool first = version == "2" || version == "2.0";
    if (!first && version != "2.1" && version != "2.2" && version != "4.1")
      scan_.fail("version of the format", "must be 2.0, 2.1, 2.2 or 4.1");
    names_have_dimension_ = !first;
    blocks_ = version == "4.1";
    const std::string_view kind = scan_.require_word("kind of file");
    if (kind != "0") scan_.fail("kind of file", "must be 0: text; gmsh -format msh41 -bin 0 writes it");
    end_section("$MeshFormat");
  }

  // Further numbers on the line are not checked.
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
      const long long dimension = names_have_dimension_ ? scan_.integer("dimension", 0, volume_dimension) : 0;
      const long long tag = scan_.integer("number of a physical group", -most, most);
      if (names_have_dimension_ && dimension < surface_dimension) continue;
      const std::string name = quoted_name();
      for (const long long of : {surface_dimension, volume_dimension})
        if (!names_have_dimension_ || of == dimension) names_[{of, tag}] = name;
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
        if (dimension >= surface_dimension) read_entity(static_cast<long long>(dimension));
      }
    }
    entities_read_ = true;
    end_section("$Entities");
  }

  void read_entity(long long dimension) {
    const bool volume = dimension == volume_dimension;
    const long long tag = scan_.integer(volume ? "number of a volume" : "number of a surface", -most, most);
    for (int k = 0; k < 6; ++k) (void)scan_.number(volume ? "bound of a volume" : "bound of a surface");
    const int groups = count("number of physical groups");
    if (volume && groups > 1) scan_.fail("physical groups of a volume", "at most one is read");
    Entity entity{groups, 0};
    if (groups > 0) entity.group = scan_.integer("physical group", -most, most);
    if (!entities_.emplace(std::pair(dimension, tag), entity).second)
      scan_.fail(volume ? "volume" : "surface", "$Entities lists it twice");
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
      const int blocks = count("number of blocks of nodes"), nodes = count("number of nodes");
      const int line = scan_.line();
      const std::size_t before = mesh_.points.size();
      for (int k = 0; k < blocks; ++k) read_node_block();
      check_count("$Nodes", line, nodes, mesh_.points.size() - before);
    }
    end_section("$Nodes");
  }

  /// Checks the total count stated in the first line of a section.
  static void check_count(const std::string& section, int line, int said, std::size_t found) {
    if (static_cast<std::size_t>(said) != found)
      throw MeshFileError(section + " says that it has " + std::to_string(said) + ", its blocks have " +
                              std::to_string(found) + ", the same number is needed",
                          line, 0);
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
      const int blocks = count("number of blocks of elements"), elements = count("number of elements");
      const int line = scan_.line();
      std::size_t found = 0;
      for (int k = 0; k < blocks; ++k) found += read_element_block();
      check_count("$Elements", line, elements, found);
    }
    elements_read_ = true;
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
    if (type == triangle_of_3_nodes) add_triangle(group);
  }

  // 4.1: dimension and number of the entity, type, number of elements; then number and nodes of each.
  std::size_t read_element_block() {
    scan_.require_line("block of elements");
    const long long dimension = scan_.integer("dimension", 0, 3);
    const long long tag = scan_.integer("number of an entity", -most, most);
    const auto listed = entities_.find({dimension, tag});
    if (listed == entities_.end() && entities_read_ && dimension >= surface_dimension)
      scan_.fail(dimension == volume_dimension ? "number of a volume" : "number of a surface",
                 "$Entities does not list it");
    const Entity entity = listed == entities_.end() ? Entity{} : listed->second;
    const long long type = type_of_element();
    const bool volume = type == tetrahedron_of_4_nodes, surface = type == triangle_of_3_nodes;
    if ((volume && dimension != volume_dimension) || (surface && dimension != surface_dimension))
      scan_.fail("type of an element", "it is not of the dimension of its block");
    if (surface && entity.groups > 1) doubt("a surface in several physical groups");
    const int elements = count("number of elements");
    for (int k = 0; k < elements; ++k) {
      scan_.require_line("element");
      (void)scan_.integer("number of an element", 0, most);
      if (volume) add_tetrahedron(entity.group);
      if (surface) add_triangle(entity.group);
    }
    return static_cast<std::size_t>(elements);
  }

  long long type_of_element() {
    const long long type = scan_.integer("type of an element", 1, most);
    if (std::find(other_volumes.begin(), other_volumes.end(), type) != other_volumes.end())
      scan_.fail("type of an element of the volume", "must be 4: tetrahedra with 4 nodes");
    if (std::find(other_surfaces.begin(), other_surfaces.end(), type) != other_surfaces.end())
      doubt("elements of surfaces that are no triangles with 3 nodes");
    return type;
  }

  template <std::size_t size>
  std::array<int, size> corners_of_element() {
    std::array<int, size> corners{};
    for (int& corner : corners) {
      const auto found = index_of_.find(scan_.integer("number of a node", 1, most));
      if (found == index_of_.end()) scan_.fail("number of a node", "no node of $Nodes has it");
      corner = found->second;
    }
    return corners;
  }

  void add_triangle(long long group) {
    surfaces_.triangles.push_back(corners_of_element<3>());
    surfaces_.group_of.push_back(index_of_group(surface_dimension, group, surfaces_));
  }

  void add_tetrahedron(long long group) {
    std::array<int, 4> corners = corners_of_element<4>();
    std::array<int, 4> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    const auto [first, is_new] = line_of_.emplace(sorted, scan_.line());
    if (!is_new)
      scan_.fail("tetrahedron that ends here",
                 "the one of line " + std::to_string(first->second) +
                     " has the same nodes; each is given once, in one physical group");
    const double volume = volume_of(corners);
    if (volume == 0.0 || volume != volume) scan_.fail("tetrahedron that ends here", "it has no volume");
    if (volume < 0.0) std::swap(corners[2], corners[3]);
    mesh_.tetrahedra.push_back(corners);
    mesh_.group_of.push_back(index_of_group(volume_dimension, group, mesh_));
  }

  [[nodiscard]] double volume_of(const std::array<int, 4>& corners) const {
    TriangleMesh tetrahedron;
    for (const int corner : corners) tetrahedron.points.push_back(mesh_.points[at(corner)]);
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return signed_volume(tetrahedron);
  }

  int index_of_group(long long dimension, long long group, VolumeMesh& mesh) {
    const auto [found, is_new] =
        index_of_group_.emplace(std::pair(dimension, group), static_cast<int>(mesh.groups.size()));
    if (is_new) {
      const auto name = names_.find({dimension, group});
      mesh.groups.push_back(name != names_.end() ? name->second
                            : group == 0         ? "default"
                                                 : std::to_string(group));
    }
    return found->second;
  }

  struct Entity {
    int groups = 0;       ///< number of its physical groups
    long long group = 0;  ///< the first
  };
  using Tag = std::pair<long long, long long>;  ///< dimension and number

  TextScanner scan_;
  VolumeMesh mesh_;
  VolumeMesh surfaces_;  ///< triangles
  bool blocks_ = false;  ///< version 4.1
  bool names_have_dimension_ = true;
  bool entities_read_ = false;  ///< there is a list of them
  bool elements_read_ = false;
  std::map<Tag, std::string> names_;
  std::map<Tag, Entity> entities_;
  std::map<Tag, int> index_of_group_;
  std::unordered_map<long long, int> index_of_;  ///< of nodes
  std::map<std::array<int, 4>, int> line_of_;    ///< of tetrahedra, by their nodes
  int doubtful_line_ = 0;                        ///< where triangles do not clearly bound bodies, 0: nowhere
  std::string doubt_;
};

}  // namespace

VolumeMesh read_msh(std::string_view text) {
  return MshReader(text).run();
}

}  // namespace ashlar
