// SPDX-License-Identifier: Apache-2.0
// The DeltaT task on profiles of a simulated scene: from a range a beam to tracks.
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "deploy/boat/level_options.h"
#include "hal_sim/sonar/detections.h"
#include "low_level/tasks/delta_t.h"
#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] MovingObstacle drifting(double x_m, double y_m, double vx_m_s, double vy_m_s) {
  MovingObstacle obstacle;
  obstacle.at_start.centre_x_m = x_m;
  obstacle.at_start.centre_y_m = y_m;
  obstacle.at_start.semi_axis_first_m = obstacle.at_start.semi_axis_second_m = 0.6;
  obstacle.velocity_x_m_s = vx_m_s;
  obstacle.velocity_y_m_s = vy_m_s;
  return obstacle;
}

[[nodiscard]] MovingObstacle quay_from(Vertex from, Vertex to) {
  MovingObstacle quay;
  quay.at_start.shape = ObstacleShape::kPolyline;
  quay.at_start.vertex_count = 2;
  quay.at_start.vertices[0] = from;
  quay.at_start.vertices[1] = to;
  return quay;
}

// A boat that sails north, with a sonar that gives profiles at 10 Hz.
class ProfileVoyage final : public ImagingSonar {
 public:
  ProfileVoyage(std::vector<MovingObstacle> obstacles, const DetectionErrors& errors,
                double speed_m_s)
      : scene_{obstacles}, detections_{obstacles.size(), errors, 1}, speed_m_s_{speed_m_s} {}

  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override {
    out.number = ++number_;
    out.captured = now;
    out.range_m = 30.0;
    out.make_profile(120, to_rad(120.0));
    scene_.observe({{{0.0, way_m()}}, {}}, time_s);
    detections_.detect(scene_, out);
    return ReadStatus::kFresh;
  }
  // The next ping, and what the task makes of it.
  const Tracks& ping() {
    time_s += 0.1;
    const Time now = kStart + from_seconds(time_s);
    VehicleState here;
    here.valid_at = now;
    here.y_m = here.odometry_y_m = way_m();
    state_.publish(here, now);
    task_.step(now);
    return tracks_.latest()->value;
  }

  double time_s = 0.0;

 private:
  [[nodiscard]] double way_m() const { return speed_m_s_ * time_s; }

  HeardScene scene_;
  Detections detections_;
  double speed_m_s_;
  std::uint64_t number_ = 0;
  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  DeltaTTask task_{
      *board_, Role::kLow, *this,
      read_low_level_options(TomlDocument::from_file(LODESMAN_DEFAULT_CONFIG).root()).delta_t};
  Writer<VehicleState> state_{board_->vehicle_state, Role::kHigh, "vehicle_state"};
  Reader<Tracks> tracks_{board_->tracks};
};

[[nodiscard]] const Track* track_at(const Tracks& tracks, const WorldPoint& at, double within_m) {
  const Track* nearest = nullptr;
  for (const Track& track : std::span{tracks.tracks}.first(tracks.count)) {
    const double off_m = edge_distance_m(track.shape, at);
    if (off_m < within_m) {
      within_m = off_m;
      nearest = &track;
    }
  }
  return nearest;
}

[[nodiscard]] int movers_in(const Tracks& tracks) {
  const auto all = std::span{tracks.tracks}.first(tracks.count);
  return static_cast<int>(std::count_if(all.begin(), all.end(), [](const Track& track) {
    return std::hypot(track.velocity_x_m_s, track.velocity_y_m_s) > 0.15;
  }));
}

TEST_CASE("delta_t task: from profiles with errors a mover is followed, and a stone stays",
          "[low_level][tasks]") {
  const std::vector<MovingObstacle> obstacles{drifting(-5.0, 12.0, 0.5, -0.1),
                                              drifting(4.0, 14.0, 0.0, 0.0),
                                              quay_from({-20.0, 25.0}, {20.0, 25.0})};
  ProfileVoyage voyage{
      obstacles, {.missed = 0.1, .split = 0.1, .displaced_m = 0.05, .noise_m = 0.03}, 0.2};
  int pings = 0;
  int followed = 0;
  int stone_lost = 0;
  int longest_lost = 0;
  std::set<std::uint32_t> ids;
  while (voyage.time_s < 14.0) {
    const Tracks& tracks = voyage.ping();
    if (voyage.time_s < 3.0) {
      continue;  // time to learn
    }
    ++pings;
    const Obstacle mover = obstacles[0].at(voyage.time_s);
    const Track* track = track_at(tracks, {{mover.centre_x_m, mover.centre_y_m}}, 0.5);
    if (track != nullptr &&
        std::hypot(track->velocity_x_m_s - 0.5, track->velocity_y_m_s + 0.1) < 0.2) {
      ++followed;
      ids.insert(track->id);
    }
    stone_lost = track_at(tracks, {{4.0, 13.6}}, 0.5) != nullptr ? 0 : stone_lost + 1;
    longest_lost = std::max(longest_lost, stone_lost);
  }
  CHECK(followed > 0.95 * pings);
  CHECK(ids.size() == 1);
  CHECK(longest_lost <= 1);  // a sonar misses it for three pings at most; two are no evidence
}

TEST_CASE("delta_t task: sailed along, a quay in profiles rests", "[low_level][tasks]") {
  ProfileVoyage voyage{
      {quay_from({5.0, -10.0}, {9.0, 60.0}), quay_from({-12.0, 4.0}, {0.0, 35.0})}, {}, 0.8};
  int moving = 0;
  while (voyage.time_s < 12.0) {
    moving += movers_in(voyage.ping());
  }
  CHECK(moving == 0);
  const Tracks& tracks = voyage.ping();
  CHECK(track_at(tracks, {{5.0 + 4.0 / 70.0 * 22.0, 12.0}}, 0.5) != nullptr);  // abeam of it now
  CHECK(track_at(tracks, {{-12.0 + 12.0 / 31.0 * 11.0, 15.0}}, 0.5) != nullptr);
}

}  // namespace
}  // namespace lodesman::testing
