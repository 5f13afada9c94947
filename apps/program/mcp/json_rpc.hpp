// Messages of JSON-RPC 2.0, as the Model Context Protocol (MCP) restricts them: identifiers of requests are texts or whole
// numbers, never null, and parameters are objects.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <variant>

namespace ashlar {

/// Codes of errors.
namespace rpc_error {
inline constexpr int parse = -32700;  ///< no JSON
inline constexpr int invalid_request =
    -32600;                                    ///< no message of JSON-RPC, or none that is allowed at present
inline constexpr int unknown_method = -32601;  ///< the server has no such method
inline constexpr int invalid_parameters = -32602;  ///< an unknown tool, missing or malformed parameters
inline constexpr int internal = -32603;            ///< the server failed
inline constexpr int no_resource = -32002;         ///< MCP: there is no resource of that address
}  // namespace rpc_error

/// An error as the answer to a request.
struct RpcFault {
  int code;
  std::string message;
  nlohmann::ordered_json id = nullptr;  ///< of the request, null if it could not be read
};

struct RpcRequest {
  nlohmann::ordered_json id;  ///< text or whole number; null: a notification, which has no answer
  std::string method;
  nlohmann::ordered_json parameters;  ///< an object, empty if none were sent

  [[nodiscard]] bool is_notification() const { return id.is_null(); }
};

/// An answer to a request of ours.
struct RpcResponse {};

/// One message that was received.
using RpcMessage = std::variant<RpcRequest, RpcResponse, RpcFault>;

/// Reads one message, not a batch.
[[nodiscard]] RpcMessage read_message(const nlohmann::ordered_json& json);

[[nodiscard]] nlohmann::ordered_json rpc_result(const nlohmann::ordered_json& id,
                                                nlohmann::ordered_json result);
[[nodiscard]] nlohmann::ordered_json rpc_fault(const RpcFault& fault);
[[nodiscard]] nlohmann::ordered_json rpc_notification(const std::string& method,
                                                      nlohmann::ordered_json parameters);

}  // namespace ashlar
