// SPDX-License-Identifier: Apache-2.0
#include "mid_level/messages/sane.h"

#include <cstring>
#include <limits>
#include <memory>
#include <random>

#include "mid_level/blackboard/blackboard.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHuge = 1e300;

// A message in which one byte is another: what no code of ours could write.
template <class M, class T>
M with_byte(M message, const T& member_of_message, const M& whole, unsigned char byte) {
  const auto offset =
      reinterpret_cast<const char*>(&member_of_message) - reinterpret_cast<const char*>(&whole);
  std::memcpy(reinterpret_cast<char*>(&message) + offset, &byte, 1);
  return message;
}

template <class M>
M random_bytes(std::mt19937_64& random) {
  M message;
  std::array<unsigned char, sizeof(M)> bytes;
  for (auto& byte : bytes) {
    byte = static_cast<unsigned char>(random());
  }
  std::memcpy(reinterpret_cast<char*>(&message), bytes.data(), sizeof(M));
  return message;
}

}  // namespace

TEST_CASE("sane: every message that has just been made is sane or cannot be one yet",
          "[mid_level][messages]") {
  const auto board = std::make_unique<Blackboard>();
  for_each_channel(*board, [](const ChannelInfo& info, const auto& channel) {
    using T = typename std::remove_cvref_t<decltype(channel)>::Value;
    CAPTURE(info.name);
    // A ping without beams is none.
    CHECK(sane(*std::make_unique<T>()) == !std::is_same_v<T, SonarPing>);
  });
}

TEST_CASE("sane: a number must be finite and within its bounds", "[mid_level][messages]") {
  for (const double bad : {kNan, kInfinity, -kInfinity, kHuge, -kHuge, 3.2, -3.2}) {
    Attitude attitude;
    attitude.heading_rad = bad;
    CAPTURE(bad);
    CHECK_FALSE(sane(attitude));
  }
  PositionFix fix;
  fix.latitude_deg = 90.0;
  CHECK(sane(fix));
  fix.latitude_deg = 90.000001;
  CHECK_FALSE(sane(fix));
  HelmCommand helm;
  helm.surge_ref = -100;
  CHECK(sane(helm));
  helm.surge_ref = -101;
  CHECK_FALSE(sane(helm));
  helm.surge_ref = std::numeric_limits<std::int32_t>::max();
  CHECK_FALSE(sane(helm));
}

TEST_CASE("sane: infinity stands where nothing is near, and nowhere else",
          "[mid_level][messages]") {
  WorldTruth truth;
  truth.inoffensive_distance_m = kInfinity;
  CHECK(sane(truth));
  truth.inoffensive_distance_m = -kInfinity;
  CHECK_FALSE(sane(truth));
  truth.inoffensive_distance_m = kNan;
  CHECK_FALSE(sane(truth));
  truth.inoffensive_distance_m = 0.0;
  truth.x_m = kInfinity;
  CHECK_FALSE(sane(truth));
}

TEST_CASE("sane: a bool is 0 or 1, and an enum one of its values", "[mid_level][messages]") {
  const Plan plan;
  CHECK(sane(plan));
  CHECK(sane(with_byte(plan, plan.narrow, plan, 1)));
  CHECK_FALSE(sane(with_byte(plan, plan.narrow, plan, 2)));
  CHECK(sane(with_byte(plan, plan.rung, plan, 9)));
  CHECK_FALSE(sane(with_byte(plan, plan.rung, plan, 10)));
  CHECK_FALSE(sane(with_byte(plan, plan.steer_by, plan, 255)));
}

TEST_CASE("sane: a count is no more than its array holds, and what it counts is looked at",
          "[mid_level][messages]") {
  auto plan = std::make_unique<Plan>();
  plan->waypoints[2].x_m = kNan;
  plan->waypoint_count = 2;
  CHECK(sane(*plan));
  plan->waypoint_count = 3;
  CHECK_FALSE(sane(*plan));
  plan->waypoints[2].x_m = 0.0;
  plan->waypoint_count = kMaxWaypoints;
  CHECK(sane(*plan));
  plan->waypoint_count = kMaxWaypoints + 1;
  CHECK_FALSE(sane(*plan));
}

TEST_CASE("sane: a count inside an element of an array is looked at", "[mid_level][messages]") {
  auto tracks = std::make_unique<Tracks>();
  tracks->count = 1;
  Obstacle& wall = tracks->tracks[0].shape;
  wall.shape = ObstacleShape::kPolyline;
  wall.vertex_count = 2;
  CHECK(sane(*tracks));
  wall.vertex_count = kMaxVertices + 1;
  CHECK_FALSE(sane(*tracks));
  wall.vertex_count = 1;  // a wall without a side
  CHECK_FALSE(sane(*tracks));
  wall.shape = ObstacleShape::kEllipse;  // and without semi-axes
  CHECK_FALSE(sane(*tracks));
}

TEST_CASE("sane: the echoes of a ping are as many as its beams and bins say",
          "[mid_level][messages]") {
  auto ping = std::make_unique<SonarPing>();
  ping->range_m = 30.0;
  ping->make_image(4, 5, 2.0);
  CHECK(sane(*ping));
  ping->echo_count = 21;
  CHECK_FALSE(sane(*ping));
  ping->beams = kMaxBeams;
  ping->bins = kMaxBins + 1;
  ping->echo_count = ping->beams * ping->bins;
  CHECK_FALSE(sane(*ping));
}

TEST_CASE("sane: a profile has a point a beam and no echoes", "[mid_level][messages]") {
  auto ping = std::make_unique<SonarPing>();
  ping->range_m = 30.0;
  ping->make_image(4, 5, 2.0);
  ping->kind = PingKind::kProfile;
  CHECK_FALSE(sane(*ping));
  ping->bins = ping->echo_count = 0;
  CHECK_FALSE(sane(*ping));
  ping->point_count = 4;
  CHECK(sane(*ping));
  ping->points[3].range_m = -1.0;
  CHECK_FALSE(sane(*ping));
  ping->points[3].range_m = 12.0;
  CHECK(sane(*ping));
  ping->sector_rad = 2.1;  // not what its beams cover
  CHECK_FALSE(sane(*ping));
}

TEST_CASE("sane: times lie between the start of the clock and a day when they can still be added",
          "[mid_level][messages]") {
  Attitude attitude;
  for (const std::int64_t bad : {std::int64_t{-1}, std::numeric_limits<std::int64_t>::min(),
                                 std::numeric_limits<std::int64_t>::max()}) {
    attitude.measured = Time{Duration{bad}};
    CHECK_FALSE(sane(attitude));
  }
  attitude.measured = Time{std::chrono::hours{24 * 365 * 100}};
  CHECK(sane(attitude));
}

TEST_CASE("sane: any bytes may be asked about", "[mid_level][messages]") {
  std::mt19937_64 random{7};
  int sane_ones = 0;
  for (int i = 0; i < 2000; ++i) {
    sane_ones += sane(random_bytes<HelmCommand>(random)) ? 1 : 0;
    sane_ones += sane(random_bytes<MissionStatus>(random)) ? 1 : 0;
    sane_ones += sane(random_bytes<Track>(random)) ? 1 : 0;
    sane_ones += sane(random_bytes<ThrustApplied>(random)) ? 1 : 0;
  }
  CHECK(sane_ones < 80);  // of 8000: few bytes make a message
}
