// [analysis] pushover and spectrum: loads that grow along a direction, and the earthquake that the answer is compared with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// spectrum = { points } or { file, scale } or { code, ... }: elastic response spectrum of acceleration at the ground.
struct SceneSpectrum {
  enum class Source {
    none,    ///< nothing is compared
    points,  ///< "points", or a table from `file`
    ec8,     ///< code = "ec8": EN 1998-1, 3.2.2.2
    ntc2018  ///< code = "ntc2018": NTC 2018, 3.2.3.2
  };
  enum class Soil { a, b, c, d, e };
  struct Point {
    double period;        ///< s, >= 0, increasing
    double acceleration;  ///< m/s^2, >= 0
  };

  Source source = Source::none;
  std::vector<Point> points;         ///< linear between them, constant beyond
  std::filesystem::path file;        ///< of `points`, as written; empty: they are in the scene
  double scale = 1.0;                ///< of its values
  std::string sha256;                ///< of the file when it was read
  double ground_acceleration = 0.0;  ///< m/s^2, > 0, on rock; of codes
  Soil soil = Soil::a;
  int type = 1;                        ///< 1 or 2; of ec8
  double amplification = 2.5;          ///< F0, > 0; of ntc2018
  double corner_period = 0.3;          ///< s, TC*, > 0; of ntc2018
  double topography = 1.0;             ///< ST, >= 1; of ntc2018
  std::optional<double> damping = {};  ///< percent, > 0; empty: 5
};

/// pushover = { direction, directions, control, limit, blocks, ... }
struct ScenePushover {
  std::optional<Vector3>
      direction;                  ///< of any length > 0; empty: the first one of `directions` is horizontal
  std::optional<int> directions;  ///< number of horizontal ones, >= 2; empty: `direction` alone
  std::string control;  ///< name of a [[measure]] of a point or block; empty: mean of the moving blocks
  std::optional<double> limit;  ///< m, > 0; empty: the size of what may move
  /// Names or globs of blocks whose loads are multiplied; empty: forces in proportion to mass are
  std::vector<std::string> blocks;
  std::optional<double> confidence_factor;  ///< >= 1; empty: 1.35
  std::optional<double> behaviour_factor;   ///< >= 1; empty: 2
  /// Of the mechanism in a building: both heights or none
  std::optional<double> height;           ///< m, >= 0, of what the mechanism stands on above the foundation
  std::optional<double> building_height;  ///< m, > 0
  std::optional<int> storeys;             ///< >= 1; empty: 1
  std::optional<double> period;           ///< s, > 0, of the building; empty: 0.05 building_height^(3/4)
};

}  // namespace ashlar
