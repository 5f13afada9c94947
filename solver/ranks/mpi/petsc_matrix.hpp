// A matrix of PETSc from the rows of bodies. For sources of this folder.
#pragma once

#include <petscmat.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/ranks/rank_solver.hpp"
#include "solver/ranks/ranks.hpp"
#include "solver/ranks/row_numbering.hpp"

namespace ashlar {

/// Storage of a matrix.
enum class PetscStorage {
  symmetric,  ///< upper triangle (SBAIJ), for factors
  general,    ///< all entries (AIJ), which multigrid requires
};

/// Owns a Mat. Functions are collective.
class PetscMatrix {
 public:
  explicit PetscMatrix(Ranks& ranks) : ranks_(ranks) {}
  ~PetscMatrix() { clear(); }
  PetscMatrix(const PetscMatrix&) = delete;
  PetscMatrix& operator=(const PetscMatrix&) = delete;

  /// True if rows have the pattern of the last ones on all ranks.
  [[nodiscard]] bool has_pattern_of(const std::vector<BodyRows>& rows) const;
  /// Numbers the unknowns of a new pattern. The matrix is empty afterwards: make() comes next.
  void number(const std::vector<BodyRows>& rows);
  /// Makes a matrix for the pattern; the option -mat_type replaces its type. @param prefix of options
  void make(PetscStorage storage, const std::string& prefix);
  /// Sets all values of the same pattern. @param rows as of number()
  void fill(const std::vector<BodyRows>& rows);
  /// Tells multigrid the rigid motions of the bodies; nothing if rows have none.
  void set_rigid_motions(const std::vector<BodyRows>& rows);

  [[nodiscard]] Mat get() const { return matrix_; }
  [[nodiscard]] std::int64_t unknowns() const { return numbering_.all; }
  /// Of all bodies; 0: they differ.
  [[nodiscard]] int common_size() const { return numbering_.common_size; }

 private:
  void clear();
  void preallocate();
  void set_blocks(const std::vector<BodyRows>& rows);
  void set_entries(const std::vector<BodyRows>& rows);
  [[nodiscard]] PetscInt block_size() const {
    return numbering_.common_size > 0 ? numbering_.common_size : 1;
  }

  Ranks& ranks_;
  std::vector<int> bodies_;
  std::vector<int> sizes_;
  std::vector<std::vector<int>> columns_;       ///< by own body: global bodies
  std::vector<std::vector<BodyPlace>> places_;  ///< by own body and column
  RowNumbering numbering_;
  Mat matrix_ = nullptr;
};

}  // namespace ashlar
