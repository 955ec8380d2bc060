// SPDX-License-Identifier: Apache-2.0
// Decisions made again from recordings in which something is otherwise: it is found where it was
// changed, and what cannot be judged is said.
#include <cstring>
#include <fstream>
#include <random>

#include "mid_level/base/startup_error.h"
#include "mid_level/recording/raw_codec.h"
#include "tests/support/rewritten_recording.h"
#include "tests/system/replayed.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

constexpr std::uint32_t kInTheMiddle = 400;  // a number that each channel in question comes to

}  // namespace

TEST_CASE("replay: one parameter that is changed shows in the first decision that goes by it",
          "[system][plain]") {
  const Scratch scratch{"replay"};
  const fs::path paper = sailed(scratch, "paper-static", "paper");

  // One that may be tuned under way, and stands in the recording as it was: control.
  const ReplayResult gain = replayed(paper, {"control.heading_gain_per_deg=7.0"});
  REQUIRE(gain.first() != nullptr);
  CHECK(gain.first()->channel == "helm_command");
  CHECK(gain.first()->field.path == "head_ref");
  CHECK(gain.differing() == of(gain, TaskId::kController).differing);

  // Planning, and nothing before or after it.
  const ReplayResult interval = replayed(paper, {"planner.waypoint_interval_m=2.0"});
  REQUIRE(interval.first() != nullptr);
  CHECK(interval.first()->channel == "plan");
  CHECK(interval.first()->field.path.starts_with("waypoint"));
  CHECK(interval.differing() == of(interval, TaskId::kPlanner).differing);

  // Perception: the zones that are made for what is seen.
  const fs::path file = sailed(scratch, "paper-static", "default");
  const ReplayResult zones = replayed(file, {"zones.hull_radius_m=1.7"});
  REQUIRE(zones.first() != nullptr);
  CHECK(zones.first()->channel == "sonar_obstacles");
  CHECK(zones.first()->sequence == 1);
  CHECK(zones.first()->field.path == "obstacles[0].protection_first_m");
  CHECK(of(zones, TaskId::kController).differing == 0);
  CHECK(of(zones, TaskId::kEstimator).differing == 0);

  // Estimation.
  const ReplayResult current = replayed(file, {"estimator.current_time_s=0.0"});
  REQUIRE(current.first() != nullptr);
  CHECK(current.first()->channel == "vehicle_state");
  CHECK(current.differing() == of(current, TaskId::kEstimator).differing);

  // Of what no decision goes by, none differs.
  check_that_none_differs(replayed(file, {"boat.name=another"}));
  CHECK_THROWS_AS(replayed(file, {"control.no_such_key=1"}), StartupError);
  CHECK_THROWS_AS(replayed(file, {"no equals sign"}), StartupError);
}

TEST_CASE("replay: one field of one publication that is changed is found there and nowhere else",
          "[system][plain]") {
  const Scratch scratch{"replay"};
  const fs::path file = sailed(scratch, "paper-static", "default");
  const fs::path changed = scratch.file("changed.mcap");
  rewrite_recording(file, changed, [](RewrittenMessage& message) {
    if (message.topic == "raw/helm_command" && message.head.sequence == kInTheMiddle) {
      HelmCommand helm;
      REQUIRE(decode_raw(message.data, helm));
      helm.head_ref += 1;
      encode_raw(helm, message.data);
    }
    return true;
  });
  const ReplayResult result = replayed(changed);
  CHECK(result.differing() == 1);
  REQUIRE(result.first() != nullptr);
  CHECK(result.first()->channel == "helm_command");
  CHECK(result.first()->sequence == kInTheMiddle);
  CHECK(result.first()->field.path == "head_ref");
  CHECK(result.not_judged() == 0);
}

TEST_CASE("replay: what a task saw and is not in the recording is said, and not judged",
          "[system][plain]") {
  const Scratch scratch{"replay"};
  const fs::path file = sailed(scratch, "paper-static", "default");
  const fs::path lacking = scratch.file("lacking.mcap");
  rewrite_recording(file, lacking, [](RewrittenMessage& message) {
    return message.topic != "raw/vehicle_state" || message.head.sequence != kInTheMiddle;
  });
  const ReplayResult result = replayed(lacking);
  CHECK(result.differing() == 0);
  const auto gaps = [&](TaskId task) {
    return of(result, task).not_judged[static_cast<std::size_t>(Doubt::kGap)];
  };
  for (const TaskId task : {TaskId::kDeltaT, TaskId::kPlanner, TaskId::kController}) {
    INFO(to_string(task));
    CHECK(gaps(task) > 0);
    CHECK(of(result, task).judged > gaps(task));  // it is judged again later
  }
  CHECK(gaps(TaskId::kPathFinder) == 0);
  // The estimator's own publication is missing, and no input of it.
  CHECK(of(result, TaskId::kEstimator).not_judged_in_all() == 1);

  // Of a channel's beginning, which a recorder that came a moment late has not.
  constexpr std::uint64_t kFirstKept = 5;
  rewrite_recording(file, lacking, [](RewrittenMessage& message) {
    return message.topic != "raw/vehicle_state" || message.head.sequence >= kFirstKept;
  });
  const ReplayResult headless = replayed(lacking);
  CHECK(headless.differing() == 0);
  CHECK(of(headless, TaskId::kEstimator).not_judged_in_all() == kFirstKept - 1);

  // A channel that falls silent while its task goes on is no gap.
  rewrite_recording(file, lacking, [](RewrittenMessage& message) {
    return message.topic != "raw/helm_command" || message.head.sequence < kInTheMiddle;
  });
  CHECK(of(replayed(lacking), TaskId::kController).differing > 0);

  // Nor is a task agreed with of which no step is recorded.
  rewrite_recording(file, lacking, [](RewrittenMessage& message) {
    return message.topic != "raw/planner_inputs";
  });
  const ReplayResult stepless = replayed(lacking);
  CHECK(of(stepless, TaskId::kPlanner).judged == 0);
  CHECK(of(stepless, TaskId::kPlanner).not_judged_in_all() > 0);

  // Without what steps saw nothing can be judged, nor is.
  rewrite_recording(file, lacking, [](RewrittenMessage& message) {
    return message.topic.find("_inputs") == std::string::npos;
  });
  const ReplayResult blind = replayed(lacking);
  CHECK(blind.judged() == 0);
  CHECK(blind.differing() == 0);
}

TEST_CASE("replay: of the first and the last ping a recorder may have but what was made of it",
          "[system][plain]") {
  const Scratch scratch{"replay"};
  const fs::path file = sailed(scratch, "paper-static", "default");
  std::uint32_t last_ping = 0;
  rewrite_recording(file, scratch.file("whole.mcap"), [&](RewrittenMessage& message) {
    last_ping = message.topic == "raw/sonar_ping" ? message.head.sequence : last_ping;
    return true;
  });
  const auto without_pings = [&](auto lacks) {
    const fs::path lacking = scratch.file("lacking.mcap");
    rewrite_recording(file, lacking, [&](RewrittenMessage& message) {
      return message.topic != "raw/sonar_ping" || !lacks(message.head.sequence);
    });
    const ReplayResult result = replayed(lacking);
    CHECK(result.differing() == 0);
    CHECK(of(result, TaskId::kDeltaT).judged > 100);
    const std::uint64_t gaps =
        of(result, TaskId::kDeltaT).not_judged[static_cast<std::size_t>(Doubt::kGap)];
    CHECK(result.not_judged() == gaps);
    return gaps;
  };
  // One that began late: its task is judged once it has agreed for a while.
  CHECK(without_pings([](std::uint32_t number) { return number < 3; }) > 0);
  // One that ends looks at one channel after the other.
  const std::uint64_t at_end =
      without_pings([&](std::uint32_t number) { return number == last_ping; });
  CHECK(at_end > 0);
  CHECK(at_end < 5);
}

TEST_CASE("replay: where the recording begins late, tasks count from when they agree",
          "[system][plain]") {
  const Scratch scratch{"replay"};
  const fs::path file = sailed(scratch, "paper-static", "default");
  const fs::path late = scratch.file("late.mcap");
  constexpr std::uint64_t kBegin_ns = 20'000'000'000;
  rewrite_recording(file, late, [](RewrittenMessage& message) {
    return message.head.publish_time_ns >= kBegin_ns || message.topic == "raw/tunables" ||
           message.topic == "raw/mission_definition" || message.topic == "raw/world_origin";
  });
  const ReplayResult result = replayed(late);
  CHECK(result.differing() == 0);
  for (const TaskId task : {TaskId::kDeltaT, TaskId::kPathFinder, TaskId::kController}) {
    INFO(to_string(task));
    CHECK(of(result, task).not_judged[static_cast<std::size_t>(Doubt::kBeginning)] > 0);
    REQUIRE(of(result, task).judged > 0);
    CHECK(*of(result, task).judged_from >= Time{seconds{30}});
  }
}

TEST_CASE("replay: a file that is cut off is judged to where it goes, and said", "[system]") {
  const Scratch scratch{"replay"};
  const fs::path file = sailed(scratch, "paper-static", "default");
  const fs::path cut = scratch.file("cut.mcap.part");
  fs::copy_file(file, cut);
  fs::resize_file(cut, fs::file_size(file) / 2);
  const ReplayResult result = replayed(cut);
  CHECK(result.differing() == 0);
  CHECK(result.judged() > 1000);
  CHECK(result.lacks.size() == 1);
}

TEST_CASE("replay: whatever bytes publications are made of, it comes to an end", "[system]") {
  const Scratch scratch{"replay"};
  const fs::path file = sailed(scratch, "paper-static", "default", {}, 15.0);
  const fs::path forged = scratch.file("forged.mcap");
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random{seed};
    rewrite_recording(file, forged, [&](RewrittenMessage& message) {
      const auto dice = random() % 100;
      if (dice < 2 && !message.data.empty()) {
        message.data[random() % message.data.size()] = static_cast<std::byte>(random());
      } else if (dice == 2) {
        message.head.sequence = static_cast<std::uint32_t>(random());
      } else if (dice == 3) {
        message.head.publish_time_ns = (std::uint64_t{random()} << 32U) | random();
      }
      return dice != 4;
    });
    const ReplayResult result = replayed(forged);
    CHECK(result.judged() + result.not_judged() > 0);
  }
  std::ofstream{forged, std::ios::binary} << "not at all";
  CHECK_THROWS_AS(replayed(forged), StartupError);
  CHECK_THROWS_AS(replayed(scratch.file("missing.mcap")), StartupError);
}
