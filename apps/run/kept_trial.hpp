// A static analysis of a search for a factor whose state is saved in the result folder during the analysis, so that
// an interrupted one can be continued.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/run/checkpoint_schedule.hpp"
#include "apps/run/factor_search.hpp"
#include "apps/scene/build/scene_loading.hpp"

namespace ashlar {

/// File name of the state of a trial in a result folder.
inline constexpr const char* trial_state_name = "factor_trial.checkpoint";

struct TrialManner {
  int threads = 1;
  std::optional<double> checkpoint_interval;  ///< s; empty: growing, see CheckpointSchedule
  bool quiet = false;                         ///< no progress output
};

class KeptTrial {
 public:
  /// @param scene must outlive this. @param hash of the scene (scene_identity.hpp). @param folder claimed by this run
  KeptTrial(const LoadedScene& scene, std::uint64_t hash, std::filesystem::path folder, TrialManner manner)
      : scene_(scene), hash_(hash), path_(std::move(folder) / trial_state_name), manner_(manner) {}

  /// Runs a trial, or continues it if the folder has its state. The state is saved when it is due, and when the trial
  /// is interrupted. Reports the number of iterations every few seconds.
  /// @param goes_on called before each iteration; false ends the trial. @return empty if it was ended
  /// @throws std::runtime_error with path and reason if the state cannot be written
  [[nodiscard]] std::optional<FactorTrial> run(double factor, const std::function<bool()>& goes_on,
                                               std::ostream& err);
  /// Number of iterations of the last trial.
  [[nodiscard]] int iterations() const { return iterations_; }
  /// Reason for an inconclusive last trial; empty otherwise.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// To be called once the outcome of the last trial is saved elsewhere.
  void forget() const { std::filesystem::remove(path_); }

 private:
  /// Hash that identifies the state of a factor.
  [[nodiscard]] std::uint64_t hash_of(double factor) const;

  const LoadedScene& scene_;
  std::uint64_t hash_;
  std::filesystem::path path_;
  TrialManner manner_;
  int iterations_ = 0;
  std::string reason_;
};

}  // namespace ashlar
