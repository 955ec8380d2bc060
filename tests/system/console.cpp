// SPDX-License-Identifier: Apache-2.0
// The console as a program, beside real ones: a run that it shows and commands, and runs that go on
// whatever becomes of it.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/support/catch.h"
#include "tests/support/node_packages.h"
#include "tests/support/raw_viewer.h"
#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;
using nlohmann::json;

namespace {

// Bound, and listened at, as long as it lives.
class TakenPort {
 public:
  TakenPort() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    REQUIRE(bind(socket_, reinterpret_cast<const sockaddr*>(&address), length) == 0);
    REQUIRE(listen(socket_, 1) == 0);
    REQUIRE(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length) == 0);
    port_ = ntohs(address.sin_port);
  }
  TakenPort(const TakenPort&) = delete;
  TakenPort& operator=(const TakenPort&) = delete;
  ~TakenPort() { close(socket_); }
  [[nodiscard]] std::uint16_t port() const { return port_; }

 private:
  int socket_ = -1;
  std::uint16_t port_ = 0;
};

// Nobody had it a moment ago.
[[nodiscard]] std::uint16_t free_port() { return TakenPort{}.port(); }

[[nodiscard]] std::string text_in(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  return text.str();
}

// A program whose standard error goes to a file.
class Heard {
 public:
  Heard(const Scratch& scratch, const std::string& name, const std::vector<std::string>& arguments)
      : said_{scratch.file(name + ".said")},
        program_{program(name), arguments, [file = said_.string()] {
                   redirect(STDERR_FILENO, file.c_str(), O_WRONLY | O_CREAT | O_APPEND);
                   redirect(STDOUT_FILENO, file.c_str(), O_WRONLY | O_CREAT | O_APPEND);
                 }} {}

  [[nodiscard]] std::string said() const { return text_in(said_); }
  [[nodiscard]] Program& process() { return program_; }
  // Its first line that has this, and what it holds; waits for it.
  [[nodiscard]] std::smatch await(const std::string& expression) {
    std::smatch match;
    REQUIRE(eventually([&] {
      text_ = said();
      return std::regex_search(text_, match, std::regex{expression});
    }));
    return match;
  }

 private:
  fs::path said_;
  Program program_;
  std::string text_;
};

// A run with a console, whose command socket has a port that is known.
class ShownRun {
 public:
  explicit ShownRun(const Scratch& scratch, const std::vector<std::string>& more = {})
      : run_{scratch, "lodesman", arguments(scratch, more)} {
    const std::smatch address = run_.await("http://127\\.0\\.0\\.1:([0-9]+)/#token=([0-9a-f]{64})");
    port = static_cast<std::uint16_t>(std::stoi(address[1]));
    token = address[2];
  }

  std::uint16_t port = 0;
  std::string token;
  [[nodiscard]] Heard& run() { return run_; }

 private:
  static std::vector<std::string> arguments(const Scratch& scratch,
                                            const std::vector<std::string>& more) {
    const auto scenario = scratch.file("scenario.toml", scenario_text(60.0));
    auto words = sim(scenario, scratch.file("run"), more);
    words.insert(words.end(), {"--set", "command_socket.port=" + std::to_string(free_port()),
                               "--set", "console.port=0", "--console", "on"});
    return words;
  }
  Heard run_;
};

[[nodiscard]] json seen_by_client(std::uint16_t port, const std::string& token) {
  const std::string command = "node '" LODESMAN_FOXGLOVE_LOOK "' '" LODESMAN_FOXGLOVE_PACKAGES
                              "' " +
                              std::to_string(port) + " " + token;
  std::FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  std::array<char, 4096> piece{};
  for (std::size_t size = 1; size > 0;) {
    size = std::fread(piece.data(), 1, piece.size(), pipe);
    output.append(piece.data(), size);
  }
  INFO(output);
  CHECK(pclose(pipe) == 0);
  return json::parse(output);
}

}  // namespace

TEST_CASE("console: a run says where it is, is seen and commanded there", "[system]") {
  const Scratch scratch{"console"};
  ShownRun shown{scratch};
  RawViewer owner{shown.port};
  const RawReply signed_in =
      owner.ask("POST", "/session", "", R"({"token":")" + shown.token + "\"}");
  REQUIRE(signed_in.status == 204);
  const std::string cookie = signed_in.header("Set-Cookie");
  RawViewer viewer{shown.port};
  REQUIRE(viewer.upgrade("/", "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n").status ==
          101);
  const json said = json::parse(viewer.hear_with(R"("op":"advertise")").payload);
  for (const json& channel : said["channels"]) {
    const std::string topic = channel["topic"];
    if (topic == "/lodesman/story" || topic == "/lodesman/status") {
      viewer.subscribe(channel["id"], channel["id"]);
    }
  }
  CHECK(viewer.hear_with(R"("state":"under_way")").opcode == 2);
  CHECK(viewer.hear_with("Sails to its goal").opcode == 2);
  viewer.call(1, R"({"command":"take","name":"test"})");
  CHECK(viewer.hear_with(R"("ok":true)").opcode == 2);
  viewer.call(2, R"({"command":"abort"})");
  CHECK(viewer.hear_with(R"("state":"aborted")").opcode == 2);
  CHECK(shown.run().process().status() == 1);
}

TEST_CASE("console: the protocol's own client sees the topics, and is answered", "[system]") {
  if (is_skipped_without(LODESMAN_FOXGLOVE_PACKAGES, "@foxglove/ws-protocol")) {
    return;
  }
  const Scratch scratch{"console-client"};
  ShownRun shown{scratch};
  const json seen = seen_by_client(shown.port, shown.token);
  CHECK(seen["subprotocol"] == "foxglove.sdk.v1");
  CHECK(seen["errors"].empty());
  CHECK(seen["wrong"].empty());
  CHECK(seen["services"] == json::array({"/lodesman/command"}));
  CHECK(seen["reply"]["ok"] == true);
}

TEST_CASE("console: a run goes on where its console has no port, and where it is killed",
          "[system]") {
  const Scratch scratch{"console-none"};
  const auto scenario = scratch.file("scenario.toml", scenario_text(60.0));
  const TakenPort taken;
  const auto without = sim(scenario, scratch.file("taken"),
                           {"--time-limit", "15", "--console", std::to_string(taken.port())});
  Heard run{scratch, "lodesman", without};
  static_cast<void>(run.await("another program listens"));
  static_cast<void>(run.await("lodesman-console ended \\(exit status 4\\): the run goes on"));
  CHECK(run.process().status() == 1);  // its time limit

  ShownRun shown{scratch, {"--time-limit", "20"}};
  constexpr const char* kName = "lodesman-consol";  // as much of it as the kernel keeps
  const pid_t launcher = shown.run().process().pid();
  REQUIRE(eventually([&] { return child_of(launcher, kName) > 0; }));
  kill(child_of(launcher, kName), SIGKILL);
  static_cast<void>(shown.run().await("lodesman-console ended \\(signal 9\\)"));
  CHECK(shown.run().process().status() == 1);
}

TEST_CASE("console: scripts get none that they have not asked for", "[system]") {
  const Scratch scratch{"script"};
  const auto scenario = scratch.file("scenario.toml", scenario_text(60.0));
  Heard run{scratch, "lodesman", sim(scenario, scratch.file("run"), {"--time-limit", "10"})};
  CHECK(run.process().status() == 1);
  CHECK(run.said().find("lodesman-console") == std::string::npos);
  CHECK(run.said().find("http:") == std::string::npos);
}

TEST_CASE("console: it waits for a boat, and ends as it is told", "[system]") {
  const Scratch scratch{"console-alone"};
  const std::vector<std::string> alone{
      "--segment", "lodesman-test-none-" + std::to_string(getpid()), "--set", "console.port=0"};
  Heard console{scratch, "lodesman-console", alone};
  const std::smatch address = console.await("http://127\\.0\\.0\\.1:([0-9]+)/\n");
  const auto port = static_cast<std::uint16_t>(std::stoi(address[1]));
  RawViewer viewer{port};
  CHECK(viewer.ask("GET", "/session").status == 200);
  kill(console.process().pid(), SIGTERM);
  CHECK(console.process().status() == 0);

  auto refused = alone;
  refused.insert(refused.end(), {"--set", "console.address=here"});
  CHECK(Heard{scratch, "lodesman-console", refused}.process().status() == 2);
  const TakenPort taken;
  auto late = alone;
  late.insert(late.end(), {"--set", "console.port=" + std::to_string(taken.port())});
  CHECK(Heard{scratch, "lodesman-console", late}.process().status() == 4);
}

TEST_CASE("console: it listens on this machine alone", "[system]") {
  const Scratch scratch{"console-address"};
  const std::string config =
      scratch.file("boat.toml", "[console]\naddress = \"0.0.0.0\"\n").string();
  Heard console{scratch, "lodesman-console", {"--config", config}};
  CHECK(console.process().status() == 2);
  CHECK(console.said() == config +
                              ":2: console.address: must be this machine's own: HTTP would carry "
                              "tokens in the clear\n");
}
