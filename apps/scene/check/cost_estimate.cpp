#include "apps/scene/check/cost_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "mechanics/block/rigid_body.hpp"

namespace ashlar {
namespace {

// Measured, in bytes.
constexpr double program = 2e7;
constexpr double of_triangle = 2000.0;
constexpr double of_sub_face = 2000.0;            ///< without the part that grows with the order
constexpr double of_surface_value = 10.0;         ///< of a function at a point of a sub-face
constexpr double of_pair_and_unknown = 1e4;       ///< contact points, matrix and factor, per pair of faces in
                                                  ///< contact
constexpr double matrices_of_kind = 4.0;          ///< of size 3p x 3p, for each kind of block
constexpr double matrices_of_block = 2.0;         ///< additionally for each block
constexpr double bytes_per_mesh_triangle = 20.0;  ///< of a file, the smallest of all formats
constexpr double of_scene_block = 4e4;  ///< what a rank has of each block of the scene, for results too
constexpr double part_of_rank = 1.25;   ///< largest part of a rank, relative to the mean, with ghosts

double functions_of(int order) {
  return (order + 1.0) * (order + 2.0) * (order + 3.0) / 6.0;
}

double unknowns_of(const SceneBlock& block) {
  if (block.fixed) return 0.0;
  return block.order == 0 ? rigid_freedom : 3.0 * functions_of(block.order);
}

struct TriangleCount {
  const std::filesystem::path& folder;

  double operator()(std::monostate) const { return 0.0; }
  double operator()(const SceneBox&) const { return 12.0; }
  double operator()(const SceneHull& hull) const { return 2.0 * static_cast<double>(hull.points.size()); }
  double operator()(const SceneSphere& sphere) const {
    return 20.0 * correctly_rounded::pow(4.0, sphere.subdivisions);
  }
  double operator()(const ScenePiece& piece) const {
    return static_cast<double>(piece.solid->mesh().triangles.size());
  }
  double operator()(const SceneMesh& mesh) const {
    if (mesh.stone) return static_cast<double>(mesh.stone->triangles.size());
    std::error_code fault;
    const auto size = std::filesystem::file_size(folder / mesh.file, fault);
    return fault ? 0.0 : static_cast<double>(size) / bytes_per_mesh_triangle;
  }
};

/// Number of sub-faces per triangle of a block.
double division_of(const Scene& scene, const SceneBlock& block) {
  if (block.fixed) return 1.0;
  if (scene.analysis.formulation == SceneAnalysis::Formulation::incremental)
    return correctly_rounded::pow(4.0, scene.contact.subdivisions.value_or(2));
  return block.order < 2 ? 1.0 : correctly_rounded::pow(4.0, scene.contact.subdivisions.value_or(0));
}

double surface_memory(const SceneBlock& block, double triangles, double sub_faces) {
  double memory = of_triangle * triangles;
  const double points = 0.5 * (block.order + 1.0) * (block.order + 2.0);
  if (sub_faces > triangles || (block.order >= 2 && !block.fixed))
    memory += sub_faces * (of_sub_face + of_surface_value * functions_of(block.order) * points);
  return memory;
}

/// Key of blocks with equal parts.
std::pair<std::size_t, int> kind_of(const SceneBlock& block) {
  return {block.shape.index(), block.order};
}

/// Blocks whose boxes intersect, and the memory of those that can touch along faces.
struct NearPairs {
  double count = 0.0;
  double memory = 0.0;  ///< bytes
};

NearPairs near_pairs(const std::vector<std::optional<Polyhedron>>& solids, const Scene& scene) {
  std::vector<Box> boxes;
  std::vector<std::size_t> blocks;
  double faces = 0.0;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (!solids[k]) continue;
    boxes.push_back(box_of(solids[k]->mesh().points));
    blocks.push_back(k);
    faces += static_cast<double>(solids[k]->faces().size());
  }
  NearPairs pairs;
  for (const auto& [a, b] : meeting_boxes(boxes)) {
    const SceneBlock& first = scene.block[blocks[static_cast<std::size_t>(a)]];
    const SceneBlock& second = scene.block[blocks[static_cast<std::size_t>(b)]];
    if (first.fixed && second.fixed) continue;
    pairs.count += 1.0;
    pairs.memory += of_pair_and_unknown * (unknowns_of(first) + unknowns_of(second));
  }
  // Blocks in contact along an edge or at a corner, and boxes of inclined blocks, have no contact points.
  pairs.memory *= std::min(1.0, 0.5 * faces / std::max(pairs.count, 1.0));
  return pairs;
}

/// @param alone bytes, of a rank that has all blocks
double memory_of_rank(double alone, double blocks, int ranks) {
  const double part = part_of_rank * (alone - program) / ranks;
  return std::min(alone, program + of_scene_block * blocks + part);
}

std::string in_words(double count, const char* noun) {
  return count < 1e7 ? fmt::format("{:.0f} {}{}", count, noun, count == 1.0 ? "" : "s")
                     : fmt::format("{:.2g} {}s", count, noun);
}

std::string bytes_in_words(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

}  // namespace

CostEstimate estimate_cost(const Scene& scene, const std::vector<std::optional<Polyhedron>>* solids,
                           int ranks) {
  CostEstimate estimate;
  estimate.ranks = ranks;
  estimate.memory = program;
  const std::filesystem::path folder = scene.file.parent_path();
  std::set<std::pair<std::size_t, int>> kinds;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const SceneBlock& block = scene.block[k];
    const bool known = solids != nullptr && (*solids)[k];
    const double triangles = known ? static_cast<double>((*solids)[k]->mesh().triangles.size())
                                   : std::visit(TriangleCount{folder}, block.shape);
    const double sub_faces = triangles * division_of(scene, block);
    const double size = unknowns_of(block);
    estimate.triangles += triangles;
    estimate.sub_faces += sub_faces;
    estimate.unknowns += size;
    estimate.memory += surface_memory(block, triangles, sub_faces);
    const bool is_new = kinds.insert(kind_of(block)).second;
    const bool differs = is_new || !std::holds_alternative<SceneBox>(block.shape);
    estimate.memory +=
        sizeof(double) * size * size * (matrices_of_block + (differs ? matrices_of_kind : 0.0));
  }
  if (solids != nullptr) {
    const NearPairs pairs = near_pairs(*solids, scene);
    estimate.pairs = pairs.count;
    estimate.memory += pairs.memory;
  }
  estimate.memory = memory_of_rank(estimate.memory, static_cast<double>(scene.block.size()), ranks);
  return estimate;
}

std::string to_string(const CostEstimate& estimate, std::size_t blocks) {
  const std::string where = estimate.ranks > 1 ? fmt::format(" on each of {} ranks", estimate.ranks) : "";
  return fmt::format("estimate: {}, {}, {}, {} of near blocks, {}{}",
                     in_words(static_cast<double>(blocks), "block"), in_words(estimate.sub_faces, "sub-face"),
                     in_words(estimate.unknowns, "unknown"), in_words(estimate.pairs, "pair"),
                     bytes_in_words(estimate.memory), where);
}

bool check_cost(const Scene& scene, const CostEstimate& estimate, Diagnostics& diagnostics) {
  const double limit = scene.analysis.memory_limit.value_or(default_memory_limit);
  if (estimate.memory <= limit) return true;
  const std::string all = fmt::format("scene is too large ({}), up to {} are allowed",
                                      to_string(estimate, scene.block.size()), bytes_in_words(limit));
  const std::string raised =
      fmt::format("analysis.memory_limit = {:.0e} (bytes) allows it",
                  correctly_rounded::pow(10.0, std::ceil(correctly_rounded::log10(estimate.memory))));
  // Memory of surfaces, and the block with most sub-faces.
  std::size_t largest = 0;
  double most = -1.0, of_surfaces = 0.0;
  const std::filesystem::path folder = scene.file.parent_path();
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const SceneBlock& block = scene.block[k];
    const double triangles = std::visit(TriangleCount{folder}, block.shape);
    const double sub_faces = triangles * division_of(scene, block);
    of_surfaces += surface_memory(block, triangles, sub_faces);
    if (sub_faces <= most) continue;
    most = sub_faces;
    largest = k;
  }
  if (of_surfaces < 0.5 * estimate.memory) {
    diagnostics.error(scene.places.key(""),
                      fmt::format("{}: fewer blocks or lower orders need less, {}", all, raised));
    return false;
  }
  diagnostics.error(
      scene.places.key(fmt::format("block.{}", largest)),
      fmt::format("{}: block \"{}\" has most, {}; fewer subdivisions, lower orders or coarser meshes need "
                  "less, {}",
                  all, scene.block[largest].name, in_words(most, "sub-face"), raised));
  return false;
}

}  // namespace ashlar
