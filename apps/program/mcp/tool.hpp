// A tool that a server offers to its clients, and a call of one.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>

#include "apps/program/mcp/shared_folder.hpp"

namespace ashlar {

/// Answer to a call.
struct ToolAnswer {
  std::string text;
  nlohmann::ordered_json data = nullptr;  ///< an object that the text holds too, for programs; null: none
  std::string png;                        ///< bytes of a picture; empty: none
  bool is_error = false;                  ///< the text says what is wrong and what to do instead
};

/// An answer with an object, which is its text too.
[[nodiscard]] ToolAnswer data_answer(nlohmann::ordered_json data);
[[nodiscard]] ToolAnswer error_answer(std::string text);

/// A call whose answer takes time. Its destructor gives it up, and ends what was started for it alone.
class ToolCall {
 public:
  ToolCall() = default;
  ToolCall(const ToolCall&) = delete;
  ToolCall& operator=(const ToolCall&) = delete;
  virtual ~ToolCall() = default;

  /// Empty while it works; then, once, its answer. @throws std::exception as Tool::call
  [[nodiscard]] virtual std::optional<ToolAnswer> answer() = 0;
  /// Given up by the client, before the destructor.
  virtual void cancel() {}
  /// Its state in words, for notifications; may be empty.
  [[nodiscard]] virtual std::string progress() const { return ""; }
};

using ToolStart = std::variant<ToolAnswer, std::unique_ptr<ToolCall>>;

struct Tool {
  std::string name;  ///< of letters and _
  std::string title;
  std::string description;
  nlohmann::ordered_json arguments;  ///< of argument_schema.hpp
  bool reads_only = true;            ///< changes no file
  /// @param arguments fit the schema. @throws ToolRefusal, other std::exception: the call's error
  std::function<ToolStart(const nlohmann::ordered_json& arguments)> call;
};

}  // namespace ashlar
