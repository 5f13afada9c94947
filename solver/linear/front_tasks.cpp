#include "solver/linear/front_tasks.hpp"

#include <algorithm>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Columns of the update of a shared front that one task computes.
constexpr int update_columns = 96;
/// Parts of a panel for the tasks of a solution: 10 to 20 microseconds.
constexpr int solution_rows = 512;
constexpr int solution_columns = 24;

int panels_of(const Front& front) {
  return static_cast<int>(front.panels.size());
}

std::vector<int> without_repetitions(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

class FactorPlan {
 public:
  explicit FactorPlan(const FrontTree& tree) : tree_(tree) {}

  FactorTasks make() {
    std::vector<int> end(tree_.fronts.size());  // task that ends the front
    for (std::size_t p = 0; p < tree_.parts.size(); ++p) {
      const TreePart& part = tree_.parts[p];
      std::vector<int> after;
      double work = 0.0;
      for (int k = part.first; k <= part.last; ++k) {
        work += tree_.fronts[at(k)].work;
        for (const int child : tree_.fronts[at(k)].children)
          if (child < part.first) after.push_back(end[at(child)]);
      }
      after = without_repetitions(after);  // subtrees of one part have the same task
      const int last = part.shared ? add_shared(part.first, after)
                                   : add(work, after, {FactorStep::part, static_cast<int>(p)});
      std::fill(end.begin() + part.first, end.begin() + part.last + 1, last);
    }
    return std::move(result_);
  }

 private:
  int add(double cost, const std::vector<int>& after, const FactorTask& task) {
    result_.tasks.push_back(task);
    return result_.graph.add(cost, after);
  }

  /// Each tile gets the panels to its left in order. @return task after which the update is complete
  int add_shared(int index, const std::vector<int>& children) {
    const Front& front = tree_.fronts[at(index)];
    const int tiles = tiles_of(front, true);
    const auto values_of = [&](int t) {
      const FrontTile tile = tile_of(front, t, true);
      return static_cast<double>(tile.end - tile.start) * (front.size() - tile.start);
    };
    std::vector<int> last;  // task of each tile
    for (int t = 0; t < tiles; ++t)
      last.push_back(add(2.0 * values_of(t), children, {FactorStep::assemble, index, 0, t}));
    for (int p = 0; p < panels_of(front); ++p) {
      const double width = front.panels[at(p)].width;
      const int eliminated = add(width * values_of(p), {last[at(p)]}, {FactorStep::eliminate, index, p, p});
      std::vector<int> readers = {eliminated};
      for (int t = p + 1; t < tiles; ++t) {
        last[at(t)] = add(width * values_of(t), {eliminated, last[at(t)]}, {FactorStep::update, index, p, t});
        readers.push_back(last[at(t)]);
      }
      add(width * values_of(p), readers, {FactorStep::finish, index, p, p});
      last[at(p)] = eliminated;
    }
    return add(0.0, last, {FactorStep::join, index});
  }

  const FrontTree& tree_;
  FactorTasks result_;
};

class SolutionPlan {
 public:
  explicit SolutionPlan(const FrontTree& tree)
      : tree_(tree), part_of_(tree.fronts.size()), forward_(tree.parts.size()), backward_(tree.parts.size()) {
    for (std::size_t p = 0; p < tree.parts.size(); ++p)
      for (int k = tree.parts[p].first; k <= tree.parts[p].last; ++k) part_of_[at(k)] = p;
  }

  SolutionTasks make() {
    for (std::size_t p = 0; p < forward_.size(); ++p) {
      std::vector<int> after;
      each_front(p, [&](const Front& front) {
        for (const int child : front.children)
          if (part_of_[at(child)] != p) append(after, forward_[part_of_[at(child)]]);
      });
      forward_[p] = add_forward(p, without_repetitions(after));
    }
    for (std::size_t p = forward_.size(); p-- > 0;) {
      std::vector<int> after = forward_[p];
      each_front(p, [&](const Front& front) {
        if (front.parent >= 0 && part_of_[at(front.parent)] != p)
          append(after, backward_[part_of_[at(front.parent)]]);
      });
      backward_[p] = add_backward(p, without_repetitions(after));
    }
    return std::move(result_);
  }

 private:
  static void append(std::vector<int>& tasks, const std::vector<int>& others) {
    tasks.insert(tasks.end(), others.begin(), others.end());
  }
  template <class Visit>
  void each_front(std::size_t part, const Visit& visit) const {
    for (int k = tree_.parts[part].first; k <= tree_.parts[part].last; ++k) visit(tree_.fronts[at(k)]);
  }
  int add(double cost, const std::vector<int>& after, const SolutionTask& task) {
    result_.tasks.push_back(task);
    return result_.graph.add(cost, after);
  }
  [[nodiscard]] double values_of(std::size_t part) const {
    double values = 0.0;
    each_front(part, [&](const Front& front) { values += static_cast<double>(front.pivots) * front.size(); });
    return values;
  }
  /// Adds a task for each group of a panel's rows or columns. @return the tasks
  std::vector<int> add_groups(int index, int p, SolutionStep step, const std::vector<int>& after) {
    const FrontPanel& panel = tree_.fronts[at(index)].panels[at(p)];
    const bool of_rows = step == SolutionStep::forward_rows;
    const int count = of_rows ? panel.rows : panel.width;
    const int most = of_rows ? solution_rows : solution_columns;
    const int groups = (count + most - 1) / most;
    std::vector<int> tasks;
    for (int k = 0; k < groups; ++k)
      tasks.push_back(add(static_cast<double>(panel.rows) * panel.width / groups, after,
                          {step, index, p, count * k / groups, count * (k + 1) / groups}));
    return tasks;
  }
  /// @return the tasks after which the part is done
  std::vector<int> add_forward(std::size_t part, const std::vector<int>& after) {
    const int index = tree_.parts[part].first;
    if (!tree_.parts[part].shared)
      return {add(values_of(part), after, {SolutionStep::forward, static_cast<int>(part)})};
    const Front& front = tree_.fronts[at(index)];
    std::vector<int> last = {add(front.size(), after, {SolutionStep::forward_start, index})};
    for (int p = 0; p < panels_of(front); ++p) last = add_groups(index, p, SolutionStep::forward_rows, last);
    return last;
  }
  std::vector<int> add_backward(std::size_t part, const std::vector<int>& after) {
    const int index = tree_.parts[part].first;
    if (!tree_.parts[part].shared)
      return {add(values_of(part), after, {SolutionStep::backward, static_cast<int>(part)})};
    const Front& front = tree_.fronts[at(index)];
    std::vector<int> last = {add(front.size(), after, {SolutionStep::backward_start, index})};
    for (int p = panels_of(front); p-- > 0;)
      last = add_groups(index, p, SolutionStep::backward_columns, last);
    return last;
  }

  const FrontTree& tree_;
  std::vector<std::size_t> part_of_;                  ///< of each front
  std::vector<std::vector<int>> forward_, backward_;  ///< tasks that end each part
  SolutionTasks result_;
};

}  // namespace

int tiles_of(const Front& front, bool shared) {
  const int columns = shared ? update_columns : std::max(front.below, 1);
  return panels_of(front) + (front.below + columns - 1) / columns;
}

FrontTile tile_of(const Front& front, int tile, bool shared) {
  if (tile < panels_of(front)) {
    const FrontPanel& panel = front.panels[at(tile)];
    return {panel.start, panel.start + panel.width};
  }
  if (!shared) return {front.pivots, front.size()};
  const int start = front.pivots + update_columns * (tile - panels_of(front));
  return {start, std::min(start + update_columns, front.size())};
}

FactorTasks factor_tasks(const FrontTree& tree) {
  return FactorPlan(tree).make();
}

SolutionTasks solution_tasks(const FrontTree& tree) {
  return SolutionPlan(tree).make();
}

}  // namespace ashlar
