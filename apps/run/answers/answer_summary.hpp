// Answers in the summary, in text and as drawings.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/results/folder/run_status.hpp"
#include "apps/run/answers/answer.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Adds thrust, pushover and kinematic, factor_of_safety or load_factor. @param simulation at the end of the motion shown
void add_answer(nlohmann::ordered_json& summary, const Answer& answer, const SceneAnalysis& analysis,
                const Simulation& simulation);

/// End of a run. message: the answer in words.
struct AnsweredEnd {
  RunStatus status = RunStatus::completed;
  std::string message;
};

/// Factor on loads in the states of the answer; empty: they have those of the scene.
[[nodiscard]] std::optional<double> factor_of_states(const Answer& answer, const SceneAnalysis& analysis);

/// End of a run that shows the states of its answer. @pre answer.shows_states()
[[nodiscard]] AnsweredEnd shown_end(const Answer& answer, const SceneAnalysis& analysis,
                                    const Simulation& simulation);
/// End of a search by static analyses whose motion was shown. @param shown its end: interrupts remain as they are
[[nodiscard]] AnsweredEnd bracket_end(const Answer& answer, const SceneAnalysis& analysis,
                                      const Simulation& simulation, AnsweredEnd shown);

/// Draws lines of thrust (thrust.svg) and the first support's movement (movement.svg), or writes the files of a pushover
/// (pushover_drawing.hpp), into a folder. Does nothing without them. @throws std::runtime_error with path and reason
void draw_answer(const Answer& answer, const Scene& scene, const Simulation& simulation,
                 const std::filesystem::path& folder);

}  // namespace ashlar
