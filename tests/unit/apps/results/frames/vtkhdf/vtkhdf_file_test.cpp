// The file as other programs read it is tested in tests/vtk/read_vtkhdf.py.
#include "apps/results/frames/vtkhdf/vtkhdf_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "apps/results/frames/stored_frames.hpp"
#include "apps/results/frames/vtkhdf/vtkhdf_frames.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/results/frames/hdf5_contents.hpp"

namespace ashlar::vtkhdf_file_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

using Integers = std::vector<std::int64_t>;

const std::vector<std::string> names = {"A",
                                        "Bl\xC3\xB6"
                                        "ck"};

/// A triangle and its first corner, moved along x.
UnstructuredGrid moved_triangle(double x) {
  UnstructuredGrid grid;
  grid.points = {{x, 0, 0}, {1 + x, 0, 0}, {x, 1, 0}};
  grid.add_cell(VtkCellType::triangle, std::array{0, 1, 2});
  grid.add_cell(VtkCellType::vertex, std::array{0});
  grid.point_data.push_back({"velocity", 3, {}, std::vector<double>{1, x, -0.0, 4, 5, 6, 7, 8, 9}});
  grid.cell_data.push_back({"block", 1, {}, std::vector<std::int32_t>{0, 1}});
  return grid;
}

/// So many vertices with a field of numbers.
UnstructuredGrid vertices(int count, double first) {
  UnstructuredGrid grid;
  std::vector<double> gaps;
  for (int k = 0; k < count; ++k) {
    grid.points.emplace_back(k, first, 0);
    grid.add_cell(VtkCellType::vertex, std::array{k});
    gaps.push_back(first + k);
  }
  grid.point_data.push_back({"gap", 1, {}, std::move(gaps)});
  return grid;
}

struct VtkhdfFile : ::testing::Test {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "a.vtkhdf";

  [[nodiscard]] Integers integers(const std::string& table) const {
    const Hdf5File file(path, Hdf5File::Access::read);
    return file.read<std::int64_t>("/VTKHDF/" + table, 0, file.table("/VTKHDF/" + table).rows);
  }
  static void append(const std::filesystem::path& to, int step, const UnstructuredGrid& blocks,
                     const UnstructuredGrid& contacts) {
    append_vtkhdf(to, {0.25 * step, step},
                  std::vector<SeriesGrid>{{"blocks", blocks}, {"contacts", contacts}}, names);
  }
  void create() const { create_vtkhdf(path, std::vector<std::string>{"blocks", "contacts"}); }
};

TEST_F(VtkhdfFile, WhatIsAppendedIsReadBackBitForBit) {
  create();
  const double tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<std::pair<UnstructuredGrid, UnstructuredGrid>> frames = {
      {moved_triangle(0), vertices(0, 0)},
      {moved_triangle(std::nan("")), vertices(70, tiny)},
      {moved_triangle(2), vertices(3, 0.1)},
      {moved_triangle(2), vertices(0, 0)},
      {moved_triangle(2), vertices(70, tiny)}};
  for (std::size_t k = 0; k < frames.size(); ++k)
    append(path, static_cast<int>(3 * k), frames[k].first, frames[k].second);
  const VtkhdfReader reader(path);
  ASSERT_EQ(reader.frames().size(), 5U);
  EXPECT_EQ(reader.frames()[4].step, 12);
  EXPECT_EQ(reader.frames()[4].time, 3.0);
  EXPECT_TRUE(reader.has("contacts"));
  EXPECT_FALSE(reader.has("bolts"));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (const auto& [series, grid] :
         {std::pair("blocks", frames[k].first), std::pair("contacts", frames[k].second)}) {
      UnstructuredGrid expected = grid;
      expected.time = reader.frames()[k].time;
      expected.block_names = names;
      EXPECT_TRUE(to_vtu(reader.read(series, k)) == to_vtu(expected)) << series << k;
    }
  }
}

TEST_F(VtkhdfFile, SinglePrecisionIsReadAsItWasRounded) {
  create();
  const auto rounded = [](UnstructuredGrid grid) {
    grid.stored_points = StoredReal::float32;
    grid.point_data[0].stored = StoredReal::float32;
    return grid;
  };
  UnstructuredGrid late = rounded(vertices(2, 0.1));
  late.point_data.push_back({"late", 1, {}, std::vector<double>{0.3, 1e99}, StoredReal::float32});
  append(path, 0, moved_triangle(0.1), rounded(vertices(2, 0.1)));
  append(path, 1, moved_triangle(0.1), rounded(vertices(2, 0.1 + 1e-12)));
  append(path, 2, moved_triangle(0.1), late);
  EXPECT_THAT(integers("contacts/Steps/PointOffsets"), ElementsAre(0, 0, 0)) << "equal when rounded";
  EXPECT_EQ(VtkhdfReader(path).read("blocks", 2).points[0].x(), 0.1);
  const UnstructuredGrid grid = VtkhdfReader(path).read("contacts", 2);
  EXPECT_EQ(grid.stored_points, StoredReal::float32);
  EXPECT_EQ(grid.points[1].y(), 0.1F);
  EXPECT_EQ(std::get<std::vector<double>>(grid.point_data[0].values)[1], 1.1F);
  EXPECT_EQ(std::get<std::vector<double>>(grid.point_data[1].values),
            (std::vector<double>{0.3F, std::numeric_limits<float>::max()}));
  const UnstructuredGrid before = VtkhdfReader(path).read("contacts", 0);
  EXPECT_TRUE(std::isnan(std::get<std::vector<double>>(before.point_data[1].values)[0]));
  cut_vtkhdf(path, 1);
  append(path, 1, moved_triangle(0.1), rounded(vertices(2, 0.1 + 1e-12)));
  append(path, 2, moved_triangle(0.1), late);
  EXPECT_EQ(to_vtu(VtkhdfReader(path).read("contacts", 2)), to_vtu(grid));
}

// Points of the blocks begin with a chunk of 64 rows each, unless they are those of the frame before.
TEST_F(VtkhdfFile, WhatDoesNotChangeIsStoredOnce) {
  create();
  for (const double x : {0.0, 1.0, 1.0}) append(path, 0, moved_triangle(x), vertices(1, x));
  EXPECT_THAT(integers("blocks/NumberOfPoints"), ElementsAre(3));
  EXPECT_THAT(integers("blocks/NumberOfCells"), ElementsAre(2));
  EXPECT_THAT(integers("blocks/NumberOfConnectivityIds"), ElementsAre(4));
  EXPECT_THAT(integers("blocks/Connectivity"), ElementsAre(0, 1, 2, 0));
  EXPECT_THAT(integers("blocks/Offsets"), ElementsAre(0, 3, 4));
  EXPECT_THAT(integers("blocks/Steps/PartOffsets"), ElementsAre(0, 0, 0));
  EXPECT_THAT(integers("blocks/Steps/PointOffsets"), ElementsAre(0, 64, 64));
  EXPECT_THAT(integers("blocks/Steps/CellOffsets"), ElementsAre(0, 0, 0));
  EXPECT_THAT(integers("blocks/Steps/CellDataOffsets/block"), ElementsAre(0, 0, 0));
  EXPECT_THAT(integers("blocks/Steps/PointDataOffsets/velocity"), ElementsAre(0, 64, 64));
  EXPECT_THAT(integers("contacts/Steps/FieldDataOffsets/block_names"), ElementsAre(0, 0, 0));
  EXPECT_THAT(integers("contacts/Steps/FieldDataSizes/block_names"), ElementsAre(1, 2, 1, 2, 1, 2));
}

// Each part of Offsets has one entry more than cells.
TEST_F(VtkhdfFile, ChangedCellsAreAnotherPart) {
  create();
  for (const int count : {1, 0, 2}) append(path, 0, moved_triangle(0), vertices(count, 0));
  EXPECT_THAT(integers("contacts/NumberOfCells"), ElementsAre(1, 0, 2));
  EXPECT_THAT(integers("contacts/Steps/PartOffsets"), ElementsAre(0, 1, 2));
  EXPECT_THAT(integers("contacts/Steps/CellOffsets"), ElementsAre(0, 1, 64));
  const Integers offsets = integers("contacts/Offsets");
  ASSERT_EQ(offsets.size(), 64U + 2 + 3);
  EXPECT_EQ(Integers(offsets.begin(), offsets.begin() + 3), (Integers{0, 1, 0}));
  EXPECT_EQ(Integers(offsets.end() - 3, offsets.end()), (Integers{0, 1, 2}));
}

TEST_F(VtkhdfFile, AFieldThatAFrameLacksIsNoNumberThere) {
  create();
  UnstructuredGrid with_water = vertices(2, 0);
  with_water.point_data.push_back({"water", 1, {}, std::vector<double>{5, 6}});
  append(path, 0, moved_triangle(0), vertices(1, 0));
  append(path, 1, moved_triangle(0), with_water);
  append(path, 2, moved_triangle(0), vertices(3, 0));
  const VtkhdfReader reader(path);
  const std::array<std::size_t, 3> sizes = {1, 2, 3};
  for (std::size_t k = 0; k < 3; ++k) {
    const UnstructuredGrid grid = reader.read("contacts", k);
    ASSERT_EQ(grid.point_data.size(), 2U);
    EXPECT_EQ(grid.point_data[1].name, "water");
    const auto& water = std::get<std::vector<double>>(grid.point_data[1].values);
    ASSERT_EQ(water.size(), sizes.at(k));
    for (std::size_t p = 0; p < water.size(); ++p) {
      if (k == 1)
        EXPECT_EQ(water[p], 5.0 + static_cast<double>(p));
      else
        EXPECT_TRUE(std::isnan(water[p]));
    }
  }
}

TEST_F(VtkhdfFile, CutAndAppendedAgainItIsTheSame) {
  const auto frame = [](const std::filesystem::path& to, int k) {
    UnstructuredGrid contacts = vertices((7 * k) % 5, k);
    if (k >= 3)
      contacts.point_data.push_back({"late", 1, {}, std::vector<double>(contacts.points.size(), k)});
    append(to, k, moved_triangle(k / 2), contacts);
  };
  create();
  for (int k = 0; k < 6; ++k) frame(path, k);
  for (const std::size_t kept : {0, 1, 2, 4, 6}) {
    const std::filesystem::path other = folder / ("cut" + std::to_string(kept));
    std::filesystem::copy_file(path, other);
    cut_vtkhdf(other, kept);
    EXPECT_EQ(VtkhdfReader(other).frames().size(), kept);
    for (int k = static_cast<int>(kept); k < 6; ++k) frame(other, k);
    EXPECT_EQ(hdf5_contents(other), hdf5_contents(path)) << kept;
  }
  EXPECT_THAT([&] { cut_vtkhdf(path, 7); },
              ThrowsMessage<std::runtime_error>(HasSubstr("6 frames, 7 were written")));
}

TEST_F(VtkhdfFile, FramesOfAnotherFileAreAppended) {
  const std::filesystem::path other = folder / "b.vtkhdf";
  create();
  create_vtkhdf(other, std::vector<std::string>{"blocks", "contacts"});
  for (int k = 0; k < 5; ++k) {
    UnstructuredGrid contacts = vertices((7 * k) % 5, k);
    if (k >= 2)
      contacts.point_data.push_back({"late", 1, {}, std::vector<double>(contacts.points.size(), k)});
    append(path, k, moved_triangle(k / 2), contacts);
    append_frames_of(path, other);
    EXPECT_EQ(hdf5_contents(other), hdf5_contents(path)) << k;
  }
  create_vtkhdf(other, std::vector<std::string>{"blocks"});
  EXPECT_THROW(append_frames_of(path, other), std::runtime_error);
}

TEST_F(VtkhdfFile, EqualFramesMakeEqualFiles) {
  for (const char* name : {"a.vtkhdf", "b.vtkhdf"}) {
    create_vtkhdf(folder / name, std::vector<std::string>{"blocks", "contacts"});
    for (int k = 0; k < 3; ++k) append(folder / name, k, moved_triangle(k), vertices(k, 0));
  }
  EXPECT_TRUE(read_text(folder / "a.vtkhdf") == read_text(folder / "b.vtkhdf"));
}

TEST_F(VtkhdfFile, FaultsNameTheFile) {
  EXPECT_THAT([&] { const VtkhdfReader reader(path); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot read " + path.string() + ": ")));
  write_text(path, "no HDF5");
  EXPECT_THAT([&] { const VtkhdfReader reader(path); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot read " + path.string() + ": ")));
  create();
  EXPECT_THROW(append_vtkhdf(path, {0, 0}, std::vector<SeriesGrid>{{"blocks", moved_triangle(0)}}, names),
               std::invalid_argument);
  EXPECT_THAT(
      [&] { create_vtkhdf(folder / "none/a.vtkhdf", names); },
      ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("none/a.vtkhdf"), HasSubstr("No such file"))));
}

// A file may claim more than it has: rows that were never written cost nothing.
TEST_F(VtkhdfFile, ClaimedRowsAreNotAllocated) {
  create();
  append(path, 0, moved_triangle(0), vertices(1, 0));
  {
    Hdf5File file(path, Hdf5File::Access::change);
    const std::int64_t most = std::int64_t{1} << 50;
    file.resize("/VTKHDF/contacts/Points", static_cast<std::uint64_t>(most));
    file.write<std::int64_t>("/VTKHDF/contacts/NumberOfPoints", 0, std::array{most});
    file.close();
  }
  EXPECT_THAT([&] { (void)VtkhdfReader(path).read("contacts", 0); },
              ThrowsMessage<std::runtime_error>(HasSubstr("larger than a file of this size can hold")));
}

TEST_F(VtkhdfFile, WhileFramesAreAddedTheFileIsComplete) {
  const std::vector<std::string> series = {"blocks"};
  {
    VtkhdfFrames frames(folder.path(), series);
    for (int k = 0; k < 4; ++k) {
      int checks = 0;
      frames.add({0.5 * k, k}, {{"blocks", moved_triangle(k)}}, names, [&] { ++checks; });
      EXPECT_EQ(checks, 1);
      frames.check_in_place();
      EXPECT_EQ(VtkhdfReader(folder / "results.vtkhdf").frames().size(), static_cast<std::size_t>(k) + 1);
    }
    const std::string before = read_text(folder / "results.vtkhdf");
    EXPECT_THROW(
        frames.add({2, 4}, {{"blocks", moved_triangle(4)}}, names, [] { throw std::runtime_error("full"); }),
        std::runtime_error);
    EXPECT_EQ(frames.frames().size(), 4U);
    EXPECT_TRUE(read_text(folder / "results.vtkhdf") == before);
    frames.add({2, 4}, {{"blocks", moved_triangle(4)}}, names, [] {});
    EXPECT_EQ(open_stored_frames(folder.path())->count("blocks"), 5U);
    write_text(folder / "results.vtkhdf", "changed");
    EXPECT_THAT([&] { frames.check_in_place(); },
                ThrowsMessage<std::runtime_error>(HasSubstr("changed by others")));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "results.vtkhdf.next"));
}

TEST_F(VtkhdfFile, GoingOnWithAFileRemovesLaterFramesAndTracesOfAKilledRun) {
  const auto add = [](VtkhdfFrames& frames, int from, int to) {
    for (int k = from; k < to; ++k) frames.add({0.5 * k, k}, {{"blocks", moved_triangle(k)}}, names, [] {});
  };
  std::filesystem::create_directory(folder / "straight");
  {
    VtkhdfFrames straight(folder / "straight", std::vector<std::string>{"blocks"});
    add(straight, 0, 6);
    VtkhdfFrames frames(folder.path(), std::vector<std::string>{"blocks"});
    add(frames, 0, 4);
  }
  write_text(folder / "results.vtkhdf.next", "half");
  write_text(folder / "results.vtkhdf.old", "half");
  VtkhdfFrames frames(folder.path(), std::vector<FrameTime>{{0, 0}, {0.5, 1}});
  EXPECT_EQ(VtkhdfReader(folder / "results.vtkhdf").frames().size(), 2U);
  add(frames, 2, 6);
  EXPECT_EQ(hdf5_contents(folder / "results.vtkhdf"), hdf5_contents(folder / "straight/results.vtkhdf"));
  EXPECT_FALSE(std::filesystem::exists(folder / "results.vtkhdf.old"));
}

}  // namespace
}  // namespace ashlar::vtkhdf_file_test
