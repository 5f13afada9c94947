#include "solver/ranks/mpi/petsc_matrix.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <string>

#include "geometry/index.hpp"
#include "solver/ranks/mpi/petsc_check.hpp"

namespace ashlar {
namespace {

/// Length of a direction that is left beside the others, of its own, at most, if it depends on them: larger values leave out
/// motions of slender blocks, smaller ones add rounding errors as directions.
constexpr double dependent_share = 1e-8;

std::vector<int> sizes_of(const std::vector<BodyRows>& rows) {
  std::vector<int> sizes;
  sizes.reserve(rows.size());
  for (const BodyRows& row : rows) sizes.push_back(static_cast<int>(row.blocks.front().rows()));
  return sizes;
}

/// Entries of rows, on and beside the diagonal block of this rank, in all and right of the diagonal only.
struct RowEntries {
  std::vector<PetscInt> own, others, own_above, others_above;
};

/// Adds an orthonormal direction unless it depends on those before.
void add_direction(std::vector<Vec>& directions, Vec direction) {
  PetscReal before = 0.0;
  check_petsc(VecNorm(direction, NORM_2, &before));
  PetscReal after = before;
  // Twice is enough (Kahan, Parlett).
  for (int pass = 0; pass < 2; ++pass) {
    for (Vec earlier : directions) {
      PetscScalar product = 0.0;
      check_petsc(VecDot(direction, earlier, &product));
      check_petsc(VecAXPY(direction, -product, earlier));
    }
    check_petsc(VecNorm(direction, NORM_2, &after));
  }
  if (!(after > dependent_share * before)) {
    check_petsc(VecDestroy(&direction));
    return;
  }
  check_petsc(VecScale(direction, 1.0 / after));
  directions.push_back(direction);
}

}  // namespace

void PetscMatrix::clear() {
  if (matrix_ != nullptr) (void)MatDestroy(&matrix_);
}

bool PetscMatrix::has_pattern_of(const std::vector<BodyRows>& rows) const {
  bool same = matrix_ != nullptr && rows.size() == bodies_.size() && sizes_of(rows) == sizes_;
  for (std::size_t k = 0; same && k < rows.size(); ++k)
    same = rows[k].body == bodies_[k] && rows[k].columns == columns_[k];
  // Sizes of columns are those of their bodies' own rows.
  return !any_rank(ranks_, !same);
}

void PetscMatrix::number(const std::vector<BodyRows>& rows) {
  clear();
  bodies_.clear();
  columns_.clear();
  places_.clear();
  sizes_ = sizes_of(rows);
  std::vector<int> asked;
  for (const BodyRows& row : rows) {
    bodies_.push_back(row.body);
    columns_.push_back(row.columns);
    asked.insert(asked.end(), row.columns.begin(), row.columns.end());
  }
  std::sort(asked.begin(), asked.end());
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  numbering_ = number_rows(ranks_, bodies_, sizes_, asked);
  for (const BodyRows& row : rows) {
    std::vector<BodyPlace>& places = places_.emplace_back();
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
      const auto found = std::lower_bound(asked.begin(), asked.end(), row.columns[k]);
      places.push_back(numbering_.asked[static_cast<std::size_t>(found - asked.begin())]);
      if (row.blocks[k].cols() != places.back().size)
        throw std::invalid_argument("a block's columns are not the unknowns of body " +
                                    std::to_string(row.columns[k]));
    }
  }
}

void PetscMatrix::make(PetscStorage storage, const std::string& prefix) {
  clear();
  const auto own = static_cast<PetscInt>(numbering_.own);
  const auto all = static_cast<PetscInt>(numbering_.all);
  check_petsc(MatCreate(PETSC_COMM_WORLD, &matrix_));
  check_petsc(MatSetSizes(matrix_, own, own, all, all));
  check_petsc(MatSetBlockSize(matrix_, block_size()));
  check_petsc(MatSetType(matrix_, storage == PetscStorage::symmetric ? MATSBAIJ : MATAIJ));
  check_petsc(MatSetOptionsPrefix(matrix_, prefix.c_str()));
  check_petsc(MatSetFromOptions(matrix_));
  preallocate();
  check_petsc(MatSetOption(matrix_, MAT_ROW_ORIENTED, PETSC_FALSE));
  check_petsc(MatSetOption(matrix_, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  PetscBool symmetric = PETSC_FALSE;
  check_petsc(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(matrix_), &symmetric, MATSBAIJ,
                                        MATSEQSBAIJ, MATMPISBAIJ, ""));
  if (symmetric == PETSC_TRUE) check_petsc(MatSetOption(matrix_, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  check_petsc(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
}

void PetscMatrix::preallocate() {
  const PetscInt block = block_size();
  RowEntries entries;
  std::int64_t first = numbering_.first_own;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    std::array<std::int64_t, 4> count{};
    for (const BodyPlace& place : places_[k]) {
      const bool beside =
          place.first < numbering_.first_own || place.first >= numbering_.first_own + numbering_.own;
      count[beside ? 1 : 0] += place.size;
      if (place.first >= first) count[beside ? 3 : 2] += place.size;
    }
    const auto rows = at(sizes_[k]) / static_cast<std::size_t>(block);
    const auto in_blocks = [&](std::int64_t columns) { return static_cast<PetscInt>(columns) / block; };
    entries.own.insert(entries.own.end(), rows, in_blocks(count[0]));
    entries.others.insert(entries.others.end(), rows, in_blocks(count[1]));
    entries.own_above.insert(entries.own_above.end(), rows, in_blocks(count[2]));
    entries.others_above.insert(entries.others_above.end(), rows, in_blocks(count[3]));
    first += sizes_[k];
  }
  check_petsc(MatXAIJSetPreallocation(matrix_, block, entries.own.data(), entries.others.data(),
                                      entries.own_above.data(), entries.others_above.data()));
}

void PetscMatrix::fill(const std::vector<BodyRows>& rows) {
  check_petsc(MatZeroEntries(matrix_));
  if (numbering_.common_size > 0)
    set_blocks(rows);
  else
    set_entries(rows);
  check_petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  check_petsc(MatSetOption(matrix_, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
}

void PetscMatrix::set_blocks(const std::vector<BodyRows>& rows) {
  auto row = static_cast<PetscInt>(numbering_.first_own) / block_size();
  for (std::size_t k = 0; k < rows.size(); ++k, ++row) {
    for (std::size_t c = 0; c < rows[k].blocks.size(); ++c) {
      const auto column = static_cast<PetscInt>(places_[k][c].first) / block_size();
      check_petsc(MatSetValuesBlocked(matrix_, 1, &row, 1, &column, rows[k].blocks[c].data(), INSERT_VALUES));
    }
  }
}

void PetscMatrix::set_entries(const std::vector<BodyRows>& rows) {
  const auto numbers = [](std::int64_t first, int size) {
    std::vector<PetscInt> result(at(size));
    std::iota(result.begin(), result.end(), static_cast<PetscInt>(first));
    return result;
  };
  std::int64_t first = numbering_.first_own;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::vector<PetscInt> own = numbers(first, sizes_[k]);
    for (std::size_t c = 0; c < rows[k].blocks.size(); ++c) {
      const std::vector<PetscInt> columns = numbers(places_[k][c].first, places_[k][c].size);
      check_petsc(MatSetValues(matrix_, sizes_[k], own.data(), places_[k][c].size, columns.data(),
                               rows[k].blocks[c].data(), INSERT_VALUES));
    }
    first += sizes_[k];
  }
}

void PetscMatrix::set_rigid_motions(const std::vector<BodyRows>& rows) {
  const bool missing =
      std::any_of(rows.begin(), rows.end(), [](const BodyRows& row) { return row.rigid.cols() != 6; });
  if (any_rank(ranks_, missing)) return;
  std::vector<Vec> directions;
  for (int motion = 0; motion < 6; ++motion) {
    Vec direction = nullptr;
    check_petsc(MatCreateVecs(matrix_, &direction, nullptr));
    PetscScalar* values = nullptr;
    check_petsc(VecGetArrayWrite(direction, &values));
    PetscScalar* next = values;
    for (const BodyRows& row : rows) {
      Eigen::Map<Eigen::VectorXd>(next, row.rigid.rows()) = row.rigid.col(motion);
      next += row.rigid.rows();
    }
    check_petsc(VecRestoreArrayWrite(direction, &values));
    add_direction(directions, direction);
  }
  MatNullSpace space = nullptr;
  check_petsc(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, static_cast<PetscInt>(directions.size()),
                                 directions.data(), &space));
  check_petsc(MatSetNearNullSpace(matrix_, space));
  check_petsc(MatNullSpaceDestroy(&space));
  for (Vec direction : directions) check_petsc(VecDestroy(&direction));
}

}  // namespace ashlar
