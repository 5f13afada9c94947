// Invariants of faces, edges, corners and triangles of every solid.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar::test_support {

inline void expect_consistent(const Polyhedron& p) {
  std::vector<int> seen(p.mesh().triangles.size(), 0);
  for (std::size_t f = 0; f < p.faces().size(); ++f) {
    for (const int t : p.faces()[f].triangles) {
      ++seen[t];
      EXPECT_EQ(p.face_of_triangle()[t], static_cast<int>(f));
    }
  }
  EXPECT_THAT(seen, testing::Each(1));

  std::set<std::array<int, 3>> sides;  // face, from, to
  for (std::size_t f = 0; f < p.faces().size(); ++f) {
    for (const auto& loop : p.faces()[f].loops) {
      EXPECT_GE(loop.size(), 3U);
      EXPECT_EQ(std::set<int>(loop.begin(), loop.end()).size(), loop.size());
      for (std::size_t i = 0; i < loop.size(); ++i) {
        sides.insert({static_cast<int>(f), loop[i], loop[(i + 1) % loop.size()]});
      }
    }
  }
  EXPECT_EQ(sides.size(), 2 * p.edges().size());
  std::set<int> ends;
  for (const PolyhedronEdge& e : p.edges()) {
    EXPECT_EQ(sides.count({e.faces[0], e.vertices[0], e.vertices[1]}), 1U);
    EXPECT_EQ(sides.count({e.faces[1], e.vertices[1], e.vertices[0]}), 1U);
    EXPECT_NE(e.faces[0], e.faces[1]);
    ends.insert(e.vertices.begin(), e.vertices.end());
  }
  EXPECT_EQ(std::vector<int>(ends.begin(), ends.end()), p.corners());
}

}  // namespace ashlar::test_support
