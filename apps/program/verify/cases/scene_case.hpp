// Verification cases as data: scenes, and tables of what to measure in them and what is right.
//
// A folder of cases holds scenes and one cases.toml; its subfolders may be such folders too. In cases.toml each table
// is a case, in the order of the file:
//
//   [limit-plane]
//   about = "limit analysis: factor of safety of a block on a plane"
//   reference = "F = (W cos(alpha) tan(phi) + c A) / (W sin(alpha))"
//   source = "limit equilibrium"
//   scene = "limit_plane.toml"
//   vary = [{ alpha = [30, 50], phi = 25, "analysis.integrator" = "dda" }]
//   define = { W = "= 2500*9.81", A = 2.0 }
//   check = [{ what = "factor of safety", value = "middle(summary.factor_of_safety)", expect = "W*...", relative = 1e-3 }]
//
// - vary: each entry is a set of variants, one for each combination of its values. A name is a parameter of the scene;
//   a path with dots is a key, as for `--set`. Without it there is one variant, the scene as it is.
// - define: numbers and formulas ("= ...") of each other, of the scene's parameters and of the varied ones.
// - check: `value` is an expression of results (case_expression.hpp). It is compared with `expect`, `at_least` or
//   `at_most`, an expression of the names above, within `relative` or `absolute`, a number or an expression; or with
//   the text `is`. With `when`, only in variants for which that expression is not zero.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/toml/formulas.hpp"

namespace ashlar {

/// An expression of a table of cases.
struct CaseText {
  std::string text;
  Place place;
  [[nodiscard]] bool given() const { return !text.empty(); }
};

/// One variant of a case.
struct CaseVariant {
  std::vector<std::string> overrides;  ///< "key.path=value" each
  std::string label;                   ///< "alpha 30, phi 25"; empty: the scene as it is
  Formulas names;                      ///< parameters of the scene, varied values and definitions
};

/// One comparison in each variant.
struct CaseCheck {
  enum class Kind { equal, at_least, at_most, is };
  Place place;
  std::string what;
  CaseText value;
  Kind kind = Kind::equal;
  CaseText expected;  ///< for `is` the text itself
  bool relative = true;
  CaseText tolerance;
  CaseText when;  ///< not given: always
};

struct SceneCase {
  std::string name;
  std::string about;
  std::string reference;  ///< in words
  std::string source;     ///< of the reference
  std::filesystem::path scene;
  Place place;
  std::vector<CaseVariant> variants;
  std::vector<CaseCheck> checks;
};

/// Reads the cases of a folder, then those of its subfolders in the order of their names. Each fault is reported at its
/// place: unknown keys, a case without scene or checks, names used twice, formulas without value, a scene that cannot be
/// parsed, a folder without cases.
[[nodiscard]] std::vector<SceneCase> read_cases(const std::filesystem::path& folder,
                                                Diagnostics& diagnostics);

/// Folder of the cases that the program brings along: share/ashlar/verification beside that of the executable. Empty:
/// there is none
[[nodiscard]] std::filesystem::path own_cases();

}  // namespace ashlar
