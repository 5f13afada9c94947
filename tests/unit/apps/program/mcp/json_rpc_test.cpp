#include "apps/program/mcp/json_rpc.hpp"

#include <gtest/gtest.h>

namespace ashlar::json_rpc_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(ReadMessage, TellsRequestsNotificationsAndAnswersApart) {
  const RpcMessage request =
      read_message({{"jsonrpc", "2.0"}, {"id", "a"}, {"method", "ping"}, {"params", {{"x", 1}}}});
  EXPECT_EQ(std::get<RpcRequest>(request).id, "a");
  EXPECT_EQ(std::get<RpcRequest>(request).parameters["x"], 1);
  EXPECT_FALSE(std::get<RpcRequest>(request).is_notification());
  const RpcMessage notification = read_message({{"jsonrpc", "2.0"}, {"method", "notifications/initialized"}});
  EXPECT_TRUE(std::get<RpcRequest>(notification).is_notification());
  EXPECT_EQ(std::get<RpcRequest>(notification).parameters, Json::object());
  EXPECT_TRUE(std::holds_alternative<RpcResponse>(
      read_message({{"jsonrpc", "2.0"}, {"id", 1}, {"result", Json::object()}})));
}

TEST(ReadMessage, NamesTheRequestOfAFaultWhereItCan) {
  const auto fault = [](const Json& json) { return std::get<RpcFault>(read_message(json)); };
  EXPECT_EQ(fault({{"id", 3}, {"method", "ping"}}).id, 3);
  EXPECT_EQ(fault({{"jsonrpc", "2.0"}, {"id", 3}}).code, rpc_error::invalid_request);
  EXPECT_EQ(fault({{"jsonrpc", "2.0"}, {"id", 3}, {"method", "x"}, {"params", Json::array()}}).code,
            rpc_error::invalid_parameters);
  for (const Json& id : {Json(nullptr), Json(1.5), Json(true), Json::array(), Json::object()})
    EXPECT_EQ(fault({{"jsonrpc", "2.0"}, {"id", id}, {"method", "ping"}}).id, nullptr) << id;
  EXPECT_EQ(fault("text").id, nullptr);
}

TEST(RpcFaultMessage, HasCodeMessageAndId) {
  EXPECT_EQ(rpc_fault({rpc_error::parse, "why"}).dump(),
            R"({"jsonrpc":"2.0","id":null,"error":{"code":-32700,"message":"why"}})");
  EXPECT_EQ(rpc_result(7, Json::object()).dump(), R"({"jsonrpc":"2.0","id":7,"result":{}})");
}

}  // namespace
}  // namespace ashlar::json_rpc_test
