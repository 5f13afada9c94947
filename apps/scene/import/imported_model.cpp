#include "apps/scene/import/imported_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"

namespace ashlar {

ImportedBox box_of(const ImportedBlock& block) {
  ImportedBox box{block.points.front(), block.points.front()};
  for (const Vector3& point : block.points) {
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  return box;
}

Vector3 centroid_of(const ImportedBlock& block) {
  Vector3 mean = Vector3::Zero();
  for (const Vector3& point : block.points) mean += point / static_cast<double>(block.points.size());
  double volume = 0.0;
  Vector3 moment = Vector3::Zero();
  for (const std::vector<int>& face : block.faces) {
    for (std::size_t k = 2; k < face.size(); ++k) {
      const Vector3 a = block.points[at(face[0])] - mean, b = block.points[at(face[k - 1])] - mean,
                    c = block.points[at(face[k])] - mean;
      const double six_volumes = a.dot(b.cross(c));
      volume += six_volumes;
      moment += six_volumes * (a + b + c) / 4.0;
    }
  }
  return volume == 0.0 ? mean : Vector3(mean + moment / volume);
}

namespace {

/// Two forces F and -F at c + s e and c - s e with 2 s e x F = M: e is across M, and F = M x e / (2 s).
void add_couple(ImportedBlock& block, const Vector3& moment) {
  if (moment.isZero(0.0)) return;
  const Vector3 centroid = centroid_of(block);
  const ImportedBox box = box_of(block);
  Vector3::Index axis = 0;
  moment.cwiseAbs().minCoeff(&axis);
  const Vector3 across = moment.cross(Vector3::Unit(axis)).normalized();
  const double arm = std::min((centroid - box.low).minCoeff(), (box.high - centroid).minCoeff());
  const Vector3 force = moment.cross(across) / (2.0 * arm);
  block.loads.push_back({centroid + arm * across, force});
  block.loads.push_back({centroid - arm * across, -force});
}

}  // namespace

void add_load(ImportedBlock& block, const Vector3& point, const Vector3& force, const Vector3& moment) {
  const ImportedBox box = box_of(block);
  const bool inside = (point.array() >= box.low.array()).all() && (point.array() <= box.high.array()).all();
  const Vector3 place = inside ? point : centroid_of(block);
  if (!force.isZero(0.0)) block.loads.push_back({place, force});
  add_couple(block, moment + (point - place).cross(force));
}

void turn_outward(ImportedBlock& block) {
  Vector3 inside = Vector3::Zero();
  for (const Vector3& point : block.points) inside += point / static_cast<double>(block.points.size());
  for (std::vector<int>& face : block.faces) {
    // Newell's normal: of a polygon that is not quite plane too.
    Vector3 normal = Vector3::Zero(), centre = Vector3::Zero();
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vector3 a = block.points[at(face[k])] - inside;
      normal += a.cross(block.points[at(face[(k + 1) % face.size()])] - inside);
      centre += a;
    }
    if (normal.dot(centre) < 0.0) std::reverse(face.begin(), face.end());
  }
}

void turn_alike(ImportedBlock& block) {
  struct Side {
    std::size_t face;
    bool forward;  ///< from the lower point to the higher one
  };
  std::map<std::pair<int, int>, std::vector<Side>> sides;
  for (std::size_t f = 0; f < block.faces.size(); ++f) {
    const std::vector<int>& face = block.faces[f];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto [low, high] = std::minmax(face[k], face[(k + 1) % face.size()]);
      sides[{low, high}].push_back({f, face[k] == low});
    }
  }
  std::vector<std::vector<std::pair<std::size_t, bool>>> neighbours(block.faces.size());
  for (const auto& [edge, both] : sides) {
    if (both.size() != 2) continue;
    const bool against = both[0].forward == both[1].forward;
    neighbours[both[0].face].emplace_back(both[1].face, against);
    neighbours[both[1].face].emplace_back(both[0].face, against);
  }
  std::vector<bool> seen(block.faces.size(), false), turned(block.faces.size(), false);
  for (std::size_t first = 0; first < seen.size(); ++first) {
    std::vector<std::size_t> open;
    if (!seen[first]) open.push_back(first);
    seen[first] = true;
    while (!open.empty()) {
      const std::size_t f = open.back();
      open.pop_back();
      for (const auto& [other, against] : neighbours[f]) {
        if (seen[other]) continue;
        seen[other] = true;
        turned[other] = turned[f] != against;
        open.push_back(other);
      }
    }
  }
  for (std::size_t f = 0; f < turned.size(); ++f)
    if (turned[f]) std::reverse(block.faces[f].begin(), block.faces[f].end());
}

double rounding_of(std::string_view number) {
  constexpr int exact_digits = 15;
  const std::size_t exponent_at = std::min(number.find_first_of("eEdD"), number.size());
  const std::string_view mantissa = number.substr(0, exponent_at);
  const auto digits =
      std::count_if(mantissa.begin(), mantissa.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (digits >= exact_digits) return 0.0;
  const std::size_t point = mantissa.find('.');
  const int decimals = point == std::string_view::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  int exponent = 0;
  if (exponent_at < number.size()) {
    std::string_view power = number.substr(exponent_at + 1);
    if (!power.empty() && power.front() == '+') power.remove_prefix(1);
    std::from_chars(power.data(), power.data() + power.size(), exponent);
  }
  return 0.5 * correctly_rounded::pow(10.0, exponent - decimals);
}

std::string plain_name(std::string_view name) {
  std::string plain(name);
  for (char& c : plain) {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '-' || c == '.';
    if (!kept) c = '_';
  }
  return plain.empty() ? "_" : plain;
}

}  // namespace ashlar
