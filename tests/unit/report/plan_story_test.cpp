// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/plan_story.h"

#include "tests/support/catch.h"

using namespace lodesman;
using cli::PlanRecord;
using cli::PlanStory;

namespace {

PlanRecord told(double t_s, const std::string& rung, std::uint32_t cause = 0) {
  PlanRecord plan;
  plan.t_s = t_s;
  plan.captured_s = t_s - 0.15;
  plan.rung = rung;
  plan.reason = PathReason::kFound;
  plan.cause = cause;
  return plan;
}

}  // namespace

TEST_CASE("plan_story: each rung has its words", "[report]") {
  CHECK(cli::describe(told(1.25, "on_route")) ==
        "1.2 s: on the path to the goal, at full speed (plan 0.15 s old)");
  CHECK(cli::describe(told(3, "slow")) == "3.0 s: along the path, at full speed (plan 0.15 s old)");
  CHECK(cli::describe(told(3, "escape")) ==
        "3.0 s: out of the zone it is in, at full speed (plan 0.15 s old)");
  CHECK(cli::describe(told(3, "near_goal")) ==
        "3.0 s: the goal lies in a zone: to the nearest free point, at full speed (plan 0.15 s "
        "old)");
  CHECK(cli::describe(told(3, "best_point")) ==
        "3.0 s: no way to the goal: to the nearest point that can be reached, at full speed (plan "
        "0.15 s old)");
  PlanRecord blind = told(3, "nothing");
  blind.reason = PathReason::kNoFrame;
  CHECK(cli::describe(blind) == "3.0 s: nothing to follow (no_frame) (plan 0.15 s old)");
  blind.rung = "previous";
  CHECK(cli::describe(blind) == "3.0 s: along the previous waypoints (no_frame) (plan 0.15 s old)");
  blind.lost_for_s = 2.5;
  blind.rung = "hold";
  CHECK(cli::describe(blind) ==
        "3.0 s: the sonar's view is lost, last known 2.5 s ago: keeps its place and waits "
        "(no_frame)");
  blind.rung = "nothing";
  CHECK(cli::describe(blind) ==
        "3.0 s: the sonar's view is lost, last known 2.5 s ago: nothing to follow");
}

TEST_CASE("plan_story: course, speed and the obstacle it is about are named", "[report]") {
  PlanRecord plan = told(12.3, "aside", 2);
  plan.course_deg = 48.2;
  plan.speed_share = 0.5;
  plan.clearance_m = 0.308;
  plan.clearance_after_s = 8.1;
  CHECK(cli::describe(plan) ==
        "12.3 s: steers 48 deg, at 50 % speed; on the path obstacle 2, 0.31 m clear in 8 s "
        "(plan 0.15 s old)");
  PlanRecord unseen = told(4, "slow");
  unseen.speed_share = 0.4;
  unseen.seen_ahead_m = 1.25;
  CHECK(cli::describe(unseen) ==
        "4.0 s: along the path, at 40 % speed; of the way ahead 1.2 m are seen (plan 0.15 s old)");
  plan.rung = "stop";
  plan.speed_share = 0.0;
  plan.clearance_m.reset();
  CHECK(cli::describe(plan) == "12.3 s: stopped until it is clear (plan 0.15 s old)");
  plan.speed_share = -0.4;
  CHECK(cli::describe(plan) == "12.3 s: astern until it is clear (plan 0.15 s old)");
  plan.rung = "slow";
  plan.speed_share = 4.55;
  CHECK(cli::describe(plan) ==
        "12.3 s: along the path, at 4.5 times its speed, to get away (plan 0.15 s old)");
  plan.rung = "hold";
  CHECK(cli::describe(plan) == "12.3 s: keeps its place (plan 0.15 s old)");
  plan.reason = PathReason::kGoalBlocked;
  CHECK(cli::describe(plan) ==
        "12.3 s: keeps its place and waits (goal_blocked) (plan 0.15 s old)");
}

TEST_CASE("plan_story: only a change is news", "[report]") {
  PlanStory story;
  CHECK_FALSE(story.news(told(0.0, "on_route")).empty());
  CHECK(story.news(told(5.0, "on_route")).empty());
  CHECK_FALSE(story.news(told(6.0, "aside", 2)).empty());
  CHECK(story.news(told(8.0, "aside", 2)).empty());
  CHECK_FALSE(story.news(told(9.0, "aside", 3)).empty());  // about another obstacle
}

TEST_CASE("plan_story: on the path another nearest obstacle is no news", "[report]") {
  PlanStory story;
  REQUIRE_FALSE(story.news(told(0.0, "on_route", 2)).empty());
  CHECK(story.news(told(5.0, "on_route", 3)).empty());
}

TEST_CASE("plan_story: news comes no more often than once a second, and is not lost", "[report]") {
  PlanStory story;
  REQUIRE_FALSE(story.news(told(10.0, "on_route")).empty());
  CHECK(story.news(told(10.5, "aside", 2)).empty());
  CHECK_FALSE(story.news(told(11.1, "aside", 2)).empty());
  // Back before it could be told: nothing has changed.
  CHECK(story.news(told(11.5, "stop", 2)).empty());
  CHECK(story.news(told(12.5, "aside", 2)).empty());
}
