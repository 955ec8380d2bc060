// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/watch/board_watch.h"

#include <algorithm>
#include <memory>

#include "deploy/operator/watch/find_segment.h"
#include "mid_level/runtime/health_watch.h"
#include "tests/support/catch.h"
#include "tests/support/text_file.h"

namespace lodesman::testing {
namespace {

using namespace cli;
using std::chrono::milliseconds;

constexpr Time kStart{std::chrono::seconds{100}};
constexpr std::size_t kOtherChannels = 26;  // than of devices and tasks

struct Boat {
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<Attitude> attitude{board->attitude, Role::kLow, "attitude"};
  Writer<TaskHealth> health{board->task_health[static_cast<std::size_t>(TaskId::kAhrs)], Role::kLow,
                            "ahrs"};
};

[[nodiscard]] ChannelRow channel(const BoardWatch& watch, const std::string& name) {
  for (const ChannelRow& row : watch.state().channels) {
    if (row.name == name) {
      return row;
    }
  }
  FAIL("no channel " + name);
  return {};
}

TEST_CASE("watch: rate, age and publications of a channel", "[cli]") {
  Boat boat;
  boat.attitude.publish({}, kStart - milliseconds{40});
  BoardWatch watch{*boat.board};
  watch.poll(kStart);
  REQUIRE_FALSE(channel(watch, "attitude").rate_hz.has_value());
  for (int i = 1; i <= 100; ++i) {
    boat.attitude.publish({}, kStart + i * milliseconds{20});
    if (i % 5 == 0) {
      watch.poll(kStart + i * milliseconds{20});
    }
  }
  watch.poll(kStart + milliseconds{2010});
  const ChannelRow row = channel(watch, "attitude");
  REQUIRE(row.rate_hz == Approx(100.0 / 2.01));
  REQUIRE(row.age_s == Approx(0.01));
  REQUIRE(row.publications == 101);
  REQUIRE(row.missed == 0);
  REQUIRE_FALSE(row.stale);
  REQUIRE(row.writer == Role::kLow);

  // A rate looks back no farther than its window.
  watch.poll(kStart + milliseconds{2500} + BoardWatch::kRateWindow);
  watch.poll(kStart + milliseconds{2600} + BoardWatch::kRateWindow);
  REQUIRE(channel(watch, "attitude").rate_hz == Approx(0.0).margin(1e-9));
  REQUIRE(channel(watch, "attitude").stale);
}

TEST_CASE("watch: only what was overwritten unseen since it began is missed", "[cli]") {
  Boat boat;
  for (int i = 0; i < 500; ++i) {
    boat.attitude.publish({}, kStart);
  }
  BoardWatch watch{*boat.board};
  watch.poll(kStart);
  REQUIRE(channel(watch, "attitude").missed == 0);
  for (int i = 0; i < 70; ++i) {
    boat.attitude.publish({}, kStart);
  }
  watch.poll(kStart);
  REQUIRE(channel(watch, "attitude").missed == 6);  // of 70 the ring keeps 64
}

TEST_CASE("watch: the newest plan that thrust followed is followed back to its ping", "[cli]") {
  Boat boat;
  BoardWatch watch{*boat.board};
  watch.poll(kStart);
  CHECK_FALSE(watch.state().chain.has_value());
  Writer<SonarPing> pings{boat.board->sonar_ping, Role::kLow, "sonar_ping"};
  Writer<PathRequest> requests{boat.board->path_request, Role::kHigh, "path_request"};
  Writer<Plan> plans{boat.board->plan, Role::kHigh, "plan"};
  Writer<HelmCommand> helms{boat.board->helm_command, Role::kHigh, "helm_command"};
  Writer<ThrustApplied> applied{boat.board->thrust_applied, Role::kLow, "thrust_applied"};
  const auto at = [](int ms) { return kStart + milliseconds{ms}; };
  const auto ping = std::make_unique<SonarPing>();
  ping->range_m = 30.0;
  ping->make_image(2, 2, 2.0);
  ping->number = 7;
  pings.publish(*ping, at(1));
  ping->number = 8;
  pings.publish(*ping, at(101));
  const auto request = std::make_unique<PathRequest>();
  request->id = 3;
  requests.publish(*request, at(2));
  Plan plan;
  plan.id = 3;
  plan.frame = 7;
  plans.publish(plan, at(4));
  helms.publish({}, at(5));
  ThrustApplied thrust;
  thrust.plan_id = 3;
  thrust.plan_captured = kStart;
  thrust.command_sequence = helms.sequence();
  applied.publish(thrust, at(6));  // not commanded
  watch.poll(at(7));
  CHECK_FALSE(watch.state().chain.has_value());
  thrust.reason = ThrustReason::kCommanded;
  applied.publish(thrust, at(8));
  watch.poll(at(9));
  applied.publish(thrust, at(50));  // the same plan still
  watch.poll(at(51));
  const auto chain = watch.state().chain;
  REQUIRE(chain.has_value());
  CHECK(chain->frame == 7);
  CHECK(chain->plan == 3);
  const auto after = [&](ChainStep step) { return chain->after_s[static_cast<std::size_t>(step)]; };
  CHECK(after(ChainStep::kPing).value() == Approx(0.001));
  CHECK(after(ChainStep::kRequest).value() == Approx(0.002));
  CHECK(after(ChainStep::kPlan).value() == Approx(0.004));
  CHECK(after(ChainStep::kHelm).value() == Approx(0.005));
  CHECK(after(ChainStep::kApplied).value() == Approx(0.008));
  CHECK_FALSE(after(ChainStep::kTracks).has_value());
  const SegmentState state{"lodesman-x", true, true, watch.state()};
  const auto json = to_json(state)["ping_to_thrust"];
  CHECK(json["plan"] == 3);
  CHECK(json["steps"].size() == kChainSteps);
  CHECK(json["steps"][0]["name"] == "ping");
  CHECK(json["steps"][2]["after_s"].is_null());
  for (const std::string& line : table_lines(state, false)) {
    CHECK(line.size() <= 80);
  }
}

TEST_CASE("watch: stale is what has a limit and is past it, or never was", "[cli]") {
  Boat boat;
  BoardWatch watch{*boat.board};
  watch.poll(kStart);
  REQUIRE(channel(watch, "attitude").stale);
  REQUIRE_FALSE(channel(watch, "attitude").age_s.has_value());
  REQUIRE_FALSE(channel(watch, "plan").stale);
  boat.attitude.publish({}, kStart);
  watch.poll(kStart + max_age::kAttitude);
  REQUIRE_FALSE(channel(watch, "attitude").stale);
  watch.poll(kStart + max_age::kAttitude + milliseconds{1});
  REQUIRE(channel(watch, "attitude").stale);
}

TEST_CASE("watch: a task tells of its steps until it falls silent", "[cli]") {
  Boat boat;
  BoardWatch watch{*boat.board};
  watch.poll(kStart);
  const auto ahrs = static_cast<std::size_t>(TaskId::kAhrs);
  REQUIRE_FALSE(watch.state().tasks[ahrs].health.has_value());
  REQUIRE_FALSE(watch.state().tasks[ahrs].silent);
  boat.health.publish({1234, 5, 6'000, 70'000}, kStart);
  watch.poll(kStart + milliseconds{900});
  const TaskRow row = watch.state().tasks[ahrs];
  REQUIRE(row.name == std::string{"ahrs"});
  REQUIRE(row.health->overruns == 5);
  REQUIRE(row.period_s == Approx(0.02));
  REQUIRE_FALSE(row.silent);
  watch.poll(kStart + silence_limit(milliseconds{20}));
  REQUIRE_FALSE(watch.state().tasks[ahrs].silent);
  watch.poll(kStart + silence_limit(milliseconds{20}) + milliseconds{1});
  REQUIRE(watch.state().tasks[ahrs].silent);
  const auto lines = table_lines({"lodesman-x", true, true, watch.state()}, false);
  REQUIRE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.starts_with("! ahrs ") && line.ends_with("  silent for 2.6 s");
  }));
}

TEST_CASE("watch: what is not sane is counted", "[cli]") {
  Boat boat;
  BoardWatch watch{*boat.board};
  Attitude nonsense;
  nonsense.heading_rad = 1e300;
  boat.attitude.publish({}, kStart);
  boat.attitude.publish(nonsense, kStart);
  watch.poll(kStart);
  REQUIRE(channel(watch, "attitude").refused == 1);
  REQUIRE(channel(watch, "attitude").publications == 1);
}

TEST_CASE("watch: the table marks what is wrong, without colour too", "[cli]") {
  Boat boat;
  BoardWatch watch{*boat.board};
  boat.attitude.publish({}, kStart);
  TaskHealth health{1234, 5, 7, 6'000, 70'000, 800'000, 60};
  health.late[6] = 1233;
  health.late[10] = 1;
  boat.health.publish(health, kStart);
  watch.poll(kStart);
  const SegmentState state{"lodesman-x", true, false, watch.state()};
  const auto lines = table_lines(state, false);
  REQUIRE(lines.size() == 3 + kOtherChannels + 1 + kDeviceCount + kTaskCount + 1);
  REQUIRE(lines[0] == "! lodesman-x: lodesman-low alive, lodesman-high GONE");
  std::string all;
  for (const std::string& line : lines) {
    REQUIRE(line.size() <= 80);
    all += line + "\n";
  }
  REQUIRE(all.find("\n! helm_command") != std::string::npos);
  REQUIRE(all.find("\n  attitude") != std::string::npos);
  REQUIRE(all.find("\n  plan ") != std::string::npos);
  REQUIRE(
      all.find(
          "\n  ahrs         low    20   60       1234        5       70.0      64.0     800.0\n") !=
      std::string::npos);
  REQUIRE(all.find("\n! ahrs: 7 inputs were not sane and passed over\n") != std::string::npos);
  REQUIRE(all.find("\x1b") == std::string::npos);
  REQUIRE(table_lines(state, true)[0].starts_with("\x1b[31m! "));

  const auto json = to_json(state);
  REQUIRE(json.at("high_alive") == false);
  REQUIRE(json.at("channels").size() == kOtherChannels);
  REQUIRE(json.at("devices").size() == kDeviceCount);
  REQUIRE(json.at("channels")[1].at("name") == "attitude");
  REQUIRE(json.at("channels")[1].at("stale") == false);
  REQUIRE(json.at("tasks").size() == kTaskCount);
  REQUIRE(json.at("tasks")[0].at("steps").is_null());
  REQUIRE(json.at("tasks")[1].at("fifo_priority") == 60);
  REQUIRE(json.at("tasks")[1].at("refused") == 7);
  REQUIRE(json.at("tasks")[1].at("late_p99_us") == Approx(64.0));
  REQUIRE(json.at("tasks")[1].at("worst_late_ns") == 800'000);
}

TEST_CASE("watch: a device is shown with its status, and since when", "[cli]") {
  Boat boat;
  Writer<DeviceHealth> heading{boat.board->device_health[0], Role::kLow, "heading"};
  Writer<DeviceHealth> position{boat.board->device_health[2], Role::kLow, "position"};
  heading.publish({DeviceStatus::kDisconnected, DeviceFault::kUnplugged, kStart, 17, 2, 1, 3},
                  kStart);
  position.publish({DeviceStatus::kAbsent, DeviceFault::kNone, kStart, 0, 0, 0, 0}, kStart);
  BoardWatch watch{*boat.board};
  watch.poll(kStart + std::chrono::seconds{2});
  const SegmentState state{"lodesman-x", true, true, watch.state()};
  std::string all;
  for (const std::string& line : table_lines(state, false)) {
    REQUIRE(line.size() <= 80);
    all += line + "\n";
  }
  REQUIRE(
      all.find("\n! heading     disconnected       2.0         17        2        1        3\n") !=
      std::string::npos);
  REQUIRE(all.find("\n! sonar       not told of\n") != std::string::npos);
  REQUIRE(all.find("\n  position    absent ") != std::string::npos);
  REQUIRE(to_json(state).at("devices").at(0).at("status") == "disconnected");
}

TEST_CASE("watch: the segment is the one named, or the only one", "[cli]") {
  REQUIRE(choose_segment("/dev/shm/lodesman-a", {}, {}) == "lodesman-a");
  REQUIRE(choose_segment("", {"lodesman-a"}, {}) == "lodesman-a");
  REQUIRE(choose_segment("", {"lodesman-a", "lodesman-b"}, {"lodesman-b"}) == "lodesman-b");
  REQUIRE_THROWS_WITH(choose_segment("", {}, {}),
                      "--segment: there is no /dev/shm/lodesman*: is lodesman-low running?");
  REQUIRE_THROWS_WITH(choose_segment("", {"lodesman-a", "lodesman-b"}, {}),
                      "--segment: name one of lodesman-a, lodesman-b (none is alive)");

  const TextFile file{"lodesman-z", ""};
  REQUIRE(segments_in(file.path().parent_path()) == std::vector<std::string>{"lodesman-z"});
  REQUIRE(segments_in("/nowhere").empty());
}

}  // namespace
}  // namespace lodesman::testing
