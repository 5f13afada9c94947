#include "apps/program/view/page_blocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace ashlar::page_blocks_test {
namespace {

using ::testing::ElementsAre;

TEST(PageBlocks, PartsThatHaveTheNumberOfABlockGetOneOfTheirOwn) {
  PageBlocks blocks({"beam.crack2.a", "wall", "beam.crack1.b", "beam.crack2.b"});
  blocks.add({"beam", "wall"});
  blocks.add({"beam.crack1.a", "wall", "beam.crack1.b"});
  blocks.add({"beam.crack2.a", "wall", "beam.crack1.b", "beam.crack2.b"});
  EXPECT_THAT(blocks.names(), ElementsAre("beam", "wall", "beam.crack1.b", "beam.crack2.b", "beam.crack1.a",
                                          "beam.crack2.a"));
  EXPECT_THROW(blocks.add({"a", "b", "c", "d", "e"}), std::runtime_error);
  const auto renumbered = [&](std::size_t frame) {
    UnstructuredGrid grid;
    grid.cell_data.push_back({"block_a", 1, {}, std::vector<std::int32_t>{0, 1, -1}});
    blocks.renumber(grid, frame);
    return std::get<std::vector<std::int32_t>>(grid.cell_data.front().values);
  };
  EXPECT_THAT(renumbered(0), ElementsAre(0, 1, -1));
  EXPECT_THAT(renumbered(1), ElementsAre(4, 1, -1));
  EXPECT_THAT(renumbered(2), ElementsAre(5, 1, -1));
}

}  // namespace
}  // namespace ashlar::page_blocks_test
