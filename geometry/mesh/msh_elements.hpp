// Types of elements of Gmsh's MSH files: their numbers, dimensions and nodes (Gmsh's manual, section "MSH file
// format", "Node ordering"). The first nodes of an element of any order are its corners.
#pragma once

#include <array>

namespace ashlar {

struct MshElement {
  int type;
  int dimension;
  int nodes;
};

/// All types of dimension 0 to 3 that Gmsh writes up to the fourth order, and complete tetrahedra above.
inline constexpr std::array<MshElement, 37> msh_elements = {
    {{1, 1, 2},   {2, 2, 3},   {3, 2, 4},   {4, 3, 4},    {5, 3, 8},   {6, 3, 6},   {7, 3, 5},   {8, 1, 3},
     {9, 2, 6},   {10, 2, 9},  {11, 3, 10}, {12, 3, 27},  {13, 3, 18}, {14, 3, 14}, {15, 0, 1},  {16, 2, 8},
     {17, 3, 20}, {18, 3, 15}, {19, 3, 13}, {20, 2, 9},   {21, 2, 10}, {22, 2, 12}, {23, 2, 15}, {24, 2, 15},
     {25, 2, 21}, {26, 1, 4},  {27, 1, 5},  {28, 1, 6},   {29, 3, 20}, {30, 3, 35}, {31, 3, 56}, {71, 3, 84},
     {79, 3, 22}, {90, 3, 40}, {92, 3, 64}, {93, 3, 125}, {118, 3, 30}}};

/// A type of the table, nullptr for others.
[[nodiscard]] constexpr const MshElement* msh_element(long long type) {
  for (const MshElement& element : msh_elements)
    if (element.type == type) return &element;
  return nullptr;
}

/// Tetrahedra and triangles that are read: of the first order, and of the second by their corners.
[[nodiscard]] constexpr bool is_msh_tetrahedron(long long type) {
  return type == 4 || type == 11;
}
[[nodiscard]] constexpr bool is_msh_triangle(long long type) {
  return type == 2 || type == 9;
}

}  // namespace ashlar
