// What contact points remember from step to step: elastic slip, state, multipliers, dilation and whether the joint
// is still intact. Memory belongs to material points, not to the step's polygons: a new point takes over from
// the nearest old one, nearest in the material of either block, or from all that are within half as near
// again: a new point in the middle of old ones has their mean, whichever rounding calls the nearest. Where
// the contact passes on to another face, over an edge that is not sharp, slip goes with it; a bond does not,
// as new surface is not bonded.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "mechanics/contact/contact_points.hpp"
#include "mechanics/contact/joint_law.hpp"
#include "mechanics/contact/spring_energy.hpp"

namespace ashlar {

/// Memory of one point after an accepted step.
struct PointMemory {
  Vector3 slip = Vector3::Zero();  ///< elastic slip of a relative to b, in the tangent plane, m
  ContactState state = ContactState::open;
  bool intact = false;             ///< joint strength not yet lost
  double normal_multiplier = 0.0;  ///< of augmented contact, Pa, of point springs N
  Vector3 shear_multiplier = Vector3::Zero();
  /// Normal impulse whose friction is still to act, of augmented contact, Pa s, of point springs N s
  double deferred_friction = 0.0;
  double compression = 0.0;  ///< depth below the normal spring's rest, m; negative: it is open
  /// Of a static analysis (solver/statics/static_analysis.hpp): what the trial slip would be if the blocks were where
  /// they were when the present load level began, m
  Vector3 level_slip = Vector3::Zero();
  bool in_level = false;  ///< whether it has been closed since then, or was: others have slipped nowhere yet
  double dilation = 0.0;  ///< by how much sliding has raised the rest of the normal spring, m, >= 0
  double level_dilation = 0.0;  ///< the same when the present load level began
};

/// Memory of a pair of blocks.
class ContactMemory {
 public:
  /// One remembered point: where it is in both materials, the faces it is between, how they lie.
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

  /// Memory for each of the new points, with vectors turned into the new tangent plane: that of the nearest
  /// old points of the same faces, or, if none of those is as near as the whole contact was wide, of any
  /// faces whose normals are within 60 degrees. Points without one start open, without slip, bonded by the
  /// joint's strength if their gap is at most `bond_distance`, m (minus infinity: never).
  /// @param keep_forces where one old point became one new one, multipliers hold the force instead of the
  /// pressure that they held there
  [[nodiscard]] std::vector<PointMemory> recall(const std::vector<ContactPoint>& points, double bond_distance,
                                                bool keep_forces = false) const;

  /// Memory of the very points that were stored, with vectors in the tangent planes of these normals.
  [[nodiscard]] std::vector<PointMemory> of_same(const std::vector<ContactPoint>& points) const;

  /// Replaces what is remembered. @param deepest largest penetration of the step, m. @param held by the
  /// springs at its end
  /// @param turned faces over which friction turned in the step before
  void store(const std::vector<ContactPoint>& points, std::vector<PointMemory> memory, double deepest,
             const SpringEnergy& held, double bulge = 0.0, std::vector<PressureCut> cuts = {},
             const std::vector<FacePair>& turned = {});

  /// Begins a load level: what slipped in the last one has slipped for good.
  void start_level();

  /// Forgets what multipliers held.
  void drop_multipliers();

  /// Moves the remembered points in block a, or in b, whose material coordinates are those of a step's start.
  void carry(bool of_a, const std::function<Vector3(const Vector3&)>& moved);

  /// Largest penetration of the last step, m, >= 0.
  [[nodiscard]] double deepest() const { return deepest_; }
  /// How far apart sliding has brought the surfaces where it did most, m, >= 0: blocks touch across such gaps.
  [[nodiscard]] double most_dilation() const { return most_dilation_; }
  /// How much deeper the blocks may be between the points, m, >= 0.
  [[nodiscard]] double bulge() const { return bulge_; }
  /// What store() was told of the last step; nothing where there was no contact.
  [[nodiscard]] const SpringEnergy& held() const { return held_; }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// Whether there was no contact in the last step.
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] const std::vector<PressureCut>& cuts() const { return cuts_; }
  /// Faces over which friction turned in the last step: the mean of its unit directions over the area was shorter than
  /// 0.7 when all of their closed points slid, and shorter than 0.95 since. In order.
  [[nodiscard]] const std::vector<FacePair>& turning() const { return turning_; }

 private:
  /// Material coordinates of all entries, (3, #entries).
  struct Places {
    Eigen::Matrix3Xd of_a;
    Eigen::Matrix3Xd of_b;
  };
  struct Found {
    PointMemory memory;
    int only_source = -1;  ///< the entry it is the memory of, -1 if there are several
  };
  [[nodiscard]] Places places() const;
  /// Of each entry from a new point, in the nearer of the two materials, m^2; infinite where it is not asked.
  /// @return (#entries)
  [[nodiscard]] Eigen::RowVectorXd squared_distances(const ContactPoint& point, const Places& places,
                                                     bool same_faces) const;
  /// Mean memory of the nearest old points, those within half as near again counting the less the farther
  /// they are; intact where most of it is. Slivers, points of less than a millionth of the largest area,
  /// are not asked.
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
