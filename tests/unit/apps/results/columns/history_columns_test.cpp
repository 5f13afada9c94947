#include "apps/results/columns/history_columns.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "apps/results/columns/contact_columns.hpp"
#include "apps/results/columns/frame_columns.hpp"
#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"

namespace ashlar::history_columns_test {
namespace {

/// A cube that moves at (3, 0, -4) m/s over a floor far below, and a measure of each kind.
BuiltSimulation flying_cube() {
  Diagnostics faults;
  const auto loaded = load_scene_text(R"(
analysis = { end_time = 1, time_step = 0.01, gravity = [0, 0, -10] }
contact = { friction_angle = 30 }
material = [{ name = "rock", density = 2000, young_modulus = 1e10, poisson_ratio = 0.2 }]
block = [
  { name = "floor", fixed = true, box = { min = [-9, -9, -91], max = [9, 9, -90] } },
  { name = "energy", material = "rock", order = 0, box = { min = [0, 0, 0], max = [1, 1, 1] }, velocity = [3, 0, -4] },
]
measure = [
  { name = "energy", block = "energy" },
  { name = "corner", block = "energy", point = [1, 1, 1] },
  { name = "energy.pier", pair = ["floor", "energy"] },
]
)",
                                      "scene.toml", {}, faults);
  return *build_simulation(*loaded, 1, faults, nullptr);
}

std::vector<Measure> measures_of_cube(const BuiltSimulation& built) {
  std::vector<Measure> measures;
  measures.push_back({.name = "energy", .kind = Measure::Kind::block, .block = 1});
  measures.back().point = built.simulation.blocks()[1].basis().centroid();
  measures.push_back({.name = "corner", .kind = Measure::Kind::point, .block = 1, .point = {1, 1, 1}});
  measures.push_back({.name = "energy.pier", .kind = Measure::Kind::pair, .block = 0});
  measures.back().other = 1;
  return measures;
}

TEST(HistoryColumns, ARowHasTheValuesOfItsColumns) {
  BuiltSimulation built = flying_cube();
  const std::vector<Measure> measures = measures_of_cube(built);
  const std::vector<Column> columns = history_columns(measures, true);
  // The first column, the step, is written apart.
  const std::vector<double> row = history_row(built.simulation, measures, {}, 2);
  ASSERT_EQ(row.size() + 1, columns.size());
  const auto value = [&](const std::string& name) {
    for (std::size_t k = 1; k < columns.size(); ++k)
      if (columns[k].name == name) return row[k - 1];
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_EQ(value("corner.x"), 1.0);
  EXPECT_EQ(value("energy.vz"), -4.0);
  EXPECT_EQ(value("corner.speed"), 5.0);
  EXPECT_NEAR(value("energy.kinetic_energy"), 0.5 * 2000 * 25, 1e-9);
  EXPECT_EQ(value("energy.runout"), 0.0);
  EXPECT_EQ(value("energy.pier.normal_force"), 0.0);
  EXPECT_EQ(value("stage"), 2.0);
  ASSERT_EQ(built.simulation.step(1.0), StepStatus::accepted);
  const std::vector<double> after = history_row(built.simulation, measures);
  // Along x at 3 m/s for 0.01 s; the fall is no runout.
  for (std::size_t k = 1; k + 1 < columns.size(); ++k)
    if (columns[k].name == "energy.runout") {
      EXPECT_NEAR(after[k - 1], 0.03, 1e-12);
    }
}

TEST(HistoryColumns, UnitsDoNotDependOnNamesOfMeasures) {
  BuiltSimulation built = flying_cube();
  const auto about = nlohmann::json::parse(column_units(history_columns(measures_of_cube(built), false)));
  EXPECT_EQ(about["energy.pier.normal_force"]["unit"], "N");
  EXPECT_EQ(about["energy.pier.normal_force"]["measure"], "energy.pier");
  EXPECT_EQ(about["energy.kinetic"]["unit"], "J");
  EXPECT_EQ(about["energy.kinetic"]["measure"], "");
  EXPECT_EQ(about["energy.kinetic_energy"]["measure"], "energy");
  EXPECT_EQ(about["energy.rx"]["unit"], "degrees");
  EXPECT_EQ(about["corner.sxy"]["group"], "stress");
  EXPECT_FALSE(about.contains("corner.rx"));
}

TEST(HistoryColumns, EachHasAUnitAndAMeaning) {
  std::vector<Column> all = contact_columns();
  for (const MeasureColumns& kind : columns_by_kind())
    all.insert(all.end(), kind.columns.begin(), kind.columns.end());
  for (const Column& column : all) {
    EXPECT_EQ(column.unit.empty(), column.name.starts_with("block_")) << column.name;
    EXPECT_FALSE(column.meaning.empty()) << column.name;
  }
  std::set<std::pair<std::string, std::string>> fields;
  for (const FrameField& field : frame_fields())
    EXPECT_TRUE(fields.insert({field.series, field.name}).second) << field.series << ' ' << field.name;
}

TEST(HistoryColumns, FormerNamesAreRead) {
  EXPECT_EQ(present_name("energy.refound_lost"), "energy.redetection_lost");
  EXPECT_EQ(present_name("energy.kinetic"), "energy.kinetic");
}

}  // namespace
}  // namespace ashlar::history_columns_test
