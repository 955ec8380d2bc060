// SPDX-License-Identifier: Apache-2.0
// What the page is told, from a small board.
#include "deploy/operator/console/boat_json.h"
#include "deploy/operator/console/json_values.h"
#include "deploy/operator/console/sonar_json.h"
#include "deploy/operator/console/story.h"
#include "deploy/operator/console/world_json.h"
#include "tests/support/catch.h"
#include "tests/unit/console/small_board.h"

using namespace lodesman;
using namespace lodesman::console;
using namespace lodesman::testing;

namespace {

// All that a message has its schema names, and the other way round.
void check_described(const Json& message, const viewer::Shape& shape) {
  for (const auto& [key, value] : message.items()) {
    INFO(key);
    CHECK(shape.schema["properties"].contains(key));
  }
  for (const auto& [key, value] : shape.schema["properties"].items()) {
    INFO(key);
    CHECK(message.contains(key));
  }
}

}  // namespace

TEST_CASE("console json: the boat, with its angles in degrees and its thrust in shares",
          "[console]") {
  SmallBoard boat;
  const Json json = boat_json(boat.look(), "2026-01-01T00:00:00.000Z");
  check_described(json, boat_shape());
  CHECK(json["time_s"] == 100.0);
  CHECK(json["wall_time"] == "2026-01-01T00:00:00.000Z");
  CHECK(json["position_m"] == Json::array({10.0, 20.0}));
  CHECK(json["heading_deg"] == 90.0);
  CHECK(json["heading_ref_deg"] == 90.0);
  CHECK(json["turn_rate_deg_s"].get<double>() == Approx(5.73));
  CHECK(json["sigma_m"] == 0.5);
  CHECK(json["thrust_left"] == 1.0);
  CHECK(json["thrust_right"] == -1.0);
  CHECK(json["inoffensive_distance_m"] == 5.0);
  CHECK(json["cross_track_m"].is_null());
  CHECK(json["seen_ahead_m"].is_null());  // enough of it
  CHECK(json["ages_s"]["attitude"] == 0.02);
  CHECK(json["ages_s"]["sonar"].is_null());
}

TEST_CASE("console json: of a boat that says nothing all is null", "[console]") {
  const auto board = std::make_unique<Blackboard>();
  BoardReaders readers{*board};
  const BoardPicture picture = readers.look(SmallBoard::kNow);
  const Json boat = boat_json(picture, "");
  check_described(boat, boat_shape());
  for (const auto& [key, value] : boat.items()) {
    INFO(key);
    CHECK((key == "time_s" || key == "ages_s" || value.is_null()));
  }
  const Json world = world_json(picture, {2.0, 1.2});
  check_described(world, world_shape());
  CHECK(world["obstacles"].empty());
  CHECK(world["goal_m"].is_null());
  CHECK_FALSE(what_it_does(picture, "").empty());
}

TEST_CASE("console json: thrust is nothing at 127 and 128, and full at both ends", "[console]") {
  CHECK(thrust_share(127) == Approx(0.0));
  CHECK(thrust_share(128) == Approx(0.0));
  CHECK(thrust_share(0) == Approx(-1.0));
  CHECK(thrust_share(255) == Approx(1.0));
  CHECK(thrust_share(129) > 0.0);
  CHECK(thrust_share(126) < 0.0);
}

TEST_CASE("console json: the world has mission, areas, plans and what moves", "[console]") {
  SmallBoard boat;
  static_cast<void>(boat.look());
  boat.publish_plan(28.0);
  const Json json = world_json(boat.look(), {2.04, 1.2});
  check_described(json, world_shape());
  CHECK(json["start_m"] == Json::array({1.0, 2.0}));
  CHECK(json["goal_m"] == Json::array({30.0, 40.0}));
  CHECK(json["goal_radius_m"] == 0.5);
  CHECK(json["mission_m"].size() == 2);
  CHECK(json["fence_m"].size() == 3);
  CHECK(json["keep_out_m"].size() == 1);
  CHECK(json["waypoints_m"][1] == Json::array({20.0, 28.0}));
  CHECK(json["previous_m"][1] == Json::array({20.0, 25.0}));
  CHECK(json["hull_m"]["width"] == 1.2);
  REQUIRE(json["obstacles"].size() == 1);
  const Json& obstacle = json["obstacles"][0];
  CHECK(obstacle["id"] == 5);
  CHECK(obstacle["outline_m"].size() == 24);
  CHECK(obstacle["zone_m"].size() == 24);
  CHECK(obstacle["moving"] == true);
  REQUIRE(obstacle["predicted_m"].size() == 6);
  CHECK(obstacle["predicted_m"][1] == Json::array({16.0, 15.0}));  // in 10 s
}

TEST_CASE("console json: where paths are found in the sonar view, zones are the frame's",
          "[console]") {
  SmallBoard boat;
  auto asked = std::make_unique<PathRequest>();
  asked->space = PathSpace::kSonarView;
  boat.request.publish(*asked, SmallBoard::kNow);
  CHECK(world_json(boat.look(), {})["obstacles"][0]["zone_m"].is_null());
  auto frame = std::make_unique<SonarObstacles>();
  frame->captured = SmallBoard::kNow;
  frame->range_m = 20.0;
  frame->count = 1;
  Obstacle& seen = frame->obstacles[0];
  seen.id = 5;
  seen.centre_y_m = 6.0;  // ahead, which is east
  seen.semi_axis_first_m = seen.semi_axis_second_m = 1.0;
  seen.protection_first_m = seen.protection_second_m = 2.0;
  boat.sonar_obstacles.publish(*frame, SmallBoard::kNow);
  const Json zone = world_json(boat.look(), {})["obstacles"][0]["zone_m"];
  REQUIRE(zone.size() == 24);
  for (const Json& point : zone) {
    CHECK(std::hypot(point[0].get<double>() - 16.0, point[1].get<double>() - 20.0) ==
          Approx(2.0).margin(0.01));
  }
}

TEST_CASE("console json: the same plan again is not the plan before", "[console]") {
  SmallBoard boat;
  static_cast<void>(boat.look());
  boat.publish_plan();
  CHECK(boat.look().previous_plan == nullptr);
}

TEST_CASE("console json: coverage is a byte a cell from the south-west", "[console]") {
  Stamped<Coverage> water;
  water.value.west_x_m = -24.0;
  water.value.south_y_m = 3.0;
  water.value.set(1, 0, WaterState::kFree);
  water.value.set(0, 1, WaterState::kOccupied);
  const Json json = coverage_json(water);
  check_described(json, coverage_shape());
  std::vector<unsigned char> cells(Coverage::kSide * Coverage::kSide);
  cells[1] = 1;
  cells[Coverage::kSide] = 2;
  CHECK(json["cells"] == viewer::base64(cells));
  CHECK(json["origin_m"] == Json::array({-24.0, 3.0}));
  CHECK(json["cell_m"] == 0.5);
}

TEST_CASE("console json: the sonar's picture, and what lies in it in the vehicle's frame",
          "[console]") {
  SmallBoard boat;
  auto ping = std::make_unique<SonarPing>();
  ping->range_m = 20.0;
  ping->captured = SmallBoard::kNow;
  ping->make_image(8, 10, 2.0);
  boat.sonar_ping.publish(*ping, SmallBoard::kNow);
  SonarPicture drawer;
  const Json json = sonar_json(boat.look(), 1.0, drawer);
  check_described(json, sonar_shape());
  CHECK(json["range_m"] == 20.0);
  CHECK(json["min_range_m"] == 1.0);
  CHECK(json["image"].get<std::string>().starts_with("/9j/"));  // a JPEG
  // Headed east, what lies 5 m east lies 5 m ahead.
  CHECK(json["path_m"][0] == Json::array({0.0, 5.0}));
  CHECK(json["tracks"][0]["id"] == 5);
}

TEST_CASE("console story: it says what the boat makes for, and what stops it", "[console]") {
  SmallBoard boat;
  CHECK(what_it_does(boat.look(), "") == "Sails to waypoint 1 of 2, 5 m away.");
  boat.publish_mission(MissionState::kHolding, MissionCause::kLinkLost);
  CHECK(what_it_does(boat.look(), "") ==
        "Stays where it is because whoever commanded is not heard any more.");
  GuardStatus guard;
  guard.state = GuardState::kBraking;
  guard.reason = GuardReason::kObstacle;
  boat.guard.publish(guard, SmallBoard::kNow);
  const std::string said = what_it_does(boat.look(), "");
  CHECK(said.starts_with("The guard keeps it from going on: something lies close ahead."));
  CHECK(what_it_does({}, "gone") == "There is no boat.");
}

TEST_CASE("console story: what a program said last is not what the boat does", "[console]") {
  SmallBoard boat;
  const std::string last = "What was said last: Sails to waypoint 1 of 2, 5 m away.";
  BoardPicture picture = boat.look();
  picture.low_alive = false;
  CHECK(what_it_does(picture, "") ==
        "Nothing drives its thrusters, as lodesman-low is not heard. " + last);
  picture.low_alive = true;
  picture.high_alive = false;
  CHECK(what_it_does(picture, "") == "Nobody steers, as lodesman-high is not heard. " + last);
  // Alive and frozen.
  CHECK(what_it_does(boat.look(SmallBoard::kNow + seconds{2}), "") ==
        "Neither of the boat's programs is heard. " + last);
  boat.thrust.publish({}, SmallBoard::kNow + seconds{2});
  CHECK(what_it_does(boat.look(SmallBoard::kNow + seconds{2}), "")
            .starts_with("Nobody steers, as lodesman-high is not heard."));
}

TEST_CASE("console story: an alarm is as grave as the mode needs what is missing", "[console]") {
  SmallBoard boat;
  const auto gravest = [&](Time now) {
    const auto alarms = alarms_of(boat.look(now), "");
    return alarms.empty() ? Alarm{} : alarms.front();
  };
  INFO(gravest(SmallBoard::kNow).text);
  CHECK(alarms_of(boat.look(), "").empty());
  CHECK(gravest(SmallBoard::kNow + seconds{5}).severity == Severity::kCritical);
  boat.publish_mission(MissionState::kIdle);
  CHECK(gravest(SmallBoard::kNow + seconds{5}).severity == Severity::kWarning);
  CHECK(alarms_of({}, "no segment").front().severity == Severity::kCritical);
}
