#include "solver/ranks/block_share.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

std::unique_ptr<MeasuredSolver> measured_solver(const RankSolverMaker& make, Ranks& ranks) {
  return std::make_unique<MeasuredSolver>(make ? make(ranks) : make_gathered_solver(ranks));
}

}  // namespace

BlockShare::BlockShare(Ranks& ranks, std::vector<int> owners, const RankSolverMaker& solver)
    : ranks_(ranks),
      solver_(measured_solver(solver, ranks)),
      step_solver_(measured_solver(solver, ranks)),
      owners_(std::move(owners)),
      is_ghost_(owners_.size(), false),
      lent_(at(ranks.count())) {
  find_own();
}

void BlockShare::find_own() {
  own_.clear();
  for (int block = 0; block < count(); ++block) {
    if (owner(block) < 0 || owner(block) >= ranks_.count())
      throw std::invalid_argument("block " + std::to_string(block) + " belongs to no rank");
    if (owns(block)) own_.push_back(block);
  }
}

void BlockShare::set_owners(std::vector<int> owners) {
  if (owners.size() != owners_.size()) throw std::invalid_argument("owners are not by block");
  std::vector<int> had;
  std::merge(own_.begin(), own_.end(), ghosts_.begin(), ghosts_.end(), std::back_inserter(had));
  owners_ = std::move(owners);
  find_own();
  std::erase_if(had, [this](int block) { return owns(block); });
  ghosts_ = std::move(had);
  is_ghost_.assign(owners_.size(), false);
  for (const int block : ghosts_) is_ghost_[at(block)] = true;
}

void BlockShare::set_ghosts(std::vector<int> ghosts) {
  ghosts_ = std::move(ghosts);
  is_ghost_.assign(owners_.size(), false);
  std::vector<std::vector<int>> asked(lent_.size());
  for (const int block : ghosts_) {
    is_ghost_[at(block)] = true;
    asked[at(owner(block))].push_back(block);
  }
  std::vector<Bytes> messages;
  for (const std::vector<int>& blocks : asked) {
    ByteWriter writer;
    if (!blocks.empty()) writer(blocks);
    messages.push_back(message_of(writer));
  }
  const std::vector<Bytes> received = ranks_.exchange(std::move(messages));
  for (std::size_t rank = 0; rank < lent_.size(); ++rank) {
    lent_[rank].clear();
    if (received[rank].empty()) continue;
    ByteReader reader(text_of_message(received[rank]));
    reader(lent_[rank]);
  }
}

void BlockShare::exchange(const std::function<void(ByteWriter&, int)>& write,
                          const std::function<void(ByteReader&, int)>& read) const {
  std::vector<Bytes> messages;
  for (int rank = 0; rank < ranks_.count(); ++rank) {
    ByteWriter writer;
    if (rank != ranks_.own()) write(writer, rank);
    messages.push_back(message_of(writer));
  }
  const std::vector<Bytes> received = ranks_.exchange(std::move(messages));
  for (int rank = 0; rank < ranks_.count(); ++rank) {
    if (received[at(rank)].empty()) continue;
    ByteReader reader(text_of_message(received[at(rank)]));
    read(reader, rank);
  }
}

void BlockShare::to_ghosts(const std::function<const Eigen::VectorXd*(int)>& of,
                           const std::function<void(int, Eigen::VectorXd)>& take) const {
  exchange(
      [&](ByteWriter& writer, int rank) {
        for (const int block : lent_[at(rank)])
          if (const Eigen::VectorXd* value = of(block)) writer(block, *value);
      },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          int block = -1;
          Eigen::VectorXd value;
          reader(block, value);
          take(block, std::move(value));
        }
      });
}

}  // namespace ashlar
