#include "solver/ranks/mpi/petsc_method.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "solver/ranks/mpi/petsc_check.hpp"
#include "solver/ranks/mpi/petsc_solver.hpp"

namespace ashlar {
namespace {

// Numbers of MUMPS's parameters and answers (its users' guide).
constexpr PetscInt mumps_spare_memory = 14;     // ICNTL: percent of its estimate
constexpr PetscInt mumps_negative_pivots = 12;  // INFOG
constexpr PetscInt mumps_entries = 29;          // INFOG: of the factor; negative: millions of them
constexpr PetscInt mumps_operations = 1;        // RINFOG: of the elimination, estimated
constexpr double mumps_million = 1e6;           // entries that a negative number of them counts
/// Spare memory of a factor in percent of its estimate: at first and at most. A factor that needs more is made again with
/// twice as much.
constexpr PetscInt first_spare_memory = 30, most_spare_memory = 500;

constexpr PetscInt most_petsc_iterations = 3000;

/// Options that users leave open, while PETSc reads them. All methods of a process share its options, and would find
/// those of another method as if users had given them.
class DefaultOptions {
 public:
  explicit DefaultOptions(const std::string& prefix) : start_("-" + prefix) {}
  ~DefaultOptions() {
    for (const std::string& name : set_) (void)PetscOptionsClearValue(nullptr, name.c_str());
  }
  DefaultOptions(const DefaultOptions&) = delete;
  DefaultOptions& operator=(const DefaultOptions&) = delete;

  void set(const char* name, const char* value) {
    const std::string full = start_ + name;
    PetscBool given = PETSC_FALSE;
    check_petsc(PetscOptionsHasName(nullptr, nullptr, full.c_str(), &given));
    if (given == PETSC_TRUE) return;
    check_petsc(PetscOptionsSetValue(nullptr, full.c_str(), value));
    set_.push_back(full);
  }

 private:
  std::string start_;
  std::vector<std::string> set_;
};

/// Joins neighbours only, not their neighbours too, which takes three quarters of the iterations
/// (../../notes/rank_solver.md), and smooths by the diagonal blocks of bodies of one size, else by point relaxation.
void set_multigrid(DefaultOptions& options, const PetscMatrix& matrix) {
  options.set("pc_gamg_aggressive_coarsening", "0");
  options.set("mg_levels_pc_type", matrix.common_size() > 1 ? PCPBJACOBI : PCSOR);
}

}  // namespace

PetscMethod::PetscMethod(Ranks& ranks, const std::vector<BodyRows>& rows, std::int64_t most_factored,
                         std::string prefix)
    : matrix_(ranks), prefix_(std::move(prefix)) {
  matrix_.number(rows);
  choose(most_factored);
  check_petsc(MatCreateVecs(matrix_.get(), &solution_, &right_side_));
  check_petsc(VecDuplicate(solution_, &residual_));
  check_petsc(VecDuplicate(solution_, &correction_));
}

PetscMethod::~PetscMethod() {
  (void)KSPDestroy(&solver_);
  for (Vec* vector : {&right_side_, &solution_, &residual_, &correction_}) (void)VecDestroy(vector);
}

/// Value of an option of PETSc; empty: it is not given.
std::string PetscMethod::option(const char* name) const {
  std::array<char, 256> value{};
  PetscBool given = PETSC_FALSE;
  check_petsc(PetscOptionsGetString(nullptr, prefix_.c_str(), name, value.data(), value.size(), &given));
  return given == PETSC_TRUE ? value.data() : "";
}

void PetscMethod::choose(std::int64_t most_factored) {
  const std::string wanted = option("-pc_type");
  const bool factor = wanted.empty() ? matrix_.unknowns() <= most_factored : wanted == PCCHOLESKY;
  matrix_.make(factor ? PetscStorage::symmetric : PetscStorage::general, prefix_);
  check_petsc(KSPCreate(PETSC_COMM_WORLD, &solver_));
  check_petsc(KSPSetOptionsPrefix(solver_, prefix_.c_str()));
  check_petsc(KSPGetPC(solver_, &preconditioner_));
  DefaultOptions defaults(prefix_);
  if (factor) {
    check_petsc(KSPSetType(solver_, KSPPREONLY));
    check_petsc(PCSetType(preconditioner_, PCCHOLESKY));
    check_petsc(PCFactorSetMatSolverType(preconditioner_, MATSOLVERMUMPS));
  } else {
    check_petsc(KSPSetType(solver_, KSPCG));
    check_petsc(KSPSetNormType(solver_, KSP_NORM_UNPRECONDITIONED));
    check_petsc(PCSetType(preconditioner_, PCGAMG));
    set_multigrid(defaults, matrix_);
  }
  check_petsc(KSPSetTolerances(solver_, petsc_refined_tolerance, 0.0, PETSC_DEFAULT, most_petsc_iterations));
  check_petsc(KSPSetFromOptions(solver_));
  check_petsc(KSPGetTolerances(solver_, &refined_tolerance_, nullptr, nullptr, nullptr));
  KSPType solver = nullptr;
  check_petsc(KSPGetType(solver_, &solver));
  PCType preconditioner = nullptr;
  check_petsc(PCGetType(preconditioner_, &preconditioner));
  MatSolverType package = nullptr;
  if (factor) check_petsc(PCFactorGetMatSolverType(preconditioner_, &package));
  iterates_ = solver != std::string(KSPPREONLY);
  by_multigrid_ = preconditioner == std::string(PCGAMG);
  by_mumps_ = package != nullptr && package == std::string(MATSOLVERMUMPS);
}

/// MUMPS sees only while it factorises how much memory pivots and messages need beyond its estimate.
PCFailedReason PetscMethod::factorize() {
  DefaultOptions defaults(prefix_);
  // Right sides are gathered: a sixth less time for a solution.
  if (by_mumps_) defaults.set("mat_mumps_icntl_20", "0");
  for (PetscInt spare = first_spare_memory;; spare *= 2) {
    if (by_mumps_) {
      Mat factor = nullptr;
      check_petsc(PCFactorSetUpMatSolverType(preconditioner_));
      check_petsc(PCFactorGetMatrix(preconditioner_, &factor));
      check_petsc(MatMumpsSetIcntl(factor, mumps_spare_memory, spare));
    }
    check_petsc(KSPSetUp(solver_));
    PCFailedReason reason = PC_NOERROR;
    check_petsc(PCGetFailedReason(preconditioner_, &reason));
    if (!by_mumps_ || reason != PC_FACTOR_OUTMEMORY || spare > most_spare_memory) return reason;
    check_petsc(PCReset(preconditioner_));
  }
}

FactorStatus PetscMethod::set_up(const std::vector<BodyRows>& rows) {
  matrix_.fill(rows);
  if (by_multigrid_) matrix_.set_rigid_motions(rows);
  check_petsc(KSPSetOperators(solver_, matrix_.get(), matrix_.get()));
  DefaultOptions defaults(prefix_);
  if (by_multigrid_) set_multigrid(defaults, matrix_);
  const PCFailedReason reason = factorize();
  if (reason == PC_FACTOR_OUTMEMORY) throw std::bad_alloc();
  if (reason != PC_NOERROR) return FactorStatus::not_positive_definite;
  PetscInt negative = 0;
  if (by_mumps_) {
    Mat factor = nullptr;
    check_petsc(PCFactorGetMatrix(preconditioner_, &factor));
    check_petsc(MatMumpsGetInfog(factor, mumps_negative_pivots, &negative));
    count_cost(factor);
  }
  return negative == 0 ? FactorStatus::success : FactorStatus::not_positive_definite;
}

/// A solution takes a multiplication and an addition for each entry, forwards and backwards.
void PetscMethod::count_cost(Mat factor) {
  PetscInt entries = 0;
  PetscReal operations = 0.0;
  check_petsc(MatMumpsGetInfog(factor, mumps_entries, &entries));
  check_petsc(MatMumpsGetRinfog(factor, mumps_operations, &operations));
  const double all =
      entries < 0 ? -mumps_million * static_cast<double>(entries) : static_cast<double>(entries);
  cost_in_solves_ = all > 0.0 ? operations / (4.0 * all) : 0.0;
}

/// One step of iterative refinement with the factor.
void PetscMethod::refine() {
  check_petsc(MatMult(matrix_.get(), solution_, residual_));
  check_petsc(VecAYPX(residual_, -1.0, right_side_));
  check_petsc(KSPSolve(solver_, residual_, correction_));
  check_petsc(VecAXPY(solution_, 1.0, correction_));
}

bool PetscMethod::solve(const Eigen::VectorXd& right_side, bool refined, Eigen::VectorXd& solution) {
  PetscScalar* values = nullptr;
  check_petsc(VecGetArrayWrite(right_side_, &values));
  Eigen::Map<Eigen::VectorXd>(values, right_side.size()) = right_side;
  check_petsc(VecRestoreArrayWrite(right_side_, &values));
  if (iterates_) {
    const PetscReal tolerance = refined ? refined_tolerance_ : std::max(refined_tolerance_, petsc_tolerance);
    check_petsc(KSPSetTolerances(solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  }
  check_petsc(KSPSolve(solver_, right_side_, solution_));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check_petsc(KSPGetConvergedReason(solver_, &reason));
  // x' A x = x' b is positive for a positive definite matrix.
  PetscScalar energy = 0.0;
  check_petsc(VecDot(right_side_, solution_, &energy));
  const bool good = reason > 0 && energy >= 0.0;
  if (iterates_) {
    PetscInt iterations = 0;
    check_petsc(KSPGetIterationNumber(solver_, &iterations));
    iterations_ += static_cast<std::uint64_t>(iterations);
  } else if (good && refined) {
    refine();
  }
  const PetscScalar* found = nullptr;
  check_petsc(VecGetArrayRead(solution_, &found));
  solution = Eigen::Map<const Eigen::VectorXd>(found, right_side.size());
  check_petsc(VecRestoreArrayRead(solution_, &found));
  return good;
}

}  // namespace ashlar
