// SPDX-License-Identifier: Apache-2.0
#include "mid_level/config/read_mission.h"

#include "mid_level/config/read_speed_table.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

constexpr GeoPoint kPond{35.0, 139.0};

MissionDefaults defaults() { return {0.5, 0.42, LinkLost::kGoOn, from_seconds(5)}; }

MissionDefinition read(const std::string& text) {
  const LocalFrame frame{kPond};
  return read_mission_text(text, "m.toml", defaults(), &frame);
}

std::string refusal_of(const std::string& text) {
  try {
    (void)read(text);
  } catch (const StartupError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("mission file: a goal is enough, the rest comes from the configuration", "[config]") {
  const MissionDefinition mission = read("goal_m = [1.0, 20.0]");
  CHECK(mission.goal_count == 1);
  CHECK(mission.goals[0].x_m == Approx(1.0));
  CHECK(mission.goals[0].y_m == Approx(20.0));
  CHECK(mission.goal_radius_m == Approx(0.5));
  CHECK(mission.speed_m_s == Approx(0.42));
  CHECK(mission.link_lost == LinkLost::kGoOn);
  CHECK(mission.on_restart == OnRestart::kHold);
  CHECK(mission.blocked == Blocked::kHold);
  CHECK(mission.blocked_patience == from_seconds(60.0));
  CHECK(mission.area_count == 0);
}

TEST_CASE("mission file: all that it may say is taken", "[config]") {
  const MissionDefinition mission = read(R"(
[mission]
waypoints_m = [[2.0, 5.0], [3.0, 6.0]]
goal_m = [0.0, 20.0]
goal_radius_m = 1.0
speed_m_s = 0.74
legs = "line"
link_lost = "return"
link_lost_after_s = 8.0
on_restart = "resume"
blocked = "skip"
blocked_patience_s = 0.0
fence_m = [[-9, -9], [9, -9], [9, 30], [-9, 30]]
keep_out_m = [[[1, 1], [2, 1], [2, 2]], [[4, 4], [5, 4], [5, 5]]]
)");
  CHECK(mission.goal_count == 3);
  CHECK(mission.goals[1].y_m == Approx(6.0));
  CHECK(mission.speed_m_s == Approx(0.74));
  CHECK(mission.legs == Legs::kLine);
  CHECK(mission.link_lost == LinkLost::kReturn);
  CHECK(mission.link_lost_after == from_seconds(8));
  CHECK(mission.on_restart == OnRestart::kResume);
  CHECK(mission.blocked == Blocked::kSkip);
  CHECK(mission.blocked_patience == Duration{});
  REQUIRE(mission.area_count == 3);
  CHECK(mission.areas[0].kind == AreaKind::kFence);
  CHECK(mission.areas[0].corner_count == 4);
  CHECK(mission.areas[2].kind == AreaKind::kKeepOut);
  CHECK(mission.areas[2].corners[1].x_m == Approx(5.0));
}

TEST_CASE("mission file: latitude and longitude are taken into the boat's world", "[config]") {
  const MissionDefinition mission =
      read("goal_deg = [35.001, 139.0]\nwaypoints_deg = [[35.0, 139.001]]");
  CHECK(mission.goals[0].x_m == Approx(91.3).epsilon(0.01));
  CHECK(mission.goals[0].y_m == Approx(0.0).margin(0.1));
  CHECK(mission.goals[1].x_m == Approx(0.0).margin(0.1));
  CHECK(mission.goals[1].y_m == Approx(110.9).epsilon(0.01));
}

TEST_CASE("mission file: what is wrong is refused with its line", "[config]") {
  CHECK(refusal_of("speed_m_s = 0.4") == "m.toml:1: goal_m: missing");
  CHECK(refusal_of("goal_m = [0, 1]\ngoal_deg = [35.0, 139.0]") ==
        "m.toml:2: goal_deg: give either goal_m or goal_deg");
  CHECK(refusal_of("goal_deg = [35.0, 149.0]") ==
        "m.toml:1: goal_deg: is farther than 100 km from the origin of the boat's world");
  CHECK(refusal_of("goal_deg = [86.0, 139.0]").starts_with("m.toml:1: goal_deg: latitude must"));
  CHECK(refusal_of("goal_m = [0, 1]\nspead = 1") == "m.toml:2: spead: unknown key");
  CHECK(refusal_of("goal_m = [0, 1]\nkeep_out_m = [[0, 0], [1, 1], [2, 2]]") ==
        "m.toml:2: keep_out_m: encloses nothing");
  CHECK(refusal_of("goal_m = [0, 1]\nfence_m = [[0, 0], [1, 1]]")
            .starts_with("m.toml:2: fence_m: must be 3 to 31 points"));
  CHECK(refusal_of("goal_m = [0, 1]\nlink_lost = \"panic\"")
            .starts_with("m.toml:2: link_lost: must be one of"));
  CHECK(refusal_of("goal_m = [0, 1]\non_restart = \"go on\"")
            .starts_with("m.toml:2: on_restart: must be one of"));
  CHECK(refusal_of("goal_m = [0, 1]\nlegs = \"curved\"")
            .starts_with("m.toml:2: legs: must be one of"));
  CHECK(refusal_of("goal_m = [0, 1]\nblocked = \"push\"")
            .starts_with("m.toml:2: blocked: must be one of"));
  CHECK(refusal_of("goal_m = [0, 1]\nblocked_patience_s = -1.0")
            .starts_with("m.toml:2: blocked_patience_s: must be"));
  CHECK(refusal_of("goal_m = [0, inf]").starts_with("m.toml:1: goal_m"));
}

TEST_CASE("mission file: what is not done yet is refused, not taken and forgotten", "[config]") {
  CHECK(refusal_of("goal_m = [0, 1]\ncolregs = \"prefer\"") ==
        "m.toml:2: colregs: only \"off\" is done yet");
  CHECK(refusal_of("goal_m = [0, 1]\nbattery_low = \"return\"") ==
        "m.toml:2: battery_low: is not done yet: leave it out");
}

TEST_CASE("speed table: read in rising order, else refused with its line", "[config]") {
  const auto read_table = [](const std::string& points) {
    return read_speed_table(TomlDocument::from_text("speed_table = " + points, "v.toml").root());
  };
  CHECK(read_table("[[10, 0.1], [100, 1.0]]").speed_m_s(55) == Approx(0.55));
  for (const char* wrong : {"[]", "[[10, 0.1], [10, 0.2]]", "[[10, 0.1], [20, 0.1]]", "[[0, 0.1]]",
                            "[[10, 0.0]]", "[[101, 1.0]]", "[[10, 11.0]]", "3"}) {
    INFO(wrong);
    CHECK_THROWS_AS(read_table(wrong), StartupError);
  }
}

TEST_CASE("mission: degrees are refused until the world's origin is known, metres are not",
          "[mid_level][config]") {
  const LocalFrame unknown;
  const auto refused = [&](const char* text) {
    try {
      (void)read_mission_text(text, "m.toml", defaults(), &unknown);
    } catch (const StartupError& error) {
      return std::string{error.what()};
    }
    return std::string{};
  };
  const std::string why = ": the origin of the boat's world is not fixed yet: no good fix has come";
  CHECK(refused("goal_deg = [35.0, 139.0]") == "m.toml:1: goal_deg" + why);
  CHECK(refused("goal_m = [0.0, 9.0]\nwaypoints_deg = [[35.0, 139.0]]") ==
        "m.toml:2: waypoints_deg" + why);
  CHECK(refused("goal_m = [0.0, 9.0]").empty());
}
