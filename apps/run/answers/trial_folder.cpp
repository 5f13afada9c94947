#include "apps/run/answers/trial_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/results/folder/run_clock.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/answers/factor_analysis.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

FactorTrial trial_from(const Json& json) {
  FactorTrial trial{json.at("factor").get<double>(), TrialOutcome::unknown, json.at("iterations").get<int>()};
  for (const TrialOutcome outcome : {TrialOutcome::stands, TrialOutcome::moves})
    if (json.at("outcome") == to_string(outcome)) trial.outcome = outcome;
  return trial;
}

}  // namespace

bool holds_open_search(const std::filesystem::path& folder, const Scene& scene) {
  return seeks_factor(scene.analysis) &&
         (std::filesystem::exists(folder / trials_name) ||
          std::filesystem::exists(folder / trial_state_name)) &&
         !std::filesystem::exists(folder / checkpoint_name);
}

TrialFolder::TrialFolder(std::shared_ptr<const FolderClaim> claim, std::uint64_t scene, bool resume,
                         std::optional<double> interval)
    : claim_(std::move(claim)),
      scene_(scene),
      trials_path_(claim_->folder() / trials_name),
      state_path_(claim_->folder() / trial_state_name),
      schedule_(interval, RunClock::now()) {
  if (!resume) {
    std::filesystem::remove(trials_path_);
    std::filesystem::remove(state_path_);
  }
  if (!std::filesystem::exists(trials_path_)) return;
  const Json json = naming_the_file(trials_path_, [&] { return parse_json(whole_file(trials_path_)); });
  if (!json.is_object() || json.value("scene", std::uint64_t{0}) != scene_)
    throw std::runtime_error(
        fmt::format("{} is of another scene, a new folder, or --force, is needed", trials_path_.string()));
  naming_the_file(trials_path_, [&] {
    for (const Json& trial : json.at("trials")) trials_.push_back(trial_from(trial));
    return trials_.size();
  });
}

std::optional<FactorTrial> TrialFolder::find(double factor) const {
  const auto found = std::find_if(trials_.begin(), trials_.end(),
                                  [&](const FactorTrial& trial) { return trial.factor == factor; });
  return found == trials_.end() ? std::nullopt : std::optional(*found);
}

std::optional<RunCheckpoint> TrialFolder::begin(double factor) {
  schedule_.begin(RunClock::now());
  if (!std::filesystem::exists(state_path_)) return std::nullopt;
  try {
    return read_checkpoint(state_path_, hash_of(factor));
  } catch (const CheckpointError&) {
    std::filesystem::remove(state_path_);
    return std::nullopt;
  }
}

bool TrialFolder::due() const {
  return schedule_.due(RunClock::now());
}

void TrialFolder::save(double factor, const RunCheckpoint& state) {
  const double began = RunClock::now();
  write_checkpoint(state_path_, hash_of(factor), state);
  schedule_.saved(began, RunClock::now());
}

void TrialFolder::add(const FactorTrial& trial) {
  claim_->check();
  trials_.push_back(trial);
  const Json json = {{"scene", scene_}, {"trials", trials_json(trials_)}};
  write_file_atomically(trials_path_, json_text(json, 1) + "\n", Durability::power);
  std::filesystem::remove(state_path_);
}

/// Hash that identifies the state of a factor.
std::uint64_t TrialFolder::hash_of(double factor) const {
  ByteWriter writer;
  writer(factor);
  return hash_bytes(writer.take(), scene_);
}

}  // namespace ashlar
