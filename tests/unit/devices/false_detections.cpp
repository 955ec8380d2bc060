// SPDX-License-Identifier: Apache-2.0
// Returns of nothing, and what a seed decides.
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "hal_sim/sonar/detections.h"
#include "mid_level/messages/sane.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"

namespace lodesman {
namespace {

constexpr DetectionErrors kAllErrors{
    .missed = 0.2, .split = 0.3, .displaced_m = 0.2, .false_per_ping = 0.5, .noise_m = 0.05};

[[nodiscard]] std::vector<MovingObstacle> stones(int count) {
  std::vector<MovingObstacle> obstacles;
  for (int i = 0; i < count; ++i) {
    MovingObstacle& stone = obstacles.emplace_back();
    stone.at_start.centre_x_m = 3.0 * i;
    stone.at_start.centre_y_m = 10.0;
    stone.at_start.semi_axis_first_m = stone.at_start.semi_axis_second_m = 0.8;
  }
  return obstacles;
}

class Head {
 public:
  Head(const std::vector<MovingObstacle>& obstacles, const DetectionErrors& errors,
       std::uint64_t seed = 1, std::uint32_t beams = 120)
      : scene_{obstacles}, detections_{obstacles.size(), errors, seed} {
    ping->range_m = 30.0;
    ping->make_profile(beams, to_rad(120.0));
    scene_.observe({}, 0.0);
  }
  void look() { detections_.detect(scene_, *ping); }
  // Of all pings to come, bit by bit.
  [[nodiscard]] std::vector<double> ranges(int pings) {
    std::vector<double> all;
    for (int i = 0; i < pings; ++i) {
      look();
      for (std::uint32_t beam = 0; beam < ping->beams; ++beam) {
        all.push_back(ping->points[beam].range_m);
      }
    }
    return all;
  }

  std::unique_ptr<SonarPing> ping = std::make_unique<SonarPing>();

 private:
  HeardScene scene_;
  Detections detections_;
};

struct FalseOne {
  double range_m;
  std::uint32_t first_beam;
  std::uint32_t beams;
  [[nodiscard]] bool operator<(const FalseOne& other) const {
    return std::tie(range_m, first_beam) < std::tie(other.range_m, other.first_beam);
  }
};

// In a ping of open water: returns side by side at the very same range.
[[nodiscard]] std::set<FalseOne> false_ones(const SonarPing& ping) {
  std::set<FalseOne> found;
  for (std::uint32_t beam = 0; beam < ping.beams;) {
    std::uint32_t end = beam + 1;
    while (end < ping.beams &&
           !(std::abs(ping.points[end].range_m - ping.points[beam].range_m) > 0.0)) {
      ++end;
    }
    if (ping.points[beam].range_m > 0.0) {
      found.insert({ping.points[beam].range_m, beam, end - beam});
    }
    beam = end;
  }
  return found;
}

TEST_CASE("detections: false returns come as often as was asked for, and stay one to three pings",
          "[hal_sim][sonar]") {
  Head head{{}, {.false_per_ping = 0.1}};  // so few that they hardly ever hide each other
  constexpr int kPings = 60000;
  std::vector<int> lasted(5);
  std::vector<int> wide(8);
  int shown = 0;
  int near = 0;
  int to_port = 0;
  std::vector<std::pair<FalseOne, std::size_t>> alive;
  for (int i = 0; i < kPings; ++i) {
    head.look();
    REQUIRE(sane(*head.ping));
    std::vector<std::pair<FalseOne, std::size_t>> now;
    for (const FalseOne& one : false_ones(*head.ping)) {
      const auto before = std::find_if(alive.begin(), alive.end(), [&](const auto& old) {
        return !(std::abs(old.first.range_m - one.range_m) > 0.0);
      });
      now.emplace_back(one, before == alive.end() ? 1 : before->second + 1);
      ++shown;
      ++wide[std::min<std::size_t>(one.beams, 7)];
      near += one.range_m < 15.0 ? 1 : 0;
      to_port += one.first_beam + one.beams / 2 < 60 ? 1 : 0;
    }
    for (const auto& [one, pings] : alive) {
      const bool goes_on = std::any_of(now.begin(), now.end(), [&, r = one.range_m](const auto& n) {
        return !(std::abs(n.first.range_m - r) > 0.0);
      });
      lasted[std::min<std::size_t>(goes_on ? 0 : pings, 4)] += 1;
    }
    alive = std::move(now);
  }
  CHECK(shown / (1.0 * kPings) == Approx(0.1).margin(0.01));
  CHECK(near / (1.0 * shown) == Approx(0.25).margin(0.03));  // a quarter of the fan's water
  CHECK(to_port / (1.0 * shown) == Approx(0.5).margin(0.05));
  for (const std::size_t beams : {3U, 4U, 5U, 6U}) {
    CHECK(wide[beams] / (1.0 * shown) == Approx(0.25).margin(0.04));
  }
  CHECK(wide[7] == 0);
  const int times = lasted[1] + lasted[2] + lasted[3];
  for (const std::size_t pings : {1U, 2U, 3U}) {
    CHECK(lasted[pings] / (1.0 * times) == Approx(1.0 / 3.0).margin(0.04));
  }
  CHECK(lasted[4] == 0);
}

TEST_CASE("detections: however few beams there are and however much goes wrong, a ping is sane",
          "[hal_sim][sonar]") {
  constexpr DetectionErrors kMost{
      .missed = 0.9, .split = 1.0, .displaced_m = 5.0, .false_per_ping = 10.0, .noise_m = 1.0};
  for (const std::uint32_t beams : {1U, 2U, 5U, 512U}) {
    Head head{stones(8), kMost, 1, beams};
    const testing::AllocationScope scope;
    bool is_sane = true;
    for (int i = 0; i < 500; ++i) {
      head.look();
      is_sane = is_sane && sane(*head.ping) && head.ping->fits();
    }
    const std::uint64_t allocations = scope.count();
    CHECK(allocations == 0);
    CHECK(is_sane);
  }
}

TEST_CASE("detections: a seed decides all, and another one otherwise", "[hal_sim][sonar]") {
  const auto obstacles = stones(3);
  const auto once = Head{obstacles, kAllErrors, 7}.ranges(200);
  CHECK(once == Head{obstacles, kAllErrors, 7}.ranges(200));
  CHECK(once != Head{obstacles, kAllErrors, 8}.ranges(200));
}

TEST_CASE("detections: one error moves no other, and one obstacle none of another's",
          "[hal_sim][sonar]") {
  // Which pings of the obstacle ahead are missed: its beams are silent.
  const auto missed_pings = [](int count, const DetectionErrors& errors) {
    Head head{stones(count), errors};
    std::vector<bool> missed;
    for (int i = 0; i < 400; ++i) {
      head.look();
      missed.push_back(!(head.ping->points[57].range_m > 0.0));
    }
    return missed;
  };
  const auto alone = missed_pings(1, {.missed = 0.2});
  CHECK(std::count(alone.begin(), alone.end(), true) > 40);
  CHECK(alone == missed_pings(3, {.missed = 0.2}));
  CHECK(alone == missed_pings(1, {.missed = 0.2, .displaced_m = 0.1, .noise_m = 0.05}));
}

}  // namespace
}  // namespace lodesman
