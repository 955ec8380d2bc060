// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_socket.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <thread>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

using Stream = boost::asio::ip::tcp::iostream;

constexpr const char* kToken = "secret";

CommandSocketOptions any_port() { return {"127.0.0.1", 0, {kToken, "", ""}}; }

std::string line_of(const std::string& command) {
  return R"({"command":")" + command + R"(","token":"secret"})";
}
std::string done(const std::string& command) { return R"({"ok":true,"did":")" + command + "\"}"; }

Answer at_once(std::string reply) {
  return [reply = std::move(reply)] { return reply; };
}
CommandHandler echo() {
  return [](const CommandRequest& request) {
    const std::string& command = request.command;
    return at_once(done(command));
  };
}

std::unique_ptr<Stream> connect(std::uint16_t port) {
  auto stream = std::make_unique<Stream>();
  stream->expires_after(seconds{20});
  stream->connect("127.0.0.1", std::to_string(port));
  return stream;
}

std::string ask(Stream& stream, const std::string& line) {
  stream << line << "\n" << std::flush;
  std::string reply;
  std::getline(stream, reply);
  return reply;
}
std::string ask(std::uint16_t port, const std::string& line) { return ask(*connect(port), line); }

// Whether the other side has ended the session.
bool ended(Stream& stream) {
  std::string reply;
  return !std::getline(stream, reply);
}

}  // namespace

TEST_CASE("command socket: a JSON line is answered with a JSON line", "[high_level][mission]") {
  const CommandSocket socket{any_port(), echo()};
  CHECK(ask(socket.port(), line_of("start")) == done("start"));
  const auto stream = connect(socket.port());
  CHECK(ask(*stream, line_of("status")) == done("status"));
  CHECK(ask(*stream, line_of("hold")) == done("hold"));
}

TEST_CASE("command socket: a session ends at the first line that is no command",
          "[high_level][mission]") {
  std::atomic<int> handled{0};
  const CommandSocket socket{any_port(), [&](const CommandRequest& request) {
                               const std::string& command = request.command;
                               ++handled;
                               return at_once(done(command));
                             }};
  const std::string command = line_of("start") + "\n";
  for (const std::string first :
       {"", "start", "[]", "{}", R"({"command": 5})", "\xff\xfe{", R"({"command":"start"})",
        "POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: text/plain\r\n\r",
        R"({"command":"start","token":"secre"})"}) {
    const auto stream = connect(socket.port());
    *stream << first << "\n" << command << command << std::flush;
    std::string reply;
    while (std::getline(*stream, reply)) {
      CHECK(reply.find("\"ok\":false") != std::string::npos);
    }
    CHECK(handled == 0);
  }
  CHECK(ask(socket.port(), std::string(100000, 'x')).empty());
  CHECK(ask(socket.port(), line_of("abort")) == done("abort"));
  CHECK(handled == 1);
}

TEST_CASE("command socket: an answer may take its time, and others are served meanwhile",
          "[high_level][mission]") {
  std::atomic<bool> confirmed{false};
  const CommandSocket socket{any_port(), [&](const CommandRequest& request) -> Answer {
                               const std::string& command = request.command;
                               if (command != "abort") {
                                 return at_once(done(command));
                               }
                               return [&confirmed]() -> std::optional<std::string> {
                                 return confirmed ? std::optional{done("abort")} : std::nullopt;
                               };
                             }};
  const auto waiting = connect(socket.port());
  *waiting << line_of("abort") << "\n" << std::flush;
  CHECK(ask(socket.port(), line_of("status")) == done("status"));
  confirmed = true;
  std::string reply;
  std::getline(*waiting, reply);
  CHECK(reply == done("abort"));
}

TEST_CASE("command socket: who awaits an answer when it ends still gets it, within a moment",
          "[high_level][mission]") {
  std::atomic<bool> confirmed{false};
  std::atomic<int> handled{0};
  auto socket =
      std::make_unique<CommandSocket>(any_port(), [&](const CommandRequest& request) -> Answer {
        const std::string& command = request.command;
        ++handled;
        return [&confirmed, command]() -> std::optional<std::string> {
          return confirmed && command == "abort" ? std::optional{done(command)} : std::nullopt;
        };
      });
  const auto abort = connect(socket->port());
  *abort << line_of("abort") << "\n" << std::flush;
  const auto never = connect(socket->port());
  *never << line_of("status") << "\n" << std::flush;
  while (handled < 2) {
    std::this_thread::sleep_for(milliseconds{1});
  }
  confirmed = true;
  socket.reset();
  std::string reply;
  std::getline(*abort, reply);
  CHECK(reply == done("abort"));
  CHECK(ended(*never));
}

TEST_CASE("command socket: silent and half-open sessions end, a session that talks does not",
          "[high_level][mission]") {
  CommandSocketOptions options = any_port();
  options.stranger_idle_limit = milliseconds{200};
  options.idle_limit = milliseconds{400};
  const CommandSocket socket{options, echo()};
  const auto silent = connect(socket.port());
  const auto half_open = connect(socket.port());
  *half_open << R"({"command":)" << std::flush;
  const auto fell_silent = connect(socket.port());
  CHECK(ask(*fell_silent, line_of("status")) == done("status"));
  CHECK(ended(*silent));
  CHECK(ended(*half_open));
  CHECK(ended(*fell_silent));
  CHECK(ask(socket.port(), line_of("abort")) == done("abort"));
}

TEST_CASE("command socket: a crowd of silent sessions makes way", "[high_level][mission]") {
  const CommandSocket socket{any_port(), echo()};
  const auto known = connect(socket.port());
  CHECK(ask(*known, line_of("status")) == done("status"));
  std::vector<std::unique_ptr<Stream>> crowd;
  for (std::size_t i = 0; i < 3 * kMaxSessions; ++i) {
    crowd.push_back(connect(socket.port()));
  }
  CHECK(ask(socket.port(), line_of("abort")) == done("abort"));
  // Strangers gave way, not the one that had shown its token.
  CHECK(ask(*known, line_of("hold")) == done("hold"));
  CHECK(ended(*crowd.front()));
}

TEST_CASE("command socket: who waits for an abort is never put out, nor the first to wait",
          "[high_level][mission]") {
  std::atomic<bool> confirmed{false};
  std::atomic<int> handled{0};
  const CommandSocket socket{any_port(), [&](const CommandRequest& request) -> Answer {
                               const std::string& command = request.command;
                               ++handled;
                               return [&confirmed, command]() -> std::optional<std::string> {
                                 return confirmed ? std::optional{done(command)} : std::nullopt;
                               };
                             }};
  const auto begin = [&](const char* command) {
    auto stream = connect(socket.port());
    *stream << line_of(command) << "\n" << std::flush;
    return stream;
  };
  const auto first = begin("start");
  const auto abort = begin("abort");
  while (handled < 2) {
    std::this_thread::sleep_for(milliseconds{1});
  }
  std::vector<std::unique_ptr<Stream>> crowd;
  for (std::size_t i = 0; i < 2 * kMaxSessions; ++i) {
    crowd.push_back(begin("status"));
  }
  // The last has been let in, so that somebody has been put out for it.
  CHECK(ask(socket.port(), "no command").find("\"ok\":false") != std::string::npos);
  confirmed = true;
  std::string reply;
  std::getline(*abort, reply);
  CHECK(reply == done("abort"));
  std::getline(*first, reply);
  CHECK(reply == done("start"));
  const auto put_out = std::count_if(crowd.begin(), crowd.end(), [](const auto& stream) {
    std::string line;
    return !std::getline(*stream, line);
  });
  CHECK(put_out >= static_cast<std::ptrdiff_t>(kMaxSessions));
}

TEST_CASE("command socket: a session that sends without end leaves the others their turn",
          "[high_level][mission]") {
  const CommandSocket socket{any_port(), echo()};
  std::atomic<bool> stop{false};
  std::thread flood{[&] {
    const auto stream = connect(socket.port());
    std::string lines;
    for (int i = 0; i < 200; ++i) {
      lines += line_of("resume") + "\n";
    }
    std::string reply;
    while (!stop && *stream << lines << std::flush) {
      for (int i = 0; i < 200 && std::getline(*stream, reply); ++i) {
      }
    }
  }};
  for (int i = 0; i < 50; ++i) {
    CHECK(ask(socket.port(), line_of("abort")) == done("abort"));
  }
  stop = true;
  flood.join();
}

TEST_CASE("command socket: it goes on when the process has no descriptors left",
          "[high_level][mission][plain]") {
  const pid_t child = fork();
  if (child == 0) {
    // Clients and socket in one process: the clients are made first, then all is used up.
    constexpr std::size_t kClients = 24;
    const CommandSocket socket{any_port(), echo()};
    std::vector<int> clients;
    for (std::size_t i = 0; i < kClients; ++i) {
      clients.push_back(::socket(AF_INET, SOCK_STREAM, 0));
    }
    const rlimit limit{static_cast<rlim_t>(clients.back()) + 1,
                       static_cast<rlim_t>(clients.back()) + 1};
    setrlimit(RLIMIT_NOFILE, &limit);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(socket.port());
    // One after the other, all left open: each one is served in the only place there is.
    bool ok = true;
    for (const int client : clients) {
      const std::string line = line_of("abort") + "\n";
      std::array<char, 100> reply{};
      const timeval patience{20, 0};
      setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
      ok = ok && connect(client, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 &&
           send(client, line.data(), line.size(), 0) == static_cast<ssize_t>(line.size()) &&
           recv(client, reply.data(), reply.size(), 0) > 0;
    }
    _exit(ok ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}

TEST_CASE("command socket: what the handler throws ends that session alone",
          "[high_level][mission]") {
  const CommandSocket socket{any_port(), [](const CommandRequest& request) -> Answer {
                               const std::string& command = request.command;
                               if (command == "throw") {
                                 throw std::runtime_error("no");
                               }
                               return at_once(done(command));
                             }};
  CHECK(ask(socket.port(), line_of("throw")).empty());
  CHECK(ask(socket.port(), line_of("abort")) == done("abort"));
}

TEST_CASE("command socket: beyond loopback it wants a lasting token, always one and a free port",
          "[high_level][mission]") {
  for (const char* address : {"0.0.0.0", "::", "192.0.2.1"}) {
    CHECK_THROWS_WITH((CommandSocket{{address, 0, {kToken, "", ""}}, echo()}),
                      std::string{"command_socket.address: "} + address +
                          " is not loopback, and that wants a token_file");
  }
  CHECK_THROWS_AS((CommandSocket{{"nowhere", 0, {kToken, "", ""}}, echo()}), StartupError);
  CHECK_THROWS_AS((CommandSocket{{"127.0.0.1", 0, {}}, echo()}), StartupError);
  const CommandSocket first{any_port(), echo()};
  CHECK_THROWS_AS((CommandSocket{{"127.0.0.1", first.port(), {kToken, "", ""}}, echo()}),
                  StartupError);
}
