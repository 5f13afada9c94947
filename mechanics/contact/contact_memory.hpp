// Memory of contact points from step to step: elastic slip, state, multipliers, dilation, intactness and damage of the
// joint. Memory belongs to material points, not to the step's polygons. A new point inherits from the nearest old one
// in the material of either block, or from all that are at most half as far again: a new point midway between old
// ones gets their mean, so that rounding does not select one. Slip follows the contact to another face over an edge
// that is not sharp. A bond does not, as new surface is not bonded.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "mechanics/contact/contact_points.hpp"
#include "mechanics/contact/laws/joint_law.hpp"
#include "mechanics/contact/laws/spring_energy.hpp"

namespace ashlar {

/// Memory of one point after an accepted step.
struct PointMemory {
  Vector3 slip = Vector3::Zero();  ///< elastic slip of a relative to b, in the tangent plane, m
  ContactState state = ContactState::open;
  bool intact = false;             ///< true: joint strength has not failed
  double normal_multiplier = 0.0;  ///< of augmented contact, Pa, for point springs N
  Vector3 shear_multiplier = Vector3::Zero();
  /// Deferred friction: normal impulse whose friction has not acted yet, of augmented contact, Pa s, for point
  /// springs N s
  double deferred_friction = 0.0;
  double compression = 0.0;  ///< depth below the normal spring's rest gap, m; negative: open
  /// For a static analysis (solver/statics/static_analysis.hpp): trial slip with the blocks at their positions at the
  /// start of the present load level, m
  Vector3 level_slip = Vector3::Zero();
  bool in_level = false;  ///< true if it has been closed at or since the start of the level; others have no
                          ///< slip yet
  double dilation = 0.0;  ///< dilation by sliding: height of the normal spring's rest gap, m, >= 0
  double level_dilation = 0.0;  ///< the same at the start of the present load level
  double damage =
      0.0;  ///< of a bond with fracture energy (bond_damage.hpp), or wear of a rough joint, 0 to 1
  double level_damage = 0.0;  ///< the same at the start of the present load level
};

/// Memory of a pair of blocks.
class ContactMemory {
 public:
  /// One remembered point: places in both materials, faces, normal.
  struct Entry {
    Vector3 material_a;
    Vector3 material_b;
    int face_a;
    int face_b;
    Vector3 normal;
    double area;  ///< m^2
    PointMemory memory;
  };

  ContactMemory() = default;
  /// As `entries`, `cuts`, `deepest`, `held` and `bulge` of an earlier one.
  ContactMemory(std::vector<Entry> entries, std::vector<PressureCut> cuts, double deepest,
                const SpringEnergy& held, double bulge);

  /// Lists all members, for a checkpoint.
  template <class Archive>
  friend void visit_members(Archive& archive, ContactMemory& memory) {
    auto& [entries, cuts, turning, deepest, bulge, held, squared_reach, largest_area, most_dilation] = memory;
    archive(entries, cuts, turning, deepest, bulge, held, squared_reach, largest_area, most_dilation);
  }

  /// Memory for each of the new points, with vectors rotated into the new tangent plane. It is that of the nearest
  /// old points of the same faces. If none of those is within the width of the whole contact, old points of any faces
  /// with normals within 60 degrees are used. Points without predecessor start open, without slip, bonded by the
  /// joint's strength if their gap is at most `bond_distance`, m (minus infinity: never).
  /// @param keep_forces if one old point became one new one, multipliers keep its force instead of its pressure
  [[nodiscard]] std::vector<PointMemory> recall(const std::vector<ContactPoint>& points, double bond_distance,
                                                bool keep_forces = false) const;

  /// Memory of exactly the stored points, with vectors in the tangent planes of these normals.
  [[nodiscard]] std::vector<PointMemory> of_same(const std::vector<ContactPoint>& points) const;

  /// Replaces the memory. @param deepest largest penetration of the step, m. @param held energy of the springs at its
  /// end
  /// @param turned faces with friction torque in the step before
  void store(const std::vector<ContactPoint>& points, std::vector<PointMemory> memory, double deepest,
             const SpringEnergy& held, double bulge = 0.0, std::vector<PressureCut> cuts = {},
             const std::vector<FacePair>& turned = {});

  /// Starts a load level: slip of the last one becomes permanent.
  void start_level();

  /// Sets the multipliers to zero.
  void drop_multipliers();

  /// Moves the remembered points in block a, or in b, if its material coordinates are those of a step's start.
  void carry(bool of_a, const std::function<Vector3(const Vector3&)>& moved);

  /// Largest penetration of the last step, m, >= 0.
  [[nodiscard]] double deepest() const { return deepest_; }
  /// Largest separation of the surfaces by dilation or at a bond in tension, m, >= 0: blocks touch across such gaps.
  [[nodiscard]] double most_dilation() const { return most_dilation_; }
  /// Possible additional depth between the points, m, >= 0.
  [[nodiscard]] double bulge() const { return bulge_; }
  /// Spring energy at the end of the last step; zero without contact.
  [[nodiscard]] const SpringEnergy& held() const { return held_; }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// True if there was no contact in the last step.
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] const std::vector<PressureCut>& cuts() const { return cuts_; }
  /// Faces with friction torque in the last step, in order: the mean of the unit directions of friction over the area
  /// was shorter than 0.7 when all of their closed points slid, and has been shorter than 0.95 since.
  [[nodiscard]] const std::vector<FacePair>& turning() const { return turning_; }

 private:
  /// Material coordinates of all entries, (3, #entries).
  struct Places {
    Eigen::Matrix3Xd of_a;
    Eigen::Matrix3Xd of_b;
  };
  struct Found {
    PointMemory memory;
    int only_source = -1;  ///< index of its only source entry, -1 if there are several
  };
  [[nodiscard]] Places places() const;
  /// Squared distance of each entry from a new point, in the nearer of the two materials, m^2; infinite for excluded
  /// entries.
  /// @return (#entries)
  [[nodiscard]] Eigen::RowVectorXd squared_distances(const ContactPoint& point, const Places& places,
                                                     bool same_faces) const;
  /// Weighted mean of the memory of the nearest old points, including those at most half as far again with a weight
  /// that decreases with the distance; intact if more than half of the weight is. Slivers, points of less than a
  /// millionth of the largest area, are excluded.
  [[nodiscard]] std::optional<Found> near(const ContactPoint& point, const Places& places,
                                          bool same_faces) const;

  std::vector<Entry> entries_;
  std::vector<PressureCut> cuts_;
  std::vector<FacePair> turning_;
  double deepest_ = 0.0;
  double bulge_ = 0.0;
  SpringEnergy held_;
  double squared_reach_ = 0.0;  ///< area of all entries, m^2
  double largest_area_ = 0.0;   ///< of an entry, m^2
  double most_dilation_ = 0.0;  ///< of an entry, m
};

}  // namespace ashlar
