// Writes the files that read_samples.py reads back; the numbers follow from formulas that both know.
// Use: write_samples FOLDER
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "apps/results/folder/result_folder.hpp"
#include "apps/results/frames/vtkhdf/vtkhdf_file.hpp"
#include "apps/results/frames/vtu/pvd_writer.hpp"
#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "geometry/index.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar {
namespace {

// Two triangles, a pentagon and a lone point on eight points; every kind of array.
UnstructuredGrid mixed_grid() {
  UnstructuredGrid grid;
  for (int i = 0; i < 8; ++i) grid.points.emplace_back(i + 0.1, -2.0 * i, i / 3.0);
  grid.add_cell(VtkCellType::triangle, std::array{0, 1, 2});
  grid.add_cell(VtkCellType::triangle, std::array{2, 1, 3});
  grid.add_cell(VtkCellType::polygon, std::array{1, 3, 4, 5, 6});
  grid.add_cell(VtkCellType::vertex, std::array{7});

  std::vector<double> vectors;
  std::vector<double> tensors;
  std::vector<double> full_tensors;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) vectors.push_back(std::sqrt(i + 10.0 * k));
    for (int k = 0; k < 6; ++k) tensors.push_back(1e6 * i - k / 7.0);
    for (int k = 0; k < 9; ++k) full_tensors.push_back(100.0 * i + k);
  }
  grid.point_data.push_back({"displacement", 3, {"x", "y", "z"}, vectors});
  grid.point_data.push_back({"stress", 6, {"xx", "yy", "zz", "xy", "yz", "xz"}, tensors});
  grid.point_data.push_back({"gradient", 9, {}, full_tensors});
  const double infinity = std::numeric_limits<double>::infinity();
  const double tiny = std::numeric_limits<double>::denorm_min();
  grid.cell_data.push_back({"a < b & \"c\"", 1, {}, std::vector<double>{-0.0, tiny, infinity, 0.1 + 0.2}});
  grid.cell_data.push_back({"block", 1, {}, std::vector<std::int32_t>{-1, 0, 2147483647, -2147483647 - 1}});
  grid.time = 0.1 + 0.2;
  grid.block_names = {"a < b & c", "", "K\u00e4mpfer 1"};
  return grid;
}

// Arrays of several compressed blocks (32768 bytes each): 4096 tuples fill blocks exactly, one more does not.
UnstructuredGrid many_points(int count) {
  UnstructuredGrid grid;
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    grid.points.emplace_back(i, std::sin(i), 1.0 / (i + 1));
    grid.add_cell(VtkCellType::vertex, std::array{i});
    values.push_back(std::sqrt(i));
  }
  grid.point_data.push_back({"value", 1, {}, values});
  return grid;
}

/// The same in single precision.
UnstructuredGrid rounded_points(int count) {
  UnstructuredGrid grid = many_points(count);
  grid.stored_points = StoredReal::float32;
  grid.point_data[0].stored = StoredReal::float32;
  return grid;
}

UnstructuredGrid empty_grid() {
  UnstructuredGrid grid;
  grid.point_data.push_back({"force", 3, {}, std::vector<double>{}});
  grid.cell_data.push_back({"state", 1, {}, std::vector<std::int32_t>{}});
  return grid;
}

using Field = std::function<Vector3(const Vector3&)>;

// The field of a polynomial that the block's order holds, through its values at 13^3 points.
Eigen::MatrixX3d coefficients(const BlockModel& block, const Field& field) {
  std::vector<Vector3> points;
  points.reserve(13 * 13 * 13);
  for (int k = 0; k < 13; ++k)
    for (int j = 0; j < 13; ++j)
      for (int i = 0; i < 13; ++i) points.emplace_back(i / 6.0, j / 12.0, k / 12.0);
  Eigen::MatrixX3d values(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    values.row(static_cast<Eigen::Index>(i)) = field(points[i]).transpose();
  return block.basis().values(points).colPivHouseholderQr().solve(values);
}

BlockModel make_block(const TriangleMesh& mesh, int order) {
  BlockDefinition definition;
  definition.solid = std::make_shared<const Polyhedron>(mesh);
  definition.material = {.density = 1000.0, .young_modulus = 1e9, .poisson_ratio = 0.25};
  definition.order = order;
  return BlockModel(definition);
}

// A bar 2 x 1 x 1 bent to  (x, y + x z / 4, z + (x / 2)^n / 2 + x^2 / 16), moving with (z^2, 0, x).
UnstructuredGrid curved_grid(int order, bool solid) {
  const std::vector<BlockModel> blocks = {make_block(make_box({0, 0, 0}, {2, 1, 1}), order)};
  const Field place = [order](const Vector3& p) {
    const double x = p.x();
    return Vector3(x, p.y() + x * p.z() / 4.0, p.z() + std::pow(x / 2.0, order) / 2.0 + x * x / 16.0);
  };
  const Field velocity = [](const Vector3& p) { return Vector3(p.z() * p.z(), 0.0, p.x()); };
  const BlockState state = {coefficients(blocks[0], place), coefficients(blocks[0], velocity)};
  return solid ? solid_frame(blocks, {state}, drawn_solids(blocks, true), {})
               : block_frame(blocks, {state}, drawn_surfaces(blocks, true), {});
}

// A box, a frame with a hole of 1 x 1 m beside it, and a bar of order 3, as they were placed.
UnstructuredGrid solid_grid() {
  TriangleMesh frame = test_support::make_frame();
  for (Vector3& point : frame.points) point.x() += 4.0;
  const std::vector<BlockModel> blocks = {make_block(make_box({0, 0, 0}, {2, 1, 1}), 1), make_block(frame, 1),
                                          make_block(make_box({0, 5, 0}, {2, 6, 1}), 3)};
  std::vector<BlockState> states;
  for (const BlockModel& block : blocks) states.push_back(block.initial_state());
  SceneOutput::Fields fields;
  fields.principal_stress = true;
  return solid_frame(blocks, states, drawn_solids(blocks, false), fields);
}

// The samples above as three frames of a file, see FRAMES of read_vtkhdf.py.
void write_frames(const std::filesystem::path& path) {
  create_vtkhdf(path, std::vector<std::string>{"mixed", "curved", "points", "rounded"});
  const std::vector<std::string> names = mixed_grid().block_names;
  UnstructuredGrid none;
  none.point_data.push_back({"value", 1, {}, std::vector<double>{}});
  const std::array points = {none, many_points(4096), many_points(4097)};
  const std::array orders = {2, 3, 5};
  for (int k = 0; k < 3; ++k) {
    append_vtkhdf(path, {0.1 * k, 10 * k},
                  std::vector<SeriesGrid>{{"mixed", mixed_grid()},
                                          {"curved", curved_grid(orders.at(at(k)), false)},
                                          {"points", points.at(at(k))},
                                          {"rounded", rounded_points(100)}},
                  names);
  }
}

void write_samples(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "frames");
  write_vtu(folder / "frames/mixed.vtu", mixed_grid());
  write_vtu(folder / "frames/empty.vtu", empty_grid());
  write_vtu(folder / "frames/points_4096.vtu", many_points(4096));
  write_vtu(folder / "frames/points_4097.vtu", many_points(4097));
  write_vtu(folder / "frames/rounded.vtu", rounded_points(100));
  for (const int order : {2, 3, 5, 8, 12})
    for (const bool solid : {false, true})
      write_vtu(folder / ((solid ? "frames/solid_" : "frames/curved_") + std::to_string(order) + ".vtu"),
                curved_grid(order, solid));
  write_vtu(folder / "frames/solids.vtu", solid_grid());
  PvdWriter series(folder / "samples.pvd");
  series.add_frame(0.0, "frames/empty.vtu");
  series.add_frame(0.1 + 0.2, "frames/mixed.vtu");
  write_frames(folder / "samples.vtkhdf");
}

}  // namespace
}  // namespace ashlar

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::cerr << "use: write_samples FOLDER\n";
    return 2;
  }
  try {
    ashlar::write_samples(arguments[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
