#include "apps/run/run_files.hpp"

#include <chrono>
#include <numeric>
#include <utility>

#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/read/scene_json.hpp"

namespace ashlar {
namespace {

std::size_t contact_points(const std::vector<PairRecord>& records) {
  return std::accumulate(records.begin(), records.end(), std::size_t{0},
                         [](std::size_t sum, const PairRecord& pair) { return sum + pair.points.size(); });
}

}  // namespace

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

RunFiles::RunFiles(const LoadedScene& loaded, SceneIdentity identity, const FolderClaim& claim,
                   const Simulation& simulation, const RunCheckpoint* earlier, double start)
    : claim_(claim),
      start_(start),
      identity_(std::move(identity)),
      reserve_(claim.folder()),
      tables_(earlier != nullptr ? ResultFolder(claim.folder(), loaded.scene, simulation, earlier->folder)
                                 : ResultFolder(claim.folder(), loaded.scene, simulation)),
      scene_bytes_(json_text(to_json(loaded.scene), 2).size()) {
  if (earlier != nullptr) earlier_seconds_ = earlier->seconds;
}

void RunFiles::add_step(const Simulation& simulation) {
  claim_.check();
  tables_.add_step(simulation);
}

void RunFiles::write_state(const SimulationSnapshot& state, const std::vector<FinishedStage>& stages,
                           const ContactChanges& changes) {
  claim_.check();
  state_bytes_ = write_checkpoint(tables_.path() / checkpoint_name, identity_.scene,
                                  {state, stages, tables_.synced_state(), seconds(), changes});
}

bool RunFiles::outgrown(const Simulation& simulation) const {
  return contact_points(simulation.contacts()) > 2 * contact_points_;
}

void RunFiles::save(const SimulationSnapshot& state, const std::vector<FinishedStage>& stages,
                    const ContactChanges& changes) {
  write_state(state, stages, changes);
  contact_points_ = contact_points(state.run.records);
  // A state with twice the contact points, which requires another checkpoint (outgrown), and the summary fit in
  // beside the present state.
  constexpr std::uintmax_t states = 4, scenes = 2, rest = 1U << 18U;
  reserve_.hold(states * state_bytes_ + scenes * scene_bytes_ + rest);
}

void RunFiles::save_in_reserve(const SimulationSnapshot& state, const std::vector<FinishedStage>& stages,
                               const ContactChanges& changes) {
  reserve_.release();
  write_state(state, stages, changes);
}

void RunFiles::write_summary(const nlohmann::ordered_json& summary) const {
  claim_.check();
  write_file_atomically(tables_.path() / "summary.json", json_text(summary, 2) + "\n", Durability::process);
}

void RunFiles::write_summary_in_reserve(const nlohmann::ordered_json& summary) {
  reserve_.release();
  write_summary(summary);
}

RunSeconds RunFiles::seconds() const {
  return {earlier_seconds_.total + seconds_now() - start_, earlier_seconds_.setup + seconds_.setup,
          earlier_seconds_.output + seconds_.output};
}

}  // namespace ashlar
