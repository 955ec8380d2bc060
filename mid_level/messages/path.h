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

namespace lodesman {

inline constexpr std::size_t kMaxPathPixels = 16384;

// "A path to this goal, please." Written by the planner task; read by PathFinder.
struct PathRequest {
  std::uint64_t id = 0;     // [-] counts up by one a request
  std::uint64_t frame = 0;  // [-] the sonar frame to plan in (SonarObstacles::frame)
  double goal_x_m = 0.0;    // [m] [vehicle] the goal at that frame's capture time
  double goal_y_m = 0.0;    // [m] [vehicle]

  static constexpr auto fields() noexcept {
    using P = PathRequest;
    return std::tuple{field("id", &P::id), field("frame", &P::frame),
                      field("goal_x_m", &P::goal_x_m), field("goal_y_m", &P::goal_y_m)};
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
};
inline constexpr std::size_t kPathReasonCount = 7;
// The reason as the contract spells it: "found", "no_path", ...
[[nodiscard]] const char* to_string(PathReason reason) noexcept;

struct PathPixel {
  std::int16_t column = 0;  // [px] [0, 865] of the sonar view
  std::int16_t row = 0;     // [px] [0, 499]

  static constexpr auto fields() noexcept {
    return std::tuple{field("column", &PathPixel::column), field("row", &PathPixel::row)};
  }
};

// The answer to one PathRequest: every pixel of the path in the sonar view, start first. Written
// by the PathFinder task; read by the planner and displays.
struct SonarPath {
  std::uint64_t request = 0;  // [-] PathRequest::id
  std::uint64_t frame = 0;    // [-] SonarObstacles::frame it was planned in
  Time captured{};            // [ns] capture time of that frame
  PathReason reason = PathReason::kNoPath;
  std::int32_t cost_10_14 = 0;     // [-] 10 a straight and 14 a diagonal step; 0 where not found
  std::uint32_t expansions = 0;    // [-] nodes taken from the open list
  std::uint32_t plan_time_ns = 0;  // [ns] obstacle list to path, measured: not in the hash
  std::uint32_t pixel_count = 0;   // [-] [0, kMaxPathPixels]
  std::array<PathPixel, kMaxPathPixels> pixels{};

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(SonarPath, pixels) +
           std::min<std::size_t>(pixel_count, kMaxPathPixels) * sizeof(PathPixel);
  }

  static constexpr auto fields() noexcept {
    using P = SonarPath;
    return std::tuple{field("request", &P::request),
                      field("frame", &P::frame),
                      field("captured", &P::captured),
                      field("reason", &P::reason),
                      field("cost_10_14", &P::cost_10_14),
                      field("expansions", &P::expansions),
                      measured_field("plan_time_ns", &P::plan_time_ns),
                      field("pixel_count", &P::pixel_count),
                      field("pixels", &P::pixels, &P::pixel_count)};
  }
};

}  // namespace lodesman
