#include "solver/state/ledger_keeper.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {

void LedgerKeeper::found_anew(double change) {
  (change > 0.0 ? ledger_.redetection_gained : ledger_.redetection_lost) += std::abs(change);
}

void LedgerKeeper::multipliers_gave(double beyond) {
  ledger_.redetection_gained += beyond;
  ledger_.numerical += beyond;
}

void LedgerKeeper::measure_elastic(const BlockSystem& system, const std::vector<BlockState>& states,
                                   int block) {
  if (!system.blocks()[at(block)].fixed() && system.here(block) && system.owns(block))
    elastic_energies_[at(block)] = system.blocks()[at(block)].elastic(states[at(block)].position).energy;
}

void LedgerKeeper::measure_elastic(const BlockSystem& system, const std::vector<BlockState>& states) {
  elastic_energies_.assign(states.size(), 0.0);
  for (int k = 0; k < system.count(); ++k) measure_elastic(system, states, k);
}

void LedgerKeeper::measure(const BlockSystem& system, const std::vector<BlockState>& states) {
  ledger_.kinetic = ledger_.elastic = ledger_.gravity = 0.0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const BlockModel& block = system.blocks()[k];
    if (block.fixed() || !system.here(static_cast<int>(k)) || !system.owns(static_cast<int>(k))) continue;
    ledger_.kinetic += block.kinetic_energy(states[k]);
    ledger_.elastic += elastic_energies_[k];
    if (system.settings().gravity_history.empty())
      ledger_.gravity += block.gravity_energy(states[k], system.settings().gravity);
  }
}

void LedgerKeeper::start(const BlockSystem& system, const std::vector<BlockState>& states) {
  measure_elastic(system, states);
  measure(system, states);
  start_balance_ = ledger_.balance();
}

void LedgerKeeper::clear(double in_springs) {
  ledger_ = Ledger{};
  ledger_.contact = in_springs;
  largest_step_residual_ = largest_energy_ = 0.0;
}

void LedgerKeeper::close_step(const BlockSystem& system, const std::vector<BlockState>& states) {
  const double last_residual = ledger_.residual;
  measure(system, states);
  ledger_.residual = ledger_.balance() - start_balance_;
  std::vector<double> sums = {ledger_.residual - last_residual,
                              ledger_.kinetic,
                              ledger_.elastic,
                              ledger_.contact,
                              ledger_.friction,
                              ledger_.applied};
  sums = sum_of_run(system, sums);
  largest_step_residual_ = std::max(largest_step_residual_, std::abs(sums[0]));
  largest_energy_ =
      std::max({largest_energy_, sums[1], sums[2], sums[3], std::abs(sums[4]), std::abs(sums[5])});
}

}  // namespace ashlar
