#include "apps/program/mcp/command_call.hpp"

#include <fmt/format.h>

#include <iostream>
#include <utility>

#include "apps/program/command_line.hpp"
#include "apps/results/text/json_text.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

class CommandCall final : public ToolCall {
 public:
  CommandCall(Workspace& workspace, CommandWork work)
      : work_(std::move(work)),
        limit_(workspace.limits().seconds),
        process_(work_.work, workspace.scratch_name(),
                 work_.limited ? workspace.readable() : std::vector<std::filesystem::path>(),
                 CopyEnd::at_once) {}

  std::optional<ToolAnswer> answer() override {
    if (const std::optional<int> status = process_.status())
      return work_.answer({*status, process_.out(), process_.err()});
    if (process_.seconds() < limit_) return std::nullopt;
    process_.end_at_once();
    return error_answer(fmt::format(
        "ended after {} s, the server's limit of a call: ask for less, or have the server started with "
        "a larger --seconds",
        limit_));
  }

  [[nodiscard]] std::string progress() const override {
    constexpr std::size_t most = 200;
    std::string text = last_part(process_.err(), most);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text.substr(text.rfind('\n') + 1);
  }

 private:
  CommandWork work_;
  double limit_;
  WorkProcess process_;
};

}  // namespace

std::function<int()> command_line_work(std::vector<std::string> arguments) {
  return [words = std::move(arguments)] { return run_command_line(words, std::cout, std::cerr); };
}

std::unique_ptr<ToolCall> command_call(Workspace& workspace, CommandWork work) {
  return std::make_unique<CommandCall>(workspace, std::move(work));
}

std::string last_part(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  const std::size_t line = text.find('\n', text.size() - most);
  return line == std::string::npos ? text.substr(text.size() - most) : text.substr(line + 1);
}

ToolAnswer command_error(const CommandOutcome& outcome) {
  constexpr std::size_t most = 20'000;
  constexpr std::string_view start = "ashlar: error: ";
  std::string text;
  for (std::size_t begin = 0; begin < outcome.err.size();) {
    const std::size_t end = std::min(outcome.err.find('\n', begin), outcome.err.size());
    const std::string_view line = std::string_view(outcome.err).substr(begin, end - begin);
    text += std::string(line.starts_with(start) ? line.substr(start.size()) : line) + '\n';
    begin = end + 1;
  }
  if (text.empty())
    text = outcome.status < 0
               ? "the program was ended by the system, perhaps for want of memory: ask for less"
               : fmt::format("the program ended with exit status {}", outcome.status);
  return error_answer(last_part(text, most));
}

std::vector<std::string> overrides_of(const Json& arguments) {
  std::vector<std::string> all;
  if (!arguments.contains("set")) return all;
  for (const auto& [key, value] : arguments["set"].items())
    all.push_back(key + "=" + (value.is_string() ? value.get<std::string>() : json_text(value)));
  return all;
}

void add_overrides(std::vector<std::string>& words, const Json& arguments) {
  // One word each: a key that begins with - is no option.
  for (const std::string& text : overrides_of(arguments)) words.push_back("--set=" + text);
}

}  // namespace ashlar
