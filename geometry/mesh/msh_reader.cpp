// MSH files of Gmsh, text and binary, of versions 2.0 to 2.2 and 4.1. Those from 2.0 to 2.2 differ in one relevant
// respect: 2.0 names physical groups without their dimension. The sections MeshFormat, PhysicalNames, Nodes and Elements are
// read, for 4.1 also Entities, which gives the physical groups of its surfaces and volumes.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "geometry/index.hpp"
#include "geometry/mesh/msh_elements.hpp"
#include "geometry/mesh/msh_scanner.hpp"
#include "geometry/mesh/volume_mesh.hpp"
#include "geometry/solid/exact_surface.hpp"

namespace ashlar {
namespace {

constexpr long long most = std::numeric_limits<int>::max();
constexpr long long surface_dimension = 2;
constexpr long long volume_dimension = 3;
class MshReader {
 public:
  explicit MshReader(std::string_view text) : scan_(text) {}

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
    if (doubtful_)
      throw MeshFileError("file has no tetrahedra, and " + doubt_ +
                              ", surfaces in one group each, of triangles with 3 or 6 nodes, are needed",
                          doubtful_line_, 0);
    mesh_.triangles = std::move(surfaces_.triangles);
    mesh_.groups = std::move(surfaces_.groups);
    mesh_.group_of = std::move(surfaces_.group_of);
  }

  /// Data needed only if there are triangles but no tetrahedra.
  void doubt(const char* what) {
    if (doubtful_) return;
    doubtful_ = true;
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
    if (kind != "0" && kind != "1") scan_.fail("kind of file", "must be 0, text, or 1, binary");
    if (kind == "1") {
      if (scan_.require_word("size of a number") != "8") scan_.fail("size of a number", "must be 8 bytes");
      scan_.begin_binary();
    }
    end_section("$MeshFormat");
  }

  // Further numbers on the line are not checked.
  void end_section(const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    scan_.require_line(end);
    scan_.expect({end});
  }

  void skip_to_end_of(const std::string& section) { scan_.skip_past_line("$End" + section.substr(1)); }

  // Numbers of things: words of a line in all sections of version 2 and among names, else 8 bytes of a binary file.
  int count_of_line(std::string_view what) { return static_cast<int>(scan_.word_as_integer(what, 0, most)); }
  int count(std::string_view what) { return static_cast<int>(scan_.size(what, 0, most)); }

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
    const int names = count_of_line("number of names");
    for (int k = 0; k < names; ++k) {
      scan_.require_line("name of a physical group");
      const long long dimension =
          names_have_dimension_ ? scan_.word_as_integer("dimension", 0, volume_dimension) : 0;
      const long long tag = scan_.word_as_integer("number of a physical group", -most, most);
      if (names_have_dimension_ && dimension < surface_dimension) continue;
      const std::string name = quoted_name();
      for (const long long of : {surface_dimension, volume_dimension})
        if (!names_have_dimension_ || of == dimension) names_[{of, tag}] = name;
    }
    end_section("$PhysicalNames");
  }

  // 4.1: points, curves, surfaces, volumes, a record each.
  void read_entities() {
    scan_.begin_record("numbers of entities");
    std::array<int, 4> numbers{};
    for (int& number : numbers) number = count("number of entities");
    for (std::size_t dimension = 0; dimension < numbers.size(); ++dimension) {
      for (int k = 0; k < numbers[dimension]; ++k) {
        scan_.begin_record("entity");
        if (dimension >= surface_dimension || scan_.binary()) read_entity(static_cast<long long>(dimension));
      }
    }
    entities_read_ = true;
    end_section("$Entities");
  }

  // Number, place or bounds, physical groups; but for points the numbers of the entities that bound it.
  void read_entity(long long dimension) {
    const bool volume = dimension == volume_dimension;
    const long long tag = scan_.integer(volume ? "number of a volume" : "number of a surface", -most, most);
    for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k)
      (void)scan_.number(volume ? "bound of a volume" : "bound of a surface");
    const int groups = count("number of physical groups");
    if (volume && groups > 1) scan_.fail("physical groups of a volume", "at most one is read");
    Entity entity{groups, 0};
    if (groups > 0) entity.group = scan_.integer("physical group", -most, most);
    scan_.skip_numbers("physical groups", std::max(0, groups - 1), 4);
    if (scan_.binary() && dimension > 0)
      scan_.skip_numbers("bounds of an entity", count("number of bounds"), 4);
    if (!entities_.emplace(std::pair(dimension, tag), entity).second && dimension >= surface_dimension)
      scan_.fail(volume ? "volume" : "surface", "$Entities lists it twice");
  }

  void read_nodes() {
    if (!blocks_) {
      scan_.require_line("the number of nodes");
      const int nodes = count_of_line("number of nodes");
      for (int k = 0; k < nodes; ++k) {
        scan_.begin_record("node");
        add_node(scan_.integer("number of a node", 1, most));
      }
    } else {
      scan_.begin_record("the number of nodes");
      const int blocks = count("number of blocks of nodes"), nodes = count("number of nodes");
      const int line = scan_.line();
      scan_.skip_numbers("least and largest number of a node", 2, 8);
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
    scan_.begin_record("block of nodes");
    const long long dimension = scan_.integer("dimension", 0, 3);
    (void)scan_.integer("number of an entity", -most, most);
    const bool parametric = scan_.integer("parametric", 0, 1) == 1;
    const int nodes = count("number of nodes");
    std::vector<long long> tags;
    for (int k = 0; k < nodes; ++k) {
      scan_.begin_record("number of a node");
      tags.push_back(scan_.size("number of a node", 1, most));
    }
    for (const long long tag : tags) {
      scan_.begin_record("node");
      add_node(tag);
      if (parametric) scan_.skip_numbers("parameters of a node", dimension, 8);
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
    if (!blocks_) {
      scan_.require_line("the number of elements");
      const int elements = count_of_line("number of elements");
      for (int read = 0; read < elements;) read += read_elements_of_a_head(elements - read);
    } else {
      scan_.begin_record("the number of elements");
      const int blocks = count("number of blocks of elements"), elements = count("number of elements");
      const int line = scan_.line();
      scan_.skip_numbers("least and largest number of an element", 2, 8);
      std::size_t found = 0;
      for (int k = 0; k < blocks; ++k) found += read_element_block();
      check_count("$Elements", line, elements, found);
    }
    elements_read_ = true;
    end_section("$Elements");
  }

  // 2.2, text: number, type, number of tags, tags (the first is the physical group, 0: none), nodes. In binary files
  // elements of a type and number of tags have a common head: type, number of elements, number of tags.
  int read_elements_of_a_head(int most_elements) {
    scan_.begin_record("element");
    if (!scan_.binary()) (void)scan_.integer("number of an element", 0, most);
    const long long type = type_of_element();
    const int elements =
        scan_.binary() ? static_cast<int>(scan_.integer("number of elements", 1, most_elements)) : 1;
    const auto tags = static_cast<int>(scan_.integer("number of tags", 0, most));
    for (int k = 0; k < elements; ++k) {
      if (scan_.binary()) (void)scan_.integer("number of an element", 0, most);
      long long group = 0;
      for (int tag = 0; tag < tags; ++tag) {
        const long long number = scan_.integer("tag", -most, most);
        if (tag == 0) group = number;
      }
      add_element(type, group);
    }
    return elements;
  }

  // 4.1: dimension and number of the entity, type, number of elements; then number and nodes of each.
  std::size_t read_element_block() {
    scan_.begin_record("block of elements");
    const long long dimension = scan_.integer("dimension", 0, 3);
    const long long tag = scan_.integer("number of an entity", -most, most);
    const auto listed = entities_.find({dimension, tag});
    if (listed == entities_.end() && entities_read_ && dimension >= surface_dimension)
      scan_.fail(dimension == volume_dimension ? "number of a volume" : "number of a surface",
                 "$Entities does not list it");
    const Entity entity = listed == entities_.end() ? Entity{} : listed->second;
    const long long type = type_of_element();
    const bool volume = is_msh_tetrahedron(type), surface = is_msh_triangle(type);
    if ((volume && dimension != volume_dimension) || (surface && dimension != surface_dimension))
      scan_.fail("type of an element", "it is not of the dimension of its block");
    if (surface && entity.groups > 1) doubt("a surface in several physical groups");
    const int elements = count("number of elements");
    for (int k = 0; k < elements; ++k) {
      scan_.begin_record("element");
      (void)scan_.size("number of an element", 0, most);
      add_element(type, entity.group);
    }
    return static_cast<std::size_t>(elements);
  }

  long long type_of_element() {
    const long long type = scan_.integer("type of an element", 1, most);
    const MshElement* element = msh_element(type);
    if (element == nullptr) {
      if (scan_.binary())
        scan_.fail("type of an element", "must be a type of the manual up to the fourth order");
      return type;
    }
    if (element->dimension == volume_dimension && !is_msh_tetrahedron(type))
      scan_.fail("type of an element of the volume", "must be 4 or 11: tetrahedra with 4 or 10 nodes");
    if (element->dimension == surface_dimension && !is_msh_triangle(type))
      doubt("elements of surfaces that are no triangles with 3 or 6 nodes");
    return type;
  }

  // Nodes of an element, its corners first.
  void add_element(long long type, long long group) {
    const MshElement* element = msh_element(type);
    if (is_msh_tetrahedron(type)) {
      add_tetrahedron(corners_of_element<4>(element->nodes), group);
    } else if (is_msh_triangle(type)) {
      surfaces_.triangles.push_back(corners_of_element<3>(element->nodes));
      surfaces_.group_of.push_back(index_of_group(surface_dimension, group, surfaces_));
    } else if (element != nullptr) {
      scan_.skip_numbers("nodes of an element", element->nodes, blocks_ ? 8 : 4);
    }
  }

  template <std::size_t size>
  std::array<int, size> corners_of_element(int nodes) {
    std::array<int, size> corners{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(nodes); ++k) {
      constexpr const char* what = "number of a node";
      const auto found = index_of_.find(blocks_ ? scan_.size(what, 1, most) : scan_.integer(what, 1, most));
      if (found == index_of_.end()) scan_.fail(what, "no node of $Nodes has it");
      if (k < size) corners[k] = found->second;
    }
    return corners;
  }

  void add_tetrahedron(std::array<int, 4> corners, long long group) {
    std::array<int, 4> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    const auto [first, is_new] = place_of_.emplace(sorted, scan_.place());
    if (!is_new)
      scan_.fail("tetrahedron that ends here",
                 "the one of " + std::string(scan_.unit_of_place()) + " " + std::to_string(first->second) +
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

  MshScanner scan_;
  VolumeMesh mesh_;
  VolumeMesh surfaces_;  ///< triangles
  bool blocks_ = false;  ///< version 4.1
  bool names_have_dimension_ = true;
  bool entities_read_ = false;  ///< there is a list of them
  bool elements_read_ = false;
  std::map<Tag, std::string> names_;
  std::map<Tag, Entity> entities_;
  std::map<Tag, int> index_of_group_;
  std::unordered_map<long long, int> index_of_;       ///< of nodes
  std::map<std::array<int, 4>, long long> place_of_;  ///< of tetrahedra, by their corners
  bool doubtful_ = false;
  int doubtful_line_ = 0;  ///< where triangles do not clearly bound bodies, 0: nowhere
  std::string doubt_;
};

}  // namespace

VolumeMesh read_msh(std::string_view text) {
  return MshReader(text).run();
}

}  // namespace ashlar
