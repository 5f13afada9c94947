// Contacts that prevent a static analysis from converging: those that open, close, stick or slide again in iteration
// after iteration.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "solver/block_pair.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

class ContactChanges {
 public:
  /// Number of last iterations examined.
  static constexpr int window = 50;

  /// Adds the last iteration of a static analysis.
  void note(const Simulation& simulation);
  void forget() { *this = ContactChanges(); }

  struct Alternating {
    PairKey blocks;
    int changes;     ///< iterations in which it had other numbers of open, locked and sliding points
    int iterations;  ///< iterations examined, at most `window`
  };
  /// Pair whose contacts changed most often; empty if none did in the last iterations.
  [[nodiscard]] std::optional<Alternating> most() const;

  /// Lists all members, for a checkpoint.
  template <class Archive>
  friend void visit_members(Archive& archive, ContactChanges& changes) {
    auto& [pairs, iteration] = changes;
    archive(pairs, iteration);
  }

 private:
  struct Pair {
    std::array<int, 3> states = {};  ///< points by ContactState, in the last iteration
    std::vector<int> changes;        ///< iterations of the window with other numbers than before
  };
  std::map<PairKey, Pair> pairs_;
  int iteration_ = 0;
};

/// Reason for a static analysis without result, and remedies: "no equilibrium was found in 500 iterations under the
/// loads at t = 1 s: contacts of blocks a and b changed in 48 of the last 50; order = 1 in place of 0, or
/// contact.augmented = false, may converge".
[[nodiscard]] std::string describe_unconverged(const Simulation& simulation, const ContactChanges& changes);

}  // namespace ashlar
