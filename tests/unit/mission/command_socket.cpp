// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_socket.h"

#include <boost/asio/ip/tcp.hpp>
#include <nlohmann/json.hpp>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

std::string ask(std::uint16_t port, const std::string& line) {
  boost::asio::ip::tcp::iostream stream;
  stream.expires_after(std::chrono::seconds{5});
  stream.connect("127.0.0.1", std::to_string(port));
  stream << line << "\n" << std::flush;
  std::string reply;
  std::getline(stream, reply);
  return reply;
}

CommandHandler echo() {
  return [](const std::string& command) { return "{\"ok\":true,\"did\":\"" + command + "\"}"; };
}

}  // namespace

TEST_CASE("command socket: a JSON line is answered with a JSON line", "[high_level][mission]") {
  const CommandSocket socket{{"127.0.0.1", 0, ""}, echo()};
  CHECK(ask(socket.port(), R"({"command": "start"})") == R"({"ok":true,"did":"start"})");
  CHECK(ask(socket.port(), R"({"command": "status"})") == R"({"ok":true,"did":"status"})");
}

TEST_CASE("command socket: what is no command is refused and the next one served",
          "[high_level][mission]") {
  const CommandSocket socket{{"127.0.0.1", 0, ""}, echo()};
  for (const char* line : {"", "start", "[]", "{}", R"({"command": 5})", "\xff\xfe{"}) {
    CHECK(ask(socket.port(), line).find("\"ok\":false") != std::string::npos);
  }
  CHECK(ask(socket.port(), std::string(100000, 'x')).empty());
  CHECK(ask(socket.port(), R"({"command": "abort"})") == R"({"ok":true,"did":"abort"})");
}

TEST_CASE("command socket: with a token, nobody else is served", "[high_level][mission]") {
  const CommandSocket socket{{"127.0.0.1", 0, "secret"}, echo()};
  CHECK(ask(socket.port(), R"({"command": "start"})").find("token") != std::string::npos);
  CHECK(ask(socket.port(), R"({"command": "start", "token": "secre"})").find("token") !=
        std::string::npos);
  CHECK(ask(socket.port(), R"({"command": "start", "token": "secret"})") ==
        R"({"ok":true,"did":"start"})");
}

TEST_CASE("command socket: beyond loopback it needs a token, and a port must be free",
          "[high_level][mission]") {
  CHECK_THROWS_WITH((CommandSocket{{"0.0.0.0", 0, ""}, echo()}),
                    "command_socket.address: 0.0.0.0 is not loopback, so a token is required");
  CHECK_THROWS_AS((CommandSocket{{"nowhere", 0, ""}, echo()}), StartupError);
  const CommandSocket first{{"127.0.0.1", 0, ""}, echo()};
  CHECK_THROWS_AS((CommandSocket{{"127.0.0.1", first.port(), ""}, echo()}), StartupError);
}
