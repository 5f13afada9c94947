// A static analysis of a search for a factor whose state is kept in the result folder while it goes on, so that one that
// is stopped goes on where it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/run/checkpoint_schedule.hpp"
#include "apps/run/factor_search.hpp"
#include "apps/scene/scene_loading.hpp"

namespace ashlar {

/// Of the state of a trial, in a result folder.
inline constexpr const char* trial_state_name = "factor_trial.checkpoint";

struct TrialManner {
  int threads = 1;
  std::optional<double> checkpoint_interval;  ///< s; empty: growing, see CheckpointSchedule
  bool quiet = false;                         ///< no progress
};

class KeptTrial {
 public:
  /// @param scene outlives it. @param hash of the scene (scene_identity.hpp). @param folder claimed by this run
  KeptTrial(const LoadedScene& scene, std::uint64_t hash, std::filesystem::path folder, TrialManner manner)
      : scene_(scene), hash_(hash), path_(std::move(folder) / trial_state_name), manner_(manner) {}

  /// Runs a trial, or goes on with it if the folder has its state; that is kept when it is due, and when the trial is
  /// stopped. Tells the number of iterations every few seconds.
  /// @param goes_on asked before each iteration. @return empty: it was told to stop
  /// @throws std::runtime_error with path and reason if the state cannot be written
  [[nodiscard]] std::optional<FactorTrial> run(double factor, const std::function<bool()>& goes_on,
                                               std::ostream& err);
  /// Of the last trial.
  [[nodiscard]] int iterations() const { return iterations_; }
  /// Why the last trial found neither equilibrium nor motion; empty if it did.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// To be called once the last trial's outcome is kept elsewhere.
  void forget() const { std::filesystem::remove(path_); }

 private:
  /// State of another factor is of no use.
  [[nodiscard]] std::uint64_t hash_of(double factor) const;

  const LoadedScene& scene_;
  std::uint64_t hash_;
  std::filesystem::path path_;
  TrialManner manner_;
  int iterations_ = 0;
  std::string reason_;
};

}  // namespace ashlar
