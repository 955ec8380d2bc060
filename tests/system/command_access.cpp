// SPDX-License-Identifier: Apache-2.0
// Who gets through to a running boat, and who does not: two real processes, and a crowd.
#include <fcntl.h>
#include <grp.h>
#include <sys/wait.h>

#include <iostream>
#include <sstream>

#include "high_level/mission/token_file.h"
#include "tests/support/catch.h"
#include "tests/support/command_crowd.h"
#include "tests/system/boat.h"
#include "tests/system/listening_port.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// A boat under way, and where it is commanded from.
struct CommandedBoat {
  explicit CommandedBoat(const std::string& name) : scratch{name} {
    REQUIRE(eventually([&] { return drives(thrust.latest()); }));
    REQUIRE(eventually([&] { return (port = port_of(boat)) != 0; }));
    REQUIRE(eventually([&] { return find_token_file(port).has_value(); }));
    token_path = *find_token_file(port);
    token = read_token(token_path);
  }
  [[nodiscard]] static std::uint16_t port_of(const Boat& boat) {
    return static_cast<std::uint16_t>(listening_port(boat.high->pid()));
  }
  [[nodiscard]] MissionStatus status() { return await_first(mission).value; }
  [[nodiscard]] int tell(const std::string& command) const {
    ChildProcess teller{"lodesman", {command, "--port", std::to_string(port), "--quiet"}};
    REQUIRE(eventually([&] { return teller.ended().has_value(); }));
    return teller.exit_status().value_or(-1);
  }
  [[nodiscard]] bool becomes(MissionState state) {
    return eventually([&] { return status().state == state; });
  }

  Scratch scratch;
  Boat boat{scratch};
  SharedBlackboard board = SharedBlackboard::observe(boat.segment, kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  Reader<MissionStatus> mission{board->mission_status};
  std::uint16_t port = 0;
  fs::path token_path;
  std::string token;
};

}  // namespace

TEST_CASE("command access: an abort is confirmed and obeyed while 20000 orders a second come",
          "[system]") {
  CommandedBoat commanded{"flood"};
  const CommandCrowd crowd{{commanded.port, 300, 20000, command_text("resume", commanded.token)}};
  for (std::uint64_t aborts = 1; aborts <= 5; ++aborts) {
    const std::uint64_t answered = crowd.answered();
    REQUIRE(eventually([&] { return crowd.answered() > answered + 1000; }));
    REQUIRE(commanded.tell("abort") == 0);
    CHECK(commanded.status().aborts == aborts);
    CHECK(commanded.status().state == MissionState::kAborted);
    REQUIRE(eventually([&] { return await_first(commanded.thrust).value.left == 128; }));
    REQUIRE(commanded.tell("start") == 0);
    REQUIRE(eventually([&] { return drives(commanded.thrust.latest()); }));
  }
}

TEST_CASE("command access: idle clients do not lock the operator out", "[system]") {
  CommandedBoat commanded{"idle"};
  const CommandCrowd crowd{{commanded.port, 400, 0, ""}};
  REQUIRE(eventually([&] { return crowd.connected() >= 400; }));
  CHECK(commanded.tell("status") == 0);
  CHECK(commanded.tell("hold") == 0);
  CHECK(commanded.tell("abort") == 0);
  CHECK(commanded.status().aborts == 1);
}

TEST_CASE("command access: a page in a browser commands nothing", "[system]") {
  CommandedBoat commanded{"page"};
  const std::string body = "{\"command\":\"hold\"}\n{\"command\":\"abort\"}\n";
  const std::string page = "POST / HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(commanded.port) +
                           "\r\nOrigin: http://example.org\r\nContent-Type: text/plain\r\n"
                           "Content-Length: " +
                           std::to_string(body.size()) + "\r\n\r\n" + body;
  for (int i = 0; i < 20; ++i) {
    CHECK(ask_boat(commanded.port, page).find("\"ok\":true") == std::string::npos);
  }
  // Even one that knew the token: what follows a line of HTTP is not read.
  const std::string knowing = "POST / HTTP/1.1\r\n\r\n" + command_text("abort", commanded.token);
  CHECK(ask_boat(commanded.port, knowing).find("\"ok\":true") == std::string::npos);
  CHECK(commanded.tell("status") == 0);  // answered after all of those
  CHECK(commanded.status().order == 1);  // its own start
  CHECK(commanded.status().aborts == 0);
  CHECK(commanded.status().state == MissionState::kUnderWay);
}

TEST_CASE("command access: another user cannot command the boat", "[system]") {
  if (geteuid() != 0) {
    std::cout << "skipped: no right to become another user\n";
    return;
  }
  constexpr uid_t kNobody = 65534;
  CommandedBoat commanded{"other-user"};
  const pid_t child = fork();
  if (child == 0) {
    const bool other = setgroups(0, nullptr) == 0 && setgid(kNobody) == 0 && setuid(kNobody) == 0;
    const bool readable = std::ifstream{commanded.token_path}.good();
    const bool obeyed =
        ask_boat(commanded.port, "{\"command\":\"abort\"}\n").find("wrong or missing token") ==
        std::string::npos;
    _exit(!other ? 1 : readable ? 2 : obeyed ? 3 : 0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(commanded.status().aborts == 0);
  CHECK(commanded.tell("abort") == 0);
  CHECK(commanded.status().aborts == 1);
}

TEST_CASE("command access: an order that cannot be is refused with 1, and no boat is 4",
          "[system]") {
  CommandedBoat commanded{"refused"};
  CHECK(commanded.tell("resume") == 1);
  CHECK(commanded.tell("hold") == 0);
  CHECK(commanded.tell("resume") == 0);
  commanded.boat.high.reset();
  CHECK_FALSE(fs::exists(commanded.token_path));
  CHECK(commanded.tell("abort") == 4);
  CHECK(commanded.tell("start") == 4);
}

TEST_CASE("command access: an abort stands when the high level is killed and comes back",
          "[system]") {
  CommandedBoat commanded{"latch"};
  REQUIRE(commanded.tell("abort") == 0);
  REQUIRE(kill(commanded.boat.high->pid(), SIGKILL) == 0);
  REQUIRE(eventually([&] { return commanded.boat.high->ended().has_value(); }));
  const std::uint64_t before = commanded.mission.newest_sequence();
  commanded.boat.start_high();  // told to start by itself
  REQUIRE(eventually([&] { return commanded.mission.newest_sequence() > before + 20; }));
  CHECK(commanded.status().state == MissionState::kAborted);
  REQUIRE(
      eventually([&] { return (commanded.port = CommandedBoat::port_of(commanded.boat)) != 0; }));
  REQUIRE(eventually([&] { return find_token_file(commanded.port).has_value(); }));
  CHECK(commanded.tell("start") == 0);
  CHECK(commanded.becomes(MissionState::kUnderWay));
}

TEST_CASE("command access: the port that the kernel chose is always said", "[system]") {
  const Scratch scratch{"port"};
  const fs::path said = scratch.file("said");
  const int own = dup(STDERR_FILENO);
  const int file = open(said.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
  REQUIRE(dup2(file, STDERR_FILENO) == STDERR_FILENO);
  const Boat boat{scratch};  // takes over the file
  REQUIRE(dup2(own, STDERR_FILENO) == STDERR_FILENO);
  close(own);
  close(file);
  int port = 0;
  REQUIRE(eventually([&] { return (port = listening_port(boat.high->pid())) != 0; }));
  const std::string line =
      "lodesman-high: command socket on 127.0.0.1 port " + std::to_string(port) + "\n";
  CHECK(eventually([&] {
    std::ostringstream text;
    text << std::ifstream{said}.rdbuf();
    return text.str().find(line) != std::string::npos;
  }));
}
