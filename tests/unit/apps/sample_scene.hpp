// A small good scene whose lines tests replace one at a time: the line of a fault is then the number given,
// and its column can be counted in the text given.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/model/diagnostics.hpp"

namespace ashlar::test {

inline const std::vector<std::string> sample_lines = {
    /*  1 */ "[analysis]",
    /*  2 */ "end_time = 1.0",
    /*  3 */ "time_step = 0.01",
    /*  4 */ "[contact]",
    /*  5 */ "friction_angle = 30",
    /*  6 */ "[[joint]]",
    /*  7 */ "blocks = [\"A\", \"B*\"]",
    /*  8 */ "[[material]]",
    /*  9 */ "name = \"rock\"",
    /* 10 */ "density = 2500",
    /* 11 */ "young_modulus = 1e9",
    /* 12 */ "poisson_ratio = 0.25",
    /* 13 */ "[[block]]",
    /* 14 */ "name = \"A\"",
    /* 15 */ "material = \"rock\"",
    /* 16 */ "box = { min = [0, 0, 1], max = [1, 1, 2] }",
    /* 17 */ "[[block]]",
    /* 18 */ "name = \"B\"",
    /* 19 */ "material = \"rock\"",
    /* 20 */ "box = { min = [0, 0, 0], max = [4, 1, 1] }",
    /* 21 */ "[[block.fix]]",
    /* 22 */ "plane = { point = [0, 0, 0], normal = [-1, 0, 0] }",
    /* 23 */ "[[block.load]]",
    /* 24 */ "plane = { point = [4, 0, 0], normal = [1, 0, 0] }",
    /* 25 */ "traction = [0, 0, -1e5]",
    /* 26 */ "[[measure]]",
    /* 27 */ "name = \"tip\"",
    /* 28 */ "block = \"B\"",
    /* 29 */ "point = [4, 0.5, 0.5]",
    /* 30 */ "[output]",
    /* 31 */ "every = 5",
};

/// The sample with one line (1-based) replaced; the replacement may have several lines or be empty.
inline std::string sample_with(int line, const std::string& replacement) {
  std::string text;
  for (int i = 1; i <= static_cast<int>(sample_lines.size()); ++i)
    text += (i == line ? replacement : sample_lines[static_cast<std::size_t>(i - 1)]) + "\n";
  return text;
}

inline std::string sample() {
  return sample_with(0, "");
}

/// One replaced line and how its only fault begins.
struct FaultCase {
  int line;
  std::string replacement;
  std::string expected;  ///< beginning of the printed fault

  friend void PrintTo(const FaultCase& fault, std::ostream* stream) { *stream << fault.replacement; }
};

/// All faults as printed.
inline std::vector<std::string> printed(const Diagnostics& diagnostics) {
  std::vector<std::string> lines;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) lines.push_back(to_string(diagnostic));
  return lines;
}

/// Faults that reading alone finds in a text called "s.toml".
inline std::vector<std::string> reading_faults(const std::string& text,
                                               const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  (void)parse_scene(text, "s.toml", overrides, diagnostics);
  return printed(diagnostics);
}

}  // namespace ashlar::test
