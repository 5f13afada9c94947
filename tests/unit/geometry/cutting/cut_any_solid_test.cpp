// Solids of any shape, turned by odd angles, so that what was flat is flat to rounding only, cut by planes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <random>
#include <string>

#include "geometry/cutting/cut_solid.hpp"
#include "geometry/mesh/mesh_io.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::cut_any_solid_test {
namespace {

constexpr double pi = 3.14159265358979323846;
const CutSolid::Choice always = [](int) { return true; };

double random_number(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vector3 random_unit(std::mt19937_64& random) {
  std::normal_distribution<double> part;
  const double x = part(random), y = part(random), z = part(random);
  return Vector3(x, y, z).normalized();
}

TriangleMesh turned(TriangleMesh mesh, std::mt19937_64& random) {
  const Vector3 axis = random_unit(random);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(random_number(random, 0.1, 3.0), axis).toRotationMatrix();
  for (Vector3& point : mesh.points) point = turn * point + Vector3(0.3, -0.2, 0.1);
  return mesh;
}

/// A sphere of rings by sides, each corner at a radius of its own.
TriangleMesh star(int rings, int sides, double least, std::mt19937_64& random) {
  TriangleMesh mesh;
  mesh.points.emplace_back(0, 0, random_number(random, least, 1.0));
  for (int i = 1; i < rings; ++i) {
    for (int k = 0; k < sides; ++k) {
      const double down = pi * i / rings, around = 2.0 * pi * k / sides,
                   radius = random_number(random, least, 1.0);
      mesh.points.push_back(radius * Vector3(std::sin(down) * std::cos(around),
                                             std::sin(down) * std::sin(around), std::cos(down)));
    }
  }
  mesh.points.emplace_back(0, 0, -random_number(random, least, 1.0));
  const int last = static_cast<int>(mesh.points.size()) - 1;
  const auto at = [&](int ring, int side) { return 1 + (ring - 1) * sides + side % sides; };
  for (int k = 0; k < sides; ++k) {
    mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
    mesh.triangles.push_back({last, at(rings - 1, k + 1), at(rings - 1, k)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

/// A torus of squares in the plane: with four by four a frame with a square hole.
TriangleMesh torus(int around, int across, double radius, double thickness) {
  TriangleMesh mesh;
  const auto at = [&](int i, int k) { return i % around * across + k % across; };
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      const double u = 2.0 * pi * i / around, v = 2.0 * pi * (k + 0.5) / across;
      const double r = radius + thickness * std::cos(v);
      mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), thickness * std::sin(v));
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

/// A closed outline, counter-clockwise, between z = 0 and a height. @param caps triangles of its corners
TriangleMesh prism(const std::vector<std::array<double, 2>>& outline,
                   const std::vector<std::array<int, 3>>& caps, double height) {
  TriangleMesh mesh;
  const auto count = static_cast<int>(outline.size());
  for (const double z : {0.0, height})
    for (const auto& [x, y] : outline) mesh.points.emplace_back(x, y, z);
  for (const auto& [a, b, c] : caps) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  for (int k = 0; k < count; ++k) {
    const int next = (k + 1) % count;
    mesh.triangles.push_back({k, next, next + count});
    mesh.triangles.push_back({k, next + count, k + count});
  }
  return mesh;
}

TriangleMesh angle() {
  return prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}},
               1.0);
}

/// Teeth of one height on a back: a plane through their tips meets many edges.
TriangleMesh comb(int teeth) {
  std::vector<std::array<double, 2>> outline = {{0.0, -1.0}, {2.0 * teeth, -1.0}};
  std::vector<std::array<int, 3>> caps;
  for (int k = teeth; k > 0; --k) {
    outline.push_back({2.0 * k, 0.0});
    outline.push_back({2.0 * k - 1.0, 1.0});
  }
  outline.push_back({0.0, 0.0});
  const auto last = static_cast<int>(outline.size()) - 1;
  for (int k = 2; k < last; k += 2) caps.push_back({k, k + 1, k + 2});
  caps.push_back({0, 1, 2});
  for (int k = 2; k < last; k += 2) caps.push_back({0, k, k + 2});
  return prism(outline, caps, 1.5);
}

double resolution_of(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Vector3& point : mesh.points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return 0x1p-46 * largest;
}

/// Volumes add up, pieces are solids of their volumes, and neighbours share their faces.
void expect_pieces_fit(const CutSolid& solid, const TriangleMesh& whole) {
  const double resolution = resolution_of(whole), volume = Polyhedron(whole).volume();
  double sum = 0.0;
  std::map<std::pair<int, int>, std::pair<double, Vector3>> shared;
  for (const int piece : solid.pieces()) {
    sum += solid.volume(piece);
    try {
      const Polyhedron body(solid.mesh(piece, resolution), resolution);
      EXPECT_NEAR(body.volume(), solid.volume(piece), 1e-12 * volume);
    } catch (const MeshError& error) {
      ADD_FAILURE() << "piece of " << solid.volume(piece) << ": " << error.what();
    }
    Vector3 closing = Vector3::Zero();
    for (const PieceFace& face : solid.faces(piece)) {
      const double area = solid.area(face);
      EXPECT_GT(area, 0.0);
      closing += area * solid.normal(face);
      if (face.neighbour < 0) continue;
      auto& [areas, normals] =
          shared.try_emplace({piece, face.neighbour}, 0.0, Vector3::Zero()).first->second;
      areas += area;
      normals += area * solid.normal(face);
    }
    EXPECT_LT(closing.norm(), 1e-12 * std::cbrt(volume * volume)) << "areas of a closed surface";
  }
  EXPECT_NEAR(sum, volume, 1e-12 * volume);
  for (const auto& [pair, of] : shared) {
    const auto& [area, normal] = shared.at({pair.second, pair.first});
    EXPECT_EQ(area, of.first);
    EXPECT_EQ(normal, Vector3(Vector3::Zero() - of.second));
  }
}

std::vector<std::pair<std::string, TriangleMesh>> shapes(std::mt19937_64& random) {
  return {
      {"star of 40", star(5, 10, 0.4, random)}, {"rough star", star(8, 12, 0.2, random)}, {"angle", angle()},
      {"frame", torus(4, 4, 2.0, 0.7)},         {"torus", torus(16, 8, 2.0, 0.7)},        {"comb", comb(6)}};
}

TEST(CutAnySolid, TurnedSolidsByRandomPlanes) {
  std::mt19937_64 random(29);
  for (int round = 0; round < 8; ++round) {
    for (const auto& [name, shape] : shapes(random)) {
      SCOPED_TRACE(name + " " + std::to_string(round));
      const TriangleMesh mesh = turned(shape, random);
      CutSolid solid{Polyhedron(mesh)};
      EXPECT_EQ(solid.volume(0), Polyhedron(mesh).volume());
      const int planes = 1 + round % 5;
      bool parted = false;
      for (int k = 0; k < planes; ++k) {
        const Vector3 normal = random_unit(random), at = 0.4 * random_unit(random);
        solid.cut({normal, at}, k, always);
        const auto above = [&](const Vector3& corner) { return normal.dot(corner - at) > 0.0; };
        const auto corners_above = std::count_if(mesh.points.begin(), mesh.points.end(), above);
        parted = parted || (corners_above > 0 && corners_above < std::ssize(mesh.points));
      }
      EXPECT_EQ(solid.pieces().size() > 1U, parted);
      expect_pieces_fit(solid, mesh);
    }
  }
}

/// Planes through three corners each: they touch edges, go along faces and part solids in lines and points.
TEST(CutAnySolid, PlanesThroughCorners) {
  std::mt19937_64 random(31);
  int several = 0;
  for (int round = 0; round < 200; ++round) {
    const TriangleMesh mesh = round % 2 == 0 ? angle() : comb(1 + round % 5);
    CutSolid solid{Polyhedron(mesh)};
    for (int k = 0; k < 1 + round % 4; ++k) {
      std::array<Vector3, 3> x;
      for (Vector3& corner : x) corner = mesh.points[random() % mesh.points.size()];
      const Vector3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
      if (!normal.isZero()) solid.cut({normal, x[0]}, k, always);
    }
    SCOPED_TRACE(round);
    expect_pieces_fit(solid, mesh);
    several += solid.pieces().size() > 2 ? 1 : 0;
  }
  EXPECT_GT(several, 50);
}

// Teeth of 45 degrees are 2 m wide and 1 m high. The plane through their tips only touches; half way up it cuts off tips of
// a quarter of a square metre.
TEST(CutAnySolid, TeethOfACombAreParted) {
  const TriangleMesh mesh = comb(6);
  CutSolid solid{Polyhedron(mesh)};
  solid.cut({Vector3::UnitY(), Vector3(0, 1, 0)}, 0, always);
  EXPECT_EQ(solid.pieces().size(), 1U);
  solid.cut({Vector3::UnitY(), Vector3(0, 0.5, 0)}, 1, always);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 7U);
  EXPECT_EQ(solid.volume(pieces[0]), 12.0 * 1.5 + 6.0 * 0.75 * 1.5);
  for (std::size_t k = 1; k < pieces.size(); ++k) EXPECT_EQ(solid.volume(pieces[k]), 0.25 * 1.5);
  // Through the valleys, which it touches in lines: teeth and the back.
  CutSolid other{Polyhedron(mesh)};
  other.cut({Vector3::UnitY(), Vector3::Zero()}, 1, always);
  EXPECT_EQ(other.pieces().size(), 7U);
  EXPECT_EQ(other.volume(other.pieces()[0]), 12.0 * 1.5);
  EXPECT_EQ(other.faces(other.pieces()[0]).size(), 6U + 5U) << "one upper face for each tooth beside it";
}

// A frame cut along its plane has sections with a hole, each of which is one face.
TEST(CutAnySolid, SectionsMayHaveHoles) {
  TriangleMesh mesh = torus(4, 4, 2.0, 0.5);
  CutSolid solid{Polyhedron(mesh)};
  solid.cut({Vector3::UnitZ(), Vector3::Zero()}, 0, always);
  const std::vector<int> pieces = solid.pieces();
  ASSERT_EQ(pieces.size(), 2U);
  for (const int piece : pieces) {
    int shared = 0;
    for (const PieceFace& face : solid.faces(piece)) {
      if (face.neighbour < 0) continue;
      ++shared;
      EXPECT_EQ(face.parts.size(), 1U);
      // Squares with diagonals of 2 (2 +- 0.5 cos 45 degrees).
      const double thick = 0.5 * std::sqrt(0.5), outer = 2.0 + thick, inner = 2.0 - thick;
      EXPECT_NEAR(solid.area(face), 2.0 * (outer * outer - inner * inner), 1e-14 * 8.0);
    }
    EXPECT_EQ(shared, 1);
  }
  solid.cut({Vector3::UnitX(), Vector3(0.1, 0, 0)}, 1, always);
  EXPECT_EQ(solid.pieces().size(), 4U) << "both halves of the ring, above and below";
  expect_pieces_fit(solid, mesh);
}

TEST(CutAnySolid, MeshesOfData) {
  std::mt19937_64 random(37);
  for (const char* name : {"l_prism.ply", "frame.obj", "pyramid.ply", "stone.off"}) {
    for (int round = 0; round < 4; ++round) {
      TriangleMesh mesh = read_mesh(std::filesystem::path(ASHLAR_DATA_DIR) / "meshes" / name);
      if (round > 0) mesh = turned(std::move(mesh), random);
      CutSolid solid{Polyhedron(mesh)};
      const Vector3 middle = 0.5 * (mesh.points.front() + mesh.points.back());
      for (int k = 0; k < 3; ++k)
        solid.cut({random_unit(random), middle + 0.01 * random_unit(random)}, k, always);
      SCOPED_TRACE(name + std::to_string(round));
      EXPECT_GT(solid.pieces().size(), 1U);
      expect_pieces_fit(solid, mesh);
    }
  }
}

TEST(CutAnySolid, ThousandsOfTriangles) {
  std::mt19937_64 random(41);
  for (const TriangleMesh& shape : {star(40, 40, 0.8, random), torus(64, 24, 2.0, 0.7)}) {
    const TriangleMesh mesh = turned(shape, random);
    EXPECT_GT(mesh.triangles.size(), 3000U);
    CutSolid solid{Polyhedron(mesh)};
    for (int k = 0; k < 5; ++k) solid.cut({random_unit(random), 0.3 * random_unit(random)}, k, always);
    EXPECT_GT(solid.pieces().size(), 6U);
    expect_pieces_fit(solid, mesh);
  }
}

/// Volumes inside and outside a surface.
std::pair<double, double> parted_volumes(const CutSolid& solid) {
  std::pair<double, double> volumes(0.0, 0.0);
  for (const int piece : solid.pieces())
    (solid.label(piece) == 1 ? volumes.first : volumes.second) += solid.volume(piece);
  return volumes;
}

// A turned tunnel with the section of an angle goes through a cube. The slabs beyond both ends aside, it takes 3 m^2 out
// of a cube that is 2 m long across the tunnel's way. Rock and tunnel that are both not convex add up.
TEST(CutAnySolid, AlongTurnedSurfaces) {
  std::mt19937_64 random(43);
  for (int round = 0; round < 5; ++round) {
    TriangleMesh tunnel = angle(), cube = make_box({-1, -1, -1}, {4, 4, 1});
    for (Vector3& point : tunnel.points) point.z() = 4.0 * point.z() - 2.0;
    const std::uint64_t turn = random();
    for (TriangleMesh* mesh : {&tunnel, &cube}) {
      std::mt19937_64 same(turn);
      *mesh = turned(std::move(*mesh), same);
    }
    CutSolid solid{Polyhedron(cube)};
    solid.cut_along(Polyhedron(tunnel), 0, 1, always);
    EXPECT_NEAR(parted_volumes(solid).first, 3.0 * 2.0, 1e-13 * 50.0);
    EXPECT_NEAR(parted_volumes(solid).second, 50.0 - 6.0, 1e-13 * 50.0);
    EXPECT_EQ(solid.pieces().size(), 2U);
    expect_pieces_fit(solid, cube);

    const TriangleMesh rock = turned(star(6, 8, 0.5, random), random);
    CutSolid rough{Polyhedron(rock)};
    rough.cut({random_unit(random), Vector3(0.3, -0.2, 0.1)}, 0, always);
    rough.cut_along(Polyhedron(turned(angle(), random)), 1, 1, always);
    rough.cut({random_unit(random), Vector3(0.3, -0.2, 0.1)}, 2, always);
    EXPECT_GT(parted_volumes(rough).first, 0.0);
    expect_pieces_fit(rough, rock);
  }
}

}  // namespace
}  // namespace ashlar::cut_any_solid_test
