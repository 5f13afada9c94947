// Norms, sums and decisions of the equations of an island, and the bodies and pairs that count in them.
//
// An island that several processes share has its own bodies on each, and their neighbours. Residuals of own bodies are
// complete, those of neighbours are not and are never used: norms, sums and work count own bodies and own pairs, and are
// summed. Changes of neighbours come from their owners after each solution. So all see the same numbers and take the
// same decisions. An island of one process, this class itself, has no other bodies, and pays nothing.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/contact/contact_points.hpp"
#include "mechanics/contact/laws/joint_law.hpp"

namespace ashlar {

/// Functions are collective for the processes that share an island (shared/shared_island_sums.hpp).
class IslandSums {
 public:
  IslandSums() = default;
  virtual ~IslandSums() = default;
  IslandSums(const IslandSums&) = delete;
  IslandSums& operator=(const IslandSums&) = delete;
  [[nodiscard]] static const IslandSums& of_one_process();

  [[nodiscard]] virtual bool shared() const { return false; }
  /// @param place of a body in the island
  [[nodiscard]] virtual bool owns_body(std::size_t /*place*/) const { return true; }
  /// @param pair of the island
  [[nodiscard]] virtual bool owns_pair(std::size_t /*pair*/) const { return true; }

  // The same for all, from those of each.
  [[nodiscard]] virtual std::vector<double> sum(const std::vector<double>& values) const { return values; }
  [[nodiscard]] virtual std::vector<double> largest(const std::vector<double>& values) const {
    return values;
  }
  [[nodiscard]] double sum(double value) const;
  [[nodiscard]] double largest(double value) const;
  [[nodiscard]] bool any(bool value) const;
  /// Inner product of vectors in the island's equations.
  [[nodiscard]] double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const;
  /// Of columns (equations, n) with a vector. @return (n)
  [[nodiscard]] virtual Eigen::VectorXd dot(const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                            const Eigen::VectorXd& y) const {
    return columns.transpose() * y;
  }

  /// Sets the parts of neighbours to those of their owners. @param x in the island's equations
  virtual void update_neighbours(Eigen::VectorXd& /*x*/) const {}
  /// @param values by body
  virtual void update_neighbours(std::vector<Eigen::VectorXd>& /*values*/) const {}
};

/// Contact states of a guess compared with those of earlier ones, by all processes.
struct StateComparison {
  bool as_before;  ///< as in the last guess
  bool repeated;   ///< as in any
};
[[nodiscard]] StateComparison compare_states(const IslandSums& sums, const std::vector<ContactState>& states,
                                             const std::vector<std::vector<ContactState>>& seen);

}  // namespace ashlar
