// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/boat_json.h"

#include <algorithm>

#include "deploy/operator/console/json_values.h"
#include "deploy/operator/console/schemas.h"
#include "mid_level/base/heading.h"
#include "mid_level/geometry/moving_obstacle.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman::console {
namespace {

void take_in(std::optional<double>& least, double distance_m) {
  least = least ? std::min(*least, distance_m) : distance_m;
}

// Where it steers to: its course, or the way to the waypoint that it makes for.
[[nodiscard]] Json heading_ref(const BoardPicture& picture) {
  if (picture.helm == nullptr || picture.state == nullptr ||
      picture.helm->value.reason != HelmReason::kTracking) {
    return nullptr;
  }
  if (picture.plan != nullptr && picture.plan->value.steer_by == SteerBy::kCourse) {
    return value_of(compass_deg(picture.plan->value.course_rad));
  }
  const HelmCommand& helm = picture.helm->value;
  const VehicleState& state = picture.state->value;
  return value_of(compass_deg(
      Heading::of_displacement(helm.waypoint_x_m - state.x_m, helm.waypoint_y_m - state.y_m)
          .rad()));
}

void add_pose(Json& boat, const BoardPicture& picture) {
  const bool there = picture.state != nullptr;
  const VehicleState state = there ? picture.state->value : VehicleState{};
  boat["position_m"] = there ? point_of(state.x_m, state.y_m) : Json(nullptr);
  // The newest of both: an attitude comes without a position too.
  if (picture.attitude != nullptr) {
    boat["heading_deg"] = value_of(compass_deg(picture.attitude->value.heading_rad));
  } else {
    boat["heading_deg"] = there ? value_of(compass_deg(state.heading_rad)) : Json(nullptr);
  }
  boat["heading_ref_deg"] = heading_ref(picture);
  boat["turn_rate_deg_s"] = there ? value_of(to_deg(state.yaw_rate_rad_s)) : Json(nullptr);
  boat["speed_m_s"] = there ? value_of(state.surge_m_s) : Json(nullptr);
  boat["sigma_m"] =
      there ? value_of(std::sqrt(std::max(0.0, state.position_xx_m2 + state.position_yy_m2)))
            : Json(nullptr);
}

void add_thrust(Json& boat, const BoardPicture& picture) {
  const bool there = picture.thrust != nullptr;
  const ThrustApplied thrust = there ? picture.thrust->value : ThrustApplied{};
  boat["thrust_left"] = there ? value_of(thrust_share(thrust.left)) : Json(nullptr);
  boat["thrust_right"] = there ? value_of(thrust_share(thrust.right)) : Json(nullptr);
  boat["surge_ref"] = there ? Json(thrust.surge_ref) : Json(nullptr);
  boat["head_ref"] = there ? Json(thrust.head_ref) : Json(nullptr);
}

[[nodiscard]] Json ages(const BoardPicture& picture) {
  const Time now = picture.now;
  return {{"attitude", value_of(age_of(picture.attitude, now))},
          {"position_fix", value_of(age_of(picture.fix, now))},
          {"state", value_of(age_of(picture.state, now))},
          {"sonar", value_of(age_of(picture.ping, now))},
          {"tracks", value_of(age_of(picture.tracks, now))},
          {"plan", value_of(age_of(picture.plan, now))},
          {"helm", value_of(age_of(picture.helm, now))},
          {"thrust", value_of(age_of(picture.thrust, now))}};
}

}  // namespace

double thrust_share(std::uint8_t byte) noexcept {
  constexpr double kFull = 127.0;
  constexpr int kAstern = 127;
  constexpr int kAhead = 128;
  const int value = byte;
  return value > kAhead ? (value - kAhead) / kFull
                        : (value < kAstern ? (value - kAstern) / kFull : 0.0);
}

std::optional<double> nearest_edge_m(const BoardPicture& picture) {
  std::optional<double> least;
  if (picture.state != nullptr && is_fresh(picture.tracks, picture.now, max_age::kSonarFrame)) {
    const VehicleState& state = picture.state->value;
    const Tracks& tracks = picture.tracks->value;
    for (std::uint32_t i = 0; i < tracks.count; ++i) {
      const Track& track = tracks.tracks[i];
      const double since_s = track.surely_moves() ? to_seconds(picture.now - track.last_seen) : 0.0;
      const Obstacle here =
          translated(track.shape, since_s * track.velocity_x_m_s, since_s * track.velocity_y_m_s);
      take_in(least, edge_distance_m(here, WorldPoint{{state.x_m, state.y_m}}));
    }
    return least;
  }
  if (is_fresh(picture.obstacles, picture.now, max_age::kSonarFrame)) {
    const SonarObstacles& seen = picture.obstacles->value;
    for (std::uint32_t i = 0; i < seen.count; ++i) {
      take_in(least, edge_distance_m(seen.obstacles[i], WorldPoint{}));
    }
  }
  return least;
}

Json boat_json(const BoardPicture& picture, const std::string& utc) {
  Json boat{{"time_s", seconds_of(picture.now)}, {"wall_time", nullptr}};
  if (!utc.empty()) {
    boat["wall_time"] = utc;
  }
  add_pose(boat, picture);
  add_thrust(boat, picture);
  const auto nearest_m = nearest_edge_m(picture);
  boat["inoffensive_distance_m"] = nearest_m ? value_of(*nearest_m) : Json(nullptr);
  const bool keeps_line = picture.mission != nullptr && picture.mission->value.keeps_line;
  boat["cross_track_m"] =
      keeps_line ? value_of(picture.mission->value.cross_track_m) : Json(nullptr);
  constexpr double kMillisecond_ns = 1e6;
  boat["plan_time_ms"] = picture.path != nullptr
                             ? value_of(picture.path->value.plan_time_ns / kMillisecond_ns)
                             : Json(nullptr);
  boat["seen_ahead_m"] =
      picture.plan != nullptr ? value_of(picture.plan->value.seen_ahead_m) : Json(nullptr);
  boat["ages_s"] = ages(picture);
  return boat;
}

viewer::Shape boat_shape() {
  const Json age = object_schema("lodesman.Ages", {{"attitude", number_schema("[s]")},
                                                   {"position_fix", number_schema("[s]")},
                                                   {"state", number_schema("[s] of the estimate")},
                                                   {"sonar", number_schema("[s]")},
                                                   {"tracks", number_schema("[s]")},
                                                   {"plan", number_schema("[s]")},
                                                   {"helm", number_schema("[s]")},
                                                   {"thrust", number_schema("[s]")}});
  return named_shape(
      "lodesman.Boat",
      {{"time_s", number_schema("[s] of the boat's own clock")},
       {"wall_time", text_schema("ISO 8601, UTC; null where the machine does not know it")},
       {"position_m", point_schema("[m] [world] x east, y north")},
       {"heading_deg", number_schema("[deg] clockwise from north")},
       {"heading_ref_deg", number_schema("[deg] of the course, or to the waypoint steered for")},
       {"turn_rate_deg_s", number_schema("[deg/s] clockwise positive")},
       {"speed_m_s", number_schema("[m/s] ahead through the water, estimated")},
       {"sigma_m", number_schema("[m] of the position: root of both variances")},
       {"thrust_left", number_schema("[-] -1 to 1, as applied")},
       {"thrust_right", number_schema("[-] -1 to 1, as applied")},
       {"surge_ref", number_schema("[-] -100 to 100, as applied")},
       {"head_ref", number_schema("[-] -100 to 100, as applied; positive turns right")},
       {"inoffensive_distance_m", number_schema("[m] to the nearest obstacle's edge; null: none")},
       {"cross_track_m", number_schema("[m] off the line kept to, to starboard positive")},
       {"plan_time_ms", number_schema("[ms] obstacles to path")},
       {"seen_ahead_m", number_schema("[m] of the way, where that is too little; else null")},
       {"ages_s", age}});
}

}  // namespace lodesman::console
