#include "apps/scene/meshes/height_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/records/text_fields.hpp"
#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

/// Heights at the crossings of lines x and y; not a number where a point is missing.
struct Grid {
  std::vector<double> x, y;  ///< m, increasing
  std::vector<double> z;     ///< (#y x #x)

  double& at(std::size_t row, std::size_t column) { return z[row * x.size() + column]; }
};

TriangleMesh surface_of(Grid& grid) {
  TriangleMesh mesh;
  std::vector<int> number(grid.z.size(), -1);
  const auto point = [&](std::size_t row, std::size_t column) {
    int& index = number[row * grid.x.size() + column];
    if (index < 0) {
      index = static_cast<int>(mesh.points.size());
      const Vector3& place = mesh.points.emplace_back(grid.x[column], grid.y[row], grid.at(row, column));
      if (is_too_far(place.cwiseAbs().maxCoeff())) throw MeshFileError("coordinate beyond 1e150 m", 0, 0);
    }
    return index;
  };
  for (std::size_t row = 0; row + 1 < grid.y.size(); ++row) {
    for (std::size_t column = 0; column + 1 < grid.x.size(); ++column) {
      if (!std::isfinite(grid.at(row, column) + grid.at(row, column + 1) + grid.at(row + 1, column) +
                         grid.at(row + 1, column + 1)))
        continue;
      const int sw = point(row, column), se = point(row, column + 1), ne = point(row + 1, column + 1),
                nw = point(row + 1, column);
      mesh.triangles.push_back({sw, se, ne});
      mesh.triangles.push_back({sw, ne, nw});
    }
  }
  if (mesh.triangles.empty()) throw MeshFileError("grid has no cell with four heights", 0, 0);
  return mesh;
}

void require_size(double columns, double rows, int line) {
  if (columns * rows <= most_grid_points) return;
  throw MeshFileError(fmt::format("grid has too many points ({} x {}), at most {:g} are allowed", columns,
                                  rows, most_grid_points),
                      line, 1);
}

double required_number(const TextField& field, int line) {
  if (const std::optional<double> value = number_of(field.text)) return *value;
  constexpr std::size_t longest_shown = 60;
  throw MeshFileError(fmt::format("no number (\"{}\")", field.text.substr(0, longest_shown)), line,
                      field.column);
}

class EsriReader {
 public:
  TriangleMesh read(std::istream& content) {
    content.exceptions(std::ios::badbit);
    for (std::string text; std::getline(content, text);) {
      ++line_;
      const std::vector<TextField> fields = fields_of(text, ' ');
      if (fields.empty()) continue;
      if (!heights_begun_ && !number_of(fields[0].text))
        read_key(fields);
      else
        read_heights(fields);
    }
    if (!heights_begun_) begin_heights();
    if (heights_.size() != wanted_)
      throw MeshFileError(
          fmt::format("grid has {} heights, ncols times nrows is {}", heights_.size(), wanted_), line_, 1);
    // Memory is taken for the heights that are there.
    const std::size_t columns = columns_, rows = wanted_ / columns_;
    Grid grid{middles("x", columns), middles("y", rows), std::vector<double>(wanted_)};
    const std::optional<double> missing = key("nodata_value");
    for (std::size_t k = 0; k < heights_.size(); ++k) {
      // The first line of heights is the northernmost.
      double& z = grid.at(rows - 1 - k / columns, k % columns);
      z = missing && heights_[k] == *missing ? std::numeric_limits<double>::quiet_NaN() : heights_[k];
    }
    return surface_of(grid);
  }

 private:
  void read_key(const std::vector<TextField>& fields) {
    std::string name(fields[0].text);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    if (fields.size() != 2)
      throw MeshFileError(
          fmt::format("key \"{}\" of a grid has {} values, one is needed", name, fields.size() - 1), line_,
          1);
    keys_[name] = required_number(fields[1], line_);
  }

  [[nodiscard]] std::optional<double> key(const std::string& name) const {
    const auto found = keys_.find(name);
    return found == keys_.end() ? std::nullopt : std::optional(found->second);
  }

  double required(const std::string& name) {
    if (const std::optional<double> value = key(name)) return *value;
    throw MeshFileError(fmt::format("head of an ESRI grid has no {}", name), std::max(line_, 1), 1);
  }

  /// @param axis "x" or "y". @return places of the middles of cells
  std::vector<double> middles(const std::string& axis, std::size_t count) {
    const double size = required("cellsize");
    const std::optional<double> center = key(axis + "llcenter");
    const double first = center ? *center : required(axis + "llcorner") + 0.5 * size;
    std::vector<double> places;
    for (std::size_t k = 0; k < count; ++k) places.push_back(first + static_cast<double>(k) * size);
    return places;
  }

  void begin_heights() {
    heights_begun_ = true;
    const double columns = required("ncols"), rows = required("nrows");
    const double size = required("cellsize");
    if (!(columns >= 1.0) || columns != std::floor(columns) || !(rows >= 1.0) || rows != std::floor(rows) ||
        !(size > 0.0))
      throw MeshFileError("ncols, nrows and cellsize of a grid must be positive, the first two whole", line_,
                          1);
    require_size(columns, rows, line_);
    columns_ = static_cast<std::size_t>(columns);
    wanted_ = columns_ * static_cast<std::size_t>(rows);
  }

  void read_heights(const std::vector<TextField>& fields) {
    if (!heights_begun_) begin_heights();
    for (const TextField& field : fields) {
      heights_.push_back(required_number(field, line_));
      if (heights_.size() > wanted_)
        throw MeshFileError(fmt::format("grid has more heights than ncols times nrows ({})", wanted_), line_,
                            field.column);
    }
  }

  std::map<std::string, double> keys_;
  std::vector<double> heights_;
  std::size_t columns_ = 0, wanted_ = 0;  ///< heights in a line of the grid, and in all
  bool heights_begun_ = false;
  int line_ = 0;
};

struct SurveyPoint {
  double x, y, z;
  int line;
};

std::vector<SurveyPoint> survey_points(std::istream& content) {
  content.exceptions(std::ios::badbit);
  std::vector<SurveyPoint> points;
  int line = 0;
  bool first = true;
  for (std::string text; std::getline(content, text);) {
    ++line;
    const std::string_view words = trimmed_text(text);
    if (words.empty() || words.front() == '#') continue;
    const std::vector<TextField> fields = fields_of(text, separator_of(text));
    if (std::exchange(first, false) && !number_of(fields[0].text)) continue;
    if (fields.size() < 3)
      throw MeshFileError(fmt::format("line has {} fields, x, y and z are needed", fields.size()), line, 1);
    points.push_back({required_number(fields[0], line), required_number(fields[1], line),
                      required_number(fields[2], line), line});
  }
  return points;
}

std::vector<double> lines_of(const std::vector<SurveyPoint>& points, double SurveyPoint::*axis) {
  std::vector<double> places;
  places.reserve(points.size());
  for (const SurveyPoint& point : points) places.push_back(point.*axis);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

std::size_t index_in(const std::vector<double>& places, double place) {
  return static_cast<std::size_t>(std::lower_bound(places.begin(), places.end(), place) - places.begin());
}

}  // namespace

bool is_height_grid(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return equal_ignoring_case(ending, ".asc") || equal_ignoring_case(ending, ".xyz");
}

TriangleMesh parse_esri_grid(std::istream& content) {
  return EsriReader().read(content);
}

TriangleMesh parse_xyz_grid(std::istream& content) {
  const std::vector<SurveyPoint> points = survey_points(content);
  Grid grid{lines_of(points, &SurveyPoint::x), lines_of(points, &SurveyPoint::y), {}};
  require_size(static_cast<double>(grid.x.size()), static_cast<double>(grid.y.size()), 1);
  grid.z.assign(grid.x.size() * grid.y.size(), std::numeric_limits<double>::quiet_NaN());
  for (const SurveyPoint& point : points) {
    double& z = grid.at(index_in(grid.y, point.y), index_in(grid.x, point.x));
    if (std::isfinite(z))
      throw MeshFileError(fmt::format("two points have one x and y ({:g}, {:g})", point.x, point.y),
                          point.line, 1);
    z = point.z;
  }
  return surface_of(grid);
}

TriangleMesh read_height_grid(const std::filesystem::path& path) {
  std::istringstream content(read_mesh_bytes(path, "grid of heights"));
  return equal_ignoring_case(path.extension().string(), ".asc") ? parse_esri_grid(content)
                                                                : parse_xyz_grid(content);
}

}  // namespace ashlar
