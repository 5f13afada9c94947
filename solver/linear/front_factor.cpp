#include "solver/linear/front_factor.hpp"

#include <algorithm>

#include "geometry/index.hpp"
#include "solver/linear/blas_threads.hpp"
#include "solver/linear/dense_kernels.hpp"

namespace ashlar {

template <class T>
FrontFactor<T>::FrontFactor(const FrontTree& tree)
    : tree_(tree),
      factor_tasks_(factor_tasks(tree)),
      solution_tasks_(solution_tasks(tree)),
      panels_(tree.panel_values),
      kept_(tree.kept_values),
      vectors_(tree.vector_values),
      middle_(tree.size()) {}

template <class T>
void FrontFactor<T>::prepare_rooms(int threads) {
  while (static_cast<int>(rooms_.size()) < threads)
    rooms_.push_back({{AlignedValues<T>(tree_.stack_values[0]), AlignedValues<T>(tree_.stack_values[1])},
                      AlignedValues<T>(at(tree_.largest_front))});
}

template <class T>
bool FrontFactor<T>::factorize(const SymmetricMatrix& matrix, int threads) {
  prepare_rooms(threads);
  failed_ = false;
  factor_tasks_.graph.run(threads, [&](int task, int worker) {
    if (failed_.load(std::memory_order_relaxed)) return;
    const OneThreadBlas use;
    run(factor_tasks_.tasks[at(task)], matrix, rooms_[at(worker)]);
  });
  return !failed_;
}

template <class T>
void FrontFactor<T>::run(const FactorTask& task, const SymmetricMatrix& matrix, const Room& room) {
  if (task.step == FactorStep::part) {
    const TreePart& part = tree_.parts[at(task.index)];
    for (int k = part.first; k <= part.last && !failed_.load(std::memory_order_relaxed); ++k)
      eliminate_front(tree_.fronts[at(k)], matrix, room);
    return;
  }
  const Front& front = tree_.fronts[at(task.index)];
  switch (task.step) {
    case FactorStep::assemble:
      return assemble(front, values_of(front, task.tile, true, room), matrix, room);
    case FactorStep::eliminate:
      return eliminate(front.panels[at(task.panel)]);
    case FactorStep::update:
      return update(front, front.panels[at(task.panel)], values_of(front, task.tile, true, room), true);
    case FactorStep::finish:
      return finish(front.panels[at(task.panel)]);
    case FactorStep::part:
    case FactorStep::join:
      return;
  }
}

template <class T>
void FrontFactor<T>::eliminate_front(const Front& front, const SymmetricMatrix& matrix, const Room& room) {
  const int tiles = tiles_of(front, false);
  for (int t = 0; t < tiles; ++t) assemble(front, values_of(front, t, false, room), matrix, room);
  for (int p = 0; p < static_cast<int>(front.panels.size()); ++p) {
    const FrontPanel& panel = front.panels[at(p)];
    eliminate(panel);
    if (failed_.load(std::memory_order_relaxed)) return;
    for (int t = p + 1; t < tiles; ++t) update(front, panel, values_of(front, t, false, room), false);
    finish(panel);
  }
}

template <class T>
T* FrontFactor<T>::update_of(const Front& front, const Room& room) const {
  return (front.kept ? kept_.data() : room.stacks[front.stack].data()) + front.update;
}

template <class T>
typename FrontFactor<T>::TileValues FrontFactor<T>::values_of(const Front& front, int tile, bool shared,
                                                              const Room& room) const {
  const FrontTile columns = tile_of(front, tile, shared);
  if (columns.start < front.pivots)
    return {columns, panel_of(front.panels[at(tile)]), front.panels[at(tile)].rows};
  const std::ptrdiff_t diagonal = columns.start - front.pivots;
  return {columns, update_of(front, room) + diagonal * front.below + diagonal, front.below};
}

namespace {

/// Adds a block of the matrix to a tile. @param tile with `columns` and `column`
template <class Tile>
void add_block(const FrontBlock& block, const Tile& tile, const SymmetricMatrix& matrix) {
  // Columns of the tile, from the first one of the block on.
  const int from = std::max(tile.columns.start - block.column, 0);
  const int end = std::min(tile.columns.end - block.column, block.transposed ? block.height : block.width);
  const auto values_of = [&](int c) {
    // A column's rows begin at its diagonal, so that those of a block are c places nearer.
    return matrix.values.data() + matrix.column_start[at(block.matrix_column + c)] + block.place - c;
  };
  using T = std::remove_reference_t<decltype(*tile.column(0))>;
  if (block.transposed) {
    if (from >= end) return;
    for (int c = 0; c < block.width; ++c)
      for (int k = from; k < end; ++k)
        tile.column(block.column + k)[block.row + c] += static_cast<T>(values_of(c)[k]);
    return;
  }
  for (int c = from; c < end; ++c) {
    T* const column = tile.column(block.column + c) + block.row;
    for (int k = block.place == 0 ? c : 0; k < block.height; ++k)
      column[k] += static_cast<T>(values_of(c)[k]);
  }
}

template <class T>
void add(T* to, const T* from, int length) {
  for (int k = 0; k < length; ++k) to[k] += from[k];
}

template <class T>
void subtract(T* to, const T* from, int length) {
  for (int k = 0; k < length; ++k) to[k] -= from[k];
}

}  // namespace

template <class T>
void FrontFactor<T>::assemble(const Front& front, const TileValues& tile, const SymmetricMatrix& matrix,
                              const Room& room) const {
  for (int c = tile.columns.start; c < tile.columns.end; ++c)
    std::fill(tile.column(c) + c, tile.column(c) + front.size(), T{0});
  if (tile.columns.start < front.pivots)
    for (const FrontBlock& block : front.blocks) add_block(block, tile, matrix);
  for (const int child : front.children) add_child(tree_.fronts[at(child)], tile, room);
}

template <class T>
void FrontFactor<T>::add_child(const Front& child, const TileValues& tile, const Room& room) const {
  const T* const values = update_of(child, room);
  for (auto run = child.in_parent.begin(); run != child.in_parent.end(); ++run) {
    const int from = std::max(tile.columns.start, run->to);
    const int end = std::min(tile.columns.end, run->to + run->length);
    for (int to = from; to < end; ++to) {
      const int c = to - run->to + run->from;
      const T* const source = values + std::ptrdiff_t{c} * child.below;
      T* const column = tile.column(to);
      add(column + to, source + c, run->from + run->length - c);
      for (auto other = run + 1; other != child.in_parent.end(); ++other)
        add(column + other->to, source + other->from, other->length);
    }
  }
}

template <class T>
void FrontFactor<T>::eliminate(const FrontPanel& panel) {
  T* const values = panel_of(panel);
  if (!factorize_triangle(panel.width, values, panel.rows)) {
    failed_.store(true, std::memory_order_relaxed);
    return;
  }
  divide_by_triangle(panel.rows - panel.width, panel.width, values, panel.rows, false, values + panel.width,
                     panel.rows);
}

template <class T>
void FrontFactor<T>::update(const Front& front, const FrontPanel& panel, const TileValues& tile,
                            bool shared) const {
  // Rows of the panel from the tile's diagonal down.
  const T* const rows = panel_of(panel) + tile.columns.start - panel.start;
  const int width = tile.columns.end - tile.columns.start;
  if (!shared && tile.columns.start >= front.pivots)
    return subtract_square(width, panel.width, rows, panel.rows, T{1}, tile.first, tile.distance);
  subtract_product(front.size() - tile.columns.start, width, panel.width, rows, panel.rows, rows, panel.rows,
                   tile.first, tile.distance);
}

template <class T>
void FrontFactor<T>::finish(const FrontPanel& panel) const {
  T* const values = panel_of(panel);
  divide_by_triangle(panel.rows - panel.width, panel.width, values, panel.rows, true, values + panel.width,
                     panel.rows);
  invert_triangle(panel.width, values, panel.rows);
  for (int c = 1; c < panel.width; ++c) {
    T* const column = values + std::ptrdiff_t{c} * panel.rows;
    std::fill(column, column + c, T{0});
  }
}

template <class T>
void FrontFactor<T>::solve(Vector& x, int threads) {
  prepare_rooms(threads);
  solution_tasks_.graph.run(threads, [&](int task, int worker) {
    const OneThreadBlas use;
    run(solution_tasks_.tasks[at(task)], x, rooms_[at(worker)]);
  });
}

template <class T>
void FrontFactor<T>::run(const SolutionTask& task, Vector& x, const Room& room) {
  if (task.step == SolutionStep::forward) {
    const TreePart& part = tree_.parts[at(task.index)];
    for (int k = part.first; k <= part.last; ++k) {
      const Front& front = tree_.fronts[at(k)];
      start_forward(front, x);
      for (const FrontPanel& panel : front.panels) forward_rows(front, panel, 0, panel.rows, x, room);
    }
    return;
  }
  if (task.step == SolutionStep::backward) {
    const TreePart& part = tree_.parts[at(task.index)];
    for (int k = part.last; k >= part.first; --k) {
      const Front& front = tree_.fronts[at(k)];
      start_backward(front, x);
      for (std::size_t p = front.panels.size(); p-- > 0;)
        backward_columns(front, front.panels[p], 0, front.panels[p].width, x);
    }
    return;
  }
  const Front& front = tree_.fronts[at(task.index)];
  switch (task.step) {
    case SolutionStep::forward_start:
      return start_forward(front, x);
    case SolutionStep::forward_rows:
      return forward_rows(front, front.panels[at(task.panel)], task.first, task.end, x, room);
    case SolutionStep::backward_start:
      return start_backward(front, x);
    case SolutionStep::backward_columns:
      return backward_columns(front, front.panels[at(task.panel)], task.first, task.end, x);
    case SolutionStep::forward:
    case SolutionStep::backward:
      return;
  }
}

template <class T>
void FrontFactor<T>::start_forward(const Front& front, Vector& x) const {
  T* const pivots = x.data() + front.start;
  T* const below = vectors_.data() + front.vector + front.pivots;
  std::fill(below, below + front.below, T{0});
  for (const int index : front.children) {
    const Front& child = tree_.fronts[at(index)];
    const T* const values = vectors_.data() + child.vector + child.pivots;
    for (const RowRun& run : child.in_parent) {
      const int of_pivots = std::clamp(front.pivots - run.to, 0, run.length);
      add(pivots + run.to, values + run.from, of_pivots);
      if (of_pivots < run.length)
        add(below + run.to + of_pivots - front.pivots, values + run.from + of_pivots, run.length - of_pivots);
    }
  }
}

/// @param first,end rows of the panel
template <class T>
void FrontFactor<T>::forward_rows(const Front& front, const FrontPanel& panel, int first, int end, Vector& x,
                                  const Room& room) {
  T* const pivots = x.data() + front.start;
  T* const below = vectors_.data() + front.vector + front.pivots;
  T* const y = room.product.data();
  times_vector(end - first, panel.width, panel_of(panel) + first, panel.rows, false, pivots + panel.start,
               T{0}, y);
  // Rows of the triangle, of other pivots, and below.
  const int width = std::clamp(panel.width, first, end);
  const int rest = std::clamp(front.pivots - panel.start, first, end);
  std::copy(y, y + width - first, middle_.data() + front.start + panel.start + first);
  if (width < rest) subtract(pivots + panel.start + width, y + width - first, rest - width);
  if (rest < end) subtract(below + panel.start + rest - front.pivots, y + rest - first, end - rest);
}

template <class T>
void FrontFactor<T>::start_backward(const Front& front, const Vector& x) const {
  T* const below = vectors_.data() + front.vector + front.pivots;
  for (const RowRun& run : front.in_vector)
    for (int k = 0; k < run.length; ++k) below[run.from + k] = -x[run.to + k];
}

/// @param first,end columns of the panel
template <class T>
void FrontFactor<T>::backward_columns(const Front& front, const FrontPanel& panel, int first, int end,
                                      Vector& x) const {
  const T* const columns = panel_of(panel) + std::ptrdiff_t{first} * panel.rows;
  T* const negative = vectors_.data() + front.vector + panel.start;  // of the unknowns from the panel on
  T* const found = x.data() + front.start + panel.start + first;
  const T* const y = middle_.data() + front.start + panel.start;
  if (end - first == panel.width) {
    std::copy(y, y + panel.width, negative);
    times_vector(panel.rows, panel.width, columns, panel.rows, true, negative, T{0}, found);
  } else {  // Other tasks read and write the same unknowns. Above its diagonal a triangle is zero.
    times_vector(panel.width - first, end - first, columns + first, panel.rows, true, y + first, T{0}, found);
    times_vector(panel.rows - panel.width, end - first, columns + panel.width, panel.rows, true,
                 negative + panel.width, T{1}, found);
  }
  for (int c = first; c < end; ++c) negative[c] = -found[c - first];
}

template class FrontFactor<float>;
template class FrontFactor<double>;

}  // namespace ashlar
