// The register of the fields of frames against the frames of runs that have all of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "apps/results/columns/frame_columns.hpp"
#include "apps/results/frames/stored_frames.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::frame_fields_test {
namespace {

using Fields = std::map<std::string, std::set<std::string>>;  ///< by series

class FrameFields : public RunCommand {
 protected:
  /// Adds the fields of the frames of a run.
  void add_fields(const std::string& out, Fields& fields) const {
    const std::unique_ptr<StoredFrames> frames = open_stored_frames(folder_ / out);
    for (const char* series : {"blocks", "surfaces", "contacts", "joints", "bolts", "loads"}) {
      if (!frames->has(series)) continue;
      const UnstructuredGrid grid = frames->read(series, frames->count(series) - 1);
      for (const std::vector<DataArray>* arrays : {&grid.point_data, &grid.cell_data})
        for (const DataArray& array : *arrays)
          // Surfaces beside blocks as volumes have the fields that blocks have otherwise.
          fields[std::string(series) == "surfaces" ? "blocks" : series].insert(array.name);
    }
  }
};

TEST_F(FrameFields, AreThoseOfTheRegister) {
  // A block that is bolted and bonded to the ground, under water and a load.
  write_text(scene_, R"(
analysis = { type = "static" }
contact = { friction_angle = 30, cohesion = 1e5, tensile_strength = 1e4, fracture_energy = { tension = 10, shear = 10 } }
output = { fields = ["displacement", "velocity", "stress", "principal_stress"] }
material = [{ name = "rock", density = 2000, young_modulus = 1e10, poisson_ratio = 0.2 }]
bolt = [{ name = "bar", from = [0.5, 0.5, 0.8], to = [0.5, 0.5, -0.8], area = 1e-4, bond_stiffness = 1e8 }]
water = [{ name = "lake", unit_weight = 9810, level = { point = [0, 0, 0.5], normal = [0, 0, 1] }, joints = ["*"] }]
[[block]]
name = "ground"
fixed = true
box = { min = [-2, -2, -1], max = [3, 3, 0] }
[[block]]
name = "stone"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
load = [{ plane = { point = [0, 0, 1], normal = [0, 0, 1] }, traction = [0, 0, -1e3] }]
)");
  Fields found;
  for (const char* solid : {"false", "true"}) {
    ASSERT_EQ(run(solid, {"--set", std::string("output.solid=") + solid}), exit_status::done) << faults_;
    add_fields(solid, found);
  }
  Fields declared;
  for (const FrameField& field : frame_fields()) declared[field.series].insert(field.name);
  EXPECT_EQ(found, declared);
}

}  // namespace
}  // namespace ashlar::frame_fields_test
