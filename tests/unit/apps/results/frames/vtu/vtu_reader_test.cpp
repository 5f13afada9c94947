#include "apps/results/frames/vtu/vtu_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "support/temporary_folder.hpp"

namespace ashlar::vtu_reader_test {
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

TEST(VtuReader, ReadsTheNamesOfBlocks) {
  UnstructuredGrid grid = sample();
  grid.time = 0.5;
  grid.block_names = {"a < b & c", "", "K\u00e4mpfer 1"};
  const std::string frame = to_vtu(grid);
  EXPECT_EQ(from_vtu(frame).block_names, grid.block_names);
  const auto with = [&](const std::string& old, const std::string& other) {
    std::string text = frame;
    text.replace(text.find(old), old.size(), other);
    return text;
  };
  const std::string count = "\"block_names\" NumberOfTuples=\"3\"";
  for (const std::string& damaged :
       {with(count, "\"block_names\" NumberOfTuples=\"4\""),
        with(count, "\"block_names\" NumberOfTuples=\"2\""), with("97 32 60", "97 x 60"),
        with("97 32 60", "97 256 60"), with(" 99 0\n", " 99\n")})
    EXPECT_THROW((void)from_vtu(damaged), std::runtime_error);
}

TEST(VtuReader, ReadsAnEmptyGrid) {
  UnstructuredGrid empty;
  empty.point_data.push_back({"force", 3, {}, std::vector<double>{}});
  EXPECT_EQ(to_vtu(from_vtu(to_vtu(empty))), to_vtu(empty));
}

TEST(VtuReader, SinglePrecisionIsReadAsItWasRounded) {
  UnstructuredGrid grid = sample();
  grid.stored_points = StoredReal::float32;
  grid.point_data[0].stored = StoredReal::float32;
  const std::string bytes = to_vtu(grid);
  EXPECT_THAT(bytes,
              AllOf(HasSubstr("type=\"Float32\" Name=\"v\""), HasSubstr("type=\"Float32\" Name=\"Points\"")));
  const UnstructuredGrid read = from_vtu(bytes);
  for (std::size_t k = 0; k < grid.points.size(); ++k)
    for (int i = 0; i < 3; ++i) EXPECT_EQ(read.points[k][i], to_float32(grid.points[k][i]));
  EXPECT_THAT(std::get<std::vector<double>>(read.point_data[0].values),
              ElementsAre(1, 2, 3, 4, 5, 0, 0.1F, 8, 9, 0));
  EXPECT_EQ(to_vtu(read), bytes);
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
  // Block count, block size (without meaning in the low bytes for a single block), size of the last block,
  // packed size, first packed byte.
  for (const std::size_t place : {0, 7, 15, 16, 23, 24, 31, 32}) {
    std::string damaged = whole;
    damaged[data + place] = static_cast<char>(damaged[data + place] ^ 0x7f);
    EXPECT_THROW((void)from_vtu(damaged), std::runtime_error) << place;
  }
}

std::string replaced(std::string text, const std::string& old, const std::string& other) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), other);
}

auto refused_with(const std::string& what) {
  return ThrowsMessage<std::runtime_error>(HasSubstr(what));
}

std::string uint64(std::uint64_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// A frame with one array of integers on its cells whose bytes in the file are given.
std::string frame_of(const std::string& cells, const std::string& components, const std::string& data) {
  return "<VTKFile type=\"UnstructuredGrid\">\n<Piece NumberOfPoints=\"0\" NumberOfCells=\"" + cells +
         "\">\n<CellData>\n<DataArray type=\"Int32\" Name=\"block\" NumberOfComponents=\"" + components +
         "\" offset=\"0\"/>\n<AppendedData encoding=\"raw\">\n_" + data;
}

TEST(VtuReader, CountsThatWrapRoundAreRefused) {
  // 3 x 6148914691236517206 doubles are 2 doubles modulo 2^64.
  const std::string frame = to_vtu(sample());
  EXPECT_THAT([&] { (void)from_vtu(replaced(frame, "Points=\"5\"", "Points=\"6148914691236517206\"")); },
              refused_with("an array of 80 bytes for 6148914691236517206 x 2 values"));
  EXPECT_THAT(
      [&] { (void)from_vtu(frame_of("4611686018427387904", "4", uint64(0) + uint64(32768) + uint64(0))); },
      refused_with("an array of 0 bytes"));
}

TEST(VtuReader, NumbersOfComponentsAreHeldAgainstTheLargest) {
  const std::string empty = uint64(0) + uint64(32768) + uint64(0);
  for (const std::string components : {"2147483647", "10", "0", "-1"}) {
    EXPECT_THAT([&] { (void)from_vtu(frame_of("0", components, empty)); },
                refused_with("array 'block' of " + components + " components, 1 to 9 are allowed"));
  }
}

TEST(VtuReader, BlocksThatClaimMoreThanZlibCanGiveAreRefused) {
  // 100 blocks of 16 MiB, from 20 bytes each.
  std::string data = uint64(100) + uint64(1 << 24) + uint64(0);
  for (int k = 0; k < 100; ++k) data += uint64(20);
  data += std::string(2000, 'x');
  EXPECT_THAT([&] { (void)from_vtu(frame_of("419430400", "1", data)); },
              refused_with("a damaged array header"));
}

TEST(VtuReader, ArraysTogetherAreHeldAgainstTheFile) {
  // 100 MiB of zeros in blocks of 32768, each in 52 bytes at the highest effort: valid, but no frame.
  constexpr std::size_t blocks = 3200;
  const std::string zeros(32768, '\0');
  std::string packed(compressBound(zeros.size()), '\0');
  uLongf size = packed.size();
  ASSERT_EQ(compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                      reinterpret_cast<const Bytef*>(zeros.data()), zeros.size(), Z_BEST_COMPRESSION),
            Z_OK);
  std::string data = uint64(blocks) + uint64(zeros.size()) + uint64(0);
  for (std::size_t k = 0; k < blocks; ++k) data += uint64(size);
  for (std::size_t k = 0; k < blocks; ++k) data.append(packed, 0, size);
  const std::string cells = std::to_string(blocks * zeros.size() / 4);
  EXPECT_THAT([&] { (void)from_vtu(frame_of(cells, "1", data)); },
              refused_with("larger than a file of this size"));
}

TEST(VtuReader, NoFrameOfZerosAloneIsHeldBack) {
  UnstructuredGrid grid;
  constexpr std::size_t count = 1'000'000;
  grid.points.assign(count, Vector3::Zero());
  grid.point_data.push_back({"stress", 9, {}, std::vector<double>(9 * count)});
  EXPECT_EQ(from_vtu(to_vtu(grid)).points.size(), count);
}

TEST(VtuReader, ArraysMayNotShareBytes) {
  const std::string frame = to_vtu(sample());
  const std::size_t points = frame.find("<DataArray", frame.find("<Points>"));
  const std::string again = frame.substr(points, frame.find("/>", points) + 2 - points);
  EXPECT_THAT([&] { (void)from_vtu(replaced(frame, again, again + "\n" + again)); },
              refused_with("arrays overlap"));
}

TEST(VtuReader, TypesAreHeldAgainstTheGrid) {
  const std::string frame = to_vtu(sample());
  EXPECT_THAT([&] { (void)from_vtu(replaced(frame, "Float64\" Name=\"v\"", "Float16\" Name=\"v\"")); },
              refused_with("array 'v' of type Float16, Float64, Float32 or Int32 is needed"));
  for (const std::string name : {"Points", "connectivity", "offsets", "types"}) {
    const std::string attribute = "\" Name=\"" + name + "\"";
    const std::size_t end = frame.find(attribute);
    ASSERT_NE(end, std::string::npos);
    std::string other = frame;
    other.replace(end - 1, 1, "7");
    EXPECT_THAT([&] { (void)from_vtu(other); }, refused_with(" of type ")) << name;
  }
}

TEST(VtuReader, AFrameHasOnePiece) {
  const std::string frame = to_vtu(sample());
  EXPECT_THAT([&] { (void)from_vtu(replaced(frame, "<PointData>\n", "<PointData>\n<Piece >\n")); },
              refused_with("more than one piece"));
}

TEST(VtuReader, DevicesAndFoldersAreNoFrames) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { (void)read_vtu(folder.path()); }, refused_with("not a regular file"));
  EXPECT_THAT([&] { (void)read_pvd("/dev/zero"); }, refused_with("not a regular file"));
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

TEST(VtuReader, ASeriesThatIsCutOrHasNoTimesIsRefused) {
  const std::string start = "<VTKFile type=\"Collection\">";
  EXPECT_THAT([&] { (void)from_pvd(start + "<DataSet timestep=\"0\" file=\"a\""); }, refused_with("is cut"));
  EXPECT_THAT([&] { (void)from_pvd(start + "<DataSet timestep=\"nan\" file=\"a\"/>"); },
              refused_with("a frame at time nan"));
  EXPECT_THAT([&] { (void)from_pvd(start + "<DataSet timestep=\"0\"/><DataSet file=\"a\"/>"); },
              refused_with("no file"));
}

}  // namespace
}  // namespace ashlar::vtu_reader_test
