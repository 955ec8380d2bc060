// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/sonar_json.h"

#include <algorithm>

#include "deploy/operator/console/json_values.h"
#include "deploy/operator/console/outlines.h"
#include "deploy/operator/console/schemas.h"
#include "mid_level/base/frames.h"

namespace lodesman::console {
namespace {

[[nodiscard]] VehiclePose pose_in(const BoardPicture& picture) {
  const VehicleState& state = picture.state->value;
  return {WorldPoint{{state.x_m, state.y_m}}, Heading::clockwise_from_y_rad(state.heading_rad)};
}

template <class Points>
[[nodiscard]] Json in_vehicle(const VehiclePose& pose, const Points& points, std::size_t count) {
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const VehiclePoint there = pose.to_vehicle(WorldPoint{{points[i].x_m, points[i].y_m}});
    list.push_back(point_of(there.xy_m.x(), there.xy_m.y()));
  }
  return list;
}

[[nodiscard]] Json detections_of(const BoardPicture& picture) {
  Json list = Json::array();
  if (picture.obstacles != nullptr) {
    const SonarObstacles& seen = picture.obstacles->value;
    for (std::uint32_t i = 0; i < seen.count; ++i) {
      list.push_back({{"outline_m", points_of(outline_of(seen.obstacles[i]))}});
    }
  }
  return list;
}

[[nodiscard]] Json tracks_of(const BoardPicture& picture, const VehiclePose& pose) {
  Json list = Json::array();
  if (picture.tracks != nullptr) {
    const Tracks& tracks = picture.tracks->value;
    for (std::uint32_t i = 0; i < tracks.count; ++i) {
      const auto outline = outline_of(tracks.tracks[i].shape);
      list.push_back(
          {{"id", tracks.tracks[i].id}, {"outline_m", in_vehicle(pose, outline, outline.size())}});
    }
  }
  return list;
}

}  // namespace

Json sonar_json(const BoardPicture& picture, double min_range_m, SonarPicture& drawer) {
  const SonarPing& ping = picture.ping->value;
  const std::vector<unsigned char> jpeg = drawer.jpeg_of(ping);
  Json sonar{{"time_s", seconds_of(ping.captured)},
             {"range_m", value_of(ping.range_m)},
             {"min_range_m", value_of(std::min(min_range_m, ping.range_m))},
             {"sector_deg", value_of(to_deg(ping.sector_rad))},
             {"image", jpeg.empty() ? Json(nullptr) : Json(viewer::base64(jpeg))},
             {"format", "jpeg"},
             {"columns", SonarPicture::kColumns},
             {"rows", SonarPicture::kRows},
             {"pose", nullptr},
             {"detections", detections_of(picture)},
             {"path_m", Json::array()},
             {"tracks", Json::array()}};
  if (picture.state != nullptr) {
    const VehicleState& state = picture.state->value;
    sonar["pose"] = {{"position_m", point_of(state.x_m, state.y_m)},
                     {"heading_deg", value_of(compass_deg(state.heading_rad))}};
    const VehiclePose pose = pose_in(picture);
    sonar["tracks"] = tracks_of(picture, pose);
    if (picture.plan != nullptr) {
      sonar["path_m"] =
          in_vehicle(pose, picture.plan->value.waypoints, picture.plan->value.waypoint_count);
    }
  }
  return sonar;
}

viewer::Shape sonar_shape() {
  Json image = text_schema(
      "a JPEG of `columns` by `rows` px: the sonar's head in the middle of the lowest row, ahead "
      "is up, the range is `rows`");
  image["contentEncoding"] = "base64";
  const Json outline = points_schema("[m] [vehicle] x to starboard, y ahead; closed");
  return named_shape(
      "lodesman.Sonar",
      {{"time_s", number_schema("[s] of the ping, by the boat's own clock")},
       {"range_m", number_schema("[m]")},
       {"min_range_m", number_schema("[m] nearer than that nothing is heard")},
       {"sector_deg", number_schema("[deg] that all beams cover")},
       {"image", image},
       {"format", text_schema("of the image")},
       {"columns", number_schema("[px]")},
       {"rows", number_schema("[px]")},
       {"pose", object_schema("lodesman.Pose",
                              {{"position_m", point_schema("[m] [world]")},
                               {"heading_deg", number_schema("[deg] clockwise from north")}})},
       {"detections", list_schema("found in the ping",
                                  object_schema("lodesman.Detection", {{"outline_m", outline}}))},
       {"path_m", points_schema("[m] [vehicle] waypoints of the plan")},
       {"tracks", list_schema("what is tracked",
                              object_schema("lodesman.SonarTrack", {{"id", number_schema("[-]")},
                                                                    {"outline_m", outline}}))}});
}

}  // namespace lodesman::console
