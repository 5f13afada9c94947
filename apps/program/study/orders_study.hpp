// Error and cost of one block by its order.
#pragma once

#include "apps/program/study/study.hpp"

namespace ashlar {

/// Two problems for n = 1, 2, ...: the cantilever 8 x 3 x 1 under its own weight, whose clamped edges are
/// singular, and a notched block under the body force and tractions of a given smooth displacement,
/// polynomial times exponential. By problem and order: unknowns, relative error (of the tip; in the energy
/// norm), seconds.
[[nodiscard]] StudyResult study_orders();

/// The same with orders up to a given one, at least 5; only the largest order is checked against the required error.
[[nodiscard]] StudyResult study_orders_to(int most_order);

/// A run whose order, or whose step, is chosen for an accuracy. All relative.
struct ChosenRun {
  std::string name;
  double accuracy;  ///< asked for
  double error;     ///< true one
  double estimate;  ///< told by the run
};

}  // namespace ashlar
