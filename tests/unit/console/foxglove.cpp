// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/foxglove.h"

#include <nlohmann/json.hpp>
#include <random>

#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::console;

namespace {

using Text = nlohmann::json;

// The encoding's number of characters, and then it.
[[nodiscard]] std::string call_bytes(const std::string& payload) {
  using namespace std::string_literals;
  return "\x02\x01\0\0\0\x2a\0\0\0\x04\0\0\0json"s + payload;
}

}  // namespace

TEST_CASE("foxglove: of the subprotocols offered the newer one is spoken", "[console]") {
  CHECK(foxglove::subprotocol_of("foxglove.websocket.v1, foxglove.sdk.v1") == "foxglove.sdk.v1");
  CHECK(foxglove::subprotocol_of("foxglove.websocket.v1") == "foxglove.websocket.v1");
  CHECK(foxglove::subprotocol_of(",  ,foxglove.sdk.v10").empty());
  CHECK(foxglove::subprotocol_of("").empty());
}

TEST_CASE("foxglove: a message's head is to the byte as the protocol has it", "[console]") {
  using namespace std::string_literals;
  const Time at{Duration{0x0102030405060708}};
  CHECK(foxglove::message_head(0x0a0b0c0d, at) ==
        "\x01\x0d\x0c\x0b\x0a\x08\x07\x06\x05\x04\x03\x02\x01"s);
  CHECK(foxglove::call_response(1, 42, "{}") == "\x03\x01\0\0\0\x2a\0\0\0\x04\0\0\0json{}"s);
}

TEST_CASE("foxglove: a call is read whole, and cut off anywhere in its head it is none",
          "[console]") {
  const std::string bytes = call_bytes(R"({"command":"abort"})");
  const auto call = foxglove::read_call(bytes);
  REQUIRE(call);
  CHECK(call->service == 1);
  CHECK(call->call == 42);
  CHECK(call->encoding == "json");
  CHECK(call->payload == R"({"command":"abort"})");
  for (std::size_t length = 0; length < 17; ++length) {
    CHECK_FALSE(foxglove::read_call(std::string_view{bytes}.substr(0, length)));
  }
}

TEST_CASE("foxglove: what a client subscribes to", "[console]") {
  const auto read = foxglove::read_text(
      R"({"op":"subscribe","subscriptions":[{"id":3,"channelId":1},{"id":-1,"channelId":2},7,
          {"id":4294967296,"channelId":2},{"channelId":2}]})");
  CHECK(read.is_understood);
  REQUIRE(read.subscribe.size() == 1);
  CHECK(read.subscribe[0].id == 3);
  CHECK(read.subscribe[0].channel == 1);
  CHECK(foxglove::read_text(R"({"op":"unsubscribe","subscriptionIds":[3,"4",5.5]})").unsubscribe ==
        std::vector<std::uint32_t>{3});
  CHECK(foxglove::read_text(R"({"op":"getParameters"})").is_understood);
}

TEST_CASE("foxglove: any bytes are read or refused", "[console]") {
  std::mt19937 chance{7};  // NOLINT: the same each time
  for (int i = 0; i < 20000; ++i) {
    std::string bytes(chance() % 64, '\0');
    for (char& c : bytes) {
      c = static_cast<char>(chance());
    }
    if (i % 2 == 0 && !bytes.empty()) {
      bytes[0] = 2;
    }
    if (const auto call = foxglove::read_call(bytes)) {
      REQUIRE(call->encoding.size() + call->payload.size() + 13 == bytes.size());
    }
    static_cast<void>(foxglove::read_text(bytes));
  }
  // Nested as deep as there is room for.
  static_cast<void>(foxglove::read_text(std::string(60000, '[')));
  std::string nested = R"({"op":"subscribe","subscriptions":)";
  nested += std::string(30000, '[') + std::string(30000, ']') + "}";
  CHECK(foxglove::read_text(nested).subscribe.empty());
}

TEST_CASE("foxglove: what is advertised has a schema of its own encoding", "[console]") {
  TopicTable topics;
  CHECK(topics.add_topic("/log", viewer::log_entry()) == 0);
  const Text said = Text::parse(foxglove::advertise(topics));
  CHECK(said["op"] == "advertise");
  CHECK(said["channels"][0]["id"] == 1);
  CHECK(said["channels"][0]["schemaEncoding"] == "jsonschema");
  CHECK(Text::parse(said["channels"][0]["schema"].get<std::string>())["title"] == "foxglove.Log");
  CHECK(Text::parse(foxglove::server_info("boat", "1", false))["capabilities"].empty());
  CHECK(Text::parse(foxglove::server_info("boat", "1", true))["capabilities"][0] == "services");
  const Text services = Text::parse(foxglove::advertise_services());
  CHECK(services["services"][0]["name"] == "/lodesman/command");
}
