#include "apps/program/mcp/tool.hpp"

#include <utility>

#include "apps/results/text/json_text.hpp"

namespace ashlar {

ToolAnswer data_answer(nlohmann::ordered_json data) {
  std::string text = json_text(data);
  return {std::move(text), std::move(data), "", false};
}

ToolAnswer error_answer(std::string text) {
  return {std::move(text), nullptr, "", true};
}

}  // namespace ashlar
