// One client of `ashlar mcp`: the Model Context Protocol, revisions 2024-11-05, 2025-03-26 and 2025-06-18
// (modelcontextprotocol.io), over messages of JSON-RPC, a line each. Tools and the pages of the book are offered.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/program/mcp/json_rpc.hpp"
#include "apps/program/mcp/tool.hpp"

namespace ashlar {

class McpSession {
 public:
  using Send = std::function<void(const nlohmann::ordered_json& message)>;

  /// @param send receives what the client is to get, an object or, as answer to a batch, a list
  McpSession(std::vector<Tool> tools, Send send);

  /// Takes a line of the client. Its answer is sent at once, or by a later poll(). Never throws for what a client sends.
  void receive(std::string_view line);
  /// Answers a line that was too long to be read.
  void refuse_long_line(std::size_t longest);
  /// Sends answers of calls that have ended, and progress of those whose client wants it.
  void poll();
  /// True while calls work.
  [[nodiscard]] bool works() const { return !calls_.empty(); }

 private:
  /// Answers that are sent together.
  struct Batch {
    nlohmann::ordered_json answers = nlohmann::ordered_json::array();
    std::size_t missing = 0;
  };
  struct Call {
    nlohmann::ordered_json id, progress_token;
    std::unique_ptr<ToolCall> work;
    std::shared_ptr<Batch> batch;  ///< null: answered alone
    std::chrono::steady_clock::time_point started, told;
  };

  void receive_batch(const nlohmann::ordered_json& messages);
  void receive_message(const nlohmann::ordered_json& json, const std::shared_ptr<Batch>& batch);
  void answer(nlohmann::ordered_json message, const std::shared_ptr<Batch>& batch);
  void take_notification(const RpcRequest& notification);
  void take_request(const RpcRequest& request, const std::shared_ptr<Batch>& batch);
  /// Of all methods but tools/call. @throws RpcFault
  nlohmann::ordered_json result_of(const RpcRequest& request);
  nlohmann::ordered_json initialize(const RpcRequest& request);
  /// @throws RpcFault
  void call_tool(const RpcRequest& request, const std::shared_ptr<Batch>& batch);
  [[nodiscard]] nlohmann::ordered_json call_result(const ToolAnswer& answer) const;
  void tell_progress(Call& call);

  std::vector<Tool> tools_;
  Send send_;
  std::vector<Call> calls_;
  std::string revision_;  ///< agreed with the client; empty before initialize
};

}  // namespace ashlar
