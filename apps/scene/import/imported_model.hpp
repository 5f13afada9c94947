// A model of another program: blocks as polygons with the properties that its files give. Readers of this folder fill
// it; model_scene.hpp writes it as a scene.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A model that cannot be read; what() is "what is wrong (value), what is allowed".
class ImportError : public std::runtime_error {
 public:
  ImportError(Place place, const std::string& what) : runtime_error(what), place_(std::move(place)) {}
  [[nodiscard]] const Place& place() const { return place_; }

 private:
  Place place_;
};

/// Properties of contacts, those that a file gives. Degrees, Pa, Pa/m.
struct ImportedLaw {
  std::optional<double> friction_angle, cohesion, tensile_strength, normal_stiffness, shear_stiffness;

  friend bool operator==(const ImportedLaw&, const ImportedLaw&) = default;
};

/// Contacts of blocks with these names, which may be globs.
struct ImportedJoint {
  std::string first, second;
  ImportedLaw law;
  bool tied = false;  ///< one body
};

struct ImportedMaterial {
  std::string name;
  std::optional<double> density;  ///< kg/m^3
};

/// A force at a point of a block.
struct ImportedLoad {
  Vector3 point;  ///< m
  Vector3 force;  ///< N
};

struct ImportedBlock {
  std::string name;                     ///< letters, digits, '_', '-' and '.'; each its own
  std::vector<Vector3> points;          ///< m
  std::vector<std::vector<int>> faces;  ///< polygons of indices into points, all seen from the same side
  std::optional<std::size_t> material;  ///< index into materials
  bool fixed = false;
  std::vector<ImportedLoad> loads;
  std::optional<Vector3> displacement;  ///< m, of a support that moves without turning
};

struct ImportedModel {
  std::string title;
  std::vector<ImportedBlock> blocks;
  std::vector<ImportedMaterial> materials;
  ImportedLaw contact;  ///< of all contacts
  std::vector<ImportedJoint> joints;
  std::optional<Vector3> gravity;     ///< m/s^2
  double rounding = 0.0;              ///< m, largest error of a coordinate by the digits of the file
  std::vector<std::string> left_out;  ///< parts of the files that are not in the model
  std::vector<std::string> notes;     ///< decisions of the reader that a user should know
};

/// Smallest box around the points of a block.
struct ImportedBox {
  Vector3 low, high;
};
[[nodiscard]] ImportedBox box_of(const ImportedBlock& block);

/// Centre of the volume within the faces, by their fans of triangles in double precision; of a block without volume the
/// mean of its points.
[[nodiscard]] Vector3 centroid_of(const ImportedBlock& block);

/// Adds a force at a point and a moment. A moment, and a force beside the block's box, act as a couple about its
/// centroid: forces at two points, the same for a rigid block. @param moment N m
void add_load(ImportedBlock& block, const Vector3& point, const Vector3& force, const Vector3& moment);

/// Turns faces of a convex block so that all of them are seen from outside.
void turn_outward(ImportedBlock& block);

/// Turns faces so that each runs through its edges against its neighbours, as far as edges have two faces. The first face
/// of each connected part stays.
void turn_alike(ImportedBlock& block);

/// Half a unit of the last digit of a decimal number as written, such as 0.05 for "1.5" and "1.5E0"; 0 for numbers of 15
/// digits and more, which are as exact as double precision.
[[nodiscard]] double rounding_of(std::string_view number);

/// The name with other characters than those of ImportedBlock::name as '_'.
[[nodiscard]] std::string plain_name(std::string_view name);

}  // namespace ashlar
