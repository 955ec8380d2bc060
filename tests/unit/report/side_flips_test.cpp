// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/side_flips.h"

#include "tests/support/catch.h"
#include "tests/unit/report/sample_runs.h"

using namespace lodesman;
using cli::passing_side;
using cli::PassingSide;
using cli::PlanRecord;
using cli::side_flips;

namespace {

using Path = std::vector<std::array<double, 2>>;

PlanRecord found(double t_s, const Path& path) {
  PlanRecord plan;
  plan.t_s = t_s;
  plan.captured_s = t_s - 0.1;
  plan.start_m = path.front();
  plan.goal_m = path.back();
  plan.reason = PathReason::kFound;
  plan.path_m = path;
  return plan;
}

PlanRecord not_found(double t_s) {
  PlanRecord plan;
  plan.t_s = t_s;
  return plan;
}

const Path kLeft{{0, 0}, {-4, 8}, {-4, 12}, {0, 20}};
const Path kRight{{0, 0}, {4, 8}, {4, 12}, {0, 20}};
const Path kStraight{{0, 0}, {0, 20}};

}  // namespace

TEST_CASE("side_flips: a path passes an obstacle ahead on its left or on its right", "[report]") {
  const Obstacle circle = testing::circle_at(0, 10, 0.5, 3.5).at_start;
  CHECK(passing_side(found(1, kLeft), circle) == PassingSide::kLeft);
  CHECK(passing_side(found(1, kRight), circle) == PassingSide::kRight);
}

TEST_CASE("side_flips: the side is the path's own, whatever way it goes", "[report]") {
  const Obstacle circle = testing::circle_at(0, 10, 0.5, 3.5).at_start;
  PlanRecord southward = found(1, {{0, 20}, {-4, 12}, {-4, 8}, {0, 0}});
  southward.start_heading_deg = 180.0;
  CHECK(passing_side(southward, circle) == PassingSide::kRight);
}

TEST_CASE("side_flips: there is no side without a passing", "[report]") {
  const Obstacle circle = testing::circle_at(0, 10, 0.5, 3.5).at_start;
  CHECK(passing_side(not_found(1), circle) == PassingSide::kNone);
  CHECK(passing_side(found(1, {{0, 0}}), circle) == PassingSide::kNone);
  CHECK(passing_side(found(1, {{0, 0}, {-2, 6}}), circle) == PassingSide::kNone);  // ends before it
  CHECK(passing_side(found(1, {{0, 11}, {0, 20}}), circle) == PassingSide::kNone);  // is behind
  PlanRecord facing_away = found(1, kLeft);
  facing_away.start_heading_deg = 180.0;
  CHECK(passing_side(facing_away, circle) == PassingSide::kNone);
  const Obstacle far = testing::circle_at(0, 15.1, 0.5, 3.5).at_start;
  CHECK(passing_side(found(1, {{0, 0}, {-4, 15}, {0, 25}}), far) == PassingSide::kNone);
  const Obstacle near = testing::circle_at(0, 14.9, 0.5, 3.5).at_start;
  CHECK(passing_side(found(1, {{0, 0}, {-4, 15}, {0, 25}}), near) == PassingSide::kLeft);
}

TEST_CASE("side_flips: a wall is passed round one of its ends", "[report]") {
  const Obstacle wall = testing::wall_of(ObstacleShape::kPolyline, {{-3, 10}, {9, 10}}, 1).at_start;
  CHECK(passing_side(found(1, {{0, 0}, {-5, 10}, {0, 20}}), wall) == PassingSide::kLeft);
  CHECK(passing_side(found(1, {{0, 0}, {10.5, 10}, {0, 20}}), wall) == PassingSide::kRight);
  const Obstacle block =
      testing::wall_of(ObstacleShape::kPolygon, {{-2, 9}, {2, 9}, {2, 11}, {-2, 11}}, 1).at_start;
  CHECK(passing_side(found(1, kLeft), block) == PassingSide::kLeft);
  CHECK(passing_side(found(1, kRight), block) == PassingSide::kRight);
}

TEST_CASE("side_flips: each change between consecutive found plans counts", "[report]") {
  const std::vector<MovingObstacle> obstacles{testing::circle_at(0, 10, 0.5, 3.5)};
  const auto none = side_flips({found(1, kLeft), found(2, kLeft)}, obstacles);
  CHECK(none.count == 0);
  CHECK_FALSE(none.first_s.has_value());
  const auto two = side_flips(
      {found(1, kLeft), found(2.5, kRight), found(3, kRight), found(4, kLeft)}, obstacles);
  CHECK(two.count == 2);
  CHECK(two.first_s.value() == Approx(2.5));
}

TEST_CASE("side_flips: plans without a path do not separate found ones", "[report]") {
  const std::vector<MovingObstacle> obstacles{testing::circle_at(0, 10, 0.5, 3.5)};
  const auto flips =
      side_flips({found(1, kLeft), not_found(2), not_found(3), found(4, kRight)}, obstacles);
  CHECK(flips.count == 1);
  CHECK(flips.first_s.value() == Approx(4.0));
}

TEST_CASE("side_flips: a path that passes an obstacle no more is no change of side", "[report]") {
  const std::vector<MovingObstacle> obstacles{testing::circle_at(0, 10, 0.5, 3.5)};
  const Path past{{0, 14}, {0, 20}};
  CHECK(side_flips({found(1, kLeft), found(2, past), found(3, kRight)}, obstacles).count == 0);
}

TEST_CASE("side_flips: each obstacle is counted for itself", "[report]") {
  const std::vector<MovingObstacle> two{testing::circle_at(-1, 6, 0.5, 1),
                                        testing::circle_at(1, 12, 0.5, 1)};
  CHECK(side_flips({found(1, kLeft), found(2, kRight)}, two).count == 2);
  // Between them: the first changes, the second does not.
  const Path between{{0, 0}, {2, 6}, {-2, 12}, {0, 20}};
  CHECK(side_flips({found(1, kLeft), found(2, between)}, two).count == 1);
}

TEST_CASE("side_flips: a path that stays while something crosses it is no change of mind",
          "[report]") {
  MovingObstacle crossing = testing::circle_at(-3, 10, 0.5, 1);
  crossing.velocity_x_m_s = 1.0;
  CHECK(side_flips({found(1, kStraight), found(6, kStraight)}, {crossing}).count == 0);
  // Where it is by then, the new path goes by it on the other side than the old one would have.
  const auto dodged = side_flips({found(1, {{0, 0}, {-4, 10}, {0, 20}}), found(3, kRight)},
                                 {testing::circle_at(0, 10, 0.5, 1)});
  CHECK(dodged.count == 1);
  crossing.vanishes_at_s = 2.0;
  CHECK(side_flips({found(1, kLeft), found(6, kRight)}, {crossing}).count == 0);
}

TEST_CASE("side_flips: between the ends of one wall there is one way", "[report]") {
  const std::vector<MovingObstacle> ring{
      testing::wall_of(ObstacleShape::kPolyline,
                       {{-1.2, 10}, {-20, 10}, {-20, -10}, {20, -10}, {20, 10}, {1.2, 10}}, 1)};
  const auto flips =
      side_flips({found(1, {{0, 0}, {-0.1, 10}, {0, 20}}), found(2, {{0, 0}, {0.1, 10}, {0, 20}}),
                  found(3, {{0, 0}, {-0.1, 10}, {0, 20}})},
                 ring);
  CHECK(flips.count == 0);
  // Round the one end of a wall, and then round the other.
  const std::vector<MovingObstacle> wall{
      testing::wall_of(ObstacleShape::kPolyline, {{-3, 10}, {9, 10}}, 1)};
  CHECK(side_flips({found(1, {{0, 0}, {-5, 10}, {0, 20}}), found(2, {{0, 0}, {10.5, 10}, {0, 20}})},
                   wall)
            .count == 1);
}

TEST_CASE("side_flips: the sample run changes side once, after 26 s", "[report]") {
  const cli::RunRecord run = testing::static_run();
  const auto flips = side_flips(run.plans, run.obstacles);
  CHECK(flips.count == 1);
  CHECK(flips.first_s.value() == Approx(27.2));
}
