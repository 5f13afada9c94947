// All laws of joints of a scene, for checks of keys that exclude each other.
#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Tables of joints that act together, and the law that they result in.
struct JointTablePath {
  std::vector<std::string>
      paths;  ///< as in ScenePlaces, the last entry of the scene first; [contact] alone or not at all
  SceneJointLaw law;
};

/// Path of the first key of this name in [contact], [[joint]] and [[stage.joint]], as in ScenePlaces; empty: none is given.
[[nodiscard]] std::optional<std::string> first_given(const Scene& scene, const std::string& key);

/// [contact], each [[joint]] and [[stage.joint]] over it, and those that match the same pairs of blocks together, as far as
/// each has been reached.
[[nodiscard]] std::vector<JointTablePath> tables_of_joints(const Scene& scene);

/// Faults of laws, each reported once.
class JointFaults {
 public:
  JointFaults(const Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}
  /// Reports at the first of the keys that is given in the last table that has one; nowhere if none has.
  /// @param at_value true: at its value
  void report(const JointTablePath& table, std::initializer_list<const char*> keys,
              const std::string& message, bool at_value = false);

 private:
  const Scene& scene_;
  Diagnostics& diagnostics_;
  std::set<std::string> reported_;
};

}  // namespace ashlar
