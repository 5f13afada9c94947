#include "apps/program/run/override_option.hpp"

#include <CLI/CLI.hpp>

namespace ashlar {

void declare_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  // One value per --set: without this limit CLI11 would take the arguments after it as further values.
  command
      .add_option("--set", overrides,
                  "Override a key of the scene: analysis.time_step=1e-4, block.B.order=5, block.0.order=5 "
                  "(repeatable)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->take_all();
}

}  // namespace ashlar
