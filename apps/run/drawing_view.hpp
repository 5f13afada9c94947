// Blocks that may move, seen along the horizontal direction in which they extend least, as an SVG drawing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/scene/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

class DrawingView {
 public:
  /// Where a point of a block is drawn, m. @param point as placed
  using PlaceOf = std::function<Vector3(int block, const Vector3& point)>;

  struct Note {
    std::string colour;
    std::string text;  ///< without <, > and &
  };

  /// @param place empty: blocks lie as they are placed
  DrawingView(const Scene& scene, const Simulation& simulation, PlaceOf place = {});

  /// "x,y" of a place, m.
  [[nodiscard]] std::string at(const Vector3& place) const;
  [[nodiscard]] std::string head() const;
  [[nodiscard]] std::string blocks(const Simulation& simulation) const;
  /// A line of text below, and the end.
  [[nodiscard]] std::string foot(const std::vector<Note>& notes) const;

 private:
  [[nodiscard]] double height() const;

  static constexpr double width_ = 900.0, margin_ = 30.0;

  PlaceOf place_;
  Vector3 up_, along_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(1e300), high_ = Eigen::Vector2d::Constant(-1e300);
  double scale_ = 1.0;
};

}  // namespace ashlar
