// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/world_json.h"

#include <algorithm>

#include "deploy/operator/console/json_values.h"
#include "deploy/operator/console/outlines.h"
#include "deploy/operator/console/schemas.h"
#include "mid_level/base/frames.h"
#include "mid_level/geometry/moving_obstacle.h"

namespace lodesman::console {
namespace {

constexpr double kForeseenStep_s = 5.0;
constexpr int kForeseenSteps = 6;

// Of the mission that is sailed or was last, or that waits for its start.
[[nodiscard]] const MissionDefinition* definition_of(const BoardPicture& picture) {
  if (picture.definition == nullptr) {
    return nullptr;
  }
  const bool other = picture.mission != nullptr && picture.mission->value.mission != 0 &&
                     picture.mission->value.mission != picture.definition->value.id;
  return other ? nullptr : &picture.definition->value;
}

void add_mission(Json& world, const BoardPicture& picture) {
  const MissionStatus* status = picture.mission != nullptr ? &picture.mission->value : nullptr;
  const MissionDefinition* definition = definition_of(picture);
  const bool set_out = status != nullptr && status->started != Time{};
  world["start_m"] = set_out ? point_of(status->home_x_m, status->home_y_m) : Json(nullptr);
  world["goal_m"] = nullptr;
  world["goal_radius_m"] = nullptr;
  world["mission_m"] = Json::array();
  if (definition != nullptr && definition->goal_count > 0) {
    const Goal& goal = definition->goals[definition->goal_count - 1];
    world["goal_m"] = point_of(goal.x_m, goal.y_m);
    world["goal_radius_m"] = value_of(definition->goal_radius_m);
    world["mission_m"] = points_of(definition->goals, definition->goal_count);
  } else if (set_out) {
    world["goal_m"] = point_of(status->goal_x_m, status->goal_y_m);
  }
  world["line"] = nullptr;
  if (status != nullptr && status->keeps_line) {
    world["line"] = {{"begins_m", point_of(status->line_begin_x_m, status->line_begin_y_m)},
                     {"ends_m", point_of(status->goal_x_m, status->goal_y_m)}};
  }
  world["fence_m"] = nullptr;
  world["keep_out_m"] = Json::array();
  for (std::uint32_t i = 0; definition != nullptr && i < definition->area_count; ++i) {
    const MissionArea& area = definition->areas[i];
    const Json corners = points_of(area.corners, area.corner_count);
    if (area.kind == AreaKind::kFence) {
      world["fence_m"] = corners;
    } else {
      world["keep_out_m"].push_back(corners);
    }
  }
}

// Of points in the vehicle frame.
[[nodiscard]] Json in_world(const VehicleState& state, std::vector<Vertex> points) {
  const VehiclePose pose{WorldPoint{{state.x_m, state.y_m}},
                         Heading::clockwise_from_y_rad(state.heading_rad)};
  for (Vertex& point : points) {
    const WorldPoint there = pose.to_world(VehiclePoint{{point.x_m, point.y_m}});
    point = {there.xy_m.x(), there.xy_m.y()};
  }
  return points_of(points);
}

// What the newest request for a path has round it; where paths are found in the sonar view, what
// the frame has that they are found in.
[[nodiscard]] Json zone_round(const BoardPicture& picture, std::uint32_t id) {
  if (picture.request == nullptr || id == 0) {
    return nullptr;
  }
  const PathRequest& request = picture.request->value;
  if (request.space == PathSpace::kWorld) {
    for (std::uint32_t i = 0; i < request.zone_count; ++i) {
      if (request.zones[i].shape.id == id) {
        return points_of(zone_of(request.zones[i].shape));
      }
    }
  } else if (picture.obstacles != nullptr && picture.state != nullptr) {
    const SonarObstacles& seen = picture.obstacles->value;
    for (std::uint32_t i = 0; i < seen.count; ++i) {
      if (seen.obstacles[i].id == id) {
        return in_world(picture.state->value, zone_of(seen.obstacles[i]));
      }
    }
  }
  return nullptr;
}

[[nodiscard]] Json foreseen(const Track& track) {
  if (!track.surely_moves()) {
    return Json::array();
  }
  double x_m = track.shape.centre_x_m;
  double y_m = track.shape.centre_y_m;
  if (track.shape.shape != ObstacleShape::kEllipse && track.shape.vertex_count > 0) {
    x_m = y_m = 0.0;
    for (std::uint32_t i = 0; i < track.shape.vertex_count; ++i) {
      x_m += track.shape.vertices[i].x_m / track.shape.vertex_count;
      y_m += track.shape.vertices[i].y_m / track.shape.vertex_count;
    }
  }
  Json places = Json::array();
  for (int i = 1; i <= kForeseenSteps; ++i) {
    const double ahead_s = i * kForeseenStep_s;
    places.push_back(
        point_of(x_m + ahead_s * track.velocity_x_m_s, y_m + ahead_s * track.velocity_y_m_s));
  }
  return places;
}

[[nodiscard]] Json obstacle_of(const BoardPicture& picture, const Track& track) {
  return {{"id", track.id},
          {"outline_m", points_of(outline_of(track.shape))},
          {"zone_m", zone_round(picture, track.id)},
          {"moving", track.surely_moves()},
          {"velocity_m_s", point_of(track.velocity_x_m_s, track.velocity_y_m_s)},
          {"sigma_m", value_of(std::sqrt(std::max(0.0, track.place_xx_m2 + track.place_yy_m2)))},
          {"velocity_sigma_m_s",
           value_of(std::sqrt(std::max(0.0, track.velocity_xx_m2_s2 + track.velocity_yy_m2_s2)))},
          {"predicted_m", foreseen(track)},
          {"confirmed", true},
          {"age_s", value_of(std::max(0.0, to_seconds(picture.now - track.last_seen)))}};
}

// Of a frame in the vehicle's frame, where nothing is tracked.
[[nodiscard]] Json obstacle_of(const BoardPicture& picture, const Obstacle& seen) {
  const VehicleState& state = picture.state->value;
  return {{"id", seen.id},
          {"outline_m", in_world(state, outline_of(seen))},
          {"zone_m", in_world(state, zone_of(seen))},
          {"moving", false},
          {"velocity_m_s", nullptr},
          {"sigma_m", nullptr},
          {"velocity_sigma_m_s", nullptr},
          {"predicted_m", Json::array()},
          {"confirmed", true},
          {"age_s", value_of(age_of(picture.obstacles, picture.now))}};
}

[[nodiscard]] Json obstacles_of(const BoardPicture& picture) {
  Json list = Json::array();
  if (picture.tracks != nullptr) {
    const Tracks& tracks = picture.tracks->value;
    for (std::uint32_t i = 0; i < tracks.count; ++i) {
      list.push_back(obstacle_of(picture, tracks.tracks[i]));
    }
  } else if (picture.obstacles != nullptr && picture.state != nullptr) {
    const SonarObstacles& seen = picture.obstacles->value;
    for (std::uint32_t i = 0; i < seen.count; ++i) {
      list.push_back(obstacle_of(picture, seen.obstacles[i]));
    }
  }
  return list;
}

[[nodiscard]] Json waypoints_of(const Stamped<Plan>* plan) {
  return plan != nullptr ? points_of(plan->value.waypoints, plan->value.waypoint_count)
                         : Json::array();
}

[[nodiscard]] Json obstacle_schema() {
  return object_schema(
      "lodesman.Obstacle",
      {{"id", number_schema("[-] kept as long as it is known")},
       {"outline_m", points_schema("[m] [world] closed")},
       {"zone_m", points_schema("[m] [world] closed, filled by the non-zero rule; null: none")},
       {"moving", flag_schema("faster than its doubt explains")},
       {"velocity_m_s", point_schema("[m/s] [world]")},
       {"sigma_m", number_schema("[m] of its place")},
       {"velocity_sigma_m_s", number_schema("[m/s]")},
       {"predicted_m", points_schema("[m] [world] in 5, 10, ... 30 s, of what moves")},
       {"confirmed", flag_schema("what is published as a track is")},
       {"age_s", number_schema("[s] since its shape was placed")}});
}

}  // namespace

Json world_json(const BoardPicture& picture, const Hull& hull) {
  Json world{{"time_s", seconds_of(picture.now)}};
  add_mission(world, picture);
  world["waypoints_m"] = waypoints_of(picture.plan);
  world["previous_m"] = waypoints_of(picture.previous_plan);
  world["hull_m"] = {{"length", value_of(hull.length_m)}, {"width", value_of(hull.beam_m)}};
  world["obstacles"] = obstacles_of(picture);
  return world;
}

viewer::Shape world_shape() {
  const Json line = object_schema("lodesman.Line", {{"begins_m", point_schema("[m] [world]")},
                                                    {"ends_m", point_schema("[m] [world]")}});
  const Json hull = object_schema(
      "lodesman.Hull", {{"length", number_schema("[m]")}, {"width", number_schema("[m]")}});
  return named_shape("lodesman.World",
                     {{"time_s", number_schema("[s] of the boat's own clock")},
                      {"start_m", point_schema("[m] [world] where the mission set out")},
                      {"goal_m", point_schema("[m] [world] the last one")},
                      {"goal_radius_m", number_schema("[m]")},
                      {"mission_m", points_schema("[m] [world] waypoints, the goal last")},
                      {"line", line},
                      {"fence_m", points_schema("[m] [world]")},
                      {"keep_out_m", list_schema("areas", points_schema("[m] [world]"))},
                      {"waypoints_m", points_schema("[m] [world] of the plan")},
                      {"previous_m", points_schema("[m] [world] of the plan before")},
                      {"hull_m", hull},
                      {"obstacles", list_schema("what is tracked", obstacle_schema())}});
}

Json coverage_json(const Stamped<Coverage>& coverage) {
  const Coverage& water = coverage.value;
  std::vector<unsigned char> cells;
  cells.reserve(Coverage::kSide * Coverage::kSide);
  for (std::size_t row = 0; row < Coverage::kSide; ++row) {
    for (std::size_t column = 0; column < Coverage::kSide; ++column) {
      const double middle_x_m =
          water.west_x_m + (static_cast<double>(column) + 0.5) * Coverage::kCell_m;
      const double middle_y_m =
          water.south_y_m + (static_cast<double>(row) + 0.5) * Coverage::kCell_m;
      cells.push_back(static_cast<unsigned char>(water.at(middle_x_m, middle_y_m)));
    }
  }
  return {{"time_s", seconds_of(water.captured)},
          {"origin_m", point_of(water.west_x_m, water.south_y_m)},
          {"cell_m", Coverage::kCell_m},
          {"columns", Coverage::kSide},
          {"rows", Coverage::kSide},
          {"cells", viewer::base64(cells)}};
}

viewer::Shape coverage_shape() {
  Json cells = text_schema(
      "a byte a cell: 0 unknown, 1 free, 2 occupied; row after row from the south, in a row from "
      "the west");
  cells["contentEncoding"] = "base64";
  return named_shape(
      "lodesman.Coverage",
      {{"time_s", number_schema("[s] of the ping, by the boat's own clock")},
       {"origin_m", point_schema("[m] [world] the south-western corner of all")},
       {"cell_m", number_schema("[m] the side of a cell; columns go east, rows north")},
       {"columns", number_schema("[-]")},
       {"rows", number_schema("[-]")},
       {"cells", cells}});
}

}  // namespace lodesman::console
