// SPDX-License-Identifier: Apache-2.0
// One process dies, or is not there yet, and the other one stays: what it does meanwhile, and how
// both find each other again.
#include <sys/stat.h>

#include <sstream>

#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

ino_t file_of(const std::string& segment) {
  struct stat file {};
  REQUIRE(stat(("/dev/shm/" + segment).c_str(), &file) == 0);
  return file.st_ino;
}

void spoil(const std::string& segment) {
  std::fstream bytes{"/dev/shm/" + segment, std::ios::in | std::ios::out | std::ios::binary};
  bytes.seekp(offsetof(SegmentHeader, layout_hash));
  const std::uint64_t other = layout_hash() + 1;
  bytes.write(reinterpret_cast<const char*>(&other), sizeof other);
}

bool is_neutral(const HelmCommand& helm) { return helm.surge_ref == 0 && helm.head_ref == 0; }

// Whether a process has come so far that it keeps SIGTERM for itself. One that has only been forked
// may do so too, for a moment: it bears the name of this program still.
bool heeds_stop(pid_t process) {
  std::ifstream status{"/proc/" + std::to_string(process) + "/status"};
  bool is_itself = false;
  for (std::string line; std::getline(status, line);) {
    is_itself |= line.starts_with("Name:") && line.ends_with("lodesman-high");
    if (line.starts_with("SigBlk:")) {
      return is_itself && (std::stoull(line.substr(7), nullptr, 16) & (1ULL << (SIGTERM - 1))) != 0;
    }
  }
  return false;
}

}  // namespace

TEST_CASE(
    "restarts: a low level that comes back takes the segment over, and the high level sails on "
    "with its mission",
    "[system]") {
  const Scratch scratch{"adopt"};
  Boat boat{scratch};
  const auto board = SharedBlackboard::observe(boat.segment, kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  Reader<HelmCommand> helm{board->helm_command};
  Reader<Attitude> attitude{board->attitude};
  Reader<MissionStatus> mission{board->mission_status};
  REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  const ino_t file = file_of(boat.segment);
  const Time started = await_first(mission).value.started;
  for (int round = 0; round < 2; ++round) {
    REQUIRE(kill(boat.low->pid(), SIGKILL) == 0);
    REQUIRE(eventually([&] { return boat.low->ended().has_value(); }));
    CHECK(eventually([&] {
      return is_neutral(await_first(helm).value) &&
             await_first(helm).value.reason == HelmReason::kStaleAttitude;
    }));
    CHECK_FALSE(boat.high->ended().has_value());
    while (attitude.next() != nullptr || thrust.next() != nullptr) {
    }
    boat.start_low();
    const Stamped<ThrustApplied>* applied = nullptr;
    REQUIRE(eventually([&] {
      applied = thrust.next();
      return drives(applied);
    }));
    // Not before the new low level's own inputs were there.
    const auto* first = attitude.next();
    REQUIRE(first != nullptr);
    CHECK(first->stamp <= applied->stamp);
    CHECK(await_first(mission).value.state == MissionState::kUnderWay);
    CHECK(await_first(mission).value.started == started);
    CHECK(file_of(boat.segment) == file);
    CHECK_FALSE(boat.high->ended().has_value());
  }
}

TEST_CASE(
    "restarts: where a new segment is made the high level attaches again, and waits for a start",
    "[system]") {
  for (const bool orderly : {true, false}) {
    const Scratch scratch{"again"};
    Boat boat{scratch};
    const auto old = SharedBlackboard::observe(boat.segment, kPatience);
    Reader<ThrustApplied> old_thrust{old->thrust_applied};
    REQUIRE(eventually([&] { return drives(old_thrust.latest()); }));
    REQUIRE(kill(boat.low->pid(), orderly ? SIGTERM : SIGKILL) == 0);
    REQUIRE(eventually([&] { return boat.low->ended().has_value(); }));
    if (!orderly) {
      spoil(boat.segment);
    }
    boat.start_low();
    REQUIRE(eventually([&] { return old.is_superseded(); }));
    const auto board = SharedBlackboard::observe(boat.segment, kPatience);
    Reader<MissionStatus> mission{board->mission_status};
    Reader<HelmCommand> helm{board->helm_command};
    REQUIRE(eventually([&] { return board.alive(Role::kHigh); }));
    REQUIRE(eventually([&] {
      const auto* status = mission.latest();
      return status != nullptr && status->value.state == MissionState::kIdle;
    }));
    // It has all it needs to sail and does not.
    Reader<VehicleState> state{board->vehicle_state};
    REQUIRE(eventually([&] { return state.newest_sequence() >= 20; }));
    CHECK(await_first(mission).value.state == MissionState::kIdle);
    CHECK(is_neutral(await_first(helm).value));
    CHECK_FALSE(boat.high->ended().has_value());
  }
}

TEST_CASE("restarts: a high level without a segment says not yet, and heeds a stop meanwhile",
          "[system]") {
  const Scratch scratch{"not-yet"};
  const Boat boat{scratch};  // for its files alone
  auto arguments = boat.arguments;
  arguments[1] = "lodesman-test-nowhere-" + std::to_string(getpid());
  Program waits{program("lodesman-high"), arguments};
  Program stopped{program("lodesman-high"), arguments};
  REQUIRE(eventually([&] { return heeds_stop(stopped.pid()); }));
  REQUIRE(kill(stopped.pid(), SIGTERM) == 0);
  CHECK(stopped.status() == 0);
  CHECK(waits.status() == 75);
  CHECK(Program{program("lodesman"), {"watch", "--once", "--segment", arguments[1]}}.status() ==
        75);
}

TEST_CASE("restarts: closed standard streams are no way into the segment", "[system]") {
  const Scratch scratch{"streams"};
  Boat boat{scratch};
  const auto board = SharedBlackboard::observe(boat.segment, kPatience);
  REQUIRE(eventually([&] { return board.alive(Role::kHigh); }));
  REQUIRE(kill(boat.low->pid(), SIGKILL) == 0);
  REQUIRE(eventually([&] { return boat.low->ended().has_value(); }));
  // What it finds there it says, on standard error.
  Program low{program("lodesman-low"), boat.arguments, [] {
                for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
                  close(stream);
                }
              }};
  Reader<ThrustApplied> thrust{board->thrust_applied};
  const std::uint64_t before = thrust.newest_sequence();
  REQUIRE(eventually([&] { return thrust.newest_sequence() > before + 5; }));
  CHECK_NOTHROW(SharedBlackboard::observe(boat.segment, Duration::zero()));
  CHECK(kill(low.pid(), SIGTERM) == 0);
  CHECK(low.status() == 0);
}
