#include "apps/scene/json/scene_json.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_json_test {
namespace {

nlohmann::json json_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, "s.toml", overrides, diagnostics);
  EXPECT_THAT(printed(diagnostics), ::testing::IsEmpty());
  return to_json(scene);
}

TEST(SceneJson, HoldsTheSceneAsUsedWithDefaultsAndOverrides) {
  EXPECT_EQ(json_of(sample(), {"block.B.order=4"}), nlohmann::json::parse(R"({
    "title": "",
    "analysis": {"type": "dynamic", "end_time": 1.0, "time_step": 0.01, "integrator": "dda", "spectral_radius": 0.8,
                 "formulation": "total", "initial_state": "as-placed", "gravity": [0.0, 0.0, -9.81],
                 "solver": "auto", "mass_damping": 0.0, "stiffness_damping": 0.0, "method": "auto",
                 "safety": {"joints": ["*"], "tolerance": 0.01, "lower": 0.1, "upper": 10.0},
                 "capacity": {"blocks": ["*"], "tolerance": 0.01, "lower": 0.1, "upper": 10.0},
                 "movement": {"supports": [], "limit": "auto", "tolerance": "auto"},
                 "sleeping": true, "memory_limit": "auto"},
    "contact": {"springs": "area", "surface": "curved", "normal_stiffness": "auto", "shear_stiffness": "auto",
                "friction_angle": 30.0, "cohesion": 0.0, "tensile_strength": 0.0, "distance": "auto",
                "angle": "auto", "chord_tolerance": "auto", "augmented": false, "penetration_tolerance": "auto",
                "allowed_overlap": 0.0, "allowed_depth": "auto", "dilation_angle": 0.0, "damping": 0.0},
    "joint": [{"blocks": ["A", "B*"]}],
    "material": [{"name": "rock", "density": 2500.0, "young_modulus": 1e9, "poisson_ratio": 0.25,
                  "elasticity": "linear"}],
    "block": [
      {"name": "A", "material": "rock", "order": 1, "box": {"min": [0.0, 0.0, 1.0], "max": [1.0, 1.0, 2.0]},
       "translate": [0.0, 0.0, 0.0], "velocity": [0.0, 0.0, 0.0], "angular_velocity": [0.0, 0.0, 0.0], "fixed": false},
      {"name": "B", "material": "rock", "order": 4, "box": {"min": [0.0, 0.0, 0.0], "max": [4.0, 1.0, 1.0]},
       "translate": [0.0, 0.0, 0.0], "velocity": [0.0, 0.0, 0.0], "angular_velocity": [0.0, 0.0, 0.0], "fixed": false,
       "fix": [{"plane": {"point": [0.0, 0.0, 0.0], "normal": [-1.0, 0.0, 0.0]}, "components": ["x", "y", "z"]}],
       "load": [{"plane": {"point": [4.0, 0.0, 0.0], "normal": [1.0, 0.0, 0.0]}, "traction": [0.0, 0.0, -1e5]}]}],
    "measure": [{"name": "tip", "block": "B", "point": [4.0, 0.5, 0.5]}],
    "output": {"every": 5, "history_every": 1, "fields": ["displacement", "velocity", "stress"], "curved": false,
               "solid": false, "format": "vtu", "precision": "auto"}
  })"));
}

TEST(SceneJson, HoldsWhatIsNotDefault) {
  const nlohmann::json json =
      json_of(sample_with(22,
                          "point = [0, 0, 0]\ncomponents = [\"y\"]\n"
                          "displacement_history = [[0, 0, 0, 0], [1, 0, 3, 0]]"),
              {"contact.subdivisions=2", "contact.normal_stiffness=5", "joint.0.tied=true",
               "joint.0.shear_stiffness=auto", "output.interval=0.5", "output.fields=[]",
               "output.curved=true", "block.A.sphere.radius=1", "block.A.rotate={axis=[0,0,1], angle=30}",
               "block.B.load.0.history=[[0, 0], [1, 2]]"});
  EXPECT_EQ(json["contact"]["subdivisions"], 2);
  EXPECT_FALSE(json["contact"].contains("chord_tolerance"));
  EXPECT_EQ(json["contact"]["normal_stiffness"], 5.0);
  EXPECT_EQ(json["joint"][0],
            nlohmann::json::parse(R"({"blocks": ["A", "B*"], "shear_stiffness": "auto", "tied": true})"));
  EXPECT_EQ(json["output"],
            nlohmann::json::parse(
                R"({"interval": 0.5, "history_every": 1, "fields": [], "curved": true, "solid": false,
                    "format": "vtu", "precision": "auto"})"));
  EXPECT_EQ(json["block"][0]["sphere"],
            nlohmann::json::parse(R"({"center": [0.0, 0.0, 0.0], "radius": 1.0, "subdivisions": 3})"));
  EXPECT_EQ(json["block"][0]["rotate"],
            nlohmann::json::parse(R"({"axis": [0.0, 0.0, 1.0], "angle": 30.0, "about": [0.0, 0.0, 0.0]})"));
  EXPECT_EQ(json["block"][1]["fix"][0],
            nlohmann::json::parse(R"({"point": [0.0, 0.0, 0.0], "components": ["y"],
                                      "displacement_history": [[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 3.0, 0.0]]})"));
  EXPECT_EQ(json["block"][1]["load"][0]["history"], nlohmann::json::parse("[[0.0, 0.0], [1.0, 2.0]]"));
}

}  // namespace
}  // namespace ashlar::test::scene_json_test
