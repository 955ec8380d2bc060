// SPDX-License-Identifier: Apache-2.0
// Numbers and points as they stand in the console's JSON: rounded to what can be seen, null where
// they are none. Pure functions; any thread.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "high_level/mission/command_line.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/obstacle.h"
#include "mid_level/recording/viewer_json.h"

namespace lodesman::console {

using viewer::Json;

// To a thousandth; null where it is no number, or without end.
[[nodiscard]] inline Json value_of(double number) {
  constexpr double kMost = 1e12;
  return std::abs(number) < kMost ? Json(std::round(number * 1000.0) / 1000.0 + 0.0)
                                  : Json(nullptr);
}
[[nodiscard]] inline Json value_of(const std::optional<Duration>& age) {
  return age ? value_of(to_seconds(*age)) : Json(nullptr);
}
[[nodiscard]] inline Json seconds_of(Time time) {
  return value_of(to_seconds(time.time_since_epoch()));
}
[[nodiscard]] inline Json point_of(double x_m, double y_m) {
  return Json::array({value_of(x_m), value_of(y_m)});
}

[[nodiscard]] inline Json scope_word(Scope scope) {
  switch (scope) {
    case Scope::kCommand: return "command";
    case Scope::kAbort: return "abort";
    case Scope::kView: return "view";
    case Scope::kNone: break;
  }
  return nullptr;
}

// Of anything that has x_m and y_m.
template <class Points>
[[nodiscard]] Json points_of(const Points& points, std::size_t count) {
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    list.push_back(point_of(points[i].x_m, points[i].y_m));
  }
  return list;
}
template <class Points>
[[nodiscard]] Json points_of(const Points& points) {
  return points_of(points, points.size());
}

// Of bytes that may be anything; discarded (is_discarded()) where they are no JSON. What is nested
// deeper than is sensible is left out, so that no work on it needs more stack than there is.
[[nodiscard]] inline Json parsed(std::string_view text) {
  constexpr int kMostDepth = 16;
  return Json::parse(
      text,
      [](int depth, Json::parse_event_t /*event*/, Json& /*value*/) { return depth <= kMostDepth; },
      false);
}

[[nodiscard]] inline std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lodesman::console
