// The tasks of a factor over a tree of fronts, and of a solution with it. They depend on the tree only, so that all sums have
// one order on any number of threads. Wide fronts near the roots are shared by several tasks.
#pragma once

#include <vector>

#include "solver/linear/front_tree.hpp"
#include "solver/task_graph.hpp"

namespace ashlar {

/// Work of a task of the factor.
enum class FactorStep {
  part,       ///< all of the fronts of a part
  assemble,   ///< of a shared front: the values of a tile, from the matrix and the children
  eliminate,  ///< of a shared front: a panel
  update,     ///< of a shared front: a tile by an eliminated panel to its left
  finish,     ///< of a shared front: a panel as solutions need it
  join,       ///< of a shared front: its update is complete
};

struct FactorTask {
  FactorStep step;
  int index;      ///< of the part or front
  int panel = 0;  ///< of the front
  int tile = 0;   ///< of the front
};

struct FactorTasks {
  TaskGraph graph;
  std::vector<FactorTask> tasks;
};

/// Columns that are updated together: panels of the pivots, then columns of the update, all at once or in groups.
struct FrontTile {
  int start, end;  ///< columns of the front
};
[[nodiscard]] int tiles_of(const Front& front, bool shared);
[[nodiscard]] FrontTile tile_of(const Front& front, int tile, bool shared);

[[nodiscard]] FactorTasks factor_tasks(const FrontTree& tree);

/// Work of a task of a solution.
enum class SolutionStep {
  forward,           ///< all of the fronts of a part, upward
  backward,          ///< the same, downward
  forward_start,     ///< of a shared front: the updates of its children
  forward_rows,      ///< of a shared front: rows of a panel
  backward_start,    ///< of a shared front: the unknowns below
  backward_columns,  ///< of a shared front: columns of a panel
};

struct SolutionTask {
  SolutionStep step;
  int index;               ///< of the part or front
  int panel = 0;           ///< of the front
  int first = 0, end = 0;  ///< rows or columns of the panel
};

struct SolutionTasks {
  TaskGraph graph;
  std::vector<SolutionTask> tasks;
};

[[nodiscard]] SolutionTasks solution_tasks(const FrontTree& tree);

}  // namespace ashlar
