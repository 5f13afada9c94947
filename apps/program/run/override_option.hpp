// The option --set, common to all commands that take a scene.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ashlar {

/// Declares the repeatable option --set on a sub-command. @param overrides "key.path=value" each, in order; see
/// scene_overrides.hpp; must outlive the parsing.
void declare_overrides(CLI::App& command, std::vector<std::string>& overrides);

}  // namespace ashlar
