#include "solver/fracture/cracked_blocks.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/parallel_for.hpp"
#include "solver/run/lost_strength.hpp"

namespace ashlar {
namespace {

/// Damage of a crack's joint at its most damaged point from which on its parts may crack again. Below, the joint is near its
/// strength and bounds the tension beside it: rounding and vibration would divide the parts at once. With more, parts wait
/// longer than the crack needs to unload them.
constexpr double softened_damage = 0.5;

/// Tension over the strength at which a load level is to end at a crack: just beyond, so that rounding does not leave the block
/// whole.
constexpr double aimed_share = 1.0005;
/// Least part of the step between load levels, to get past places where tension hardly grows.
constexpr double least_level = 1e-3;

/// Damage of a joint at its most damaged point, 0 to 1.
double largest_damage(const PairHistory& pair) {
  double largest = 0.0;
  for (const ContactMemory::Entry& entry : pair.memory.entries())
    largest = std::max(largest, entry.memory.intact ? entry.memory.damage : 1.0);
  return largest;
}

/// Parts of one block beside a crack that has not softened yet. @param origins by block. @return by block
std::vector<bool> beside_new_cracks(const Simulation& run, const std::vector<int>& origins) {
  std::vector<bool> beside(origins.size(), false);
  for (const auto& [blocks, pair] : run.histories()) {
    if (origins[at(blocks[0])] != origins[at(blocks[1])] || pair.memory.empty()) continue;
    if (!(largest_damage(pair) < softened_damage)) continue;
    for (const int block : blocks) beside[at(block)] = true;
  }
  return beside;
}

}  // namespace

CrackedBlocks::CrackedBlocks(std::vector<std::optional<CrackLaw>> laws, DefinitionOf definition,
                             const Simulation& run, int most_blocks)
    : laws_(std::make_shared<const std::vector<std::optional<CrackLaw>>>(std::move(laws))),
      start_(std::make_shared<const BlockSystem>(run.system())),
      definition_(std::move(definition)),
      most_blocks_(most_blocks),
      cracks_(run.blocks().size(), 0) {
  for (int k = 0; k < run.system().count(); ++k) origins_.push_back(k);
  begin_stage();
}

const std::optional<CrackLaw>& CrackedBlocks::law_of(int block) const {
  return (*laws_)[at(origins_[at(block)])];
}

const BlockDefinition& CrackedBlocks::definition_of(int block) {
  const auto [place, is_new] = definitions_.try_emplace(block);
  if (is_new) place->second = definition_(block);
  return place->second;
}

double CrackedBlocks::excess(const WeakPlace& place) const {
  return place.stress / law_of(place.block)->tensile_strength;
}

std::vector<WeakPlace> CrackedBlocks::weak_places(const Simulation& run, bool level) {
  std::vector<int> asked;
  const std::vector<bool> waits = beside_new_cracks(run, origins_);
  for (int k = 0; k < run.system().count(); ++k) {
    if (waits[at(k)] || !law_of(k) || !run.system().present(k) || !run.system().moving()[at(k)]) continue;
    if (std::binary_search(record_.left_whole.begin(), record_.left_whole.end(), k)) continue;
    asked.push_back(k);
    probes_.try_emplace(k);
  }
  std::vector<std::optional<WeakPlace>> found(asked.size());
  parallel_for(run.system().settings().threads, asked.size(), [&](std::size_t n) {
    const BlockModel& block = run.blocks()[at(asked[n])];
    const CrackLaw& law = *law_of(asked[n]);
    StressProbes& probes = probes_.at(asked[n]);
    if (probes.points.empty()) probes = stress_probes(block, law.least_size);
    found[n] = weakest_place(block, run.states()[at(asked[n])], probes, level ? 0.0 : law.tensile_strength);
    if (found[n]) found[n]->block = asked[n];
  });
  if (level) note_level(run.time(), asked, found);
  std::vector<WeakPlace> places;
  for (const std::optional<WeakPlace>& place : found)
    if (place && excess(*place) >= 1.0) places.push_back(*place);
  std::stable_sort(places.begin(), places.end(),
                   [this](const WeakPlace& x, const WeakPlace& y) { return excess(x) > excess(y); });
  return places;
}

void CrackedBlocks::note_level(double time, const std::vector<int>& asked,
                               const std::vector<std::optional<WeakPlace>>& found) {
  LevelTension level{time, std::vector<double>(origins_.size(), -1.0)};
  for (std::size_t n = 0; n < asked.size(); ++n)
    level.shares[at(asked[n])] = found[n] ? excess(*found[n]) : 0.0;
  std::vector<LevelTension>& levels = record_.levels;
  // After a crack the level is balanced once more.
  if (!levels.empty() && levels.back().time == time) levels.pop_back();
  if (levels.size() == 2) levels.erase(levels.begin());
  levels.push_back(std::move(level));
}

void CrackedBlocks::begin_stage() {
  // A block that is under tension then has too early a first prediction, and a right one after it.
  record_.levels = {{0.0, std::vector<double>(origins_.size(), 0.0)}};
}

std::optional<double> CrackedBlocks::time_of_next_crack(double time_step) const {
  if (record_.levels.size() < 2) return std::nullopt;
  const LevelTension& before = record_.levels[0];
  const LevelTension& now = record_.levels[1];
  double first = 1.0;  // in time steps
  for (std::size_t k = 0; k < std::min(before.shares.size(), now.shares.size()); ++k) {
    const double share = now.shares[k];
    const double growth = (share - before.shares[k]) * time_step / (now.time - before.time);
    if (before.shares[k] < 0.0 || share < 0.0 || share >= 1.0 || !(growth > 0.0)) continue;
    first = std::min(first, std::max((aimed_share - share) / growth, least_level));
  }
  if (first == 1.0) return std::nullopt;
  return now.time + first * time_step;
}

std::optional<CrackedBlocks::Division> CrackedBlocks::division_of(int block, const Plane& plane,
                                                                  std::size_t blocks) {
  const BlockDefinition& whole = definition_of(block);
  const std::optional<DividedSolid> solids = divided_solid(*whole.solid, plane, law_of(block)->least_size);
  if (!solids) return std::nullopt;
  const std::string& name = start_->blocks()[at(origins_[at(block)])].name();
  const int crack = cracks_[at(origins_[at(block)])] + 1;
  Division division{{block, {}}, {}, solids->area};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < solids->parts.size(); ++k) {
    names.push_back(name_of_part(whole.name.empty() ? name : whole.name, crack, k));
    division.numbers.numbers.push_back(k == 0 ? block : static_cast<int>(blocks + k - 1));
  }
  try {
    division.parts = parts_of(whole, *solids, names);
  } catch (const std::domain_error&) {
    return std::nullopt;  // a sliver on which the functions lose their digits
  }
  return division;
}

Simulation::LawOfPair CrackedBlocks::laws() const {
  return [start = start_, laws = laws_, origins = origins_](int a, int b) {
    const auto [low, high] = std::minmax(origins[at(a)], origins[at(b)]);
    return low == high ? (*laws)[at(low)]->joint : start->law(low, high);
  };
}

Simulation CrackedBlocks::with_division(const Simulation& run, const Division& division) {
  const int origin = origins_[at(division.numbers.block)];
  for (std::size_t k = 0; k < division.parts.size(); ++k) {
    const int number = division.numbers.numbers[k];
    if (k > 0) origins_.push_back(origin);
    definitions_[number] = division.parts[k].definition;
    probes_.erase(number);
  }
  ++cracks_[at(origin)];
  return with_parts(run, division.numbers, division.parts, laws());
}

void CrackedBlocks::leave_whole(int block) {
  record_.left_whole.insert(std::lower_bound(record_.left_whole.begin(), record_.left_whole.end(), block),
                            block);
}

int CrackedBlocks::divide(Simulation& run, int stage, bool level) {
  int cracks = 0;
  for (const WeakPlace& place : weak_places(run, level)) {
    const CrackLaw law = *law_of(place.block);
    const std::optional<Plane> plane =
        plane_with_room(run.blocks()[at(place.block)].solid(), place.plane, law.least_size);
    std::optional<Division> division;
    if (plane) division = division_of(place.block, *plane, run.blocks().size());
    if (!division) {
      leave_whole(place.block);
      continue;
    }
    if (run.blocks().size() + division->parts.size() - 1 > static_cast<std::size_t>(most_blocks_))
      throw std::length_error("block \"" + run.blocks()[at(place.block)].name() +
                              "\" cracks, but there would be more than " + std::to_string(most_blocks_) +
                              " blocks; give the [[crack]] a larger most_blocks or least_size");
    Simulation parts = with_division(run, *division);
    parts.restore(divided_state(run, division->numbers, division->parts, law.joint, parts));
    run = std::move(parts);
    record_.events.push_back({run.time(), stage, place.block, division->numbers.numbers, plane->point,
                              plane->normal, division->area, place.stress});
    ++cracks;
  }
  return cracks;
}

void CrackedBlocks::repeat(const CrackRecord& record, Simulation& run) {
  for (const CrackEvent& event : record.events) {
    const std::optional<Division> division =
        division_of(event.block, {event.point, event.normal}, run.blocks().size());
    if (!division) throw std::runtime_error("a crack of the earlier run does not fit the blocks of this one");
    run = with_division(run, *division);
    record_.events.push_back(event);
  }
  record_.left_whole = record.left_whole;
  record_.levels = record.levels;
}

double energy_of_cracks(const Simulation& run, const std::vector<int>& origins) {
  double energy = 0.0;
  for (const auto& [blocks, pair] : run.histories()) {
    if (origins[at(blocks[0])] != origins[at(blocks[1])]) continue;
    const FractureEnergy fracture = run.system().law(blocks[0], blocks[1]).fracture;
    energy += fracture.tension * pair.broken;
    for (const ContactMemory::Entry& entry : pair.memory.entries()) {
      // The area of points that have failed is that which is broken.
      if (entry.memory.intact) energy += dissipated_energy(fracture, entry.memory) * entry.area;
    }
  }
  return energy;
}

}  // namespace ashlar
