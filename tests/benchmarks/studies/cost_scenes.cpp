#include "benchmarks/studies/cost_scenes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>

namespace ashlar {

SceneText::SceneText(int order, const std::string& analysis) : order_(order) {
  text_ = "[analysis]\nend_time = 1000.0\ntime_step = 0.004166666666666667\n" + analysis + R"([contact]
friction_angle = 26.565
[[material]]
name = "stone"
density = 2600
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "ground"
fixed = true
box = { min = [-500, -500, -5], max = [500, 500, 0] }
)";
}

void SceneText::begin_block() {
  fmt::format_to(std::back_inserter(text_), "[[block]]\nname = \"b{}\"\nmaterial = \"stone\"\norder = {}\n",
                 blocks_++, order_);
}

void SceneText::add_box(const Vector3& low, const Vector3& high) {
  begin_block();
  fmt::format_to(std::back_inserter(text_), "box = {{ min = [{}, {}, {}], max = [{}, {}, {}] }}\n", low.x(),
                 low.y(), low.z(), high.x(), high.y(), high.z());
}

void SceneText::add_hull(const Vector3& centre, int number) {
  begin_block();
  text_ += "hull = { points = [";
  std::mt19937 random(static_cast<unsigned>(number));
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  constexpr int corners = 20;
  for (int k = 0; k < corners; ++k) {
    // Uniform on the sphere: height and longitude are.
    const double height = between(-1.0, 1.0);
    const double longitude = between(0.0, 2.0 * std::numbers::pi);
    const double radius = std::sqrt(1.0 - height * height);
    const Vector3 place =
        centre + Vector3(radius * std::cos(longitude), radius * std::sin(longitude), height);
    fmt::format_to(std::back_inserter(text_), "{}[{:.6f}, {:.6f}, {:.6f}]", k > 0 ? ", " : "", place.x(),
                   place.y(), place.z());
  }
  text_ += "] }\n";
}

SceneText floor_of(int n) {
  SceneText scene(1);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) scene.add_cube(1.5 * i, 1.5 * j, 0);
  }
  return scene;
}

namespace {

void add_courses(SceneText& scene, int n, bool half_bricks) {
  for (int course = 0; course < n; ++course) {
    const double low = 0.5 * course;
    const double shift = 0.5 * (course % 2);
    for (int i = 0; i < n + (half_bricks ? course % 2 : 0); ++i) {
      const double left = half_bricks ? std::max(0.0, i - shift) : i + shift;
      const double right = half_bricks ? std::min<double>(n, i - shift + 1.0) : i + shift + 1.0;
      scene.add_box({left, 0, low}, {right, 0.5, low + 0.5});
    }
  }
}

}  // namespace

SceneText wall_of(int n) {
  SceneText scene(1);
  add_courses(scene, n, true);
  return scene;
}

SceneText waking_wall_of(int n) {
  SceneText scene(1, "sleeping = false\n");
  add_courses(scene, n, true);
  return scene;
}

SceneText loose_wall_of(int n) {
  SceneText scene(1);
  add_courses(scene, n, false);
  return scene;
}

SceneText pile_of(int n, double gap) {
  SceneText scene(1);
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) scene.add_cube(1.02 * i, 1.02 * j, gap + k * (1.0 + gap));
    }
  }
  return scene;
}

SceneText pyramid_of(int n) {
  SceneText scene(1);
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n - k; ++j) {
      for (int i = 0; i < n - k; ++i) scene.add_cube(i + 0.5 * k, j + 0.5 * k, k);
    }
  }
  return scene;
}

SceneText cube_of_order(int order) {
  SceneText scene(order);
  scene.add_cube(0, 0, 0);
  return scene;
}

SceneText hulls_of(int n, int order) {
  SceneText scene(order);
  const int side = static_cast<int>(std::ceil(std::cbrt(n)));
  constexpr double apart = 3.0;
  for (int k = 0; k < n; ++k)
    scene.add_hull(apart * Vector3(k % side, k / side % side, 1 + k / (side * side)), k);
  return scene;
}

std::string dominoes_text() {
  std::string text = R"([analysis]
end_time = 1000.0
time_step = 2.5e-4
[contact]
friction_angle = 30
[[material]]
name = "stone"
density = 1500
young_modulus = 2e11
poisson_ratio = 0.2
[[block]]
name = "ground"
fixed = true
box = { min = [-1, -1, -0.1], max = [2, 1, 0] }
)";
  constexpr int count = 16;
  constexpr double apart = 0.024, thickness = 0.0075, width = 0.024, height = 0.048, push = 4.0;
  for (int k = 0; k < count; ++k) {
    const double x = k * apart;
    fmt::format_to(
        std::back_inserter(text),
        "[[block]]\nname = \"d{}\"\nmaterial = \"stone\"\nbox = {{ min = [{}, 0, 0], max = [{}, {}, {}] }}\n",
        k, x, x + thickness, width, height);
    // Rotation about its lower front edge.
    if (k == 0)
      fmt::format_to(std::back_inserter(text), "velocity = [{}, 0, {}]\nangular_velocity = [0, {}, 0]\n",
                     0.5 * push * height, 0.5 * push * thickness, push);
  }
  return text;
}

}  // namespace ashlar
