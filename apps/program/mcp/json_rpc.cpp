#include "apps/program/mcp/json_rpc.hpp"

#include <utility>

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

bool is_identifier(const Json& id) {
  return id.is_string() || id.is_number_integer();
}

}  // namespace

RpcMessage read_message(const Json& json) {
  if (!json.is_object()) return RpcFault{rpc_error::invalid_request, "a message is a JSON object"};
  const auto id = json.find("id");
  const bool has_id = id != json.end();
  const Json known_id = has_id && is_identifier(*id) ? *id : Json();
  const auto fault = [&](const char* what) { return RpcFault{rpc_error::invalid_request, what, known_id}; };
  if (const auto version = json.find("jsonrpc"); version == json.end() || *version != "2.0")
    return fault("\"jsonrpc\" is missing or other than \"2.0\"");
  const auto method = json.find("method");
  if (method == json.end() && (json.contains("result") || json.contains("error"))) return RpcResponse{};
  if (method == json.end() || !method->is_string()) return fault("\"method\" is missing or no text");
  if (has_id && !is_identifier(*id))
    return fault("\"id\" is neither a text nor a whole number below 2^64; a notification has none");
  const auto parameters = json.find("params");
  if (parameters != json.end() && !parameters->is_object()) {
    return RpcFault{rpc_error::invalid_parameters, "\"params\" is no object", known_id};
  }
  return RpcRequest{known_id, method->get<std::string>(),
                    parameters == json.end() ? Json::object() : *parameters};
}

Json rpc_result(const Json& id, Json result) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
}

Json rpc_fault(const RpcFault& fault) {
  return {
      {"jsonrpc", "2.0"}, {"id", fault.id}, {"error", {{"code", fault.code}, {"message", fault.message}}}};
}

Json rpc_notification(const std::string& method, Json parameters) {
  return {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(parameters)}};
}

}  // namespace ashlar
