// Blocks that crack in a run: finds the blocks whose mean tension has reached their strength at the end of a step, divides
// them, and keeps the record of all cracks (notes/cracks.md).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/fracture/crack.hpp"
#include "solver/fracture/divided_run.hpp"
#include "solver/fracture/stress_average.hpp"

namespace ashlar {

class CrackedBlocks {
 public:
  using DefinitionOf = std::function<BlockDefinition(int block)>;

  /// @param laws by block of the run; empty: it does not crack
  /// @param definition of a block of the run, of those that crack. @param run without cracks so far
  /// @param most_blocks of the run with all parts
  CrackedBlocks(std::vector<std::optional<CrackLaw>> laws, DefinitionOf definition, const Simulation& run,
                int most_blocks);

  /// Divides each block whose strength is reached once, those with the largest excess first. Blocks that do not move are left
  /// out. @param stage stages that have ended before. @param level true: at the balance of a load level, which is noted
  /// @return number of new events in record()
  /// @throws std::length_error if there would be more than most_blocks
  int divide(Simulation& run, int stage, bool level);
  /// Makes the cracks of an earlier run in the blocks of this one, as placed. @param run as given to the constructor
  void repeat(const CrackRecord& record, Simulation& run);
  /// A stage begins: record() has no load levels but its start, at which no block is under tension.
  void begin_stage();

  /// Time at which a block is expected to reach its strength, by its tension at the last two load levels: the next level
  /// ends there (notes/cracks.md). @param time_step s, > 0, between levels
  /// @return s, of the stage; empty: not before the next level
  [[nodiscard]] std::optional<double> time_of_next_crack(double time_step) const;

  [[nodiscard]] const CrackRecord& record() const { return record_; }

 private:
  struct Division {
    PartNumbers numbers;
    std::vector<BlockPart> parts;
    double area;  ///< m^2
  };

  [[nodiscard]] const std::optional<CrackLaw>& law_of(int block) const;
  [[nodiscard]] const BlockDefinition& definition_of(int block);
  [[nodiscard]] std::vector<WeakPlace> weak_places(const Simulation& run, bool level);
  void note_level(double time, const std::vector<int>& asked,
                  const std::vector<std::optional<WeakPlace>>& found);
  [[nodiscard]] double excess(const WeakPlace& place) const;
  [[nodiscard]] std::optional<Division> division_of(int block, const Plane& plane, std::size_t blocks);
  /// The law of all pairs, with the joints of cracks.
  [[nodiscard]] Simulation::LawOfPair laws() const;
  [[nodiscard]] Simulation with_division(const Simulation& run, const Division& division);
  void leave_whole(int block);

  std::shared_ptr<const std::vector<std::optional<CrackLaw>>> laws_;  ///< by block at the start
  std::shared_ptr<const BlockSystem> start_;  ///< blocks at the start, for their joint laws
  DefinitionOf definition_;
  int most_blocks_;
  std::vector<int> origins_;
  std::map<int, BlockDefinition> definitions_;  ///< of blocks that crack, as far as they were needed
  std::map<int, StressProbes> probes_;          ///< the same
  std::vector<int> cracks_;                     ///< by block at the start: number of its cracks
  CrackRecord record_;
};

/// Fracture energy of the damaged area of all cracks, J: that of tension where a joint has failed or is open, else that of
/// shear. @param origins by block: number of the block at the start of which it is a part
[[nodiscard]] double energy_of_cracks(const Simulation& run, const std::vector<int>& origins);

}  // namespace ashlar
