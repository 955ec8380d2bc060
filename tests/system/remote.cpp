// SPDX-License-Identifier: Apache-2.0
// A boat that is commanded over a network, and whoever sits in between: two real processes behind
// an address of this machine that is not loopback, and the operator's command.
#include <sys/socket.h>

#include <sstream>

#include "tests/support/catch.h"
#include "tests/support/far_client.h"
#include "tests/support/own_address.h"
#include "tests/support/relay.h"
#include "tests/system/program.h"
#include "tests/system/remote_boat.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// What a command of `lodesman` says on standard error, and its exit status.
struct Said {
  int status = -1;
  std::string text;
};

Said said_by(const Scratch& scratch, const std::vector<std::string>& words) {
  const std::string file = scratch.file("said").string();
  fs::remove(file);
  Program command{program("lodesman"), words,
                  [&] { redirect(STDERR_FILENO, file.c_str(), O_WRONLY | O_CREAT | O_APPEND); }};
  Said said{command.status(), ""};
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  said.text = text.str();
  return said;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream{text};
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

// A digit of the line's code or proof is another.
std::string with_another_digit(std::string line, const std::string& key) {
  const std::size_t at = line.find("\"" + key + "\":\"");
  if (at != std::string::npos) {
    char& digit = line[at + key.size() + 4];
    digit = digit == '0' ? '1' : '0';
  }
  return line;
}

}  // namespace

TEST_CASE("remote: a boat is started, held, stopped and asked from outside by its token file",
          "[system]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  const Scratch scratch{"remote"};
  RemoteBoat boat{scratch, *own};
  CHECK(boat.tell({"status"}) == 0);
  REQUIRE(boat.sails());
  CHECK(boat.tell({"hold"}) == 0);
  CHECK(boat.becomes(MissionState::kHolding));
  CHECK(boat.tell({"resume"}) == 0);
  CHECK(boat.tell({"tune", "mission.speed_limit_m_s=0.5"}) == 0);
  CHECK(boat.tell({"abort"}) == 0);
  CHECK(boat.mission().state == MissionState::kAborted);
  const fs::path mission = scratch.file("m.toml", "goal_m = [0.0, 40.0]\nspeed_m_s = 0.42\n");
  CHECK(boat.tell({"start", "--mission", mission.string()}) == 0);
  CHECK(boat.becomes(MissionState::kUnderWay));
  CHECK(boat.tell({"disarm"}) == 0);
  CHECK(boat.tell({"arm"}) == 0);
  CHECK(boat.tell({"manual", "20", "0"}) == 0);
  CHECK(boat.tell({"estop"}) == 0);
  CHECK(boat.tell({"estop", "--release"}) == 0);
  // Aboard no file is needed, and one does no harm.
  const std::string port = std::to_string(boat.port());
  CHECK(said_by(scratch, {"status", "--port", port, "--quiet"}).status == 0);
  CHECK(said_by(scratch, {"status", "--port", port, "--token-file", boat.token_file().string()})
            .status == 0);
}

TEST_CASE("remote: over IPv6 too, and by a name", "[system]") {
  const auto own = own_address(AF_INET6);
  if (!own) {
    return;
  }
  const Scratch scratch{"remote-ipv6"};
  RemoteBoat boat{scratch, *own};
  REQUIRE(boat.sails());
  CHECK(boat.tell({"abort"}) == 0);
  CHECK(boat.mission().state == MissionState::kAborted);
  // A name may be anybody's: behind one the token is proved, wherever it leads. This is one that
  // every resolver knows.
  const Said by_name =
      said_by(scratch, {"status", "--host", "127.1", "--port", std::to_string(boat.port()),
                        "--token-file", boat.token_file().string(), "--quiet"});
  CHECK(by_name.status == 0);
  const Said without =
      said_by(scratch, {"status", "--host", "127.1", "--port", std::to_string(boat.port())});
  CHECK(without.status == 2);
}

TEST_CASE("remote: who lacks the token file, or has another, is told so in one line", "[system]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  const Scratch scratch{"remote-refused"};
  RemoteBoat boat{scratch, *own};
  const std::string port = std::to_string(boat.port());
  const Said without = said_by(scratch, {"abort", "--host", *own, "--port", port});
  CHECK(without.status == 2);
  CHECK(contains(without.text, "--host: beyond loopback needs --token-file"));
  const fs::path other = scratch.file("other.token");
  make_token_file(other);
  const Said wrong =
      said_by(scratch, {"abort", "--host", *own, "--port", port, "--token-file", other.string()});
  CHECK(wrong.status == 4);
  CHECK(contains(wrong.text, "refuses the handshake (wrong proof): is this its token file?"));
  const fs::path weak = scratch.file("weak.token", std::string(40, 'x') + "\n");
  fs::permissions(weak, fs::perms::owner_read);
  const Said refused =
      said_by(scratch, {"abort", "--host", *own, "--port", port, "--token-file", weak.string()});
  CHECK(refused.status == 2);
  CHECK(contains(refused.text, weak.string() + ":1: token: is none that lodesman token --new"));
  CHECK(boat.mission().aborts == 0);
  // A file with the token to abort alone.
  const fs::path abort_only = scratch.file("abort.token", read_tokens(boat.token_file()).abort);
  fs::permissions(abort_only, fs::perms::owner_read);
  const auto as_stopper = [&](const std::string& command) {
    return said_by(scratch, {command, "--host", *own, "--port", port, "--token-file",
                             abort_only.string(), "--quiet"});
  };
  const Said start = as_stopper("start");
  CHECK(start.status == 1);
  CHECK(contains(start.text, "this token is not good for start"));
  CHECK(as_stopper("abort").status == 0);
  CHECK(boat.mission().aborts == 1);
}

TEST_CASE("remote: a session that was recorded holds no token, and is refused when it is replayed",
          "[system]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  const Scratch scratch{"remote-replay"};
  RemoteBoat boat{scratch, *own};
  REQUIRE(boat.sails());
  const Relay relay{*own, boat.port()};
  REQUIRE(boat.tell({"abort"}, relay.port()) == 0);
  REQUIRE(boat.mission().aborts == 1);
  REQUIRE(boat.tell({"goto", "0,50"}, relay.port()) == 0);
  REQUIRE(boat.becomes(MissionState::kUnderWay));
  const std::uint64_t orders = boat.mission().order;
  const std::string heard = relay.heard(RelayWay::kToBoat);
  const std::vector<std::string> lines = lines_in(heard);
  REQUIRE(lines.size() == 6);  // request, answer and command, twice
  for (const std::string& all : {heard, relay.heard(RelayWay::kToClient)}) {
    for (std::size_t i = 0; i + 16 <= boat.token().size(); ++i) {
      CHECK_FALSE(contains(all, boat.token().substr(i, 16)));
    }
  }
  for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
    FarClient replay{*own, boat.port()};
    replay.send(lines[first] + "\n" + lines[first + 1]);
    CHECK(contains(replay.challenge(), "boat_nonce"));
    CHECK(replay.line() == refusal("wrong proof"));
    replay.send(lines[first + 2]);
    CHECK_FALSE(replay.line());
  }
  CHECK(boat.tell({"status"}) == 0);  // answered after all of those
  CHECK(boat.mission().aborts == 1);
  CHECK(boat.mission().order == orders);
  CHECK(boat.mission().state == MissionState::kUnderWay);
}

TEST_CASE(
    "remote: what is altered or repeated on its way is not obeyed, nor an altered answer "
    "believed",
    "[system]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  const Scratch scratch{"remote-altered"};
  RemoteBoat boat{scratch, *own};
  REQUIRE(boat.sails());
  // Another word in the place of the operator's.
  const Relay other_word{*own, boat.port(), [](RelayWay way, std::string line) {
                           const std::size_t at = line.find("\"status\"");
                           return way == RelayWay::kToBoat && at != std::string::npos
                                      ? line.replace(at, 8, "\"disarm\"")
                                      : line;
                         }};
  CHECK(boat.tell({"status"}, other_word.port()) == 1);  // refused by the boat
  // What stands behind an altered line is not obeyed either.
  const Relay twice{*own, boat.port(), [](RelayWay way, const std::string& line) {
                      return way == RelayWay::kToBoat && contains(line, "\"hold\"")
                                 ? with_another_digit(line, "code") + line
                                 : line;
                    }};
  CHECK(boat.tell({"hold"}, twice.port()) != 0);
  CHECK(boat.mission().state == MissionState::kUnderWay);
  CHECK(boat.mission().aborts == 0);
  // The boat's answer.
  const Relay answer{*own, boat.port(), [](RelayWay way, const std::string& line) {
                       return way == RelayWay::kToClient ? with_another_digit(line, "code") : line;
                     }};
  const Said altered = said_by(scratch, boat.words({"hold"}, answer.port()));
  CHECK(altered.status == 4);
  CHECK(contains(altered.text, "gave an answer that was altered on its way"));
}

TEST_CASE("remote: who does not prove that he is the boat is ordered nothing", "[system]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  const Scratch scratch{"remote-impostor"};
  RemoteBoat boat{scratch, *own};
  const Relay impostor{*own, boat.port(), [](RelayWay way, const std::string& line) {
                         return way == RelayWay::kToClient ? with_another_digit(line, "proof")
                                                           : line;
                       }};
  const Said said = said_by(scratch, boat.words({"abort"}, impostor.port()));
  CHECK(said.status == 4);
  CHECK(contains(said.text, "does not prove that it holds the token"));
  CHECK_FALSE(contains(impostor.heard(RelayWay::kToBoat), "abort"));
  const Relay newer{*own, boat.port(), [](RelayWay way, std::string line) {
                      const std::size_t at = line.find("\"handshake\":1");
                      return way == RelayWay::kToClient && at != std::string::npos
                                 ? line.replace(at, 13, "\"handshake\":2")
                                 : line;
                    }};
  const Said version = said_by(scratch, boat.words({"status"}, newer.port()));
  CHECK(version.status == 4);
  CHECK(contains(version.text, "speaks another handshake than 1"));
  // A boat that would take the token in the clear is not given it.
  const Relay plain{*own, boat.port(), [](RelayWay way, const std::string& line) {
                      return way == RelayWay::kToClient
                                 ? refusal("a command is a line {\"command\": ...}") + "\n"
                                 : line;
                    }};
  const Said downgraded = said_by(scratch, boat.words({"status"}, plain.port()));
  CHECK(downgraded.status == 4);
  CHECK(contains(downgraded.text, "gives no challenge"));
  CHECK_FALSE(contains(plain.heard(RelayWay::kToBoat), boat.token().substr(0, 16)));
  CHECK(boat.mission().aborts == 0);
}

TEST_CASE("remote: a link that dies without a word is missed, and the mission does what it says",
          "[system]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  const Scratch scratch{"remote-link"};
  RemoteBoat boat{scratch, *own};
  REQUIRE(boat.sails());
  const fs::path mission = scratch.file(
      "m.toml", "goal_m = [0.0, 50.0]\nlink_lost = \"hold\"\nlink_lost_after_s = 1.5\n");
  Relay relay{*own, boat.port()};
  const ChildProcess commander{
      "lodesman", boat.words({"start", "--mission", mission.string(), "--follow"}, relay.port())};
  REQUIRE(eventually([&] { return contains(relay.heard(RelayWay::kToBoat), "heartbeat"); }));
  REQUIRE(boat.becomes(MissionState::kUnderWay));
  relay.fall_silent();
  CHECK(boat.becomes(MissionState::kHolding));
  CHECK(boat.mission().cause == MissionCause::kLinkLost);
  CHECK(boat.tell({"abort"}) == 0);
  CHECK(boat.mission().state == MissionState::kAborted);
}

TEST_CASE("remote: a boat does not come up beyond loopback without its token file", "[system]") {
  const Scratch scratch{"remote-config"};
  const auto refused = [&](const std::string& section) {
    const fs::path config =
        scratch.file("boat.toml", "[command_socket]\n" + section +
                                      "[simulation]\nscenario = \"paper-static\"\n");
    const std::string file = scratch.file("said").string();
    fs::remove(file);
    Program high{program("lodesman-high"), {"--config", config.string()}, [&] {
                   redirect(STDERR_FILENO, file.c_str(), O_WRONLY | O_CREAT);
                 }};
    CHECK(high.status() == 2);
    std::ostringstream text;
    text << std::ifstream{file}.rdbuf();
    return text.str();
  };
  const std::string config = scratch.file("boat.toml").string();
  CHECK(refused("address = \"0.0.0.0\"\n") ==
        config +
            ":2: command_socket.address: beyond loopback a token_file is needed: lodesman "
            "token --new FILE makes one\n");
  CHECK(refused("address = \"boat\"\n") ==
        config + ":2: command_socket.address: must be an IP address\n");
  const std::string none = scratch.file("none").string();
  CHECK(refused("address = \"::\"\ntoken_file = \"" + none + "\"\n") ==
        none + ":1: token: cannot be read: No such file or directory\n");
}
