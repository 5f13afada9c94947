// Small solids with volumes and counts that can be derived by hand, for the tests of every layer.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "geometry/solid/shapes.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar::test_support {

/// Prism over a profile in the plane z = 0, up to z = height. @param cap triangles of the profile,
/// counter-clockwise. @param rings boundary loops of the profile: outer counter-clockwise, holes clockwise.
inline TriangleMesh make_prism(const std::vector<std::array<double, 2>>& profile,
                               const std::vector<std::array<int, 3>>& cap,
                               const std::vector<std::vector<int>>& rings, double height) {
  const int n = static_cast<int>(profile.size());
  TriangleMesh mesh;
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : profile) mesh.points.emplace_back(x, y, z);
  }
  for (const auto& [a, b, c] : cap) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + n, b + n, c + n});
  }
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int a = ring[i];
      const int b = ring[(i + 1) % ring.size()];
      mesh.triangles.push_back({a, b, b + n});
      mesh.triangles.push_back({a, b + n, a + n});
    }
  }
  return mesh;
}

/// L of three unit squares, height 1: volume 3, 8 faces, 18 edges (one reflex), 12 corners.
inline TriangleMesh make_l_prism() {
  return make_prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                    {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}, {{0, 1, 2, 3, 4, 5}}, 1.0);
}

/// Square 3 by 3 with a square hole 1 by 1 in the middle, height 1: volume 8, 10 faces (two with a hole),
/// 24 edges, 16 corners, genus 1.
inline TriangleMesh make_frame() {
  return make_prism({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}},
                    {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}},
                    {{0, 1, 2, 3}, {4, 7, 6, 5}}, 1.0);
}

/// Cube [-1, 2]^3 without the cube [0, 2]^3: a floor and two walls that meet in the origin, volume 19.
inline TriangleMesh make_corner() {
  TriangleMesh mesh = make_box(Vector3::Constant(-1.0), Vector3::Constant(2.0));
  // Point x + 2 y + 4 z of the box is at the far side of the axes that are one. The far corner is replaced by
  // the cube's seven other points.
  std::erase_if(mesh.triangles, [&](const auto& t) {
    for (int axis = 0; axis < 3; ++axis)
      if (mesh.points[t[0]][axis] == 2.0 && mesh.points[t[1]][axis] == 2.0 && mesh.points[t[2]][axis] == 2.0)
        return true;
    return false;
  });
  const auto number = [&mesh](const Vector3& p) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      if (mesh.points[i] == p) return static_cast<int>(i);
    mesh.points.push_back(p);
    return static_cast<int>(mesh.points.size()) - 1;
  };
  std::erase(mesh.points, Vector3(2, 2, 2));
  for (int axis = 0; axis < 3; ++axis) {
    const auto point = [&](double along, double u, double v) {
      Vector3 p;
      p[axis] = along;
      p[(axis + 1) % 3] = u;
      p[(axis + 2) % 3] = v;
      return number(p);
    };
    const auto quadrangle = [&](const std::array<int, 4>& c) {
      mesh.triangles.push_back({c[0], c[1], c[2]});
      mesh.triangles.push_back({c[0], c[2], c[3]});
    };
    // The wall, and the L at the far side of the cube, of which the cube leaves two strips.
    quadrangle({point(0, 0, 0), point(0, 2, 0), point(0, 2, 2), point(0, 0, 2)});
    quadrangle({point(2, -1, -1), point(2, 2, -1), point(2, 2, 0), point(2, 0, 0)});
    quadrangle({point(2, -1, -1), point(2, 0, 0), point(2, 0, 2), point(2, -1, 2)});
  }
  return mesh;
}

/// Square base 2 by 2, height 3: volume 4.
inline TriangleMesh make_pyramid() {
  return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}},
          {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

/// Unit cube whose faces are divided into n by n squares: points on edges and inside faces.
inline TriangleMesh make_divided_cube(int n) {
  TriangleMesh mesh;
  const auto point_number = [&mesh](const Vector3& p) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      if (mesh.points[i] == p) return static_cast<int>(i);
    }
    mesh.points.push_back(p);
    return static_cast<int>(mesh.points.size()) - 1;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const double level : {0.0, 1.0}) {
      const auto corner = [&](int i, int j) {
        Vector3 p;
        p[axis] = level;
        p[(axis + 1) % 3] = static_cast<double>(i) / n;
        p[(axis + 2) % 3] = static_cast<double>(j) / n;
        return point_number(p);
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const int a = corner(i, j);
          int b = corner(i + 1, j);
          const int c = corner(i + 1, j + 1);
          int d = corner(i, j + 1);
          if (level == 0.0) std::swap(b, d);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
      }
    }
  }
  return mesh;
}

/// Unit cube with the middle of its top face moved to the given height.
inline TriangleMesh make_dented_cube(double height) {
  TriangleMesh mesh = make_box(Vector3::Zero(), Vector3::Ones());
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] >= 4 && t[1] >= 4 && t[2] >= 4; });
  mesh.points.emplace_back(0.5, 0.5, height);
  mesh.triangles.insert(mesh.triangles.end(), {{4, 5, 8}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}});
  return mesh;
}

/// The triangles of both meshes over their points put one after the other.
inline TriangleMesh join(TriangleMesh a, const TriangleMesh& b) {
  const int offset = static_cast<int>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

inline TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace ashlar::test_support
