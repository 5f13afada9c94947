#include "apps/vtu_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "support/temporary_folder.hpp"

namespace ashlar {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

UnstructuredGrid sample() {
  UnstructuredGrid grid;
  for (int i = 0; i < 5; ++i) grid.points.emplace_back(0.1 + i, -2.0 * i, 1.0 / (1 + i));
  grid.add_cell(VtkCellType::triangle, std::array{0, 1, 2});
  grid.add_cell(VtkCellType::polygon, std::array{1, 2, 3, 4});
  grid.point_data.push_back(
      {"v", 2, {"a", "b"}, std::vector<double>{1, 2, 3, 4, 5, -0.0, 0.1, 8, 9, 1e-320}});
  grid.cell_data.push_back(
      {"a < \"b\" & c", 1, {}, std::vector<std::int32_t>{-7, std::numeric_limits<std::int32_t>::max()}});
  return grid;
}

TEST(VtuReader, ReadsBackWhatWasWritten) {
  const UnstructuredGrid written = sample();
  const UnstructuredGrid read = from_vtu(to_vtu(written));
  EXPECT_EQ(read.points, written.points);
  EXPECT_EQ(read.connectivity, (std::vector{0, 1, 2, 1, 2, 3, 4}));
  EXPECT_EQ(read.offsets, (std::vector{3, 7}));
  EXPECT_EQ(read.types, (std::vector{VtkCellType::triangle, VtkCellType::polygon}));
  ASSERT_EQ(read.point_data.size(), 1U);
  EXPECT_EQ(read.point_data[0].name, "v");
  EXPECT_EQ(read.point_data[0].components, 2);
  EXPECT_THAT(read.point_data[0].component_names, ElementsAre("a", "b"));
  EXPECT_EQ(read.point_data[0].values, written.point_data[0].values);
  ASSERT_EQ(read.cell_data.size(), 1U);
  EXPECT_EQ(read.cell_data[0].name, "a < \"b\" & c");
  EXPECT_EQ(read.cell_data[0].values, written.cell_data[0].values);
  EXPECT_EQ(to_vtu(read), to_vtu(written));
}

TEST(VtuReader, ReadsAnEmptyGrid) {
  UnstructuredGrid empty;
  empty.point_data.push_back({"force", 3, {}, std::vector<double>{}});
  EXPECT_EQ(to_vtu(from_vtu(to_vtu(empty))), to_vtu(empty));
}

// 4096 doubles fill one compressed block of 32768 bytes exactly.
TEST(VtuReader, ReadsSeveralCompressedBlocks) {
  for (const int count : {4095, 4096, 4097, 8192}) {
    UnstructuredGrid grid;
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
      grid.points.emplace_back(i, 0, 0);
      values.push_back(1.0 / (1 + i));
    }
    grid.point_data.push_back({"value", 1, {}, values});
    EXPECT_EQ(std::get<std::vector<double>>(from_vtu(to_vtu(grid)).point_data[0].values), values) << count;
  }
}

TEST(VtuReader, EveryCutIsNoticed) {
  const std::string whole = to_vtu(sample());
  const std::size_t data = whole.find("\n_") + 2;
  const std::size_t end = whole.find("\n  </AppendedData>");
  for (std::size_t size = 0; size < end; size += size < data ? 101 : 1)
    EXPECT_THROW((void)from_vtu(whole.substr(0, size)), std::runtime_error) << size;
}

TEST(VtuReader, DamageIsNoticed) {
  const std::string whole = to_vtu(sample());
  const std::size_t data = whole.find("\n_") + 2;
  // Block count, block size (the low bytes say nothing where there is one block), size of the last block,
  // packed size, first packed byte.
  for (const std::size_t place : {0, 7, 15, 16, 23, 24, 31, 32}) {
    std::string damaged = whole;
    damaged[data + place] = static_cast<char>(damaged[data + place] ^ 0x7f);
    EXPECT_THROW((void)from_vtu(damaged), std::runtime_error) << place;
  }
}

TEST(VtuReader, NamesTheFile) {
  const TemporaryFolder folder;
  write_text(folder / "x.vtu", "<html>");
  EXPECT_THAT([&] { (void)read_vtu(folder / "x.vtu"); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(StartsWith("cannot read " + (folder / "x.vtu").string()), HasSubstr("no frame"))));
  EXPECT_THAT([&] { (void)read_vtu(folder / "none.vtu"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot be opened")));
}

TEST(VtuReader, ReadsSeries) {
  const TemporaryFolder folder;
  {
    PvdWriter series(folder / "s.pvd");
    series.add_frame(0.0, "frames/a & b.vtu");
    series.add_frame(0.1 + 0.2, "frames/c.vtu");
  }
  const std::vector<PvdFrame> frames = read_pvd(folder / "s.pvd");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].file, "frames/a & b.vtu");
  EXPECT_EQ(frames[1].time, 0.1 + 0.2);
  EXPECT_EQ(frames[1].file, "frames/c.vtu");
}

}  // namespace
}  // namespace ashlar
