// Order of the protocol, with tools of the test's own; tests/mcp talks to the program itself.
#include "apps/program/mcp/mcp_session.hpp"

#include <gmock/gmock.h>

#include "apps/program/mcp/argument_schema.hpp"
#include "apps/results/text/json_text.hpp"

namespace ashlar::mcp_session_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// A call that ends when it is told to.
class Waiting final : public ToolCall {
 public:
  struct State {
    bool ends = false, cancelled = false, gone = false;
  };
  explicit Waiting(std::shared_ptr<State> state) : state_(std::move(state)) {}
  ~Waiting() override { state_->gone = true; }
  std::optional<ToolAnswer> answer() override {
    return state_->ends ? std::optional(data_answer({{"good", true}})) : std::nullopt;
  }
  void cancel() override { state_->cancelled = true; }

 private:
  std::shared_ptr<State> state_;
};

class Session : public ::testing::Test {
 protected:
  Session() {
    const Json none = arguments_schema({});
    tools_.push_back({"quick", "Quick", "Answers at once.", none, true, [](const Json&) -> ToolStart {
                        return ToolAnswer{"text", nullptr, "\x89PNG", false};
                      }});
    tools_.push_back({"slow", "Slow", "Works.", none, true,
                      [this](const Json&) -> ToolStart { return std::make_unique<Waiting>(state_); }});
    tools_.push_back({"refused", "Refused", "Refuses.", none, true,
                      [](const Json&) -> ToolStart { throw ToolRefusal("no; do that instead"); }});
    session_.emplace(tools_, [this](const Json& message) { sent_.push_back(message); });
  }

  void begin(const char* revision) {
    request(0, "initialize", {{"protocolVersion", revision}});
    sent_.clear();
  }
  static Json message(const Json& id, const char* method, const Json& parameters) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", parameters}};
  }
  void request(const Json& id, const char* method, const Json& parameters = Json::object()) {
    session_->receive(json_text(message(id, method, parameters)));
  }
  /// The only message that was sent since the last one.
  Json sent() {
    EXPECT_EQ(sent_.size(), 1U);
    const Json only = sent_.empty() ? Json() : sent_.front();
    sent_.clear();
    return only;
  }

  std::shared_ptr<Waiting::State> state_ = std::make_shared<Waiting::State>();
  std::vector<Tool> tools_;
  std::vector<Json> sent_;
  std::optional<McpSession> session_;
};

TEST_F(Session, TextAndPicturesAreContent) {
  begin("2025-06-18");
  request(1, "tools/call", {{"name", "quick"}});
  const Json result = sent()["result"];
  EXPECT_EQ(result["content"][0].dump(), R"({"type":"text","text":"text"})");
  // 89 50 4e 47 in base64, by hand: 100010 010101 000001 001110 010001 11(0000).
  EXPECT_EQ(result["content"][1].dump(), R"({"type":"image","data":"iVBORw==","mimeType":"image/png"})");
  EXPECT_EQ(result["isError"], false);
}

TEST_F(Session, ARefusalIsAResult) {
  begin("2025-06-18");
  request(1, "tools/call", {{"name", "refused"}});
  const Json result = sent()["result"];
  EXPECT_EQ(result["isError"], true);
  EXPECT_EQ(result["content"][0]["text"], "no; do that instead");
  request(2, "tools/call", {{"name", "refused"}, {"arguments", {{"a", 1}}}});
  EXPECT_THAT(sent()["result"]["content"][0]["text"].get<std::string>(), HasSubstr("unknown argument"));
}

TEST_F(Session, CallsAreAnsweredWhenTheyEnd) {
  begin("2025-06-18");
  request("a", "tools/call", {{"name", "slow"}});
  session_->poll();
  request(2, "ping");
  EXPECT_EQ(sent()["id"], 2);
  EXPECT_TRUE(session_->works());
  state_->ends = true;
  session_->poll();
  const Json answer = sent();
  EXPECT_EQ(answer["id"], "a");
  EXPECT_EQ(answer["result"]["structuredContent"], Json({{"good", true}}));
  EXPECT_FALSE(session_->works());
  EXPECT_TRUE(state_->gone);
}

TEST_F(Session, ACancelledCallHasNoAnswer) {
  begin("2025-06-18");
  request(1, "tools/call", {{"name", "slow"}});
  const auto cancel = [&](const Json& id) {
    session_->receive(json_text(
        {{"jsonrpc", "2.0"}, {"method", "notifications/cancelled"}, {"params", {{"requestId", id}}}}));
  };
  cancel("1");
  EXPECT_FALSE(state_->cancelled) << "another id";
  cancel(1);
  EXPECT_TRUE(state_->cancelled);
  EXPECT_TRUE(state_->gone);
  session_->poll();
  EXPECT_TRUE(sent_.empty());
}

TEST_F(Session, AListIsAnsweredAsOne) {
  begin("2025-03-26");
  session_->receive(
      json_text(Json::array({message(1, "ping", Json::object()), message(2, "tools/call", {{"name", "slow"}}),
                             message(3, "tools/call", {{"name", "quick"}})})));
  EXPECT_TRUE(sent_.empty());
  state_->ends = true;
  session_->poll();
  EXPECT_EQ(sent().size(), 3U);
  // The last missing answer is that of a call that was given up.
  state_ = std::make_shared<Waiting::State>();
  session_->receive(json_text(
      Json::array({message(1, "ping", Json::object()), message(2, "tools/call", {{"name", "slow"}})})));
  session_->receive(R"({"jsonrpc":"2.0","method":"notifications/cancelled","params":{"requestId":2}})");
  EXPECT_EQ(sent().size(), 1U);
}

TEST_F(Session, EachLineHasAnAnswerWhateverItHolds) {
  for (const char* line : {"{", "[]", "[1]", "{}", "\xff"}) {
    session_->receive(line);
    EXPECT_TRUE(sent().contains("error")) << line;
  }
  session_->receive("  ");
  EXPECT_TRUE(sent_.empty());
  session_->refuse_long_line(5);
  EXPECT_THAT(sent()["error"]["message"].get<std::string>(), HasSubstr("at most 5 bytes"));
}

}  // namespace
}  // namespace ashlar::mcp_session_test
