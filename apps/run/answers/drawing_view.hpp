// Moving blocks as an SVG drawing, projected along the horizontal direction of their smallest extent.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

class DrawingView {
 public:
  /// Place of a point of a block in the drawing, m. @param point as placed
  using PlaceOf = std::function<Vector3(int block, const Vector3& point)>;

  struct Note {
    std::string colour;
    std::string text;  ///< without <, > and &
  };

  /// @param place empty: blocks are drawn as placed
  DrawingView(const Scene& scene, const Simulation& simulation, PlaceOf place = {});

  /// "x,y" of a place, m.
  [[nodiscard]] std::string at(const Vector3& place) const;
  [[nodiscard]] std::string head() const;
  [[nodiscard]] std::string blocks(const Simulation& simulation) const;
  /// Lines of text below, and the end of the drawing.
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
