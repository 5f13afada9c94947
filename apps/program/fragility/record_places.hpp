// Places of a scene that records of ground motion enter: each acceleration_history whose rows come from a file,
//
//   acceleration_history = { file = "any.AT2", values = ["a", "", ""], scale = "g" }
//
// of supports of blocks and stages. A record takes the place of `file`, and a factor multiplies `scale`; the other keys are
// kept: components, columns, baseline, interval of rows. All places have the same file, as a base moves as a whole.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

struct RecordPlaces {
  struct Table {
    std::string path;   ///< "block.0.fix.1.acceleration_history"
    std::string scale;  ///< as written: "1", "g", "= g"
  };
  std::vector<Table> tables;
  bool resampled = false;  ///< rows have equal intervals, whatever those of the file

  /// Overrides (--set) with which a scene has a record times a factor.
  /// @param file relative to the folder of the scene, or absolute
  [[nodiscard]] std::vector<std::string> overrides(const std::filesystem::path& file, double factor) const;
};

/// @param document with overrides applied. @param scene its file. Reported: no such place, which are needed; places with
/// different files
[[nodiscard]] RecordPlaces record_places(const toml::table& document, const std::filesystem::path& scene,
                                         Diagnostics& diagnostics);

/// The first support of a scene whose acceleration comes from a file; null: none.
[[nodiscard]] const SceneFix* record_support(const Scene& scene);

}  // namespace ashlar
