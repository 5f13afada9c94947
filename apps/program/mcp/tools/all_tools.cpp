#include <iterator>
#include <utility>

#include "apps/program/mcp/tools/tools.hpp"

namespace ashlar {

std::vector<Tool> all_tools(Workspace& workspace) {
  std::vector<Tool> all;
  for (std::vector<Tool> some : {book_tools(), file_tools(workspace), scene_tools(workspace),
                                 run_tools(workspace), result_tools(workspace)})
    all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
  return all;
}

}  // namespace ashlar
