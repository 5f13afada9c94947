// A scene run to its end, with the last values of its history.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/run/run.hpp"

namespace ashlar::test {

inline LoadedScene loaded_scene(const std::string& text) {
  Diagnostics faults;
  auto scene = load_scene_text(text, "test.toml", {}, faults);
  if (!scene) throw std::invalid_argument(to_string(faults.sorted().front()));
  return std::move(*scene);
}

/// Message of the first fault of a scene; empty: it has none.
inline std::string first_fault(const std::string& text) {
  Diagnostics faults;
  (void)load_scene_text(text, "test.toml", {}, faults);
  return faults.good() ? "" : to_string(faults.sorted().front());
}

class EndedRun {
 public:
  explicit EndedRun(const std::string& text) : run_(loaded_scene(text)) {
    while (run_.step()) {
    }
  }

  [[nodiscard]] const Run& run() const { return run_; }

  /// Value of a column in the last row.
  [[nodiscard]] double last(const std::string& column) const {
    const std::vector<std::string> columns = run_.columns();
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end()) throw std::out_of_range(column);
    return run_.rows().back().at(static_cast<std::size_t>(found - columns.begin()));
  }

 private:
  ashlar::Run run_;
};

}  // namespace ashlar::test
