// Expressions of results in checks of verification cases.
//
// Formulas (formulas.hpp) with, besides the names of the case,
//   cube.uz, time            a column of history.csv: its last value
//   'stone 1.uz'             the same, of a name with other characters
//   summary.energy_max       a number of summary.json (json_path.hpp); true is 1, false 0, null none. Vectors and places
//                            there are those of the scene that is run, also if it is placed (scene_case_run.hpp)
//   known(e)                 1 if the results in it have values, otherwise 0
//   middle(summary.factor_of_safety)  geometric mean of `lower` and `upper` of a bracket
// and functions over the rows of the history, of expressions in which columns are those of the row:
//   first(e), last(e)        in the first and last row
//   largest(e), smallest(e)  extremum; largest(e, from, to): of the rows between two times, s
//   mean(e, from, to)        over time, trapezoidal
//   hann(e, from, to)        the same weighted by Hann's window, which removes oscillations of several periods
//   at(e, t)                 at a time, linear between rows
//   crossing(e, k)           time of the k-th change of sign, linear between rows
//   before(e)                e in the row before
//   rising(e, c, k)          e in the row in which c changes to above zero for the k-th time
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program/verify/cases/scene_case.hpp"

namespace ashlar {

/// Results of a run.
struct CaseResults {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< (#rows x #columns)
  nlohmann::ordered_json summary;
};

/// The value of an expression. Rows in which a part of it has no value (the opening of a pair without points) are left
/// out by functions over rows. @return nan if a result in it has no value
/// @throws FormulaError with an offset in the text: an unknown name, a malformed text, a time outside the run
[[nodiscard]] double value_of(const std::string& text, const Formulas& names, const CaseResults& results);

}  // namespace ashlar
