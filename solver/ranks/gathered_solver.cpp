// Systems that each rank gathers as a whole.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/linear/block_matrix.hpp"
#include "solver/linear/sparse_cholesky.hpp"
#include "solver/ranks/block_share.hpp"
#include "solver/ranks/rank_solver.hpp"

namespace ashlar {
namespace {

class GatheredSolver final : public RankSolver {
 public:
  explicit GatheredSolver(Ranks& ranks) : ranks_(ranks) {}

  [[nodiscard]] FactorStatus factorize(const std::vector<BodyRows>& rows) override {
    factorized_ = false;
    own_.clear();
    for (const BodyRows& row : rows) own_.push_back(row.body);
    std::map<int, BodyRows> all;  // by body
    for (std::vector<BodyRows>& of_rank : values_of_ranks(ranks_, rows)) {
      for (BodyRows& row : of_rank) {
        const int body = row.body;
        all.emplace(body, std::move(row));
      }
    }
    arrange(all);
    for (const auto& [body, row] : all) {
      for (std::size_t k = 0; k < row.columns.size(); ++k) {
        if (row.columns[k] == body) matrix_->add_diagonal(place_.at(body), row.blocks[k]);
        if (row.columns[k] > body)
          matrix_->add_pair(place_.at(body), place_.at(row.columns[k]), row.blocks[k]);
      }
    }
    const FactorStatus status = factor_.factorize(matrix_->matrix());
    factorized_ = status == FactorStatus::success;
    return status;
  }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined) override {
    if (!factorized_) throw std::logic_error("a system was not factorised");
    Eigen::VectorXd all(matrix_->matrix().size);
    Eigen::Index own_start = 0;
    struct Part {
      std::vector<int> bodies;
      Eigen::VectorXd values;
    };
    for (const Part& part : values_of_ranks(ranks_, Part{own_, right_side})) {
      Eigen::Index start = 0;
      for (const int body : part.bodies) {
        const int size = sizes_[at(place_.at(body))];
        all.segment(matrix_->offset(place_.at(body)), size) = part.values.segment(start, size);
        start += size;
      }
    }
    const Eigen::VectorXd found = factor_.solve(all, refined);
    Eigen::VectorXd own(right_side.size());
    for (const int body : own_) {
      const int size = sizes_[at(place_.at(body))];
      own.segment(own_start, size) = found.segment(matrix_->offset(place_.at(body)), size);
      own_start += size;
    }
    return own;
  }

  [[nodiscard]] double cost_in_solves() const override { return factor_.cost_in_solves(); }
  [[nodiscard]] const FactorCounts& counts() const override { return factor_.counts(); }

 private:
  /// Makes an empty matrix of the pattern of all rows; the last one if it has not changed.
  void arrange(const std::map<int, BodyRows>& all) {
    std::vector<int> bodies, sizes;
    std::vector<std::array<int, 2>> pairs;
    place_.clear();
    for (const auto& [body, row] : all) {
      place_.emplace(body, static_cast<int>(place_.size()));
      bodies.push_back(body);
      sizes.push_back(static_cast<int>(row.blocks.front().rows()));
    }
    for (const auto& [body, row] : all)
      for (const int other : row.columns)
        if (other > body) pairs.push_back({place_.at(body), place_.at(other)});
    if (matrix_ && sizes == sizes_ && pairs == pairs_) {
      matrix_->set_zero();
      return;
    }
    sizes_ = std::move(sizes);
    pairs_ = std::move(pairs);
    matrix_.emplace(sizes_, pairs_);
  }

  Ranks& ranks_;
  std::vector<int> own_;      ///< bodies of this rank
  std::map<int, int> place_;  ///< of a body in the matrix
  std::vector<int> sizes_;
  std::vector<std::array<int, 2>> pairs_;
  std::optional<BlockMatrix> matrix_;
  SparseCholesky factor_;
  bool factorized_ = false;
};

}  // namespace

std::unique_ptr<RankSolver> make_gathered_solver(Ranks& ranks) {
  return std::make_unique<GatheredSolver>(ranks);
}

}  // namespace ashlar
