#include "apps/results/frames/frame_precision.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "geometry/solid/shapes.hpp"

namespace ashlar::frame_precision_test {
namespace {

/// A cube of 1 m up to that x.
BlockModel cube_up_to(double x, Formulation formulation = Formulation::total) {
  BlockDefinition definition;
  definition.solid = std::make_shared<const Polyhedron>(make_box({x - 1, 0, 0}, {x, 1, 1}));
  definition.material = {.density = 1000.0, .young_modulus = 1e9, .poisson_ratio = 0.25};
  definition.order = 1;
  definition.formulation = formulation;
  return BlockModel(definition);
}

FramePrecision with_blocks(std::vector<BlockModel> blocks) {
  SceneOutput output;
  output.precision = SceneOutput::Precision::of_single;
  return frame_precision(output, blocks);
}

// A number of single precision is within 2^-24 of the true one: 1e-4 m at 1e-4 * 2^24 = 1677.7 m.
TEST(FramePrecision, PlacesAreDoubleFarFromTheOrigin) {
  EXPECT_EQ(with_blocks({cube_up_to(1677.0)}).fields, StoredReal::float32);
  EXPECT_EQ(with_blocks({cube_up_to(1677.0)}).places, StoredReal::float32);
  EXPECT_EQ(with_blocks({cube_up_to(1678.0)}).fields, StoredReal::float32);
  EXPECT_EQ(with_blocks({cube_up_to(1678.0)}).places, StoredReal::float64);
  EXPECT_EQ(with_blocks({cube_up_to(0.0), cube_up_to(-1677.0)}).places, StoredReal::float64) << "to -1678";
}

TEST(FramePrecision, PlacesOfIncrementalBlocksAreDouble) {
  EXPECT_EQ(with_blocks({cube_up_to(1.0), cube_up_to(3.0, Formulation::incremental)}).places,
            StoredReal::float64);
}

TEST(FramePrecision, DependsOnTheFormatUnlessItIsGiven) {
  SceneOutput output;
  EXPECT_EQ(frame_precision(output, {cube_up_to(1.0)}).fields, StoredReal::float64);
  EXPECT_EQ(frame_precision(output, {cube_up_to(1.0)}).places, StoredReal::float64);
  output.format = SceneOutput::Format::vtkhdf;
  EXPECT_EQ(frame_precision(output, {cube_up_to(1.0)}).fields, StoredReal::float32);
}

TEST(FramePrecision, IsDoubleOnRequest) {
  SceneOutput output;
  output.precision = SceneOutput::Precision::of_double;
  const FramePrecision precision = frame_precision(output, {cube_up_to(1.0)});
  EXPECT_EQ(precision.fields, StoredReal::float64);
  EXPECT_EQ(precision.places, StoredReal::float64);
}

TEST(FramePrecision, PlacesOfBlocksAreDoubleAlways) {
  const FramePrecision precision{StoredReal::float32, StoredReal::float32};
  for (const char* series : {"blocks", "surfaces", "contacts", "joints"}) {
    UnstructuredGrid grid;
    grid.point_data.push_back({"velocity", 3, {}, std::vector<double>{}});
    grid.cell_data.push_back({"area", 1, {}, std::vector<double>{}});
    set_precision(grid, series, precision);
    const bool of_blocks = std::string(series) == "blocks" || std::string(series) == "surfaces";
    EXPECT_EQ(grid.stored_points, of_blocks ? StoredReal::float64 : StoredReal::float32) << series;
    EXPECT_EQ(grid.point_data[0].stored, StoredReal::float32);
    EXPECT_EQ(grid.cell_data[0].stored, StoredReal::float32);
  }
}

}  // namespace
}  // namespace ashlar::frame_precision_test
