// Cases of rock cut by joints: consistency of pieces; removable blocks.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "apps/program/verify/verification.hpp"
#include "apps/scene/check/initial_overlap.hpp"
#include "apps/scene/expand/joint_planes.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/cutting/cut_solid.hpp"
#include "geometry/solid/hull_solid.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar {
namespace {

const CutSolid::Choice every_piece = [](int) { return true; };

Polyhedron body_of(const CutSolid& solid, int piece) {
  TriangleMesh mesh = solid.mesh(piece);
  const double resolution = resolution_of(mesh.points);
  return Polyhedron(std::move(mesh), resolution);
}

std::vector<VerificationCheck> cut_cube() {
  constexpr double side = 10.0;
  CutSolid solid(Polyhedron(make_box(Vector3::Zero(), Vector3::Constant(side))));
  const std::array<Vector3, 3> normals = {plane_normal(0, 0), plane_normal(90, 0), plane_normal(90, 90)};
  for (int set = 0; set < 3; ++set)
    for (int k = -2; k < 12; ++k)
      solid.cut({normals[static_cast<std::size_t>(set)], Vector3::Zero(), 1.0 * k}, set, every_piece);
  const std::vector<int> pieces = solid.pieces();
  double volume_error = 0.0, area_error = 0.0, shared = 0.0;
  for (const int piece : pieces) {
    volume_error = std::max(volume_error, std::abs(solid.volume(piece) - 1.0));
    for (const PieceFace& face : solid.faces(piece)) {
      area_error = std::max(area_error, std::abs(solid.area(face) - 1.0));
      if (face.neighbour > piece) shared += 1.0;
    }
  }
  return {check_absolute("blocks", static_cast<double>(pieces.size()), 1000, 0),
          check_absolute("pairs of neighbours", shared, 3.0 * 9.0 * 100.0, 0),
          check_absolute("largest error of a volume, m^3", volume_error, 0.0, 1e-12),
          check_absolute("largest error of a face, m^2", area_error, 0.0, 1e-12)};
}

/// An L of two arms, 6 by 6 by 4 m, 3 m wide: 108 m^3.
Polyhedron make_angle() {
  const std::array<std::array<double, 2>, 6> outline = {{{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 6}, {0, 6}}};
  TriangleMesh mesh;
  for (const double z : {0.0, 4.0})
    for (const auto& [x, y] : outline) mesh.points.emplace_back(x, y, z);
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, next + 6});
    mesh.triangles.push_back({k, next + 6, k + 6});
  }
  for (const auto& [a, b, c] :
       std::initializer_list<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  return Polyhedron(std::move(mesh));
}

Polyhedron random_solid(int seed, std::mt19937_64& random) {
  if (seed % 2 != 0) return make_angle();
  std::vector<Vector3> points;
  for (int k = 0; k < 20; ++k) {
    Vector3 point;
    for (double& x : point) x = 6.0 * random_share(random);
    points.push_back(point);
  }
  return make_hull_solid(points, 0.0);
}

struct Faults {
  double volume = 0.0;   ///< of the sum, relative to the solid
  double overlap = 0.0;  ///< deepest, m
  double faces = 0.0;    ///< number of cut faces without an equal face of a neighbour
};

void find_face_faults(const CutSolid& solid, Faults& faults) {
  std::map<std::tuple<int, int, int>, double> areas;  // of piece, neighbour and plane
  const std::vector<int> pieces = solid.pieces();
  for (const int piece : pieces) {
    for (const PieceFace& face : solid.faces(piece)) {
      if (face.mark >= 0 && face.neighbour < 0) faults.faces += 1.0;
      if (face.neighbour >= 0) areas[{piece, face.neighbour, face.plane}] += solid.area(face);
    }
  }
  for (const auto& [key, area] : areas) {
    const auto& [piece, neighbour, plane] = key;
    const auto other = areas.find({neighbour, piece, plane});
    if (other == areas.end() || other->second != area) faults.faces += 1.0;
  }
}

void find_overlap(const CutSolid& solid, Faults& faults) {
  std::vector<Polyhedron> bodies;
  std::vector<Box> boxes;
  for (const int piece : solid.pieces()) {
    bodies.push_back(body_of(solid, piece));
    boxes.push_back(box_of(bodies.back().mesh().points));
  }
  for (const auto& [a, b] : meeting_boxes(boxes))
    faults.overlap = std::max(
        faults.overlap,
        overlap_depth(bodies[static_cast<std::size_t>(a)], bodies[static_cast<std::size_t>(b)]).depth);
}

std::vector<VerificationCheck> cut_conserves() {
  constexpr int seeds = 50;
  Faults faults;
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const Polyhedron body = random_solid(seed, random);
    CutSolid solid(body);
    const int sets = 3 + seed % 4;
    for (int set = 0; set < sets; ++set) {
      const double dip = std::acos(random_share(random)) * 180.0 / std::numbers::pi;
      const Vector3 normal = plane_normal(dip, 360.0 * random_share(random));
      const double shift = random_share(random);
      for (int k = -4; k <= 4; ++k)
        solid.cut({normal, Vector3::Constant(3.0), 2.0 * (k + shift)}, set, every_piece);
    }
    double sum = 0.0;
    for (const int piece : solid.pieces()) sum += solid.volume(piece);
    faults.volume = std::max(faults.volume, std::abs(sum / body.volume() - 1.0));
    find_face_faults(solid, faults);
    find_overlap(solid, faults);
  }
  return {check_absolute("largest error of the sum of volumes, of the solid", faults.volume, 0.0, 1e-12),
          check_absolute("deepest overlap of rounded blocks, m", faults.overlap, 0.0, 1e-12),
          check_absolute("cut faces that are not shared", faults.faces, 0.0, 0)};
}

int piece_around(const CutSolid& solid, const Vector3& point) {
  for (const int piece : solid.pieces()) {
    bool inside = true;
    for (int axis = 0; axis < 3 && inside; ++axis) {
      const auto [low, high] = solid.extent(piece, {Vector3::Unit(axis), Vector3::Zero()});
      inside = low < point[axis] && point[axis] < high;
    }
    if (!inside) continue;
    for (const PieceFace& face : solid.faces(piece)) {
      const Vector3 normal = solid.normal(face);
      inside = inside && normal.dot(point) < solid.extent(piece, {normal, Vector3::Zero()}).second;
    }
    if (inside) return piece;
  }
  return -1;
}

std::vector<HeldFace> joints_of(const CutSolid& solid, int piece) {
  std::vector<HeldFace> held;
  for (const PieceFace& face : solid.faces(piece))
    if (face.neighbour >= 0) held.push_back({face.plane, face.below});
  return held;
}

/// Three joints of 60 degrees to the roof z = 0 of a tunnel. If they meet above the roof the block between them
/// narrows upwards: a key block. If they meet below, it widens and is held, under a joint at z = 5, by its own shape.
/// Also the wedge of two planes of the case `wedge`, whose friction angle is known.
std::vector<VerificationCheck> removable() {
  const Vector3 down(0, 0, -1);
  const auto roof = [&](double apex) {
    CutSolid rock(Polyhedron(make_box({-20, -20, 0}, {20, 20, 10})));
    rock.cut({Vector3::UnitZ(), {0, 0, 5}}, 0, every_piece);
    for (const double direction : {0.0, 120.0, 240.0})
      rock.cut({plane_normal(60, direction), {0, 0, apex}}, 1, every_piece);
    const int piece = piece_around(rock, {0, 0, 0.5});
    return rock.key_block(piece, joints_of(rock, piece), down);
  };
  const KeyBlock key = roof(3.0), tapered = roof(-3.0);
  CutSolid slope(Polyhedron(make_box({-10, -10, -10}, {10, 10, 10})));
  slope.cut({plane_normal(40, 130), Vector3::Zero()}, 0, every_piece);
  slope.cut({plane_normal(60, 220), Vector3::Zero()}, 1, every_piece);
  const int piece = piece_around(slope, {0, 0, 9});
  const KeyBlock wedge = slope.key_block(piece, joints_of(slope, piece), down);
  const double critical =
      std::atan(wedge.thrust / (wedge.pressure[0] + wedge.pressure[1])) * 180.0 / std::numbers::pi;
  const auto number = [](BlockMode mode) { return static_cast<double>(mode); };
  return {check_absolute("roof wedge: removable", key.removable, 1, 0),
          check_absolute("roof wedge: falling", number(key.mode), number(BlockMode::falling), 0),
          check_absolute("tapered block: removable", tapered.removable, 0, 0),
          check_absolute("tapered block: finite", tapered.finite, 1, 0),
          check_absolute("wedge 40/130, 60/220: slides on two", number(wedge.mode),
                         number(BlockMode::sliding_on_two), 0),
          check_absolute("its friction angle at rest, deg", critical, 33.357, 5e-4)};
}

/// The tetrahedron of four planes n_i . x = h_i: with M the determinant of the rows (n_i, h_i) and D_i that
/// of the normals without n_i, V = |M|^3 / (6 |D_1 D_2 D_3 D_4|), and the face in plane i has the area 3 V /
/// H_i with its height H_i = |M / D_i| / |n_i|. The D_i are the minors m, n, p, q of the wedge formulas of
/// Hoek and Bray, Rock Slope Engineering, appendix 2; the planes are those of their example.
std::vector<VerificationCheck> wedge_geometry() {
  const std::array<CutPlane, 4> planes = {{{plane_normal(45, 105), Vector3::Zero()},
                                           {plane_normal(70, 235), Vector3::Zero()},
                                           {plane_normal(12, 195), {0, 0, 30}},
                                           {plane_normal(65, 185), Vector3::Zero()}}};
  Eigen::Matrix4d rows;
  for (int i = 0; i < 4; ++i) {
    const CutPlane& plane = planes[static_cast<std::size_t>(i)];
    rows.row(i) << plane.normal.transpose(), plane.normal.dot(plane.point);
  }
  const double whole = std::abs(rows.determinant());
  std::array<double, 4> minors{};
  double product = 6.0;
  for (int i = 0; i < 4; ++i) {
    Eigen::Matrix3d normals;
    for (int j = 0, k = 0; j < 4; ++j)
      if (j != i) normals.row(k++) = rows.row(j).head<3>();
    minors[static_cast<std::size_t>(i)] = std::abs(normals.determinant());
    product *= minors[static_cast<std::size_t>(i)];
  }
  const double volume = whole * whole * whole / product;
  CutSolid rock(Polyhedron(make_box(Vector3::Constant(-200), Vector3::Constant(200))));
  for (int i = 0; i < 4; ++i) rock.cut(planes[static_cast<std::size_t>(i)], i, every_piece);
  std::vector<VerificationCheck> checks;
  for (const int piece : rock.pieces()) {
    const std::vector<PieceFace> faces = rock.faces(piece);
    if (faces.size() != 4 || faces[0].mark < 0 || faces[1].mark < 0 || faces[2].mark < 0 || faces[3].mark < 0)
      continue;
    checks.push_back(check_relative("volume, m^3", rock.volume(piece), volume, 1e-12));
    for (const PieceFace& face : faces) {
      const auto i = static_cast<std::size_t>(face.mark);
      const double area = 3.0 * volume * minors[i] * planes[i].normal.norm() / whole;
      checks.push_back(
          check_relative(fmt::format("area on plane {}, m^2", face.mark + 1), rock.area(face), area, 1e-12));
    }
  }
  checks.push_back(
      check_absolute("tetrahedra of the four planes", static_cast<double>(checks.size()) / 5.0, 1, 0));
  return checks;
}

constexpr VerificationCase cutting_case_list[] = {
    {"cut-cube", "a cube cut into unit cubes by three sets of joints", cut_cube},
    {"cut-conserves", "hulls and solids that are not convex cut by random sets", cut_conserves},
    {"removable", "key blocks by block theory", removable},
    {"wedge-geometry", "volume and areas of a wedge of four planes", wedge_geometry},
};

}  // namespace

std::span<const VerificationCase> cutting_cases() {
  return cutting_case_list;
}

}  // namespace ashlar
