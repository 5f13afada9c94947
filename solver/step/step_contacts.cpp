#include "solver/step/step_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/contact/contact_master.hpp"
#include "mechanics/contact/overlap_outline.hpp"
#include "solver/contact/energy_bounds.hpp"
#include "solver/parallel_for.hpp"
#include "solver/state/automatic.hpp"
#include "solver/step/step_problem.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

/// By how much a block is shorter or longer along a unit direction, in the mean, than it is without load, m.
double way_given(const BlockModel& model, const BlockState& state, const Vector3& direction) {
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

/// How far a has moved past b at each point since the load level began, m.
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

/// Whether a block has gone so far in the load level that it is on a way of its own, not on that of an iteration
/// to balance.
bool is_far(const BlockSystem& system, const RunState& state, int block) {
  const BlockModel& model = system.blocks()[at(block)];
  const Eigen::MatrixX3d way = state.states[at(block)].position - state.statics.level_start[at(block)];
  return system.moving()[at(block)] &&
         mean_motion(model, way) > system.settings().statics.motion * block_size(model);
}

/// Takes the slip of a load level so far for good: what comes counts from there.
void take_slip(const std::vector<ContactPoint>& points, const std::vector<Vector3>& moved,
               std::vector<PointMemory>& memory) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    memory[k].level_dilation = memory[k].dilation;
    if (!memory[k].in_level) continue;
    const Vector3 slid = memory[k].level_slip + moved[k] - memory[k].slip;
    memory[k].level_slip -= slid - points[k].normal.dot(slid) * points[k].normal;
  }
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
    if (const auto* vertex = std::get_if<VertexContact>(&blocks.touch.contact)) {
      place->contacts.vertices.push_back(*vertex);
    } else {
      place->contacts.edges.push_back(std::get<EdgeContact>(blocks.touch.contact));
    }
  }
  return found;
}

StepContacts::StepContacts(const BlockSystem& system)
    : finder_(system.blocks(), system.settings(), system.left_out(), system.absent()) {}

std::vector<FoundContacts> StepContacts::detect(const BlockSystem& system, RunState& state, double step) {
  const Stopwatch watch(state.log.seconds.contact_search);
  const std::vector<BlockState> driven = driven_states(system, state, step);
  const ExpectedMotion motion = driven.empty() ? finder_.expected_motion(state.states, step)
                                               : finder_.expected_motion(driven, step > 0.0 ? step : 1.0);
  finder_.watch(system.moving());
  std::vector<FoundContacts> found = finder_.find(state.states, motion, state.pairs);
  ways_out_ = WaysOut(state.pairs, system.moving());
  for (const auto& [blocks, contacts] : found) {
    if (!(history_of(state.pairs, blocks).memory.deepest() > 0.0))
      ways_out_.add_touching(blocks, finder_.placed(blocks[0]), finder_.placed(blocks[1]), contacts);
  }
  const auto stands = standing_ways(system, state, found);
  const GivenWay given = given_way(system, state);
  for (auto& [pair, contacts] : found) {
    const PlacedSurface& a = finder_.placed(pair[0]);
    const PlacedSurface& b = finder_.placed(pair[1]);
    leave_out_seams(a, b, ways_out_.of_pair(pair[0], pair[1], normals_of(a, b, contacts), given), stands,
                    contacts);
  }
  return found;
}

std::optional<ContactPair> StepContacts::pair_of(const BlockSystem& system, const RunState& state,
                                                 const FoundContacts& found, JointLaw law, PairUse use,
                                                 const CoveredFaces& covered) const {
  const auto& [blocks, contacts] = found;
  const auto [a, b] = blocks;
  const ContactBody body_a = body_at_start(system, state, a, &finder_.placed(a));
  const ContactBody body_b = body_at_start(system, state, b, &finder_.placed(b));
  const PairHistory& known = history_of(state.pairs, blocks);
  const SimulationSettings& settings = system.settings();
  const bool goes_on = use == PairUse::motion && state.has_begun();
  law.augmented = settings.augmented && !law.gives_way;
  const ContactPointSettings point_settings{settings.area_springs, settings.curved_surface, law.augmented};
  const std::vector<bool> masters =
      first_is_master(body_a, body_b, contacts.overlaps, [&covered, a = a, b = b](const RimPlace& rim) {
        return rim.of_a ? covered.goes_on(b, a, rim) : covered.goes_on(a, b, rim);
      });
  auto [points, cuts] =
      contact_points(body_a, body_b, contacts, masters, point_settings, known.memory.cuts());
  // Faces that share no area to the last bit are found, but have no points.
  if (points.empty()) return std::nullopt;
  auto memory = known.memory.recall(
      points, state.has_begun() ? -std::numeric_limits<double>::infinity() : settings.contact_distance,
      use == PairUse::statics && settings.area_springs);
  law.rounding = coordinate_rounding(*body_a.placed, *body_b.placed);
  std::vector<Vector3> moved;
  if (use == PairUse::statics && !state.statics.level_start.empty()) {
    moved = moved_in_level(system, state, blocks, points);
    if (is_far(system, state, a) || is_far(system, state, b)) take_slip(points, moved, memory);
  }
  ContactPair pair(PairBodies{a, b, body_a, body_b}, law, std::move(points), std::move(memory),
                   std::move(cuts));
  if (goes_on && law.augmented) pair.hold_where_found(known.taken);
  if (!moved.empty()) pair.count_slip(moved);
  if (use == PairUse::statics && state.statics.holds_bonds) pair.hold_bonds();
  return pair;
}

std::vector<ContactPair> StepContacts::pairs(const BlockSystem& system, RunState& state,
                                             const std::vector<FoundContacts>& found, PairUse use) const {
  const Stopwatch watch(state.log.seconds.contact_points);
  const SimulationSettings& settings = system.settings();
  const bool goes_on = use == PairUse::motion && state.has_begun();
  std::vector<ContactPair> pairs;
  const CoveredFaces covered(
      found, [this](int block) -> const PlacedSurface& { return finder_.placed(block); },
      settings.contact_distance);
  // Laws are the caller's, who need not expect several threads.
  std::vector<JointLaw> laws;
  for (const FoundContacts& pair : found) laws.push_back(system.law(pair.blocks[0], pair.blocks[1]));
  std::vector<std::optional<ContactPair>> made(found.size());
  parallel_for(settings.threads, found.size(),
               [&](std::size_t n) { made[n] = pair_of(system, state, found[n], laws[n], use, covered); });
  for (std::optional<ContactPair>& pair : made) {
    if (!pair) continue;
    state.log.counts.contact_points += pair->points().size();
    pairs.push_back(std::move(*pair));
  }
  if (goes_on) {
    const std::vector<SpringEnergy> bounds = energy_bounds(pairs, state.pairs, system.moving());
    for (std::size_t k = 0; k < pairs.size(); ++k) pairs[k].hold_at_most(bounds[k]);
  }
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
  const auto stands = standing_ways(system, state, found);
  const GivenWay given = given_way(system, state);
  std::erase_if(passing, [&](const PassingBlocks& pair) {
    const PlacedSurface& a = finder_.placed(pair.blocks[0]);
    const PlacedSurface& b = finder_.placed(pair.blocks[1]);
    const std::vector<WayOut> ways =
        ways_out_.of_pair(pair.blocks[0], pair.blocks[1], normals_of(a, b, pair.touch), given);
    return at_seam(a, b, ways, stands, pair.touch);
  });
  return passing;
}

GivenWay StepContacts::given_way(const BlockSystem& system, const RunState& state) {
  return [&system, &state](int block, const Vector3& direction) {
    const BlockModel& model = system.blocks()[at(block)];
    if (!system.moving()[at(block)] || model.incremental() != nullptr) return 0.0;
    return way_given(model, state.states[at(block)], direction);
  };
}

std::function<bool(const WayOut&)> StepContacts::standing_ways(
    const BlockSystem& system, const RunState& state, const std::vector<FoundContacts>& found) const {
  return [this, given = given_way(system, state), &found](const WayOut& way) {
    const auto placed = [this](int block) -> const PlacedSurface& { return finder_.placed(block); };
    return ways_out_.stands(way, found, placed, given);
  };
}

}  // namespace ashlar
