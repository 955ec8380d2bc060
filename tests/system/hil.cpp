// SPDX-License-Identifier: Apache-2.0
// The real drivers, told by an operator, against devices that are emulated to the byte.
#include "high_level/mission/token_file.h"
#include "mid_level/base/geodesy.h"
#include "tests/support/catch.h"
#include "tests/system/benched_boat.h"
#include "tests/system/listening_port.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// A boat on the bench, and the operator's command.
struct OperatedBoat {
  explicit OperatedBoat(const std::string& box, Benched benched = Benched::kHeadingAndThrusters)
      : boat{box, {}, benched} {
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

namespace {

// What the boat says of one of its devices.
struct DeviceEar {
  DeviceEar(const Blackboard& board, DeviceId device)
      : health{board.device_health[static_cast<std::size_t>(device)]} {}
  [[nodiscard]] bool hears(DeviceStatus status) {
    return eventually([&] {
      const auto* newest = health.latest();
      return newest != nullptr && newest->value.status == status;
    });
  }
  Reader<DeviceHealth> health;
};

}  // namespace

TEST_CASE("hil: four real drivers at once, and what each says when its device falls silent",
          "[system]") {
  OperatedBoat operated{"maestro", Benched::kAll};
  BenchedBoat& boat = operated.boat;
  DeviceEar sonar{**operated.board, DeviceId::kSonar};
  DeviceEar position{**operated.board, DeviceId::kPosition};
  CHECK(sonar.hears(DeviceStatus::kWorking));
  CHECK(position.hears(DeviceStatus::kWorking));
  REQUIRE(operated.is_obeyed({"arm"}));
  REQUIRE(operated.is_obeyed({"start"}));
  boat.await_drive();
  boat.order("sonar stall for=4");
  CHECK(sonar.hears(DeviceStatus::kSilent));
  CHECK(sonar.hears(DeviceStatus::kWorking));
  boat.order("position disconnect for=4");
  CHECK(position.hears(DeviceStatus::kDisconnected));
  CHECK(position.hears(DeviceStatus::kWorking));
  boat.order("sonar range value=10 for=1");
  Reader<SonarPing> pings{(*operated.board)->sonar_ping};
  const auto reaches = [&](double least_m, double most_m) {
    return eventually([&] {
      const auto* ping = pings.latest();
      return ping != nullptr && ping->value.range_m > least_m && ping->value.range_m < most_m;
    });
  };
  CHECK(reaches(9.0, 11.0));   // as its user has it
  CHECK(reaches(29.0, 31.0));  // as the driver asked again
}

TEST_CASE("bench: at_start the receiver's first fixes are the origin, which outlives both programs",
          "[system]") {
  BenchedBoat boat{"maestro", {}, Benched::kAll, {"origin.at_start=true"}};
  const auto found = [&] {
    std::optional<SharedBlackboard> board;
    REQUIRE(eventually([&] {
      try {
        board.emplace(SharedBlackboard::observe(boat.segment(), Duration::zero()));
      } catch (const StartupError&) {
        return false;
      }
      return board->alive(Role::kLow) && board->alive(Role::kHigh);
    }));
    Reader<VehicleState> states{(*board)->vehicle_state};
    const std::uint64_t before = states.newest_sequence();
    REQUIRE(eventually([&] { return states.newest_sequence() > before + 20; }));
    Reader<WorldOrigin> origins{(*board)->world_origin};
    CHECK(origins.newest_sequence() == 1);
    return await_first(origins).value;
  };
  const WorldOrigin first = found();
  CHECK(first.source == OriginSource::kFirstFix);
  CHECK(rough_distance_m({first.latitude_deg, first.longitude_deg}, {35.0, 139.0}) < 20.0);
  const auto is_first = [&](const WorldOrigin& origin) {
    return rough_distance_m({first.latitude_deg, first.longitude_deg},
                            {origin.latitude_deg, origin.longitude_deg}) < 1e-6 &&
           origin.fixed == first.fixed;
  };
  const auto end = [](ChildProcess& process, int signal) {
    REQUIRE(kill(process.pid(), signal) == 0);
    REQUIRE(eventually([&] { return process.ended().has_value(); }));
  };
  end(*boat.high, SIGKILL);
  boat.start_high();
  CHECK(is_first(found()));
  end(*boat.low, SIGKILL);  // it takes its segment over
  boat.start_low();
  CHECK(is_first(found()));
  end(*boat.low, SIGTERM);  // it makes another
  boat.start_low();
  CHECK(is_first(found()));
}

TEST_CASE(
    "hil: a low level that died goes by the proof on record, and proves a box that was away anew",
    "[system]") {
  OperatedBoat operated{"maestro"};
  BenchedBoat& boat = operated.boat;
  REQUIRE(operated.is_obeyed({"arm"}));
  REQUIRE(operated.is_obeyed({"start"}));
  boat.await_drive();
  Reader<BoxProof> proofs{(*operated.board)->box_proof};
  const Stamped<BoxProof> first = await_first(proofs);
  REQUIRE(first.value.power_up != 0);
  const auto kill_low = [&] {
    REQUIRE(kill(boat.low->pid(), SIGKILL) == 0);
    REQUIRE(eventually([&] { return boat.low->ended().has_value(); }));
    CHECK(boat.still_after_s(Time{}) >= 0.0);
  };
  kill_low();
  boat.start_low();
  boat.await_drive();
  const BoxProof recalled = await_first(proofs).value;
  CHECK(recalled.proved == first.value.proved);  // it stands: nothing was proved since
  CHECK(recalled.power_up == first.value.power_up);
  kill_low();
  boat.order("thruster disconnect for=0.2");
  std::this_thread::sleep_for(milliseconds{400});
  boat.start_low();
  boat.await_drive();
  const BoxProof anew = await_first(proofs).value;
  CHECK(anew.proved > first.value.proved);
  CHECK(anew.power_up != first.value.power_up);
}
