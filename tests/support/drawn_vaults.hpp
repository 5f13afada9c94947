// Vaults as a drawing program writes them: one group of an OBJ file for each stone, corners rounded to a decimal,
// each stone with vertex numbers and first corners of its own.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar::test_support {

/// Corners and outward polygons of one stone.
struct DrawnStone {
  std::vector<Vector3> corners;
  std::vector<std::vector<int>> faces;
  bool support = false;  ///< of the courses that the vault springs from
};

/// A hexahedron. @param c lower quadrangle counter-clockwise from above, then the upper one above it
inline DrawnStone drawn_hexahedron(const std::array<Vector3, 8>& c) {
  return {{c.begin(), c.end()},
          {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
          false};
}

/// A dome of courses around the z axis, open at the top, inner radius 3 m, 0.3 m thick. The joints of each course
/// are half a stone from those of the next, and stones have a corner wherever one of a neighbour lies on an edge
/// of theirs: each stone meets two others above and below it, in polygons that both have. Inner and outer faces
/// have six corners, which are not in a plane.
inline std::vector<DrawnStone> drawn_dome(int courses, int stones) {
  constexpr double inner = 3.0, outer = 3.3, lowest = 0.05, highest = 1.3;  // m; rad over the springing
  const auto corner = [&](int course, int half, double radius) {
    const double height = lowest + (highest - lowest) * course / courses;
    const double angle = std::numbers::pi * (half % (2 * stones)) / stones;
    return Vector3(radius * std::cos(height) * std::cos(angle), radius * std::cos(height) * std::sin(angle),
                   radius * std::sin(height));
  };
  std::vector<DrawnStone> dome;
  for (int course = 0; course < courses; ++course) {
    for (int stone = 0; stone < stones; ++stone) {
      const int first = 2 * stone + course % 2;
      DrawnStone drawn;
      // 0 to 2 inner and lower, 3 to 5 inner and upper, 6 to 11 outer.
      for (const double radius : {inner, outer})
        for (const int level : {course, course + 1})
          for (int half = first; half < first + 3; ++half)
            drawn.corners.push_back(corner(level, half, radius));
      drawn.faces = {{0, 3, 4, 5, 2, 1}, {6, 7, 8, 11, 10, 9}, {0, 1, 7, 6}, {1, 2, 8, 7},
                     {4, 3, 9, 10},      {5, 4, 10, 11},       {3, 0, 6, 9}, {2, 5, 11, 8}};
      drawn.support = course == 0;
      dome.push_back(std::move(drawn));
    }
  }
  return dome;
}

/// A stone of a tunnel vault around the y axis, between two angles from the vertical and two cuts across it, each
/// given at the inner and the outer radius of each angle.
inline DrawnStone drawn_voussoir(double inner, double outer, const std::array<double, 2>& angles,
                                 const std::array<std::array<double, 2>, 2>& near,
                                 const std::array<std::array<double, 2>, 2>& far) {
  const auto at = [&](double radius, std::size_t side, double y) {
    return Vector3(radius * std::sin(angles[side]), y, radius * std::cos(angles[side]));
  };
  return drawn_hexahedron({at(inner, 0, near[0][0]), at(inner, 1, near[1][0]), at(inner, 1, far[1][0]),
                           at(inner, 0, far[0][0]), at(outer, 0, near[0][1]), at(outer, 1, near[1][1]),
                           at(outer, 1, far[1][1]), at(outer, 0, far[0][1])});
}

inline void turn_about_z(std::vector<DrawnStone>& stones, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (DrawnStone& stone : stones)
    for (Vector3& p : stone.corners) p = Vector3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
}

/// A tunnel vault, inner radius 3 m, turned off the axes. Joints of a course are half a stone from those of the
/// next, and stones have eight corners only: corners of one lie inside the faces of the next.
inline std::vector<DrawnStone> drawn_barrel(int courses, int stones) {
  constexpr double inner = 3.0, outer = 3.3, length = 0.5, widest = 1.2;
  std::vector<DrawnStone> barrel;
  for (int course = 0; course < courses; ++course) {
    const std::array<double, 2> angles = {widest * (2.0 * course / courses - 1.0),
                                          widest * (2.0 * (course + 1) / courses - 1.0)};
    const auto joint = [&](int n) { return length * (n == 0 || n == stones ? n : n + 0.5 * (course % 2)); };
    for (int n = 0; n < stones; ++n) {
      const double near = joint(n), far = joint(n + 1);
      barrel.push_back(
          drawn_voussoir(inner, outer, angles, {{{near, near}, {near, near}}}, {{{far, far}, {far, far}}}));
      barrel.back().support = course == 0 || course + 1 == courses;
    }
  }
  turn_about_z(barrel, 0.3);
  return barrel;
}

/// A cross vault over a square, inner radius 3 m: four webs that meet over its diagonals, each of `courses`
/// courses to either side of the crown, whose stones at the diagonals are mitred. Of course k, counted from the
/// crown, the stone next to the diagonal is one of pieces[k]. Courses are bonded as those of drawn_barrel().
inline std::vector<DrawnStone> drawn_cross_vault(const std::vector<int>& pieces) {
  constexpr double inner = 3.0, outer = 3.3, edge = 3.3, widest = 1.0;
  std::vector<DrawnStone> web;
  const auto courses = static_cast<double>(pieces.size());
  for (const double side : {-1.0, 1.0}) {
    for (std::size_t course = 0; course < pieces.size(); ++course) {
      std::array<double, 2> angles = {side * widest * static_cast<double>(course) / courses,
                                      side * widest * static_cast<double>(course + 1) / courses};
      if (side < 0.0) std::swap(angles[0], angles[1]);
      // Over the diagonal y = |x|.
      const auto mitre = [&](std::size_t k) {
        const double share = std::abs(std::sin(angles[k]));
        return std::array{inner * share, outer * share};
      };
      const double start = outer * std::max(std::abs(std::sin(angles[0])), std::abs(std::sin(angles[1])));
      std::array<std::array<double, 2>, 2> near = {mitre(0), mitre(1)};
      for (int n = 1; n <= pieces[course]; ++n) {
        const double share = (n - 0.3 * static_cast<double>(course % 2)) / pieces[course];
        const double far = n == pieces[course] ? edge : start + share * (edge - start);
        const std::array<std::array<double, 2>, 2> end = {{{far, far}, {far, far}}};
        web.push_back(drawn_voussoir(inner, outer, angles, near, end));
        web.back().support = course + 1 == pieces.size();
        near = end;
      }
    }
  }
  std::vector<DrawnStone> vault;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (DrawnStone stone : web) {
      // Quarter turns without rounding: neighbours over a diagonal have the same corners.
      for (Vector3& p : stone.corners)
        for (int k = 0; k < quarter; ++k) p = Vector3(-p.y(), p.x(), p.z());
      vault.push_back(std::move(stone));
    }
  }
  turn_about_z(vault, 0.3);
  return vault;
}

/// An OBJ file; groups of supports are called base and a number, others s and a number. @param decimals of coordinates, m. @param random numbers corners and chooses the first of each face
inline std::string drawing_of(const std::vector<DrawnStone>& stones, int decimals, std::mt19937& random) {
  std::string text;
  int before = 1;
  for (std::size_t n = 0; n < stones.size(); ++n) {
    const auto& [corners, faces, support] = stones[n];
    std::vector<std::size_t> order(corners.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::shuffle(order.begin(), order.end(), random);
    text += fmt::format("o {}{}\n", support ? "base" : "s", n);
    std::vector<int> number(corners.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Vector3& p = corners[order[k]];
      number[order[k]] = before + static_cast<int>(k);
      text += fmt::format("v {:.{}f} {:.{}f} {:.{}f}\n", p.x(), decimals, p.y(), decimals, p.z(), decimals);
    }
    for (const std::vector<int>& face : faces) {
      const std::size_t first = random() % face.size();
      text += "f";
      for (std::size_t k = 0; k < face.size(); ++k)
        text += fmt::format(" {}", number[static_cast<std::size_t>(face[(first + k) % face.size()])]);
      text += "\n";
    }
    before += static_cast<int>(corners.size());
  }
  return text;
}

}  // namespace ashlar::test_support
