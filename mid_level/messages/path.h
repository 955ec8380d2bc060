// SPDX-License-Identifier: Apache-2.0
// The question that the planner asks of PathFinder, and the answer.
// Plain data for the blackboard; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

inline constexpr std::size_t kMaxPathPixels = 16384;

// [m] kWorld: as far from the start, along x or y, a goal may lie.
inline constexpr double kPathReach_m = 2000.0;

// Where a path is looked for.
enum class PathSpace : std::uint8_t {
  kSonarView,  // the pixels of the sonar view (the paper): zones are those of the sonar frame
  kWorld,      // the plane round the start, in any direction: zones come with the request
};
[[nodiscard]] constexpr auto enumerators(PathSpace) noexcept {
  return enumerators_to<PathSpace::kWorld>("sonar_view", "world");
}

// A zone to keep out of.
struct PathZone {
  Obstacle shape{};     // [world] with its protection zone
  double give_m = 0.0;  // [m] >= 0 what of the zone may be given up where there is no way otherwise
  bool may_keep_to_port = true;       // a path may bend round it with it on the port side ...
  bool may_keep_to_starboard = true;  // ... or on the starboard side

  static constexpr auto fields() noexcept {
    using Z = PathZone;
    return field_list(field("shape", &Z::shape), field("give_m", &Z::give_m).within(0.0, 1e6),
                      field("may_keep_to_port", &Z::may_keep_to_port),
                      field("may_keep_to_starboard", &Z::may_keep_to_starboard));
  }
};

// "A path to this goal, please." Written by the planner task; read by PathFinder.
struct PathRequest {
  std::uint64_t id = 0;     // [-] counts up by one a request
  std::uint64_t frame = 0;  // [-] the sonar frame to plan in (SonarObstacles::frame)
  PathSpace space = PathSpace::kSonarView;
  double goal_x_m = 0.0;  // [m] kSonarView: [vehicle] at that frame's capture time; kWorld: [world]
  double goal_y_m = 0.0;  // [m]
  double start_x_m = 0.0;  // [m] [world] kWorld only
  double start_y_m = 0.0;  // [m] [world]
  // [m] a path that passes zones on other sides than asked for must be shorter by this. kWorld only
  double side_gain_m = 0.0;
  std::uint32_t zone_count = 0;  // [-] [0, kMaxObstacles] kWorld only
  std::array<PathZone, kMaxObstacles> zones{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(PathRequest, zones) +
           std::min<std::size_t>(zone_count, kMaxObstacles) * sizeof(PathZone);
  }

  static constexpr auto fields() noexcept {
    using P = PathRequest;
    return field_list(field("id", &P::id), field("frame", &P::frame), field("space", &P::space),
                      field("goal_x_m", &P::goal_x_m), field("goal_y_m", &P::goal_y_m),
                      field("start_x_m", &P::start_x_m), field("start_y_m", &P::start_y_m),
                      field("side_gain_m", &P::side_gain_m).within(0.0, 1e6),
                      field("zone_count", &P::zone_count),
                      field("zones", &P::zones, &P::zone_count));
  }
};

enum class PathReason : std::uint8_t {
  kFound,
  kNoPath,         // start and goal are free, and nothing joins them
  kStartBlocked,   // the start lies in a protection zone
  kGoalBlocked,    // the goal lies in a protection zone
  kGoalOutOfView,  // the goal lies outside the fan
  kLimit,          // the search or the path met its bound
  kNoFrame,        // no fresh sonar frame to plan in, or PathFinder gave no answer
  kNoPosition,     // the position is lost, and with it the place of everything
  kNoHeading,      // the heading is lost
};
// As the contract spells them.
[[nodiscard]] constexpr auto enumerators(PathReason) noexcept {
  return enumerators_to<PathReason::kNoHeading>("found", "no_path", "start_blocked", "goal_blocked",
                                                "goal_out_of_view", "limit", "no_frame",
                                                "no_position", "no_heading");
}

inline constexpr std::size_t kMaxPathPoints = 512;

struct PathPoint {
  double x_m = 0.0;  // [m] [world]
  double y_m = 0.0;  // [m] [world]

  static constexpr auto fields() noexcept {
    return field_list(field("x_m", &PathPoint::x_m), field("y_m", &PathPoint::y_m));
  }
};

struct PathPixel {
  std::int16_t column = 0;  // [px] [0, 865] of the sonar view
  std::int16_t row = 0;     // [px] [0, 499]

  static constexpr auto fields() noexcept {
    return field_list(field("column", &PathPixel::column).within(0, 865),
                      field("row", &PathPixel::row).within(0, 499));
  }
};

// The answer to one PathRequest: every pixel of the path in the sonar view, start first. Written
// by the PathFinder task; read by the planner and displays.
struct SonarPath {
  std::uint64_t request = 0;  // [-] PathRequest::id
  std::uint64_t frame = 0;    // [-] SonarObstacles::frame it was planned in
  Time captured{};            // [ns] capture time of that frame
  double range_m = 0.0;       // [m] [0, 300] that frame's: the radius of the sonar view
  PathReason reason = PathReason::kNoPath;
  std::int32_t cost_10_14 = 0;   // [-] 10 a straight and 14 a diagonal step; 0 where not found
  std::uint32_t expansions = 0;  // [-] nodes taken from the open list
  // kWorld: the path as a line, start first; where none was found, to the point nearest to the
  // goal.
  double length_m = 0.0;          // [m]
  bool narrow = false;            // zones had to give what they may
  bool sides_changed = false;     // not the sides that were asked for
  std::uint32_t point_count = 0;  // [-] [0, kMaxPathPoints]
  std::array<PathPoint, kMaxPathPoints> points{};
  std::uint32_t plan_time_ns = 0;  // [ns] obstacle list to path, measured: not in the hash
  std::uint32_t pixel_count = 0;   // [-] [0, kMaxPathPixels]
  std::array<PathPixel, kMaxPathPixels> pixels{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(SonarPath, pixels) +
           std::min<std::size_t>(pixel_count, kMaxPathPixels) * sizeof(PathPixel);
  }

  static constexpr auto fields() noexcept {
    using P = SonarPath;
    return field_list(
        field("request", &P::request), field("frame", &P::frame), field("captured", &P::captured),
        field("range_m", &P::range_m).within(0.0, 350.0), field("reason", &P::reason),
        field("cost_10_14", &P::cost_10_14), field("expansions", &P::expansions),
        field("length_m", &P::length_m).within(0.0, 1e9), field("narrow", &P::narrow),
        field("sides_changed", &P::sides_changed), field("point_count", &P::point_count),
        field("points", &P::points, &P::point_count),
        measured_field("plan_time_ns", &P::plan_time_ns), field("pixel_count", &P::pixel_count),
        field("pixels", &P::pixels, &P::pixel_count));
  }
};

}  // namespace lodesman
