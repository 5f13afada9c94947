#include "apps/scene/meshes/dxf_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/meshes/dxf_outline.hpp"
#include "apps/scene/meshes/dxf_pairs.hpp"
#include "geometry/exact/degree_turn.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

/// Flags of polylines and their vertices (group code 70).
constexpr long long closed_in_m = 1;
constexpr long long polygon_mesh = 16;
constexpr long long closed_in_n = 32;
constexpr long long polyface = 64;
constexpr long long polyface_record = 128;

struct Insert {
  std::string block;
  Eigen::Affine3d transformation;  ///< of points relative to the block's base
  int line;
};

/// A block of the drawing, or the drawing itself.
struct Block {
  Vector3 base = Vector3::Zero();
  std::vector<std::pair<std::string, PolygonSoup>> layers;
  std::map<std::string, std::size_t, std::less<>> number;
  std::vector<Insert> inserts;

  PolygonSoup& layer(std::string_view name) {
    const auto [found, is_new] = number.emplace(name, layers.size());
    if (is_new) layers.emplace_back(name, PolygonSoup());
    return layers[found->second].second;
  }
};

/// A POLYLINE with its vertices.
struct Polyline {
  std::string layer;
  long long flags = 0;
  long long smoothing = 0;
  long long m = 0;
  long long n = 0;
  int line = 0;
  std::vector<Vector3> points;
  DxfOutline outline;                           ///< of one that is no mesh
  std::vector<std::array<long long, 4>> faces;  ///< 1-based indices, negative for hidden edges, 0: none
  std::vector<int> face_lines;
};

void add_polyface(const Polyline& polyline, PolygonSoup& soup) {
  for (std::size_t f = 0; f < polyline.faces.size(); ++f) {
    std::vector<Vector3> corners;
    for (const long long index : polyline.faces[f]) {
      if (index == 0) continue;
      const auto count = static_cast<long long>(polyline.points.size());
      if (index < -count || index > count)
        throw MeshFileError(
            fmt::format("point index ({}) of a polyface with {} points, allowed are their numbers", index,
                        count),
            polyline.face_lines[f], 1);
      corners.push_back(polyline.points[static_cast<std::size_t>(std::abs(index)) - 1]);
    }
    if (corners.size() >= 3) add_face(soup, corners);  // others are lines
  }
}

void add_polygon_mesh(const Polyline& polyline, PolygonSoup& soup) {
  const auto fail = [&](const std::string& what) { throw MeshFileError(what, polyline.line, 1); };
  if (polyline.smoothing != 0) fail("smoothed polygon mesh, allowed are those without smoothing (75 is 0)");
  constexpr long long most = 32767;
  const long long m = polyline.m;
  const long long n = polyline.n;
  if (m < 2 || n < 2 || m > most || n > most || static_cast<std::size_t>(m * n) != polyline.points.size())
    fail(fmt::format("polygon mesh of {} x {} vertices, it has {}; allowed are 2 to {} each way", m, n,
                     polyline.points.size(), most));
  const auto point = [&](long long i, long long j) {
    return polyline.points[static_cast<std::size_t>(i % m * n + j % n)];
  };
  const long long rows = (polyline.flags & closed_in_m) != 0 ? m : m - 1;
  const long long columns = (polyline.flags & closed_in_n) != 0 ? n : n - 1;
  for (long long i = 0; i < rows; ++i)
    for (long long j = 0; j < columns; ++j)
      add_face(soup, {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
}

class DxfReader {
 public:
  explicit DxfReader(std::string_view text) : bytes_(text.size()), pairs_(text) {}

  ShapeLayout run() {
    pairs_.next();
    while (!pairs_.is(0, "EOF")) {
      if (!pairs_.is(0, "SECTION")) pairs_.fail("must be SECTION or EOF, after a 0");
      pairs_.next();
      if (pairs_.code() != 2) pairs_.fail("must be the name of a section, after a 2");
      const std::string_view name = pairs_.value();
      pairs_.next();
      if (name == "ENTITIES")
        read_entities(drawing_, "ENDSEC");
      else if (name == "BLOCKS")
        read_blocks();
      else
        while (!pairs_.is(0, "ENDSEC")) pairs_.next();
      pairs_.next();
    }
    return layout();
  }

 private:
  /// Calls `use` for each pair up to the next entity.
  template <class Use>
  void each_pair(Use use) {
    for (pairs_.next(); pairs_.code() != 0; pairs_.next()) use();
  }

  void read_blocks() {
    while (!pairs_.is(0, "ENDSEC")) {
      if (!pairs_.is(0, "BLOCK")) {
        each_pair([] {});
        continue;
      }
      Block block;
      std::string name;
      const int line = pairs_.line();
      each_pair([&] {
        if (pairs_.code() == 2) name = pairs_.value();
        read_point(block.base, 0);
      });
      read_entities(block, "ENDBLK");
      each_pair([] {});
      if (!blocks_.emplace(name, std::move(block)).second)
        throw MeshFileError(
            fmt::format("block \"{}\" is there twice, each needs its own name", printable(name)), line, 1);
    }
  }

  /// Reads from the first entity to the given end.
  void read_entities(Block& block, std::string_view end) {
    while (!pairs_.is(0, end)) {
      if (pairs_.is(0, "ENDSEC") || pairs_.is(0, "EOF")) pairs_.fail(fmt::format("stands before {}", end));
      if (pairs_.is(0, "3DFACE"))
        read_face(block);
      else if (pairs_.is(0, "POLYLINE"))
        read_polyline(block);
      else if (pairs_.is(0, "LWPOLYLINE"))
        read_outline(block);
      else if (pairs_.is(0, "INSERT"))
        read_insert(block);
      else
        each_pair([] {});
    }
  }

  /// Reads a coordinate of corner k, if the pair is one. @return its axis
  std::optional<int> read_point(Vector3& point, int k) {
    for (int axis = 0; axis < 3; ++axis) {
      if (pairs_.code() != 10 * (axis + 1) + k) continue;
      point[axis] = pairs_.number("a coordinate");
      return axis;
    }
    return std::nullopt;
  }

  void read_face(Block& block) {
    std::vector<Vector3> corners(4, Vector3::Zero());
    std::array<int, 4> given{};
    std::string layer;
    const int line = pairs_.line();
    each_pair([&] {
      if (pairs_.code() == 8) layer = pairs_.text();
      for (int k = 0; k < 4; ++k)
        if (read_point(corners[static_cast<std::size_t>(k)], k)) ++given[static_cast<std::size_t>(k)];
    });
    for (std::size_t k = 0; k < 3; ++k)
      if (given[k] < 2)
        throw MeshFileError(fmt::format("3DFACE without corner {}, which it needs", k + 1), line, 1);
    if (given[3] == 0 || corners[3] == corners[2]) corners.pop_back();
    add_face(block.layer(layer), corners);
  }

  /// Reads a property that outlines of both kinds have.
  void read_property(DxfOutline& outline) {
    const int code = pairs_.code();
    if (code == 39) outline.thickness = pairs_.number("a thickness");
    if (code == 42 && pairs_.number("a bulge") != 0.0) outline.has_arcs = true;
    if (code == 210 || code == 220) outline.upward = outline.upward && pairs_.number("a direction") == 0.0;
    if (code == 230) outline.upward = outline.upward && pairs_.number("a direction") > 0.0;
    if (code == 70) outline.closed = (pairs_.integer("flags") & closed_in_m) != 0;
  }

  void read_outline(Block& block) {
    DxfOutline outline;
    outline.line = pairs_.line();
    std::string layer;
    each_pair([&] {
      if (pairs_.code() == 8) layer = pairs_.text();
      if (pairs_.code() == 38) outline.elevation = pairs_.number("an elevation");
      if (pairs_.code() == 10) outline.points.push_back(Vector3::Zero());
      if (!outline.points.empty()) read_point(outline.points.back(), 0);
      read_property(outline);
    });
    if (outline.thickness != 0.0) add_prism(std::move(outline), block.layer(layer));
  }

  void read_polyline(Block& block) {
    Polyline polyline;
    polyline.line = pairs_.line();
    polyline.outline.line = polyline.line;
    each_pair([&] {
      if (pairs_.code() == 30) polyline.outline.elevation = pairs_.number("an elevation");
      read_property(polyline.outline);
      if (pairs_.code() == 8) polyline.layer = pairs_.text();
      if (pairs_.code() == 70) polyline.flags = pairs_.integer("flags");
      if (pairs_.code() == 71) polyline.m = pairs_.integer("a number of vertices");
      if (pairs_.code() == 72) polyline.n = pairs_.integer("a number of vertices or faces");
      if (pairs_.code() == 75) polyline.smoothing = pairs_.integer("a kind of smoothing");
    });
    while (pairs_.is(0, "VERTEX")) read_vertex(polyline);
    if (!pairs_.is(0, "SEQEND")) pairs_.fail("must be VERTEX or SEQEND, in a POLYLINE");
    each_pair([] {});
    if ((polyline.flags & (polyface | polygon_mesh)) == 0) {
      if (polyline.outline.thickness == 0.0) return;  // a line
      polyline.outline.points = std::move(polyline.points);
      add_prism(std::move(polyline.outline), block.layer(polyline.layer));
      return;
    }
    PolygonSoup& soup = block.layer(polyline.layer);
    if ((polyline.flags & polyface) != 0)
      add_polyface(polyline, soup);
    else
      add_polygon_mesh(polyline, soup);
  }

  void read_vertex(Polyline& polyline) {
    Vector3 point = Vector3::Zero();
    std::array<long long, 4> corners{};
    long long flags = 0;
    const int line = pairs_.line();
    each_pair([&] {
      const int code = pairs_.code();
      if (code == 70) flags = pairs_.integer("flags");
      if (code == 42 && pairs_.number("a bulge") != 0.0) polyline.outline.has_arcs = true;
      if (code >= 71 && code <= 74)
        corners[static_cast<std::size_t>(code - 71)] = pairs_.integer("a point index");
      read_point(point, 0);
    });
    const bool face = (flags & polyface_record) != 0 && (flags & polyface) == 0;
    if (face) {
      polyline.faces.push_back(corners);
      polyline.face_lines.push_back(line);
    } else {
      polyline.points.push_back(point);
    }
  }

  void read_insert(Block& block) {
    Insert insert{{}, Eigen::Affine3d::Identity(), pairs_.line()};
    Vector3 place = Vector3::Zero();
    Vector3 scale = Vector3::Ones();
    Vector3 normal = Vector3::UnitZ();
    double angle = 0.0;
    each_pair([&] {
      const int code = pairs_.code();
      if (code == 2) insert.block = pairs_.value();
      read_point(place, 0);
      if (code >= 41 && code <= 43) scale[code - 41] = pairs_.number("a scale");
      if (code == 50) angle = pairs_.number("an angle");
      if (code == 210 || code == 220 || code == 230) normal[code / 10 - 21] = pairs_.number("a direction");
      if ((code == 70 || code == 71) && pairs_.integer("a number of columns or rows") > 1)
        pairs_.fail("columns or rows of an INSERT, allowed is 1");
    });
    if (normal.x() != 0.0 || normal.y() != 0.0 || !(normal.z() > 0.0))
      throw MeshFileError(
          "INSERT in another plane than xy, allowed is the direction (0, 0, 1) (210, 220, 230)", insert.line,
          1);
    const auto [sine, cosine] = degree_turn(angle);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
    insert.transformation.linear() = turn * scale.asDiagonal();
    insert.transformation.translation() = place;
    block.inserts.push_back(std::move(insert));
  }

  ShapeLayout layout() {
    ShapeLayout layout(ShapeLayout::SameName::joined, layout_limits(bytes_));
    layout.require_room(size_of(drawing_, layout, 0));
    struct Visit {
      const Block* block;
      Eigen::Affine3d transformation;
    };
    std::vector<Visit> stack = {{&drawing_, Eigen::Affine3d::Identity()}};
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const std::vector<std::size_t>& shapes = known_.at(visit.block)->shapes;
      for (std::size_t k = 0; k < shapes.size(); ++k)
        layout.place(visit.block->layers[k].first, shapes[k], visit.transformation);
      for (std::size_t k = visit.block->inserts.size(); k-- > 0;) {
        const Insert& insert = visit.block->inserts[k];
        const Block& block = block_of(insert);
        stack.push_back(
            {&block, visit.transformation * insert.transformation * Eigen::Translation3d(-block.base)});
      }
    }
    return layout;
  }

  /// Size of a block with its inserts. Adds its shapes to the layout. @param level nesting of blocks
  LayoutSize size_of(const Block& block, ShapeLayout& layout, int level) {
    const auto [found, is_new] = known_.try_emplace(&block);
    std::optional<Known>& known = found->second;
    if (!is_new && known) return known->size;
    if (!is_new || level > most_block_levels)
      throw MeshFileError(
          fmt::format(
              "a block is in itself, or blocks are in each other more than {} deep, which is not allowed",
              most_block_levels),
          0, 0);
    Known result;
    result.size.placements = 1.0;
    for (auto& [name, soup] : block.layers) {
      result.size += {1.0, static_cast<double>(soup.face_count())};
      result.shapes.push_back(layout.add(soup));
    }
    for (const Insert& insert : block.inserts) result.size += size_of(block_of(insert), layout, level + 1);
    known = std::move(result);
    return known->size;
  }

  const Block& block_of(const Insert& insert) const {
    const auto found = blocks_.find(insert.block);
    if (found == blocks_.end())
      throw MeshFileError(
          fmt::format("INSERT of block \"{}\", which the drawing does not have", printable(insert.block)),
          insert.line, 1);
    return found->second;
  }

  struct Known {
    LayoutSize size;
    std::vector<std::size_t> shapes;  ///< of its layers
  };

  std::size_t bytes_;
  DxfPairs pairs_;
  Block drawing_;
  std::map<std::string, Block> blocks_;
  std::map<const Block*, std::optional<Known>> known_;  ///< empty while its inserts are examined
};

}  // namespace

ShapeLayout read_dxf(std::string_view text) {
  constexpr std::string_view binary = "AutoCAD Binary DXF";
  if (text.starts_with(binary)) throw MeshFileError("binary DXF, allowed are texts", 0, 0);
  return DxfReader(text).run();
}

}  // namespace ashlar
