// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/watched_recording.h"

#include <memory>

#include "mid_level/base/startup_error.h"
#include "mid_level/recording/raw_codec.h"
#include "mid_level/recording/recording.h"
#include "tests/support/catch.h"
#include "tests/unit/report/temporary_directory.h"

using namespace lodesman;
using namespace lodesman::cli;
using lodesman::testing::TemporaryDirectory;

namespace {

[[nodiscard]] Time s(double seconds) { return Time{from_seconds(seconds)}; }

// A boat's recording that the test writes by hand: nobody tells it the truth.
class Written {
 public:
  explicit Written(const std::filesystem::path& file)
      : recording_{std::make_unique<DiskFile>(file),
                   {"test",
                    {},
                    {{"config.toml", load_configuration("default", CommonOptions{}).to_text()}}},
                   Time{}} {}

  template <class M>
  void add(const std::string& channel, const M& message, Time stamp) {
    const auto channels = raw_channels();
    std::vector<std::byte> raw(used_bytes(message));
    encode_raw(message, raw);
    for (std::uint32_t i = 0; i < channels.size(); ++i) {
      if (channels[i].name == channel) {
        recording_.add(Publication{i, static_cast<std::uint32_t>(raw.size()), stamp, ++sequence_},
                       raw);
      }
    }
  }

  void status(MissionState state, std::uint64_t mission, Time started, Time now) {
    MissionStatus status;
    status.state = state;
    status.mission = mission;
    status.first_started = s(50);
    status.started = started;
    status.ended = state == MissionState::kUnderWay ? Time{} : now;
    status.goal_y_m = 10.0;
    add("mission_status", status, now);
  }
  // Northwards at 1 m/s, from 0.1 s after `from` on.
  void sail(Time from, Time to) {
    for (Time now = from + from_seconds(0.1); now < to; now += from_seconds(0.02)) {
      VehicleState state;
      state.valid_at = now;
      state.y_m = to_seconds(now - from);
      add("vehicle_state", state, now);
    }
  }
  void finish() { REQUIRE(recording_.finish() == 0); }

 private:
  Recording recording_;
  std::uint64_t sequence_ = 0;
};

// It begins when one mission is over; then mission 5, started twice, and 6 in the middle of it.
[[nodiscard]] std::filesystem::path a_day(const TemporaryDirectory& directory) {
  const std::filesystem::path file = directory.path() / "day.mcap";
  Written day{file};
  day.add("world_origin", WorldOrigin{48.5, -7.5}, s(40));
  day.status(MissionState::kReached, 4, s(50), s(90));
  day.status(MissionState::kUnderWay, 5, s(100), s(100));
  day.sail(s(100), s(104));
  day.status(MissionState::kAborted, 5, s(100), s(104));
  day.status(MissionState::kUnderWay, 5, s(200), s(200));
  day.sail(s(200), s(206));
  day.status(MissionState::kUnderWay, 6, s(206), s(206));
  day.sail(s(206), s(214));
  day.status(MissionState::kReached, 6, s(206), s(214));
  day.finish();
  return file;
}

}  // namespace

TEST_CASE("watched recording: each start is a run of its own, with times from its start", "[run]") {
  const TemporaryDirectory directory;
  const std::vector<std::filesystem::path> files{a_day(directory)};
  const RecordedBoat boat = recorded_boat(files);
  CHECK_FALSE(boat.has_truth);
  REQUIRE(boat.missions.size() == 3);
  const auto watched = [&](std::size_t mission) {
    WatchedRecording run{files, boat, mission, [] { return false; }, {}};
    WatchedRun shown = watch_recording(run);
    CHECK(shown.lacks.empty());
    return shown.record;
  };
  const RunRecord first = watched(0);
  CHECK(first.result.outcome == "aborted");
  CHECK(first.result.time_s == Approx(4.0));
  CHECK(first.result.path_length_m == Approx(3.9).margin(0.1));
  CHECK(first.result.origin_deg.has_value());
  REQUIRE(first.trajectory.size() > 30);
  CHECK(first.trajectory.size() < 42);  // ten a second
  CHECK(first.trajectory.front().t_s == Approx(0.1));
  // Another start ends it, and nothing else did.
  const RunRecord second = watched(1);
  CHECK(second.result.outcome == "time_limit");
  CHECK(second.result.time_s == Approx(6.0).margin(0.1));
  const RunRecord third = watched(2);
  CHECK(third.result.reached);
  CHECK(third.result.time_s == Approx(8.0));
  CHECK(third.trajectory.back().y_m == Approx(8.0).margin(0.15));
}

TEST_CASE("watched recording: a file without a configuration is none of a boat's", "[run]") {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "other.mcap";
  Recording recording{std::make_unique<DiskFile>(file), {}, Time{}};
  REQUIRE(recording.finish() == 0);
  CHECK_THROWS_AS(recorded_boat({file}), StartupError);
}
