#include "apps/program/mcp/mcp_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <utility>

#include "apps/program/mcp/argument_schema.hpp"
#include "apps/program/mcp/book_resources.hpp"
#include "apps/results/folder/program_version.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/meshes/base64.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

// Oldest first. Batches are of the second only, structured content is of the last.
constexpr std::array<std::string_view, 3> revisions = {"2024-11-05", "2025-03-26", "2025-06-18"};

constexpr auto instructions =
    "Ashlar simulates loose blocks of rock and masonry (3-D discontinuous deformation analysis). A job: "
    "search_book and "
    "scene_keys tell how; new_scene or write_file writes a scene (TOML); check lists its faults with their "
    "places, "
    "correct them all; run_start runs it, run_status polls; summary, history and picture show the results. "
    "Paths are "
    "relative to the server's folder. SI units, degrees, z is up. A result is as good as its model: compare "
    "with a "
    "formula or a case of verify, and tell the user what was assumed.";

/// Text of a parameter. @throws RpcFault if it is missing or something else
const std::string& text_parameter(const RpcRequest& request, const char* name) {
  const auto found = request.parameters.find(name);
  if (found == request.parameters.end() || !found->is_string())
    throw RpcFault{rpc_error::invalid_parameters, fmt::format("\"{}\" is missing or no text", name),
                   request.id};
  return found->get_ref<const std::string&>();
}

/// All entries are on one page.
void refuse_cursor(const RpcRequest& request) {
  if (request.parameters.contains("cursor"))
    throw RpcFault{rpc_error::invalid_parameters, "there is no such cursor: lists have one page", request.id};
}

Json list_entry(const Tool& tool) {
  return {{"name", tool.name},
          {"title", tool.title},
          {"description", tool.description},
          {"inputSchema", tool.arguments},
          {"annotations",
           {{"title", tool.title},
            {"readOnlyHint", tool.reads_only},
            {"destructiveHint", !tool.reads_only},
            {"openWorldHint", false}}}};
}

}  // namespace

McpSession::McpSession(std::vector<Tool> tools, Send send)
    : tools_(std::move(tools)), send_(std::move(send)) {}

void McpSession::receive(std::string_view line) {
  if (line.find_first_not_of(" \t\r") == std::string_view::npos) return;
  Json json;
  try {
    json = parse_json(line);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    send_(rpc_fault({rpc_error::parse, fault_text(fault)}));
    return;
  }
  if (json.is_array())
    receive_batch(json);
  else
    receive_message(json, nullptr);
}

void McpSession::refuse_long_line(std::size_t longest) {
  send_(rpc_fault({rpc_error::invalid_request, fmt::format("a message has at most {} bytes", longest)}));
}

void McpSession::receive_batch(const Json& messages) {
  if (revision_ != revisions[1] || messages.empty()) {
    send_(rpc_fault({rpc_error::invalid_request,
                     "a list of messages is allowed in revision 2025-03-26 only, and there with one message "
                     "or more: send "
                     "one object a line"}));
    return;
  }
  // Requests answer themselves; others leave the count as it is.
  const auto batch = std::make_shared<Batch>();
  batch->missing = 1;  // until all messages are read
  for (const Json& message : messages) receive_message(message, batch);
  --batch->missing;
  if (batch->missing == 0 && !batch->answers.empty()) send_(batch->answers);
}

void McpSession::receive_message(const Json& json, const std::shared_ptr<Batch>& batch) {
  const RpcMessage message = read_message(json);
  if (const auto* fault = std::get_if<RpcFault>(&message)) {
    if (batch) ++batch->missing;
    answer(rpc_fault(*fault), batch);
  } else if (const auto* request = std::get_if<RpcRequest>(&message)) {
    if (request->is_notification()) {
      take_notification(*request);
    } else {
      if (batch) ++batch->missing;
      take_request(*request, batch);
    }
  }
}

void McpSession::answer(Json message, const std::shared_ptr<Batch>& batch) {
  if (!batch) {
    send_(message);
    return;
  }
  batch->answers.push_back(std::move(message));
  if (--batch->missing == 0) send_(batch->answers);
}

void McpSession::take_notification(const RpcRequest& notification) {
  if (notification.method != "notifications/cancelled") return;
  const auto id = notification.parameters.find("requestId");
  if (id == notification.parameters.end()) return;
  const auto call =
      std::find_if(calls_.begin(), calls_.end(), [&](const Call& one) { return one.id == *id; });
  if (call == calls_.end()) return;  // answered meanwhile
  call->work->cancel();
  if (call->batch && --call->batch->missing == 0 && !call->batch->answers.empty())
    send_(call->batch->answers);
  calls_.erase(call);
}

void McpSession::take_request(const RpcRequest& request, const std::shared_ptr<Batch>& batch) {
  try {
    const bool open = request.method == "initialize" || request.method == "ping";
    if (revision_.empty() && !open)
      throw RpcFault{rpc_error::invalid_request, "the first request is initialize", request.id};
    if (std::any_of(calls_.begin(), calls_.end(), [&](const Call& call) { return call.id == request.id; }))
      throw RpcFault{rpc_error::invalid_request, "this id is that of a request that is still at work",
                     request.id};
    if (request.method == "initialize" && batch)
      throw RpcFault{rpc_error::invalid_request, "initialize comes alone, not in a list", request.id};
    if (request.method == "tools/call")
      call_tool(request, batch);
    else
      answer(rpc_result(request.id, result_of(request)), batch);
  } catch (const RpcFault& fault) {
    answer(rpc_fault(fault), batch);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    answer(rpc_fault({rpc_error::internal, fault_text(failure), request.id}), batch);
  }
}

Json McpSession::result_of(const RpcRequest& request) {
  if (request.method == "initialize") return initialize(request);
  if (request.method == "ping") return Json::object();
  if (request.method == "tools/list") {
    refuse_cursor(request);
    Json list = Json::array();
    for (const Tool& tool : tools_) list.push_back(list_entry(tool));
    return {{"tools", std::move(list)}};
  }
  if (request.method == "resources/list") {
    refuse_cursor(request);
    return {{"resources", resource_list()}};
  }
  if (request.method == "resources/templates/list") {
    refuse_cursor(request);
    return {{"resourceTemplates", Json::array()}};
  }
  if (request.method == "resources/read") {
    const std::string& uri = text_parameter(request, "uri");
    if (std::optional<Json> contents = resource_contents(uri)) return *std::move(contents);
    throw RpcFault{rpc_error::no_resource, "there is no such resource; resources/list names all", request.id};
  }
  throw RpcFault{rpc_error::unknown_method, "this server has no such method", request.id};
}

Json McpSession::initialize(const RpcRequest& request) {
  if (!revision_.empty())
    throw RpcFault{rpc_error::invalid_request, "the session is initialized already", request.id};
  const std::string& wanted = text_parameter(request, "protocolVersion");
  const bool known = std::find(revisions.begin(), revisions.end(), wanted) != revisions.end();
  revision_ = known ? wanted : std::string(revisions.back());
  return {{"protocolVersion", revision_},
          {"capabilities", {{"tools", {{"listChanged", false}}}, {"resources", Json::object()}}},
          {"serverInfo", {{"name", "ashlar"}, {"title", "Ashlar"}, {"version", program_version()}}},
          {"instructions", instructions}};
}

void McpSession::call_tool(const RpcRequest& request, const std::shared_ptr<Batch>& batch) {
  const std::string& name = text_parameter(request, "name");
  const auto tool =
      std::find_if(tools_.begin(), tools_.end(), [&](const Tool& one) { return one.name == name; });
  if (tool == tools_.end()) {
    std::vector<std::string> names;
    for (const Tool& one : tools_) names.push_back(one.name);
    throw RpcFault{rpc_error::invalid_parameters,
                   fmt::format("unknown tool, {}tools/list names all", guess(name, names)), request.id};
  }
  const auto given = request.parameters.find("arguments");
  const Json arguments = given == request.parameters.end() ? Json::object() : *given;
  if (!arguments.is_object())
    throw RpcFault{rpc_error::invalid_parameters, "\"arguments\" is no object", request.id};
  // Faults that the client's model can correct are results, not errors of the protocol.
  if (const std::string fault = fault_of_arguments(tool->arguments, arguments); !fault.empty()) {
    answer(rpc_result(request.id, call_result(error_answer(fault))), batch);
    return;
  }
  ToolStart start;
  try {
    start = tool->call(arguments);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    start = error_answer(fault_text(failure));
  }
  if (const auto* done = std::get_if<ToolAnswer>(&start)) {
    answer(rpc_result(request.id, call_result(*done)), batch);
    return;
  }
  Json token;
  if (const auto more = request.parameters.find("_meta");
      more != request.parameters.end() && more->is_object())
    if (const auto found = more->find("progressToken"); found != more->end()) token = *found;
  if (!token.is_string() && !token.is_number_integer()) token = nullptr;
  const auto now = std::chrono::steady_clock::now();
  calls_.push_back(
      {request.id, token, std::get<std::unique_ptr<ToolCall>>(std::move(start)), batch, now, now});
}

Json McpSession::call_result(const ToolAnswer& answer) const {
  Json content = Json::array();
  if (!answer.text.empty()) content.push_back({{"type", "text"}, {"text", answer.text}});
  if (!answer.png.empty())
    content.push_back({{"type", "image"}, {"data", to_base64(answer.png)}, {"mimeType", "image/png"}});
  Json result = {{"content", std::move(content)}, {"isError", answer.is_error}};
  if (answer.data.is_object() && revision_ == revisions.back()) result["structuredContent"] = answer.data;
  return result;
}

void McpSession::tell_progress(Call& call) {
  constexpr std::chrono::seconds interval(1);
  const auto now = std::chrono::steady_clock::now();
  if (call.progress_token.is_null() || now - call.told < interval) return;
  call.told = now;
  Json told = {{"progressToken", call.progress_token},
               {"progress", std::chrono::duration<double>(now - call.started).count()}};
  if (const std::string words = call.work->progress(); !words.empty() && revision_ != revisions.front())
    told["message"] = words;
  send_(rpc_notification("notifications/progress", std::move(told)));
}

void McpSession::poll() {
  for (std::size_t k = 0; k < calls_.size();) {
    std::optional<ToolAnswer> done;
    try {
      done = calls_[k].work->answer();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& failure) {
      done = error_answer(fault_text(failure));
    }
    if (!done) {
      tell_progress(calls_[k++]);
      continue;
    }
    answer(rpc_result(calls_[k].id, call_result(*done)), calls_[k].batch);
    calls_.erase(calls_.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

}  // namespace ashlar
