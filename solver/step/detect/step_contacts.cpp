#include "solver/step/detect/step_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/contact/overlap_outline.hpp"
#include "mechanics/contact/reference_face.hpp"
#include "solver/parallel_for.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/step_problem.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

/// Mean change of length of a block along a unit direction, relative to the unloaded one, m.
double compression_along(const BlockModel& model, const BlockState& state, const Vector3& direction) {
  const Eigen::Matrix3d gradient = state.position.transpose() * model.parts()->mean_gradients;
  // F maps lines along F^-1 n to lines along n and stretches them by 1/|F^-1 n|.
  const Vector3 undeformed = gradient.inverse() * direction;
  const double stretch = 1.0 / undeformed.norm();
  const Vector3 along = stretch * undeformed;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vector3& point : model.solid().mesh().points) {
    low = std::min(low, along.dot(point));
    high = std::max(high, along.dot(point));
  }
  return std::abs(stretch - 1.0) * (high - low);
}

ContactBody body_at_start(const BlockSystem& system, const RunState& state, int block,
                          const PlacedSurface* placed) {
  return {&system.blocks()[at(block)], &state.states[at(block)], placed};
}

JointLaw law_of(const BlockSystem& system, const PairKey& blocks) {
  return system.law(blocks[0], blocks[1]);
}

/// Contacts at the present state, without points. An empty result may be cached too.
ContactCache as_found(const ContactFinder& finder, const RunState& state, const NearPair& pair,
                      const JointLaw& law, PairContacts contacts) {
  ContactCache found;
  found.contacts = std::move(contacts);
  for (std::size_t k = 0; k < 2; ++k) {
    found.positions[k] = state.states[at(pair.blocks[k])].position;
    found.divisions[k] = finder.surfaces()[at(pair.blocks[k])].wanted();
  }
  found.reach = pair.reach;
  found.law = law;
  return found;
}

/// True if contacts of two blocks may be cached: an incremental block has other coordinates in each step.
bool may_last(const BlockSystem& system, const PairKey& blocks) {
  return system.blocks()[at(blocks[0])].incremental() == nullptr &&
         system.blocks()[at(blocks[1])].incremental() == nullptr;
}
bool may_last(const BlockSystem& system, const FoundContacts& found, PairUse use) {
  return use == PairUse::motion && found.reach > 0.0 && may_last(system, found.blocks);
}

/// Drops empty results of pairs that are no longer near. @param near sorted
void forget_far_pairs(PairHistories& histories, const std::vector<NearPair>& near,
                      const std::vector<bool>& moving) {
  auto next = near.begin();
  for (auto& [blocks, pair] : histories) {
    while (next != near.end() && next->blocks < blocks) ++next;
    if (next != near.end() && next->blocks == blocks) continue;
    if (moving[at(blocks[0])] || moving[at(blocks[1])]) pair.cache.reset();
  }
}

/// Displacement of a relative to b at each point since the load level began, m.
std::vector<Vector3> moved_in_level(const BlockSystem& system, const RunState& state, const PairKey& blocks,
                                    const std::vector<ContactPoint>& points) {
  std::vector<Vector3> moved(points.size(), Vector3::Zero());
  for (const bool of_a : {true, false}) {
    const std::size_t block = at(blocks[of_a ? 0 : 1]);
    if (!system.moving()[block]) continue;
    std::vector<Vector3> material;
    material.reserve(points.size());
    for (const ContactPoint& point : points) material.push_back(of_a ? point.material_a : point.material_b);
    const Eigen::MatrixX3d motion = system.blocks()[block].basis().values(material) *
                                    (state.states[block].position - state.statics.level_start[block]);
    for (std::size_t k = 0; k < points.size(); ++k)
      moved[k] += (of_a ? 1.0 : -1.0) * motion.row(static_cast<Eigen::Index>(k)).transpose();
  }
  return moved;
}

/// True if a block has moved so far in the load level that it undergoes a motion of its own, not that of an iteration
/// to balance.
bool is_far(const BlockSystem& system, const RunState& state, int block) {
  const BlockModel& model = system.blocks()[at(block)];
  const Eigen::MatrixX3d retraction = state.states[at(block)].position - state.statics.level_start[at(block)];
  return system.moving()[at(block)] &&
         mean_motion(model, retraction) > system.settings().statics.motion * model.size();
}

/// Makes the slip of a load level permanent: later slip counts from there.
void take_slip(const std::vector<ContactPoint>& points, const std::vector<Vector3>& moved,
               std::vector<PointMemory>& memory) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    memory[k].level_dilation = memory[k].dilation;
    memory[k].level_damage = memory[k].damage;
    if (!memory[k].in_level) continue;
    const Vector3 slid = memory[k].level_slip + moved[k] - memory[k].slip;
    memory[k].level_slip -= slid - points[k].normal.dot(slid) * points[k].normal;
  }
}

/// Along the largest face of all blocks; empty: as those of the system have it.
std::optional<Eigen::Matrix3d> axes_of(const BlockSystem& system) {
  const PlacesOfRun* placed = system.exchange().placed();
  return placed == nullptr ? std::nullopt : std::optional(placed->axes);
}

std::vector<PlacedVolume> places_of(const BlockSystem& system) {
  const PlacesOfRun* placed = system.exchange().placed();
  return placed == nullptr ? places_of(system.blocks()) : placed->volumes;
}

}  // namespace

std::vector<FoundContacts> with_passing(std::vector<FoundContacts> found,
                                        const std::vector<PassingBlocks>& passing) {
  for (const PassingBlocks& blocks : passing) {
    auto place = std::lower_bound(
        found.begin(), found.end(), blocks.blocks,
        [](const FoundContacts& contacts, const PairKey& pair) { return contacts.blocks < pair; });
    if (place == found.end() || place->blocks != blocks.blocks)
      place = found.insert(place, FoundContacts{blocks.blocks, {}});
    place->kept.reset();
    place->reach = 0.0;
    if (const auto* vertex = std::get_if<VertexContact>(&blocks.touch.contact)) {
      place->contacts.vertices.push_back(*vertex);
    } else {
      place->contacts.edges.push_back(std::get<EdgeContact>(blocks.touch.contact));
    }
  }
  return found;
}

StepContacts::StepContacts(const BlockSystem& system, ContactObserver observer)
    : observer_(std::move(observer)),
      finder_(system.blocks(), system.settings(), system.left_out(), system.away(), observer_,
              axes_of(system)),
      order_(places_of(system), system.settings().gravity_at(0.0)) {}

std::vector<std::shared_ptr<const KeptContacts>> StepContacts::kept(const BlockSystem& system,
                                                                    const RunState& state,
                                                                    const std::vector<NearPair>& near) const {
  const SimulationSettings& settings = system.settings();
  std::vector<std::shared_ptr<const KeptContacts>> result(near.size());
  std::vector<std::optional<JointLaw>> laws(near.size());
  // Laws are user functions, which need not be thread-safe.
  for (std::size_t n = 0; n < near.size(); ++n)
    if (history_of(state.pairs, near[n].blocks).cache != nullptr) laws[n] = law_of(system, near[n].blocks);
  parallel_for(settings.threads, near.size(), [&](std::size_t n) {
    if (!laws[n]) return;
    const auto& [blocks, reach] = near[n];
    const PairHistory& history = history_of(state.pairs, blocks);
    const std::shared_ptr<const ContactCache>& cache = history.cache;
    // Blocks that were apart have no points.
    if (!cache->found.points.empty() && cache->found.turning != history.memory.turning()) return;
    for (std::size_t k = 0; k < 2; ++k)
      if (finder_.surfaces()[at(blocks[k])].wanted() != cache->divisions[k]) return;
    const auto bound_of = [this](int block) {
      return [this, block](const Eigen::MatrixX3d& change) { return finder_.motion_bound(block, change); };
    };
    std::optional<KeptContacts> found =
        kept_contacts(cache, body_at_start(system, state, blocks[0], nullptr),
                      body_at_start(system, state, blocks[1], nullptr), *laws[n],
                      {settings.cached_motion(), reach}, {bound_of(blocks[0]), bound_of(blocks[1])});
    if (found) result[n] = std::make_shared<const KeptContacts>(std::move(*found));
  });
  return result;
}

std::vector<FoundContacts> StepContacts::detect(const BlockSystem& system, RunState& state, double step) {
  const Stopwatch watch(state.log.seconds.contact_search);
  const std::vector<BlockState> driven = driven_states(system, state, step);
  const ExpectedMotion motion = driven.empty() ? finder_.expected_motion(state.states, step)
                                               : finder_.expected_motion(driven, step > 0.0 ? step : 1.0);
  finder_.watch(system.moving());
  retractions_.reset();
  const std::vector<NearPair> near = finder_.near_pairs(state.states, motion, state.pairs);
  std::vector<std::shared_ptr<const KeptContacts>> kept(near.size());
  if (step > 0.0) kept = this->kept(system, state, near);
  system.exchange().agree_on_kept(system, near, kept);
  std::vector<PairContacts> known_contacts(near.size());
  KnownContacts known(near.size(), nullptr);
  for (std::size_t n = 0; n < near.size(); ++n) {
    if (kept[n] == nullptr) continue;
    known_contacts[n] = shifted(kept[n]->cache->contacts, kept[n]->shift);
    known[n] = &known_contacts[n];
  }
  std::vector<FoundContacts> found = finder_.find(state.states, known, state.pairs);
  const bool any_new = !found.empty();
  forget_far_pairs(state.pairs, near, system.moving());
  if (step > 0.0) note_apart(system, state, near, known, found);
  for (std::size_t n = 0; n < near.size(); ++n) {
    if (known[n] != nullptr && !known[n]->empty())
      found.push_back({near[n].blocks, std::move(known_contacts[n]), near[n].reach, std::move(kept[n])});
  }
  std::sort(found.begin(), found.end(),
            [](const FoundContacts& x, const FoundContacts& y) { return x.blocks < y.blocks; });
  if (any_new) remove_internal_edges_of(system, state, found);
  return found;
}

void StepContacts::note_apart(const BlockSystem& system, RunState& state, const std::vector<NearPair>& near,
                              const KnownContacts& known, const std::vector<FoundContacts>& found) const {
  auto next = found.begin();
  for (std::size_t n = 0; n < near.size(); ++n) {
    if (known[n] != nullptr) continue;
    // Both are sorted, and the new contacts are of pairs that were not cached.
    if (next != found.end() && next->blocks == near[n].blocks) {
      ++next;
    } else if (may_last(system, near[n].blocks)) {
      state.pairs[near[n].blocks].cache = std::make_shared<const ContactCache>(
          as_found(finder_, state, near[n], law_of(system, near[n].blocks), {}));
    }
  }
}

const Retractions& StepContacts::retractions(const RunState& state, const std::vector<bool>& moving,
                                             const std::vector<FoundContacts>& found) {
  if (retractions_) return *retractions_;
  retractions_ = Retractions(state.pairs, moving);
  for (const auto& pair : found) {
    if (!(history_of(state.pairs, pair.blocks).memory.deepest() > 0.0))
      retractions_->add_touching(pair.blocks, finder_.placed(pair.blocks[0]), finder_.placed(pair.blocks[1]),
                                 pair.contacts);
  }
  return *retractions_;
}

void StepContacts::remove_internal_edges_of(const BlockSystem& system, const RunState& state,
                                            std::vector<FoundContacts>& found) {
  const Retractions& known = retractions(state, system.moving(), found);
  const BlockCompression given = compression_of(system, state);
  const auto placed = [this](int block) -> const PlacedSurface& { return finder_.placed(block); };
  const auto stands = [&](const Retraction& retraction) {
    return retractions_->stands(retraction, found, placed, given);
  };
  for (FoundContacts& pair : found) {
    if (pair.kept != nullptr) continue;
    const PlacedSurface& a = finder_.placed(pair.blocks[0]);
    const PlacedSurface& b = finder_.placed(pair.blocks[1]);
    remove_internal_edges(
        a, b, known.of_pair(pair.blocks[0], pair.blocks[1], normals_of(a, b, pair.contacts), given), stands,
        pair.contacts);
    if (observer_) observer_(ContactStage::internal_edge, pair.blocks, pair.contacts);
  }
}

std::optional<PairRecipe> StepContacts::recipe_of(const BlockSystem& system, const RunState& state,
                                                  const FoundContacts& found, JointLaw law, PairUse use,
                                                  const SurfaceContinuation& covered) const {
  const PairKey& blocks = found.blocks;
  const PairContacts& contacts = found.contacts;
  const auto [a, b] = blocks;
  const ContactBody body_a = body_at_start(system, state, a, &finder_.placed(a));
  const ContactBody body_b = body_at_start(system, state, b, &finder_.placed(b));
  const PairHistory& known = history_of(state.pairs, blocks);
  const SimulationSettings& settings = system.settings();
  const bool continues = use == PairUse::motion && state.has_begun();
  const ContactPointSettings point_settings{settings.area_springs, settings.curved_surface,
                                            law.has_multipliers(), known.overlap, law.normal_spring()};
  const std::vector<bool> references_on_a = reference_is_on_a(
      body_a, body_b, contacts.overlaps,
      [&covered, a = a, b = b](const RimPlace& rim) {
        return rim.of_a ? covered.continues(b, a, rim) : covered.continues(a, b, rim);
      },
      order_.is_before(a, b));
  ContactPoints made = contact_points(body_a, body_b, contacts, references_on_a, point_settings,
                                      known.memory.cuts(), known.memory.turning());
  std::vector<ContactPoint> points = made.points;
  // Faces that share no area within rounding are detected, but have no points.
  if (points.empty()) return std::nullopt;
  // New points share pressure with the old ones, not forces: points of a finer rule do not succeed single ones.
  auto memory = known.memory.recall(
      points, state.has_begun() ? -std::numeric_limits<double>::infinity() : settings.contact_distance,
      use == PairUse::statics && settings.area_springs && points.size() == known.memory.entries().size());
  law.rounding = coordinate_rounding(*body_a.placed, *body_b.placed);
  PatchStart start;
  if (use == PairUse::motion && !state.has_begun()) start.touch_within = law.rounding;
  if (continues && law.has_multipliers()) start.frozen = known.spent;
  start.freezes_failure = use == PairUse::statics && state.statics.freezes_failure;
  if (use == PairUse::statics && !state.statics.level_start.empty()) {
    start.moved_in_level = moved_in_level(system, state, blocks, points);
    if (is_far(system, state, a) || is_far(system, state, b)) take_slip(points, start.moved_in_level, memory);
  }
  ContactPatch patch{std::move(points), made.cuts, made.turning};
  if (may_last(system, found, use)) {
    patch.rows = PairRows::values_of(*body_a.model, *body_b.model, patch.points);
    ContactCache cache = as_found(finder_, state, {blocks, found.reach}, law, contacts);
    cache.found = std::move(made);
    cache.rows = patch.rows;
    patch.cache = std::make_shared<const ContactCache>(std::move(cache));
  }
  return PairRecipe{blocks, law, std::move(patch), std::move(memory), start};
}

std::vector<ContactPair> StepContacts::pairs(const BlockSystem& system, RunState& state,
                                             const std::vector<FoundContacts>& found, PairUse use) {
  const Stopwatch watch(state.log.seconds.contact_points);
  const SimulationSettings& settings = system.settings();
  const bool continues = use == PairUse::motion && state.has_begun();
  const bool all_kept =
      std::all_of(found.begin(), found.end(), [](const FoundContacts& pair) { return pair.kept != nullptr; });
  SurfaceContinuation covered(settings.contact_distance);
  for (const auto& [blocks, contacts, reach, kept] : found)
    if (!all_kept && !contacts.overlaps.empty())
      covered.add(blocks, contacts.overlaps, finder_.placed(blocks[0]), finder_.placed(blocks[1]));
  // Laws are user functions, which need not be thread-safe.
  std::vector<JointLaw> laws;
  laws.reserve(found.size());
  for (const FoundContacts& pair : found) laws.push_back(law_of(system, pair.blocks));
  std::vector<std::optional<PairRecipe>> made(found.size());
  parallel_for(settings.threads, found.size(), [&](std::size_t n) {
    const auto& [blocks, contacts, reach, kept] = found[n];
    if (!system.owns_pair(blocks[0], blocks[1])) return;
    if (kept == nullptr) {
      made[n] = recipe_of(system, state, found[n], laws[n], use, covered);
    } else if (!kept->points.empty()) {
      made[n] = kept_recipe(state, blocks, *kept, laws[n]);
    }
  });
  std::vector<PairRecipe> recipes;
  for (std::size_t n = 0; n < found.size(); ++n) {
    if (made[n]) {
      state.log.counts.contact_points += made[n]->patch.points.size();
      recipes.push_back(std::move(*made[n]));
    } else if (found[n].kept == nullptr && may_last(system, found[n], use)) {
      state.pairs[found[n].blocks].cache = std::make_shared<const ContactCache>(
          as_found(finder_, state, {found[n].blocks, found[n].reach}, laws[n], found[n].contacts));
    }
  }
  system.exchange().add_recipes_of_others(
      system, state, [&system](const PairKey& blocks) { return law_of(system, blocks); }, recipes);
  std::vector<std::optional<ContactPair>> assembled(recipes.size());
  parallel_for(settings.threads, recipes.size(),
               [&](std::size_t n) { assembled[n] = make_pair(system, state, std::move(recipes[n])); });
  std::vector<ContactPair> pairs;
  pairs.reserve(assembled.size());
  for (std::optional<ContactPair>& pair : assembled) pairs.push_back(std::move(*pair));
  if (continues) bound_energies(system, state, pairs);
  for (const TiedBlocks& tied : system.ties()) {
    if (!system.moving()[at(tied.a)] && !system.moving()[at(tied.b)]) continue;
    pairs.emplace_back(PairBodies{tied.a, tied.b, body_at_start(system, state, tied.a, nullptr),
                                  body_at_start(system, state, tied.b, nullptr)},
                       tied.tie, tied.stiffness);
  }
  return pairs;
}

std::vector<PassingBlocks> StepContacts::check_motion(const BlockSystem& system, RunState& state,
                                                      const std::vector<BlockState>& after,
                                                      const std::vector<FoundContacts>& found) {
  const Stopwatch watch(state.log.seconds.motion_check);
  std::vector<PassingBlocks> passing = finder_.check_motion(state.states, after, found, state.pairs);
  if (passing.empty()) return passing;
  const Retractions& known = retractions(state, system.moving(), found);
  const BlockCompression given = compression_of(system, state);
  const auto placed = [this](int block) -> const PlacedSurface& { return finder_.placed(block); };
  const auto stands = [&](const Retraction& retraction) {
    return retractions_->stands(retraction, found, placed, given);
  };
  std::erase_if(passing, [&](const PassingBlocks& pair) {
    const PlacedSurface& a = finder_.placed(pair.blocks[0]);
    const PlacedSurface& b = finder_.placed(pair.blocks[1]);
    const std::vector<Retraction> of_pair =
        known.of_pair(pair.blocks[0], pair.blocks[1], normals_of(a, b, pair.touch), given);
    return at_internal_edge(a, b, of_pair, stands, pair.touch);
  });
  return passing;
}

BlockCompression StepContacts::compression_of(const BlockSystem& system, const RunState& state) {
  return [&system, &state](int block, const Vector3& direction) {
    const BlockModel& model = system.blocks()[at(block)];
    if (!system.moving()[at(block)] || model.incremental() != nullptr) return 0.0;
    return compression_along(model, state.states[at(block)], direction);
  };
}

}  // namespace ashlar
