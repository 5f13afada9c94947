#include <stdexcept>
#include <string>

#include "apps/program/view/curved_cells.hpp"
#include "apps/results/frames/vtu/vtu_reader.hpp"
#include "apps/results/text/json_text.hpp"
#include "fuzz/targets.hpp"

namespace ashlar::fuzz {

bool vtu(std::string_view bytes) {
  try {
    const UnstructuredGrid grid = from_vtu(bytes);
    const std::string written = to_vtu(grid);
    require(to_vtu(from_vtu(written)) == written, "what is written is read back");
    const CurvedCells cells(grid);
    validate(cells.divided(grid));
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

bool pvd(std::string_view bytes) {
  try {
    (void)from_pvd(bytes);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

bool summary(std::string_view bytes) {
  try {
    const nlohmann::ordered_json json = parse_json(bytes);
    const std::string text = json_text(json);
    require(json_text(parse_json(text)) == text, "what is written is read back");
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace ashlar::fuzz
