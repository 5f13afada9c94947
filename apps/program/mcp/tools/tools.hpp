// The tools of `ashlar mcp`, by what they work on.
#pragma once

#include <vector>

#include "apps/program/mcp/tool.hpp"
#include "apps/program/mcp/workspace.hpp"

namespace ashlar {

/// Search of the book and of the keys of scenes.
[[nodiscard]] std::vector<Tool> book_tools();
/// Files of the folder, new scenes.
[[nodiscard]] std::vector<Tool> file_tools(Workspace& workspace);
/// Tools of a scene: its faults and blocks; contacts of meshes and of blocks; verification cases.
[[nodiscard]] std::vector<Tool> scene_tools(Workspace& workspace);
/// Runs: started, polled, stopped.
[[nodiscard]] std::vector<Tool> run_tools(Workspace& workspace);
/// Tools of results: summary, history, pictures, page.
[[nodiscard]] std::vector<Tool> result_tools(Workspace& workspace);

/// All of them, in the order in which a client needs them. @param workspace lives longer
[[nodiscard]] std::vector<Tool> all_tools(Workspace& workspace);

}  // namespace ashlar
