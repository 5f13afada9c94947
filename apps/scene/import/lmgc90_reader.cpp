#include "apps/scene/import/lmgc90_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "apps/scene/import/lmgc90_behaviour.hpp"
#include "apps/scene/import/lmgc90_lines.hpp"
#include "geometry/index.hpp"
#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  try {
    return read_mesh_bytes(file, "model");
  } catch (const MeshFileError& error) {
    throw ImportError({file.string(), error.line(), error.column()}, error.what());
  }
}

class Lmgc90Reader {
 public:
  explicit Lmgc90Reader(fs::path bodies) : bodies_(std::move(bodies)) {}

  ImportedModel read() {
    model_.title = title();
    read_bodies();
    if (model_.blocks.empty())
      throw ImportError({bodies_.string(), 0, 0},
                        "file has no bodies, RBDY3 with a polyhedron (POLYR) are needed");
    if (const auto bulk = text_beside("BULK_BEHAV.DAT"))
      read_lmgc90_bulk(beside("BULK_BEHAV.DAT").string(), *bulk, materials_by_name_, model_);
    if (!model_.gravity) model_.notes.emplace_back("gravity is not in the files: 9.81 m/s^2 downwards");
    for (const ImportedMaterial& material : model_.materials)
      if (!material.density)
        model_.notes.push_back(fmt::format("density of {} is not in the files", material.name));
    if (const auto contact = text_beside("TACT_BEHAV.DAT"))
      read_lmgc90_contact(beside("TACT_BEHAV.DAT").string(), *contact, colours_, model_);
    else
      model_.notes.emplace_back("friction is not in the files (TACT_BEHAV.DAT): none");
    if (const auto initial = text_beside("DOF.INI")) read_initial(beside("DOF.INI").string(), *initial);
    if (const auto driven = text_beside("DRV_DOF.DAT")) read_driven(beside("DRV_DOF.DAT").string(), *driven);
    return std::move(model_);
  }

 private:
  [[nodiscard]] fs::path beside(const char* name) const { return bodies_.parent_path() / name; }

  [[nodiscard]] std::optional<std::string> text_beside(const char* name) const {
    std::error_code ignored;
    if (!fs::exists(beside(name), ignored)) return std::nullopt;
    return bytes_of(beside(name));
  }

  [[nodiscard]] std::string title() const {
    fs::path folder = fs::absolute(bodies_).lexically_normal().parent_path();
    if (folder.filename() == "DATBOX") folder = folder.parent_path();
    return folder.filename().string();
  }

  void read_bodies() {
    const std::string text = bytes_of(bodies_);
    Lmgc90Lines lines(bodies_.string(), text);
    while (lines.next())
      if (lines.word(0) == "$bdyty") read_body(lines);
  }

  /// A body up to $$$$$$.
  void read_body(Lmgc90Lines& lines) {
    lines.require_next("a body");
    if (lines.word(0) != "RBDY3")
      lines.fail(lines.word(0),
                 fmt::format("body of kind {} is not read, allowed is RBDY3: rigid bodies in space",
                             printable(lines.word(0))));
    // Bodies are numbered in their order: the written numbers of planes begin again in many files.
    const auto number = static_cast<int>(model_.blocks.size()) + 1;
    ImportedBlock block;
    std::optional<std::string> material;
    Vector3 place = Vector3::Zero();
    std::string colour;
    bool own_frame = false;
    for (lines.require_next("$$$$$$"); lines.word(0) != "$$$$$$"; lines.require_next("$$$$$$")) {
      if (lines.word(0) == "$bdyty")
        lines.fail(lines.word(0), "body without its end $$$$$$, which is needed");
      if (lines.word(0) == "PLAIN") {
        if (lines.word(2) == "behav") material = std::string(lines.word(3));
        own_frame = lines.has("avrd") && lines.number("avrd") != 0.0;
      } else if (lines.word(0) == "NO6xx") {
        place = triple(lines, "coo1", "coo2", "coo3");
        lines.require_next("the orientation of a body");
        if (!triple(lines, "coo4", "coo5", "coo6").isZero(0.0))
          lines.fail(lines.text("coo4"), "body is turned (coo4 to coo6), 0 is needed");
      } else if (lines.word(0) == "POLYR" || lines.word(0) == "PLANx") {
        if (!block.points.empty())
          lines.fail(
              lines.word(0),
              fmt::format("body {} has several contactors, one is needed: clusters are not read", number));
        colour = plain_name(lines.word(3));
        if (lines.word(0) == "POLYR")
          read_polyhedron(lines, block);
        else
          add_box(triple(lines, "axe1", "axe2", "axe3"), block, lines);
      } else if (in_contactors(lines)) {
        lines.fail(lines.word(0), fmt::format("contactor {} is not read, allowed are POLYR and PLANx",
                                              printable(lines.word(0))));
      }
    }
    in_own_frame_.push_back(own_frame);
    centres_.push_back(place);
    finish(lines, number, colour, place, material, std::move(block));
  }

  /// A line below $tacty with the name of a contactor.
  bool in_contactors(const Lmgc90Lines& lines) {
    return lines.words().size() >= 3 && lines.word(2) == "color";
  }

  void finish(const Lmgc90Lines& lines, int number, const std::string& colour, const Vector3& place,
              const std::optional<std::string>& material, ImportedBlock block) {
    if (block.points.empty())
      lines.fail(lines.word(0), fmt::format("body {} has no polyhedron (POLYR), which is needed", number));
    for (Vector3& point : block.points) point += place;
    block.name = fmt::format("{}_{}", colour, number);
    ++colours_[colour];
    turn_alike(block);
    if (material) {
      const auto [found, is_new] = materials_by_name_.emplace(*material, model_.materials.size());
      if (is_new) {
        std::string name = plain_name(*material);
        for (const ImportedMaterial& other : model_.materials)
          if (other.name == name) name += fmt::format(".{}", model_.materials.size() + 1);
        model_.materials.push_back({name, std::nullopt});
      }
      block.material = found->second;
    }
    model_.blocks.push_back(std::move(block));
  }

  Vector3 triple(const Lmgc90Lines& lines, const char* x, const char* y, const char* z) {
    Vector3 vector;
    int axis = 0;
    for (const char* name : {x, y, z}) {
      vector[axis++] = lines.number(name);
      // Its digits are those of a decimal number of any size, so that the largest coordinate counts.
      const std::string_view digits = lines.text(name);
      if (std::string_view(name).starts_with("coo") && digits.find('.') != std::string_view::npos &&
          vector[axis - 1] != 0.0)
        model_.rounding = std::max(model_.rounding, rounding_of(digits));
    }
    return vector;
  }

  void read_polyhedron(Lmgc90Lines& lines, ImportedBlock& block) {
    const int vertices = lines.whole_number("nb_vertex");
    const int faces = lines.whole_number(lines.has("nb_faces") ? "nb_faces" : "nb_face");
    for (int k = 0; k < vertices; ++k) {
      lines.require_next("a vertex of a polyhedron");
      block.points.push_back(triple(lines, "coo1", "coo2", "coo3"));
    }
    for (int k = 0; k < faces; ++k) {
      lines.require_next("a face of a polyhedron");
      std::vector<int> face;
      for (const char* name : {"ver1", "ver2", "ver3"}) {
        const int corner = lines.whole_number(name);
        if (corner < 1 || corner > vertices)
          lines.fail(lines.text(name), fmt::format("{} ({}), allowed 1 to {}", name, corner, vertices));
        face.push_back(corner - 1);
      }
      block.faces.push_back(std::move(face));
    }
    if (block.points.size() < 4 || block.faces.size() < 4)
      lines.fail(
          lines.text("ver1"),
          fmt::format("polyhedron has {} vertices and {} faces, at least 4 are needed", vertices, faces));
  }

  static void add_box(const Vector3& half, ImportedBlock& block, const Lmgc90Lines& lines) {
    if (!(half.minCoeff() > 0.0)) lines.fail(lines.text("axe1"), "half lengths of a PLANx must be > 0");
    for (int k = 0; k < 8; ++k)
      block.points.emplace_back((k & 1) != 0 ? half.x() : -half.x(), (k & 2) != 0 ? half.y() : -half.y(),
                                (k & 4) != 0 ? half.z() : -half.z());
    block.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  }

  /// Velocities and forces of bodies: six components each, three along the axes and three about them.
  void read_driven(const std::string& file, const std::string& text) {
    Lmgc90Lines lines(file, text);
    while (lines.next()) {
      if (lines.word(0) != "$bdyty") continue;
      lines.require_next("a body");
      if (lines.word(0) != "RBDY3") lines.fail(lines.word(0), "kind of a body, RBDY3 is needed");
      const int number = lines.whole_number_of_word(1);
      read_driven_body(lines, number, block(lines, number));
    }
  }

  ImportedBlock& block(const Lmgc90Lines& lines, int number) {
    if (number < 1 || at(number) > model_.blocks.size())
      lines.fail(lines.word(1),
                 fmt::format("body {} is unknown, BODIES.DAT has 1 to {}", number, model_.blocks.size()));
    return model_.blocks[at(number) - 1];
  }

  void read_driven_body(Lmgc90Lines& lines, int number, ImportedBlock& block) {
    int held = 0;
    bool moves = false;
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    for (lines.require_next("$$$$$$"); lines.word(0) != "$$$$$$"; lines.require_next("$$$$$$")) {
      if (lines.word(0) == "$bdyty")
        lines.fail(lines.word(0), "body without its end $$$$$$, which is needed");
      const bool velocity = lines.word(0) == "vlocy";
      if (!velocity && lines.word(0) != "force") continue;
      const int component = lines.whole_number_of_word(1);
      if (component < 1 || component > 6)
        lines.fail(lines.word(1), fmt::format("component ({}), allowed 1 to 6", component));
      const double value = driven_value(lines, number);
      if (velocity) {
        ++held;
        moves = moves || value != 0.0;
      } else if (component <= 3) {
        force[component - 1] += value;
      } else {
        moment[component - 4] += value;
      }
    }
    if (held >= 6 || moves) block.fixed = true;
    if (moves)
      model_.left_out.push_back(fmt::format("velocity of body {}, which is held instead", number));
    else if (held > 0 && held < 6)
      model_.left_out.push_back(
          fmt::format("supports of body {} in {} of 6 components (all are needed)", number, held));
    if (!force.isZero(0.0) || !moment.isZero(0.0)) add_load(block, centroid_of(block), force, moment);
  }

  /// (CT + AMP cos(OMEGA t + PHI)) times (RAMPI + RAMP t), which is at most 1 by its amount; or a file with rows t, value.
  double driven_value(const Lmgc90Lines& lines, int number) {
    const auto note_end = [&] {
      model_.left_out.push_back(
          fmt::format("history of a force or velocity of body {} (its last value is taken)", number));
    };
    if (lines.word(2) == "evolution") {
      const fs::path file = bodies_.parent_path() / std::string(lines.word(3));
      if (!file.lexically_normal().string().starts_with(bodies_.parent_path().lexically_normal().string()))
        lines.fail(lines.word(3), "file of an evolution, one in the folder of BODIES.DAT is needed");
      const std::string text = bytes_of(file);
      Lmgc90Lines rows(file.string(), text);
      double last = 0.0;
      while (rows.next()) last = rows.number_of_word(1);
      note_end();
      return last;
    }
    const double constant = lines.number_of_word(2), amplitude = lines.number_of_word(3);
    const double ramp = lines.number_of_word(6), slope = lines.number_of_word(7);
    if (amplitude != 0.0 || slope != 0.0) note_end();
    if (slope != 0.0) return slope > 0.0 ? constant : -constant;
    return constant * std::min(1.0, std::max(-1.0, ramp));
  }

  /// Bodies with given inertia have their vertices in the frame of its axes a, b, g, about their centre. Of all
  /// bodies displacements X and velocities V are left out.
  void read_initial(const std::string& file, const std::string& text) {
    Lmgc90Lines lines(file, text);
    bool moved = false, turned = false;
    int number = 0;
    while (lines.next()) {
      if (lines.word(0) == "RBDY3") number = lines.whole_number_of_word(1);
      for (const char* name :
           {"X(1)", "X(2)", "X(3)", "X(4)", "X(5)", "X(6)", "V(1)", "V(2)", "V(3)", "V(4)", "V(5)", "V(6)"})
        moved = moved || (lines.has(name) && lines.number(name) != 0.0);
      if (!lines.has("a(1)")) continue;
      Eigen::Matrix3d frame;
      frame.col(0) = triple(lines, "a(1)", "a(2)", "a(3)");
      lines.require_next("axis b of a body");
      frame.col(1) = triple(lines, "b(1)", "b(2)", "b(3)");
      lines.require_next("axis g of a body");
      const bool third_is_g = lines.has("g(1)");  // c in files of older versions
      frame.col(2) =
          third_is_g ? triple(lines, "g(1)", "g(2)", "g(3)") : triple(lines, "c(1)", "c(2)", "c(3)");
      if (frame.isIdentity(0.0)) continue;
      ImportedBlock& turned_block = block(lines, number);
      if (!in_own_frame_[at(number) - 1]) {
        turned = true;
        continue;
      }
      // Seven digits of a direction.
      if (!(frame.transpose() * frame).isIdentity(1e-5))
        lines.fail(lines.text("g(1)"),
                   fmt::format("axes of body {} are not of unit length and orthogonal", number));
      const Vector3 centre = centres_[at(number) - 1];
      for (Vector3& point : turned_block.points) point = centre + frame * (point - centre);
    }
    if (moved)
      model_.left_out.emplace_back(
          "displacements and velocities of DOF.INI (bodies start as in BODIES.DAT, at rest)");
    if (turned) model_.left_out.emplace_back("turned frames of DOF.INI of bodies without given inertia");
  }

  fs::path bodies_;
  ImportedModel model_;
  std::vector<bool> in_own_frame_;  ///< (#bodies), vertices are in the frame of inertia, which DOF.INI turns
  std::map<std::string, std::size_t> materials_by_name_;
  std::map<std::string, int> colours_;  ///< number of bodies of each
  std::vector<Vector3> centres_;        ///< (#bodies)
};

}  // namespace

ImportedModel read_lmgc90(const fs::path& bodies) {
  return Lmgc90Reader(bodies).read();
}

}  // namespace ashlar
