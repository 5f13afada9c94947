// Keeps the energy ledger of a run (ledger.hpp). It is the only writer, so that each energy is booked once.
#pragma once

#include <vector>

#include "solver/state/block_system.hpp"
#include "solver/state/ledger.hpp"

namespace ashlar {

/// Books energies, J. Negative amounts cancel earlier ones.
class LedgerKeeper {
 public:
  [[nodiscard]] const Ledger& ledger() const { return ledger_; }
  /// Largest change of the residual in one step and largest energy so far, J.
  [[nodiscard]] double largest_step_residual() const { return largest_step_residual_; }
  [[nodiscard]] double largest_energy() const { return largest_energy_; }
  /// Elastic energy of a block at its last measurement, J.
  [[nodiscard]] double elastic_energy(int block) const {
    return elastic_energies_[static_cast<std::size_t>(block)];
  }

  void loads_did(double work) { ledger_.applied += work; }
  void damping_took(double energy) { ledger_.damping += energy; }
  void integrator_took(double energy) { ledger_.numerical += energy; }
  void sliding_took(double energy) { ledger_.friction += energy; }
  /// Sets the energy of the springs of all contacts and ties at the end of a step.
  void springs_hold(double energy) { ledger_.contact = energy; }
  /// Books the change of spring energy due to re-detected contacts.
  void found_anew(double change);
  /// Books energy released by multipliers beyond their accounts, >= 0.
  void multipliers_gave(double beyond);

  /// Measures the elastic energy of one block, or of all.
  void measure_elastic(const BlockSystem& system, const std::vector<BlockState>& states, int block);
  void measure_elastic(const BlockSystem& system, const std::vector<BlockState>& states);
  /// Measures kinetic and gravitational energy of states; the elastic energy is as last measured.
  void measure(const BlockSystem& system, const std::vector<BlockState>& states);
  /// Kinetic, elastic and gravitational energy, as measured.
  [[nodiscard]] double mechanical() const { return ledger_.kinetic + ledger_.elastic + ledger_.gravity; }

  /// Measures all energies and makes the present balance the initial one.
  void start(const BlockSystem& system, const std::vector<BlockState>& states);
  /// Replaces energies and the initial balance by those of a part of a run, or of the whole; largest values stay.
  void set(const Ledger& ledger, double start_balance) {
    ledger_ = ledger;
    start_balance_ = start_balance;
  }
  [[nodiscard]] double start_balance() const { return start_balance_; }
  /// Clears all bookings and sets the spring energy. To be followed by start().
  void clear(double in_springs);
  /// Measures the energies at the end of a step whose work has been booked, and the error of the balance.
  void close_step(const BlockSystem& system, const std::vector<BlockState>& states);

  /// Lists the data of a checkpoint (byte_archive.hpp); elastic energies of blocks follow from their states.
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
