#include "mechanics/block/block_parts.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace ashlar {
namespace {

/// Values as bytes.
class Key {
 public:
  template <class Number>
  void add(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// Adds an exact difference: its rounded value and its rounding error (Knuth).
  void add_difference(double a, double b) {
    const double difference = a - b;
    const double lost = a - difference;
    const double rest = (a - (difference + lost)) + (lost - b);
    // Adding zero maps both zeros to one.
    add(difference + 0.0);
    add(rest + 0.0);
  }
  void add_difference(const Vector3& a, const Vector3& b) {
    for (int axis = 0; axis < 3; ++axis) add_difference(a[axis], b[axis]);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

void add_mesh(Key& key, const TriangleMesh& mesh) {
  key.add(mesh.points.size());
  for (const Vector3& point : mesh.points) key.add_difference(point, mesh.points.front());
  key.add(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) key.add(corner);
  }
}

void add_material(Key& key, const Material& material) {
  key.add(material.young_modulus);
  key.add(material.poisson_ratio);
  key.add(static_cast<int>(material.elasticity));
}

void add_supports(Key& key, const Polyhedron& solid, const std::vector<BlockSupport>& supports) {
  key.add(supports.size());
  for (const BlockSupport& support : supports) {
    for (const bool held : support.components) key.add(held);
    const auto* point = std::get_if<Vector3>(&support.where);
    key.add(point != nullptr);
    if (point != nullptr) {
      key.add_difference(*point, solid.mesh().points.front());
      continue;
    }
    for (const int face : faces_at(solid, support.where)) {
      for (const int triangle : solid.faces()[static_cast<std::size_t>(face)].triangles) key.add(triangle);
    }
    key.add(-1);
  }
}

/// Supports, and quiet faces that are held.
std::vector<BlockSupport> supports_of(const BlockDefinition& definition) {
  std::vector<BlockSupport> supports = definition.supports;
  if (!definition.released)
    for (const QuietFaces& quiet : definition.quiet) supports.push_back({quiet.where, quiet.components});
  return supports;
}

/// Converts supports of the placed solid to those of the shape before translation.
std::vector<BlockSupport> supports_of_shape(const BlockDefinition& definition) {
  std::vector<BlockSupport> supports = supports_of(definition);
  const Vector3 back = definition.shape->mesh().points.front() - definition.solid->mesh().points.front();
  for (BlockSupport& support : supports) {
    if (auto* point = std::get_if<Vector3>(&support.where)) {
      *point += back;
    } else {
      support.where = FaceList{faces_at(*definition.solid, support.where)};
    }
  }
  return supports;
}

/// Its strain is a polynomial of order 2 (n - 1), which may be too high for a shape.
std::shared_ptr<const StVenantKirchhoff> large_strains(const Polyhedron& solid, const PolynomialBasis& basis,
                                                       const Material& material) {
  try {
    return std::make_shared<const StVenantKirchhoff>(solid, basis, material);
  } catch (const OrderTooHigh& error) {
    throw OrderTooHigh(basis.order(), 1 + error.highest_safe_order / 2);
  }
}

}  // namespace

BlockParts::BlockParts(const Polyhedron& solid, const PolynomialBasis& basis,
                       const BlockDefinition& definition, const std::vector<BlockSupport>& supports)
    : space(basis.size()), turns(true) {
  if (definition.fixed) return;
  space = AdmissibleSpace(solid, basis, supports);
  turns = space.can_turn() && definition.quiet.empty();
  mean_gradients = ashlar::mean_gradients(basis);
  stiffness = elastic_stiffness(basis, definition.material);
  if (!turns || definition.formulation == Formulation::incremental)
    reduced_stiffness = space.restrict(stiffness);
  if (definition.order > 0 && definition.material.elasticity == Elasticity::st_venant_kirchhoff)
    large = large_strains(solid, basis, definition.material);
}

std::vector<std::size_t> BlockPartsLibrary::kinds() const {
  std::vector<std::size_t> kinds;
  kinds.reserve(parts_.size());
  for (const auto& [key, parts] : parts_) kinds.push_back(std::hash<std::string>()(key));
  return kinds;
}

BlockPartsLibrary::Found BlockPartsLibrary::find(const BlockDefinition& definition) {
  const Polyhedron& solid = definition.shape ? *definition.shape : *definition.solid;
  const int order = definition.fixed ? 1 : std::max(definition.order, 1);
  Key key;
  add_mesh(key, solid.mesh());
  key.add(order);
  auto basis = bases_.find(key.bytes());
  if (basis == bases_.end()) basis = bases_.emplace(key.bytes(), PolynomialBasis(solid, order)).first;
  const std::vector<BlockSupport> supports =
      definition.shape ? supports_of_shape(definition) : supports_of(definition);
  key.add(definition.fixed);
  key.add(static_cast<int>(definition.formulation));
  if (!definition.fixed) {
    key.add(definition.order == 0);
    key.add(definition.quiet.empty());
    add_material(key, definition.material);
    add_supports(key, solid, supports);
  }
  auto& parts = parts_[key.bytes()];
  if (!parts) {
    parts = std::make_shared<const BlockParts>(solid, basis->second.moved_to(solid.mesh().points.front()),
                                               definition, supports);
  }
  return {basis->second.moved_to(definition.solid->mesh().points.front()), parts};
}

}  // namespace ashlar
