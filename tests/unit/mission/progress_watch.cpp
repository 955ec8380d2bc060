// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/progress_watch.h"

#include "tests/support/catch.h"

using namespace lodesman;

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr ProgressWatchOptions kOptions{seconds{15}, 0.5};
constexpr Time kStart{seconds{100}};

// A boat that wants to go north at 0.22 m/s and goes over ground with a velocity of its own.
struct Boat {
  ProgressWatch watch{kOptions};
  Time now = kStart;
  ProgressSample sample;
  NoWayCause cause = NoWayCause::kNone;

  Boat() {
    sample.wanted = true;
    sample.position = WorldPoint{{3.0, 4.0}};
    sample.course = {0.0, 1.0};
    sample.through_water_m_s = 0.22;
    watch.start(now);
  }
  void go(Duration time, double east_m_s, double north_m_s) {
    for (const Time end = now + time; now < end; now += milliseconds{50}) {
      if (sample.position) {
        sample.position->xy_m += 0.05 * Eigen::Vector2d{east_m_s, north_m_s};
      }
      cause = watch.update(now, sample);
    }
  }
};

}  // namespace

TEST_CASE("progress watch: way is made, however slowly within reason", "[high_level][mission]") {
  Boat boat;
  for (int i = 0; i < 20; ++i) {
    boat.go(seconds{10}, 0.0, 0.05);
    CHECK(boat.cause == NoWayCause::kNone);
  }
}

TEST_CASE("progress watch: no way for the patience is said, with the time since when",
          "[high_level][mission]") {
  Boat boat;
  boat.go(seconds{14}, 0.0, 0.0);
  CHECK(boat.cause == NoWayCause::kNone);
  boat.go(milliseconds{1200}, 0.0, 0.0);
  CHECK(boat.cause == NoWayCause::kUnknown);
  CHECK(boat.watch.since() == kStart);
  boat.go(seconds{4}, 0.0, 0.22);
  CHECK(boat.cause == NoWayCause::kNone);
}

TEST_CASE("progress watch: a cause that is known is given", "[high_level][mission]") {
  Boat boat;
  boat.sample.cause = NoWayCause::kThrusters;
  boat.go(seconds{16}, 0.0, 0.0);
  CHECK(boat.cause == NoWayCause::kThrusters);
  boat.sample.position.reset();
  boat.sample.cause = NoWayCause::kNoPosition;
  boat.go(seconds{1}, 0.0, 0.0);
  CHECK(boat.cause == NoWayCause::kNoPosition);
}

TEST_CASE("progress watch: once the sonar is heard again the patience begins anew",
          "[high_level][mission]") {
  Boat boat;
  boat.sample.cause = NoWayCause::kNoSonar;
  boat.go(seconds{16}, 0.05, 0.0);
  CHECK(boat.cause == NoWayCause::kNoSonar);
  boat.sample.cause = NoWayCause::kUnknown;
  boat.go(seconds{14}, 0.0, 0.0);
  CHECK(boat.cause == NoWayCause::kNone);
  boat.go(seconds{2}, 0.0, 0.0);
  CHECK(boat.cause == NoWayCause::kUnknown);
}

TEST_CASE("progress watch: a boat that is carried astern or aside has the current for a cause",
          "[high_level][mission]") {
  for (const auto& [east_m_s, north_m_s] : {std::pair{0.0, -0.3}, std::pair{0.5, 0.0}}) {
    Boat boat;
    boat.go(seconds{16}, east_m_s, north_m_s);
    CHECK(boat.cause == NoWayCause::kCurrent);
  }
}

TEST_CASE("progress watch: a position found again elsewhere is no current",
          "[high_level][mission]") {
  Boat boat;
  boat.sample.position.reset();
  boat.sample.cause = NoWayCause::kNoPosition;
  boat.go(seconds{20}, 0.0, 0.0);
  boat.sample.cause = NoWayCause::kUnknown;
  boat.sample.position = WorldPoint{{30.0, -4.0}};
  boat.go(milliseconds{200}, 0.0, 0.22);
  CHECK(boat.cause == NoWayCause::kUnknown);
  boat.go(seconds{3}, 0.0, 0.22);
  CHECK(boat.cause == NoWayCause::kNone);
}

TEST_CASE("progress watch: who wants no way, makes none in peace", "[high_level][mission]") {
  Boat boat;
  boat.sample.wanted = false;
  boat.go(seconds{60}, 0.0, 0.0);
  CHECK(boat.cause == NoWayCause::kNone);
  boat.sample.wanted = true;
  boat.go(seconds{14}, 0.0, 0.0);
  CHECK(boat.cause == NoWayCause::kNone);
}

TEST_CASE("progress watch: to jump about in one place is no way", "[high_level][mission]") {
  Boat boat;
  NoWayCause said = NoWayCause::kNone;
  for (int i = 0; i < 200; ++i) {
    boat.go(milliseconds{200}, 0.0, i % 2 == 0 ? 1.5 : -1.5);
    said = boat.cause != NoWayCause::kNone ? boat.cause : said;
  }
  CHECK(said == NoWayCause::kUnknown);
}

TEST_CASE("progress watch: a slow boat need not make half a metre", "[high_level][mission]") {
  CHECK(least_way_m(kOptions, 1.0) == Approx(0.5));
  CHECK(least_way_m(kOptions, 0.05) == Approx(0.1875));
}
