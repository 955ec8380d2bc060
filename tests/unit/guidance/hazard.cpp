// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/hazard.h"

#include <limits>

#include "tests/support/catch.h"
#include "tests/unit/guidance/support.h"

namespace lodesman::testing {
namespace {

Track doubtful_track(double speed_m_s, double sigma_m_s) {
  Track track = disc_track(1, 0.0, 10.0, speed_m_s, 0.0);
  track.velocity_xx_m2_s2 = track.velocity_yy_m2_s2 = sigma_m_s * sigma_m_s;
  return track;
}

}  // namespace

TEST_CASE("hazard: without doubt a track moves or it rests", "[high_level][guidance]") {
  CHECK(probability_of_motion(doubtful_track(0.0, 0.0)) == Approx(0.0));
  CHECK(probability_of_motion(doubtful_track(1e-3, 0.0)) == Approx(1.0));
}

TEST_CASE("hazard: motion is the likelier the more of a velocity its doubt cannot explain",
          "[high_level][guidance]") {
  for (const double sigma_m_s : {0.01, 0.05, 0.15, 0.5}) {
    double last = -1.0;
    for (const double speed_m_s : {0.0, 0.5, 1.0, 2.0, 4.0, 8.0}) {
      const double p = probability_of_motion(doubtful_track(speed_m_s * sigma_m_s, sigma_m_s));
      CHECK(p >= last);
      CHECK(p >= 0.0);
      CHECK(p <= 1.0);
      last = p;
    }
  }
  // A small velocity, well measured, is rest; one that is measured badly says little.
  CHECK(probability_of_motion(doubtful_track(0.01, 0.01)) < 0.01);
  CHECK(probability_of_motion(doubtful_track(0.3, 0.05)) > 0.99);
  CHECK(probability_of_motion(doubtful_track(0.0, 10.0)) == Approx(0.3).margin(0.01));
}

TEST_CASE("hazard: what may rest or move is foreseen as both, with probabilities of one in all",
          "[high_level][guidance]") {
  const Tracks tracks = tracks_of(
      {doubtful_track(0.3, 0.15), disc_track(2, 5.0, 5.0), disc_track(3, -5.0, 5.0, 0.2, 0.1)});
  Hazards hazards;
  foresee_hazards(at_s(2.0), tracks, 0.0, hazards);
  REQUIRE(hazards.count == 4);
  CHECK(hazards.list[0].track == hazards.list[1].track);
  CHECK(hazards.list[0].velocity_m_s.norm() == Approx(0.0));
  CHECK(hazards.list[1].velocity_m_s.x() == Approx(0.3));
  CHECK(hazards.list[0].probability + hazards.list[1].probability == Approx(1.0));
  CHECK(hazards.list[2].probability == Approx(1.0));
  CHECK(hazards.list[3].probability == Approx(1.0));
  CHECK(hazards.fastest_m_s == Approx(0.3));
  for (std::size_t i = 0; i < hazards.count; ++i) {
    CHECK(hazards.list[i].age_s == Approx(2.0));
  }
}

TEST_CASE("hazard: as many as can be are foreseen", "[high_level][guidance]") {
  Tracks tracks;
  tracks.count = kMaxObstacles;
  for (std::uint32_t i = 0; i < kMaxObstacles; ++i) {
    tracks.tracks[i] = doubtful_track(0.3, 0.15);
  }
  Hazards hazards;
  foresee_hazards(at_s(0.0), tracks, 0.0, hazards);
  CHECK(hazards.count == 2 * kMaxObstacles);
}

TEST_CASE("hazard: the clearance is the hull's, where the obstacle is by then",
          "[high_level][guidance]") {
  const Tracks tracks = tracks_of({disc_track(1, 0.0, 10.0, 0.0, -1.0)});
  Hazards hazards;
  foresee_hazards(at_s(0.0), tracks, 0.0, hazards);
  const HullDiscs hull = HullDiscs::of(1.02, 0.6);
  const VehicleMotion north{{{0.0, 0.0}}, 0.0, {0.0, 0.0, 0.0}};
  const auto at = [&](double after_s) {
    return clearance_m(hazards.list[0], after_s, north, hull,
                       std::numeric_limits<double>::infinity());
  };
  CHECK(at(0.0) == Approx(9.5 - hull.at_m - hull.radius_m));
  CHECK(at(5.0) == Approx(4.5 - hull.at_m - hull.radius_m));
  CHECK(at(9.0) < 0.0);
  // In its way only while it comes.
  CHECK(closeness_ahead(hazards.list[0], 5.0, north) > 0.0);
  CHECK(closeness_ahead(hazards.list[0], 12.0, north) == Approx(0.0));
}

}  // namespace lodesman::testing
