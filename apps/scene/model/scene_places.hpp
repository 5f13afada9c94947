// Place of each key of a scene, so that later faults refer to its line.
#pragma once

#include <map>
#include <string>

#include "apps/scene/model/diagnostics.hpp"

namespace ashlar {

/// Places of the keys that were given (defaults have none). A key is named by its path: tables and keys
/// joined by dots, entries of arrays of tables by their 0-based index: "analysis.time_step",
/// "block.0.fix.1.plane".
class ScenePlaces {
 public:
  /// Both places of one key: of its name and of its value. A [[table]] header is the place of its entry.
  struct KeyPlaces {
    Place key;
    Place value;
  };

  void record(const std::string& path, KeyPlaces places) { places_[path] = std::move(places); }
  [[nodiscard]] bool contains(const std::string& path) const { return places_.contains(origin_of(path)); }
  /// Place of the key's name, or of the innermost given table around it; the scene's start if there is none.
  [[nodiscard]] Place key(const std::string& path) const { return find(path).key; }
  /// The same for the key's value.
  [[nodiscard]] Place value(const std::string& path) const { return find(path).value; }
  /// Records that `path` was written at another one: the places of "block.7" and its keys are then those of
  /// "masonry.0" and its keys, except those recorded under their own path. An origin may have an origin of its own;
  /// cycles are not allowed.
  void record_origin(const std::string& path, std::string origin) { origins_[path] = std::move(origin); }
  /// Removes the origin of a path.
  void remove_origin(const std::string& path) { origins_.erase(path); }
  /// Moves the places of a list's entries, and their origins: entries recorded as "block.3.box" become
  /// "FOLDER.3.box".
  void move_list(const std::string& list, const std::string& folder);
  /// All given keys by path.
  [[nodiscard]] const std::map<std::string, KeyPlaces>& all() const { return places_; }

 private:
  [[nodiscard]] KeyPlaces find(std::string path) const;
  /// Path at which a key was written.
  [[nodiscard]] std::string origin_of(std::string path) const;

  std::map<std::string, KeyPlaces> places_;     ///< "" is the start of the scene
  std::map<std::string, std::string> origins_;  ///< paths written elsewhere
};

}  // namespace ashlar
