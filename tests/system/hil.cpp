// SPDX-License-Identifier: Apache-2.0
// The real drivers, told by an operator, against devices that are emulated to the byte.
#include "high_level/mission/token_file.h"
#include "tests/support/catch.h"
#include "tests/system/benched_boat.h"
#include "tests/system/listening_port.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// A boat on the bench, and the operator's command.
struct OperatedBoat {
  explicit OperatedBoat(const std::string& box) : boat{box} {
    board.emplace(SharedBlackboard::observe(boat.segment(), kPatience));
    status.emplace((*board)->thrust_status);
    REQUIRE(eventually([&] {
      port = static_cast<std::uint16_t>(listening_port(boat.high->pid()));
      return port != 0 && find_token_file(port).has_value();
    }));
  }
  [[nodiscard]] int tell(std::vector<std::string> words) const {
    words.insert(words.begin() + 1, {"--port", std::to_string(port), "--quiet"});
    ChildProcess teller{"lodesman", words};
    REQUIRE(eventually([&] { return teller.ended().has_value(); }));
    return teller.exit_status().value_or(-1);
  }
  [[nodiscard]] bool is_obeyed(const std::vector<std::string>& words) const {
    return eventually([&] { return tell(words) == 0; });
  }
  [[nodiscard]] ThrustState state() { return await_first(*status).value.state; }

  BenchedBoat boat;
  std::optional<SharedBlackboard> board;
  std::optional<Reader<ThrustStatus>> status;
  std::uint16_t port = 0;
};

}  // namespace

TEST_CASE("hil: disarmed at power-up, armed by a word, and stopped for good by another",
          "[system]") {
  OperatedBoat operated{"maestro"};
  BenchedBoat& boat = operated.boat;
  CHECK(operated.state() == ThrustState::kDisarmed);
  CHECK(operated.tell({"start"}) == 1);
  CHECK(operated.tell({"manual", "50", "0"}) == 1);
  REQUIRE(operated.is_obeyed({"arm"}));  // once the box has been seen to stop by itself
  CHECK(operated.state() == ThrustState::kArmed);
  CHECK(boat.is_still());
  REQUIRE(operated.is_obeyed({"start"}));
  boat.await_drive();
  CHECK(operated.tell({"estop"}) == 0);
  CHECK(boat.still_after_s(Time{}) >= 0.0);
  CHECK(operated.state() == ThrustState::kStopped);
  CHECK(operated.tell({"arm"}) == 1);
  CHECK(operated.tell({"start"}) == 1);
  CHECK(operated.tell({"estop", "--release"}) == 0);
  CHECK(operated.tell({"start"}) == 1);  // not before it is armed again
  REQUIRE(operated.is_obeyed({"arm"}));
  REQUIRE(operated.is_obeyed({"start"}));
  boat.await_drive();
}

TEST_CASE("hil: the stick outranks the mission, falls silent in neutral, and gives nothing back",
          "[system]") {
  OperatedBoat operated{"roboclaw"};
  BenchedBoat& boat = operated.boat;
  REQUIRE(operated.is_obeyed({"arm"}));
  REQUIRE(operated.is_obeyed({"start"}));
  boat.await_drive();
  CHECK(operated.tell({"manual", "--for", "1", "--", "-60", "0"}) == 0);
  CHECK(operated.state() == ThrustState::kManual);
  CHECK(boat.has_gone_astern());
  CHECK(boat.still_after_s(Time{}) >= 0.0);
  CHECK(operated.state() == ThrustState::kManual);
  REQUIRE(operated.is_obeyed({"resume"}));
  boat.await_drive();
  CHECK(operated.state() == ThrustState::kArmed);
  CHECK(operated.tell({"disarm"}) == 0);
  CHECK(boat.still_after_s(Time{}) >= 0.0);
  CHECK(operated.tell({"resume"}) == 1);  // the mission was aborted with it
}
