#include "solver/step/solve/joined_island.hpp"

#include <memory>
#include <utility>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/island/joined_system.hpp"
#include "solver/step/solve/open_close.hpp"

namespace ashlar {

IslandResult solve_joined_island(const BlockSystem& system, const Island& island,
                                 std::vector<BodyStep>& bodies, const std::vector<ContactPair>& pairs,
                                 const TimeScheme& scheme, const SimulationSettings& settings,
                                 SharedFactor* kept) {
  const std::unique_ptr<JoinedSystem> linear =
      system.exchange().joined_system(system, island, bodies, pairs, kept);
  IslandResult result;
  IslandProblem problem(island, bodies, pairs, scheme, settings, linear->solver(), linear->sums());
  iterate_open_close(problem, result);
  if (!system.exchange().first()) result.iterations = result.fallbacks = 0;
  return result;
}

void tell_changes(const BlockSystem& system, std::vector<BodyStep>& bodies) {
  system.exchange().tell_neighbours(
      [&](ByteWriter& writer, int block) {
        if (system.moving()[at(block)]) writer(bodies[at(block)].change);
      },
      [&](ByteReader& reader, int block) { reader(bodies[at(block)].change); });
}

}  // namespace ashlar
