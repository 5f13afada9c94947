// Keeps the energy ledger of a run (ledger.hpp): nothing else writes to it, so that each energy is booked once.
#pragma once

#include <vector>

#include "solver/state/block_system.hpp"
#include "solver/state/ledger.hpp"

namespace ashlar {

/// Books energies, J. Amounts may be negative: what was booked is taken back.
class LedgerKeeper {
 public:
  [[nodiscard]] const Ledger& ledger() const { return ledger_; }
  /// Largest change of the residual in one step and largest energy so far, J.
  [[nodiscard]] double largest_step_residual() const { return largest_step_residual_; }
  [[nodiscard]] double largest_energy() const { return largest_energy_; }
  /// Of a block, when it was measured last, J.
  [[nodiscard]] double elastic_energy(int block) const {
    return elastic_energies_[static_cast<std::size_t>(block)];
  }

  void loads_did(double work) { ledger_.applied += work; }
  void damping_took(double energy) { ledger_.damping += energy; }
  void integrator_took(double energy) { ledger_.numerical += energy; }
  void sliding_took(double energy) { ledger_.friction += energy; }
  /// What the springs of all contacts and ties hold at the end of a step.
  void springs_hold(double energy) { ledger_.contact = energy; }
  /// By how much more the springs hold where contacts were found anew.
  void found_anew(double change);
  /// What multipliers gave beyond what they had taken, >= 0.
  void multipliers_gave(double beyond);

  /// Measures the elastic energy of one block, or of all.
  void measure_elastic(const BlockSystem& system, const std::vector<BlockState>& states, int block);
  void measure_elastic(const BlockSystem& system, const std::vector<BlockState>& states);
  /// Kinetic energy and that of gravity are those of these states, the elastic one as measured.
  void measure(const BlockSystem& system, const std::vector<BlockState>& states);
  /// Kinetic, elastic and of gravity, as measured.
  [[nodiscard]] double mechanical() const { return ledger_.kinetic + ledger_.elastic + ledger_.gravity; }

  /// Measures all and takes the balance as it is now for that of the start.
  void start(const BlockSystem& system, const std::vector<BlockState>& states);
  /// Forgets all that was booked; springs hold this much. To be followed by start().
  void clear(double in_springs);
  /// Measures the end of a step whose energies have been booked, and what the balance lacks.
  void close_step(const BlockSystem& system, const std::vector<BlockState>& states);

  /// Lists what a checkpoint stores (run/byte_archive.hpp); elastic energies of blocks follow from their states.
  template <class Archive>
  friend void visit_members(Archive& archive, LedgerKeeper& keeper) {
    auto& [ledger, start_balance, largest_step_residual, largest_energy, elastic_energies] = keeper;
    archive(ledger, start_balance, largest_step_residual, largest_energy);
  }

 private:
  Ledger ledger_;
  double start_balance_ = 0.0;
  double largest_step_residual_ = 0.0;
  double largest_energy_ = 0.0;
  std::vector<double> elastic_energies_;  ///< by block
};

}  // namespace ashlar
