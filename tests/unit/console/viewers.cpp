// SPDX-License-Identifier: Apache-2.0
// WebSocket: who is let in, what he hears, what his commands come to, and that no one keeps
// another waiting.
#include <nlohmann/json.hpp>
#include <random>

#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "tests/support/catch.h"
#include "tests/unit/console/served_console.h"

using namespace lodesman;
using namespace lodesman::testing;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

using Text = nlohmann::json;

// Numbers of channels by their topics, from what is said first.
[[nodiscard]] std::map<std::string, unsigned> channels_of(RawViewer& viewer) {
  const Text said = Text::parse(viewer.hear_with(R"("op":"advertise")").payload);
  std::map<std::string, unsigned> channels;
  for (const Text& channel : said["channels"]) {
    channels[channel["topic"]] = channel["id"];
  }
  return channels;
}

// Behind its head.
[[nodiscard]] Text message_in(const RawFrame& frame) {
  REQUIRE(frame.opcode == 2);
  return Text::parse(frame.payload.substr(13));
}

[[nodiscard]] Text reply_in(const RawFrame& frame) {
  REQUIRE(frame.opcode == 2);
  return Text::parse(frame.payload.substr(17));
}

}  // namespace

TEST_CASE("console viewers: without a session, a ticket or a subprotocol nobody is let in",
          "[console]") {
  const ServedConsole console;
  const auto status_of = [&](const std::string& target, const std::string& headers,
                             const std::string& protocol = "foxglove.sdk.v1") {
    RawViewer viewer{console.port()};
    return viewer.upgrade(target, headers, protocol).status;
  };
  const std::string cookie = console.signed_in(console.tokens.view);
  CHECK(status_of("/", "") == 401);
  CHECK(status_of("/", "Cookie: lodesman_console=" + std::string(64, '0') + "\r\n") == 401);
  CHECK(status_of("/", cookie, "") == 400);
  CHECK(status_of("/", cookie, "mqtt") == 400);
  CHECK(status_of("/other", cookie) == 404);
  CHECK(status_of("/view/" + std::string(32, '0'), "") == 403);
  CHECK(status_of("/view/", "") == 403);
  CHECK(status_of("/", cookie) == 101);
}

TEST_CASE("console viewers: the boat's topics are told at once, and a command comes to the boat",
          "[console]") {
  const ServedConsole console;
  RawViewer viewer{console.port()};
  const RawReply upgraded = viewer.upgrade("/", console.signed_in(console.tokens.command));
  REQUIRE(upgraded.status == 101);
  CHECK(upgraded.header("Sec-WebSocket-Protocol") == "foxglove.sdk.v1");
  const Text info = Text::parse(viewer.hear().payload);
  CHECK(info["op"] == "serverInfo");
  CHECK(info["capabilities"] == Text::array({"services"}));
  const auto channels = channels_of(viewer);
  for (const char* topic :
       {"/tf", "/scene", "/waypoints", "/position", "/sonar", "/log", "/lodesman/boat",
        "/lodesman/world", "/lodesman/coverage", "/lodesman/sonar", "/lodesman/status",
        "/lodesman/story", "/lodesman/events", "/lodesman/clients"}) {
    INFO(topic);
    CHECK(channels.count(topic) == 1);
  }
  viewer.subscribe(1, channels.at("/lodesman/status"));
  CHECK(message_in(viewer.hear_with(R"("state":"idle")"))["ok"] == true);
  viewer.subscribe(2, channels.at("/lodesman/story"));
  CHECK(message_in(viewer.hear_with("\"now\""))["now"] == "There is no boat.");
  viewer.subscribe(3, channels.at("/lodesman/clients"));
  const Text clients = message_in(viewer.hear_with("\"clients\""));
  CHECK(clients["clients"] == 1);
  CHECK(clients["you"]["scope"] == "command");
  viewer.call(42, R"({"command":"hold"})");
  CHECK(reply_in(viewer.hear_with("json{"))["ok"] == true);
  CHECK(console.told("hold") == 1);
}

TEST_CASE("console viewers: a token to view commands nothing, one to abort aborts", "[console]") {
  const ServedConsole console;
  const auto reply_to = [&](const std::string& token, const std::string& command) {
    RawViewer viewer{console.port()};
    REQUIRE(viewer.upgrade("/", console.signed_in(token)).status == 101);
    viewer.call(1, R"({"command":")" + command + R"(","token":")" + console.tokens.command + "\"}");
    return reply_in(viewer.hear_with("json{"));
  };
  CHECK(reply_to(console.tokens.view, "hold")["ok"] == false);
  CHECK(reply_to(console.tokens.view, "abort")["ok"] == false);
  CHECK(reply_to(console.tokens.abort, "hold")["ok"] == false);
  CHECK(console.told_but_status() == 0);
  CHECK(reply_to(console.tokens.abort, "abort")["ok"] == true);
  CHECK(console.told("abort") == 1);
}

TEST_CASE("console viewers: a ticket lets look on from any origin, and do nothing", "[console]") {
  const ServedConsole console;
  RawViewer owner{console.port()};
  CHECK(owner.ask("POST", "/ticket", "Content-Length: 0\r\n").status == 401);
  const RawReply reply = owner.ask(
      "POST", "/ticket", console.signed_in(console.tokens.command) + "Content-Length: 0\r\n");
  REQUIRE(reply.status == 200);
  RawViewer viewer{console.port()};
  REQUIRE(viewer.upgrade(Text::parse(reply.body)["path"], "Origin: https://viewer.example\r\n")
              .status == 101);
  const Text info = Text::parse(viewer.hear().payload);
  CHECK(info["capabilities"].empty());
  const auto channels = channels_of(viewer);
  viewer.call(1, R"({"command":"abort"})");
  CHECK(viewer.hear_with("serviceCallFailure").opcode == 1);
  viewer.subscribe(1, channels.at("/lodesman/boat"));
  CHECK(message_in(viewer.hear_with("ages_s"))["position_m"].is_null());
  CHECK(console.told_but_status() == 0);
}

TEST_CASE("console viewers: whose session ends is let go", "[console]") {
  const ServedConsole console;
  const std::string cookie = console.signed_in(console.tokens.command);
  RawViewer viewer{console.port()};
  REQUIRE(viewer.upgrade("/", cookie).status == 101);
  RawViewer owner{console.port()};
  CHECK(owner.ask("DELETE", "/session", cookie).status == 204);
  CHECK(viewer.is_ended());
}

TEST_CASE("console viewers: frames that are wrong or too long end their connection alone",
          "[console]") {
  const ServedConsole console;
  const std::string cookie = console.signed_in(console.tokens.command);
  RawViewer bystander{console.port()};
  REQUIRE(bystander.upgrade("/", cookie).status == 101);
  const auto channels = channels_of(bystander);
  const std::string zeros(4, '\0');
  const std::string wrong[] = {
      std::string{"\x81\x05hello"},                  // not masked
      std::string{"\xf1\x80"} + zeros,               // reserved bits
      std::string{"\x83\x80"} + zeros,               // no such opcode
      std::string{"\x80\x80"} + zeros,               // goes on with nothing
      std::string{"\x81\x82"} + zeros + "\xff\xff",  // no UTF-8
      std::string{"\x82\xff\x7f\xff\xff\xff"} + std::string(4, '\xff') + zeros,  // for ever
  };
  for (const std::string& bytes : wrong) {
    RawViewer viewer{console.port()};
    REQUIRE(viewer.upgrade("/", cookie).status == 101);
    viewer.say(bytes);
    CHECK(viewer.is_ended());
  }
  RawViewer talker{console.port()};
  REQUIRE(talker.upgrade("/", cookie).status == 101);
  talker.frame(2, std::string(70000, 'x'));
  CHECK(talker.is_ended());
  std::mt19937 chance{3};  // NOLINT: the same each time
  for (int i = 0; i < 100; ++i) {
    RawViewer viewer{console.port()};
    REQUIRE(viewer.upgrade("/", cookie).status == 101);
    std::string bytes(1 + chance() % 200, '\0');
    for (char& c : bytes) {
      c = static_cast<char>(chance());
    }
    viewer.say(bytes);
  }
  bystander.subscribe(1, channels.at("/lodesman/boat"));
  CHECK(bystander.hear_with("ages_s").opcode == 2);
  CHECK(console.told_but_status() == 0);
}

TEST_CASE("console viewers: whoever may not order, or orders in a wrong way, orders nothing",
          "[console]") {
  const ServedConsole console;
  const std::string commander = console.signed_in(console.tokens.command);
  const std::string looker = console.signed_in(console.tokens.view);
  const std::string right = R"({"command":"abort"})";
  const std::string forged = "Cookie: lodesman_console=" + std::string(64, '7') + "\r\n";
  // Each way is tried with the order that everybody with a token to abort may give.
  const std::pair<std::string, std::string> not_let_in[] = {
      {"/", ""},
      {"/", forged},
      {"/", commander + "Origin: http://evil.example\r\n"},
      {"/view/" + std::string(32, '7'), commander},
      {"/other", commander}};
  const std::string no_orders[] = {
      R"({"command":7})", R"({"command":["abort"]})", R"({"Command":"abort"})", R"(["abort"])",
      R"("abort")",       R"({"command":"abort")",    std::string(5000, '['),   ""};
  constexpr int kRounds = 67;  // a thousand and five in all
  for (int round = 0; round < kRounds; ++round) {
    for (const auto& [target, headers] : not_let_in) {
      RawViewer viewer{console.port()};
      CHECK(viewer.upgrade(target, headers).status >= 400);
      viewer.call(1, right);
    }
    RawViewer renamed{console.port()};
    renamed.host = "evil.example";
    CHECK(renamed.upgrade("/", commander).status == 421);
    renamed.call(1, right);
    RawViewer viewer{console.port()};
    REQUIRE(viewer.upgrade("/", round % 2 == 0 ? commander : looker).status == 101);
    for (const std::string& wrong : no_orders) {
      viewer.call(2, wrong);
    }
  }
  RawViewer looks{console.port()};
  REQUIRE(looks.upgrade("/", looker).status == 101);
  looks.call(3, right);
  CHECK(reply_in(looks.hear_with("json{"))["ok"] == false);
  CHECK(console.told_but_status() == 0);
  RawViewer orders{console.port()};
  REQUIRE(orders.upgrade("/", commander).status == 101);
  orders.call(4, right);
  CHECK(reply_in(orders.hear_with("json{"))["ok"] == true);
  CHECK(console.told("abort") == 1);
}

TEST_CASE("console viewers: five that take nothing delay none of fifteen that do", "[console]") {
  constexpr seconds kStall{5};
  const ServedConsole console{kStall};
  auto board = SharedBlackboard::create(console.segment());
  Writer<SonarPing> pings = writer_of(board.writable(), board.writable().sonar_ping, Role::kLow);
  const std::string cookie = console.signed_in(console.tokens.view);
  std::map<std::string, unsigned> channels;
  std::vector<RawViewer> stalled;
  std::vector<RawViewer> others;
  for (int i = 0; i < 20; ++i) {
    const bool stalls = i % 4 == 0;
    constexpr int kSmall = 4096;
    auto& crowd = stalls ? stalled : others;
    crowd.emplace_back(console.port(), stalls ? kSmall : 0);
    REQUIRE(crowd.back().upgrade("/", cookie).status == 101);
    channels = channels_of(crowd.back());
    for (const char* topic : {"/lodesman/boat", "/lodesman/sonar", "/sonar"}) {
      crowd.back().subscribe(channels.at(topic), channels.at(topic));
    }
  }
  auto ping = std::make_unique<SonarPing>();
  ping->range_m = 20.0;
  ping->make_image(120, 500, 2.0);
  std::mt19937 chance{5};  // NOLINT: noise takes room
  constexpr int kWanted = 60;
  std::vector<double> last_s(others.size(), to_seconds(SteadyClock{}.now().time_since_epoch()));
  double longest_gap_s = 0.0;
  for (int n = 0; n < kWanted; ++n) {
    for (std::size_t i = 0; i < 4096; ++i) {
      ping->echo[chance() % ping->echo_count] = static_cast<std::uint8_t>(chance());
    }
    pings.publish(*ping, SteadyClock{}.now());
    for (std::size_t i = 0; i < others.size(); ++i) {
      const double at_s = message_in(others[i].hear_with("ages_s"))["time_s"].get<double>();
      longest_gap_s = std::max(longest_gap_s, at_s - last_s[i]);
      last_s[i] = at_s;
    }
  }
  // Who waited for one that takes nothing would have waited until that one is closed.
  CHECK(longest_gap_s < to_seconds(kStall));
  for (RawViewer& viewer : stalled) {
    CHECK(viewer.is_ended());
  }
  for (RawViewer& viewer : others) {
    CHECK(viewer.hear_with("ages_s").opcode == 2);
  }
}

TEST_CASE("console viewers: a boat that comes and goes is followed", "[console]") {
  const ServedConsole console;
  RawViewer viewer{console.port()};
  REQUIRE(viewer.upgrade("/", console.signed_in(console.tokens.view)).status == 101);
  const auto channels = channels_of(viewer);
  viewer.subscribe(1, channels.at("/lodesman/boat"));
  viewer.subscribe(2, channels.at("/lodesman/events"));
  CHECK(viewer.hear_with(R"("position_m":null)").opcode == 2);
  for (int i = 1; i <= 2; ++i) {
    auto board = SharedBlackboard::create(console.segment());
    Writer<VehicleState> states =
        writer_of(board.writable(), board.writable().vehicle_state, Role::kHigh);
    VehicleState state;
    state.x_m = i;
    state.valid_at = SteadyClock{}.now();
    states.publish(state, SteadyClock{}.now());
    CHECK(viewer.hear_with("\"position_m\":[" + std::to_string(i) + ".0,").opcode == 2);
  }
}

TEST_CASE("console viewers: there are sixty-four places", "[console]") {
  const ServedConsole console;
  const std::string cookie = console.signed_in(console.tokens.view);
  std::vector<RawViewer> crowd;
  for (std::size_t i = 0; i < console::Console::kMaxClients; ++i) {
    crowd.emplace_back(console.port());
    REQUIRE(crowd.back().upgrade("/", cookie).status == 101);
  }
  RawViewer late{console.port()};
  CHECK(late.upgrade("/", cookie).status == 503);
  crowd.pop_back();
  bool let_in = false;
  for (int i = 0; i < 100 && !let_in; ++i) {
    RawViewer next{console.port()};
    let_in = next.upgrade("/", cookie).status == 101;
  }
  CHECK(let_in);
}
