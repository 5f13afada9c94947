#include "solver/state/block_system.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/state/free_bodies.hpp"

namespace ashlar {
namespace {

/// Places where a block is checked for inversion: its corners, the midpoints of its edges and the centroids of the
/// corners of its faces. An affine block has the same gradient everywhere.
std::vector<Vector3> asked_places(const BlockModel& block) {
  if (block.order() == 1) return {block.basis().centroid()};
  const Polyhedron& solid = block.solid();
  const auto& points = solid.mesh().points;
  std::vector<Vector3> places = {block.basis().centroid()};
  for (const int corner : solid.corners()) places.push_back(points[at(corner)]);
  for (const PolyhedronEdge& edge : solid.edges())
    places.emplace_back(0.5 * (points[at(edge.vertices[0])] + points[at(edge.vertices[1])]));
  for (const PolyhedronFace& face : solid.faces()) {
    Vector3 sum = Vector3::Zero();
    for (const int corner : face.loops.front()) sum += points[at(corner)];
    places.emplace_back(sum / static_cast<double>(face.loops.front().size()));
  }
  return places;
}

/// Gradients of the functions at these places. @return (3 #places, p)
Eigen::MatrixXd gradients_at(const BlockModel& block, const std::vector<Vector3>& places) {
  Eigen::MatrixXd gradients(3 * static_cast<Eigen::Index>(places.size()), block.basis().size());
  for (std::size_t k = 0; k < places.size(); ++k)
    gradients.middleRows(3 * static_cast<Eigen::Index>(k), 3) =
        block.basis().gradients(places[k]).transpose();
  return gradients;
}

}  // namespace

BlockSystem::BlockSystem(std::vector<BlockModel> blocks, LawOfPair law, const SimulationSettings& settings,
                         const std::vector<TieRequest>& ties, std::vector<bool> absent,
                         StepExchange& exchange)
    : blocks_(std::move(blocks)),
      absent_(std::move(absent)),
      exchange_(&exchange),
      law_(std::move(law)),
      settings_(settings) {
  absent_.resize(blocks_.size(), false);
  away_ = absent_;
  for (int k = 0; k < count(); ++k) away_[at(k)] = absent_[at(k)] || !exchange_->knows(k);
  let_go();
  for (int k = 0; k < count(); ++k)
    if (moving_[at(k)] && blocks_[at(k)].quiet()) quiet_.push_back(k);
  // The surface of an incremental block consists of its sub-faces.
  if (any_of_run(*this, any_incremental())) settings_.curved_surface = false;
  const bool any_rigid =
      std::any_of(blocks_.begin(), blocks_.end(), [](const auto& block) { return block.rigid(); });
  if (any_rigid && settings_.integrator == Integrator::generalized_alpha)
    throw std::invalid_argument("generalized-alpha has no accelerations of rigid blocks");
  for (const BlockModel& block : blocks_)
    roundoff_force_.push_back(block.fixed() ? 0.0 : block.force_rounding());
  asked_gradients_.resize(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) note_gradients(k);
  std::vector<PairKey> tied;
  exchange_->on_all([&] { tied = make_ties(ties); });
  find_free_bodies(tied);
}

JointLaw BlockSystem::law(int a, int b) const {
  JointLaw law = law_(a, b);
  const bool by_multipliers = settings_.augmented && law.transmission != Transmission::springs;
  law.transmission = by_multipliers ? Transmission::multipliers : Transmission::springs;
  return law;
}

std::vector<PairKey> BlockSystem::make_ties(const std::vector<TieRequest>& ties) {
  std::vector<PairKey> tied;
  for (const auto& [a, b, stiffness] : ties) {
    // Neighbours may come later.
    if (!exchange_->alone()) left_out_.insert({a, b});
    if (!here(a) || !here(b) || !concerns(a, b)) continue;
    const BlockModel& block_a = blocks_[at(a)];
    const BlockModel& block_b = blocks_[at(b)];
    if (block_a.incremental() != nullptr || block_b.incremental() != nullptr)
      throw std::invalid_argument("blocks of the incremental formulation cannot be tied");
    left_out_.insert({a, b});
    Tie tie = tie_between(block_a.solid(), block_a.basis(), block_b.solid(), block_b.basis());
    if (tie.area == 0.0) continue;
    ties_.push_back({a, b, std::make_shared<const Tie>(std::move(tie)), stiffness});
    if (owns_pair(a, b)) tied.push_back({a, b});
  }
  return tied;
}

void BlockSystem::find_free_bodies(const std::vector<PairKey>& tied) {
  if (exchange_->alone()) {
    free_bodies_ = ashlar::free_bodies(blocks_, tied);
    std::erase_if(free_bodies_, [this](const std::vector<int>& body) { return !present(body.front()); });
    return;
  }
  std::vector<int> held;
  for (int k = 0; k < count(); ++k)
    if (owns(k) && (!present(k) || !may_turn_freely(blocks_[at(k)]))) held.push_back(k);
  const std::vector<PairKey> all_tied = joined_of_run(*this, tied);
  std::vector<bool> free(blocks_.size(), true);
  for (const int k : joined_of_run(*this, held)) free[at(k)] = false;
  std::vector<std::vector<int>> bodies = ashlar::free_bodies(free, all_tied);
  const auto own = [this](const std::vector<int>& body) {
    return static_cast<std::size_t>(
        std::count_if(body.begin(), body.end(), [this](int block) { return owns(block); }));
  };
  std::vector<bool> parted;
  for (const std::vector<int>& body : bodies) parted.push_back(own(body) > 0 && own(body) < body.size());
  parted = any_of_run(*this, parted);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    if (parted[n]) parted_bodies_.push_back(bodies[n]);
    if (own(bodies[n]) > 0) free_bodies_.push_back(std::move(bodies[n]));
  }
}

bool BlockSystem::owns(int block) const {
  return exchange_->owns(block);
}

bool BlockSystem::owns_pair(int a, int b) const {
  if (exchange_->alone()) return true;
  if (blocks_[at(a)].fixed()) return owns(b);
  if (blocks_[at(b)].fixed()) return owns(a);
  return owns(std::min(a, b));
}

bool BlockSystem::concerns(int a, int b) const {
  if (exchange_->alone()) return true;
  return (owns(a) && !blocks_[at(a)].fixed()) || (owns(b) && !blocks_[at(b)].fixed());
}

void BlockSystem::set_bolts(std::vector<Bolt> bolts) {
  for (const Bolt& bolt : bolts)
    for (const BoltSpan& piece : bolt.chain.shape().pieces())
      if (blocks_.at(at(piece.block)).incremental() != nullptr)
        throw std::invalid_argument("incremental blocks do not tell where a bolt was placed");
  bolts_ = std::move(bolts);
}

bool BlockSystem::is_tied(int block) const {
  return std::any_of(ties_.begin(), ties_.end(),
                     [&](const TiedBlocks& tie) { return tie.a == block || tie.b == block; });
}

bool BlockSystem::are_tied(int a, int b) const {
  return std::any_of(ties_.begin(), ties_.end(),
                     [&](const TiedBlocks& tie) { return tie.a == a && tie.b == b; });
}

double BlockSystem::roundoff_force(int block) const {
  return roundoff_force_[at(block)];
}

const Eigen::MatrixXd* BlockSystem::asked_gradients(int block) const {
  return asked_gradients_[at(block)].get();
}

bool BlockSystem::any_incremental() const {
  return std::any_of(blocks_.begin(), blocks_.end(),
                     [](const BlockModel& block) { return block.incremental() != nullptr; });
}

double BlockSystem::smaller_size(const BlockPair& blocks) const {
  return std::min(blocks_[at(blocks[0])].size(), blocks_[at(blocks[1])].size());
}

int BlockSystem::unknowns() const {
  int sum = 0;
  for (int k = 0; k < count(); ++k)
    if (present(k) && owns(k)) sum += blocks_[at(k)].freedom();
  return sum;
}

std::vector<bool> BlockSystem::held_without_contacts() const {
  std::vector<bool> held;
  held.reserve(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) held.push_back(!moving_[k] || blocks_[k].space().held());
  for (bool more = true; more;) {
    more = false;
    for (const TiedBlocks& tie : ties_) {
      if (held[at(tie.a)] == held[at(tie.b)]) continue;
      held[at(tie.a)] = held[at(tie.b)] = more = true;
    }
  }
  return held;
}

void BlockSystem::replace(int block, BlockModel model) {
  blocks_[at(block)] = std::move(model);
  note_gradients(at(block));
  roundoff_force_[at(block)] = blocks_[at(block)].force_rounding();
  // Ties have as many columns as their blocks have functions.
  for (TiedBlocks& tied : ties_) {
    if (tied.a != block && tied.b != block) continue;
    const BlockModel& a = blocks_[at(tied.a)];
    const BlockModel& b = blocks_[at(tied.b)];
    tied.tie = std::make_shared<const Tie>(tie_between(a.solid(), a.basis(), b.solid(), b.basis()));
  }
}

void BlockSystem::set_here(int block, BlockModel model, bool here) {
  blocks_[at(block)] = std::move(model);
  away_[at(block)] = absent_[at(block)] || !here;
  moving_[at(block)] = this->here(block) && !blocks_[at(block)].fixed() && !loose_.contains(block);
  roundoff_force_[at(block)] = moving_[at(block)] ? blocks_[at(block)].force_rounding() : 0.0;
  note_gradients(at(block));
  std::erase(quiet_, block);
  if (this->here(block) && !blocks_[at(block)].fixed() && blocks_[at(block)].quiet())
    quiet_.insert(std::lower_bound(quiet_.begin(), quiet_.end(), block), block);
  // The owner of a free body turns it. Blocks that change their owner are not tied.
  std::erase_if(free_bodies_, [block](const std::vector<int>& body) { return body.front() == block; });
  const BlockModel& now = blocks_[at(block)];
  // Quiet faces hold a block as the run starts.
  if (!present(block) || !owns(block) || !may_turn_freely(now) || now.quiet()) return;
  const auto place = std::find_if(free_bodies_.begin(), free_bodies_.end(),
                                  [block](const std::vector<int>& body) { return body.front() > block; });
  free_bodies_.insert(place, {block});
}

void BlockSystem::carry_on(int block, BlockModel model) {
  blocks_[at(block)] = std::move(model);
}

void BlockSystem::set_load_factor(int block, int load, double factor) {
  blocks_.at(at(block)).set_load_factor(at(load), factor);
}

std::map<std::array<int, 2>, double> BlockSystem::load_factors() const {
  std::map<std::array<int, 2>, double> factors;
  for (int block = 0; block < count(); ++block) {
    const std::vector<Load>& loads = blocks_[at(block)].loads();
    for (int load = 0; load < static_cast<int>(loads.size()); ++load)
      if (loads[at(load)].factor != 1.0) factors[{block, load}] = loads[at(load)].factor;
  }
  return factors;
}

std::map<int, Eigen::MatrixX3d> BlockSystem::reactions() const {
  std::map<int, Eigen::MatrixX3d> reactions;
  for (const int k : quiet_)
    if (!blocks_[at(k)].holds_quiet_faces()) reactions.emplace(k, blocks_[at(k)].reaction());
  return reactions;
}

void BlockSystem::set_reaction(int block, Eigen::MatrixX3d reaction) {
  blocks_.at(at(block)).set_reaction(std::move(reaction));
}

void BlockSystem::hold(const std::vector<int>& blocks) {
  for (const int block : blocks) moving_[at(block)] = false;
}

void BlockSystem::let_go() {
  moving_.clear();
  for (int k = 0; k < count(); ++k)
    moving_.push_back(!blocks_[at(k)].fixed() && here(k) && !loose_.contains(k));
}

void BlockSystem::hold_loose(const std::vector<int>& blocks) {
  loose_.insert(blocks.begin(), blocks.end());
  hold(blocks);
}

void BlockSystem::let_go_loose() {
  loose_.clear();
  let_go();
}

void BlockSystem::note_gradients(std::size_t k) {
  asked_gradients_[k].reset();
  if (!moving_[k] || blocks_[k].incremental() != nullptr) return;
  for (std::size_t twin = 0; twin < k; ++twin) {
    if (asked_gradients_[twin] == nullptr || blocks_[twin].parts() != blocks_[k].parts()) continue;
    asked_gradients_[k] = asked_gradients_[twin];
    return;
  }
  asked_gradients_[k] =
      std::make_shared<const Eigen::MatrixXd>(gradients_at(blocks_[k], asked_places(blocks_[k])));
}

}  // namespace ashlar
