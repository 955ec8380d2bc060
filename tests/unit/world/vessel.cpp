// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/vessel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/shipped_vessel.h"

namespace lodesman {
namespace {

using testing::shipped_speeds;
using testing::shipped_vessel;

constexpr double kStep_s = 0.02;
const std::array<double, 5> kPaperSpeeds_m_s = {0.11, 0.22, 0.42, 0.74, 1.12};

// Eqs 13-14 once more, for the tests alone.
[[nodiscard]] std::uint8_t command_of(int mixed) {
  const double root = 12.8 * std::sqrt(std::abs(mixed) / 2.0);
  return static_cast<std::uint8_t>(std::clamp(128.0 + (mixed < 0 ? -root : root), 0.0, 255.0));
}
[[nodiscard]] ThrustCommand mix(int surge_ref, int head_ref) {
  return {command_of(surge_ref + head_ref), command_of(surge_ref - head_ref)};
}

[[nodiscard]] Vessel moving_vessel(int surge_ref, const WaterConditions& water = {}) {
  Vessel vessel{shipped_vessel(), water, {}};
  for (int i = 0; i < 3000; ++i) {
    vessel.advance(kStep_s, mix(surge_ref, 0));
  }
  return vessel;
}

TEST_CASE("vessel: a thruster pulls with the square of its command, and rests at 127 and 128",
          "[hal_sim][vessel]") {
  const VesselParameters p = shipped_vessel();
  CHECK(thrust_n(p, 127) == Approx(0.0).margin(0.0));
  CHECK(thrust_n(p, 128) == Approx(0.0).margin(0.0));
  CHECK(thrust_n(p, 0) == Approx(-60.0));
  CHECK(thrust_n(p, 64) == Approx(-15.0));
  CHECK(thrust_n(p, 192) == Approx(15.0));
  for (int command = 128; command < 255; ++command) {
    CHECK(thrust_n(p, static_cast<std::uint8_t>(command + 1)) >
          thrust_n(p, static_cast<std::uint8_t>(command)));
  }
}

TEST_CASE("vessel: each speed of the paper is held by an integer SurgeRef within 3 %",
          "[hal_sim][vessel]") {
  const VesselParameters p = shipped_vessel();
  const SpeedTable speeds = shipped_speeds();
  const std::array<int, 5> surge_refs = {8, 16, 31, 57, 91};
  for (std::size_t i = 0; i < kPaperSpeeds_m_s.size(); ++i) {
    const HeldSpeed held = speeds.held(kPaperSpeeds_m_s[i]);
    INFO(kPaperSpeeds_m_s[i] << " m/s: SurgeRef " << held.surge_ref << " holds " << held.speed_m_s);
    CHECK(held.surge_ref == surge_refs[i]);
    CHECK(held.speed_m_s == Approx(kPaperSpeeds_m_s[i]).epsilon(0.03));
    CHECK(moving_vessel(held.surge_ref).state().surge_m_s ==
          Approx(steady_speed_m_s(p, held.surge_ref)).epsilon(0.001));
  }
  CHECK(steady_speed_m_s(p, 100) == Approx(1.2).epsilon(0.03));
  CHECK(steady_speed_m_s(p, 0) == Approx(0.0).margin(0.0));
}

TEST_CASE("vessel: the shipped boat's speed table is what its simulated vessel settles at",
          "[hal_sim][vessel]") {
  const SpeedTable speeds = shipped_speeds();
  for (int surge_ref = 8; surge_ref <= kMaxSurgeRef; ++surge_ref) {
    INFO("SurgeRef " << surge_ref);
    // Commands are whole numbers: between its points the vessel's speed goes in steps.
    CHECK(speeds.speed_m_s(surge_ref) ==
          Approx(steady_speed_m_s(shipped_vessel(), surge_ref)).epsilon(0.04));
  }
}

TEST_CASE("vessel: more thrust to the left turns it right, towards positive x",
          "[hal_sim][vessel]") {
  Vessel vessel{shipped_vessel(), {}, {}};
  for (int i = 0; i < 100; ++i) {
    vessel.advance(kStep_s, mix(16, 30));
  }
  CHECK(vessel.state().yaw_rate_rad_s > 0.0);
  CHECK(vessel.state().pose.heading.rad() > 0.0);
  CHECK(vessel.state().pose.p_WV.xy_m.x() > 0.0);
  CHECK(vessel.state().pose.p_WV.xy_m.y() > 0.0);
}

struct Manoeuvre {
  std::string name;
  double duration_s;
  std::function<ThrustCommand(double)> thrust_at;  // by time
};

const std::vector<Manoeuvre> kManoeuvres = {
    {"acceleration", 20.0, [](double) { return mix(100, 0); }},
    {"turning circle", 60.0, [](double) { return mix(57, 40); }},
    {"zig-zag", 60.0, [](double t_s) { return mix(57, std::fmod(t_s, 12.0) < 6.0 ? 30 : -30); }},
    {"crash stop", 20.0, [](double t_s) { return mix(t_s < 10.0 ? 100 : -100, 0); }},
};

// Where a manoeuvre ends, with the way and the turning done on it.
struct Sailed {
  Eigen::Vector2d end_m = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  double way_m = 0.0;
  double turning_rad = 0.0;
};

[[nodiscard]] Sailed sail(const Manoeuvre& manoeuvre, double step_s, bool lift) {
  VesselParameters parameters = shipped_vessel();
  parameters.step_s_max = step_s;
  Vessel vessel{parameters, {0.0, 0.0, lift}, {}};
  Sailed track;
  for (int i = 0; i * kStep_s < manoeuvre.duration_s; ++i) {
    const VesselState before = vessel.state();
    vessel.advance(kStep_s, manoeuvre.thrust_at(i * kStep_s));
    const VesselState& after = vessel.state();
    track.way_m += (after.pose.p_WV.xy_m - before.pose.p_WV.xy_m).norm();
    const double turned_rad = before.pose.heading.turn_to_rad(after.pose.heading);
    track.turning_rad += std::abs(turned_rad);
    track.heading_rad += turned_rad;
  }
  track.end_m = vessel.state().pose.p_WV.xy_m;
  return track;
}

TEST_CASE("vessel: halving the step moves no manoeuvre by 1 %", "[hal_sim][vessel]") {
  for (const bool lift : {false, true}) {
    for (const Manoeuvre& manoeuvre : kManoeuvres) {
      INFO(manoeuvre.name << (lift ? " with lift" : ""));
      const Sailed coarse = sail(manoeuvre, kStep_s, lift);
      const Sailed fine = sail(manoeuvre, kStep_s / 2.0, lift);
      CHECK(fine.way_m > 1.0);
      CHECK((coarse.end_m - fine.end_m).norm() <= 0.01 * fine.way_m);
      CHECK(std::abs(coarse.heading_rad - fine.heading_rad) <= 0.01 * fine.turning_rad + 1e-12);
    }
  }
}

// A turn of 30 degrees under the P law at 20 Hz, with a heading 0.1 s old.
struct Response {
  double overshoot_deg = 0.0;
  double settled_s = 0.0;  // within a degree from then on
};

[[nodiscard]] Response turn_by_30_deg(double speed_m_s, double gain_per_deg) {
  const int surge_ref = shipped_speeds().held(speed_m_s).surge_ref;
  Vessel vessel = moving_vessel(surge_ref);
  std::array<double, 5> heading_deg{};
  ThrustCommand thrust = mix(surge_ref, 0);
  Response response;
  for (std::size_t i = 0; i < 3000; ++i) {
    const double now_deg = to_deg(vessel.state().pose.heading.rad());
    if (i % 3 == 0) {
      const double deviation_deg = 30.0 - heading_deg[i % heading_deg.size()];
      thrust =
          mix(surge_ref, std::clamp(static_cast<int>(gain_per_deg * deviation_deg), -100, 100));
    }
    heading_deg[i % heading_deg.size()] = now_deg;
    response.overshoot_deg = std::max(response.overshoot_deg, now_deg - 30.0);
    if (std::abs(now_deg - 30.0) > 1.0) {
      response.settled_s = static_cast<double>(i) * kStep_s;
    }
    vessel.advance(kStep_s, thrust);
  }
  return response;
}

TEST_CASE("vessel: the P law is steady up to 0.74 m/s and less so at 1.12", "[hal_sim][vessel]") {
  for (const double gain_per_deg : {1.0, 2.0, 3.0}) {
    for (const double speed_m_s : {0.11, 0.22, 0.42, 0.74}) {
      const Response response = turn_by_30_deg(speed_m_s, gain_per_deg);
      INFO(speed_m_s << " m/s, gain " << gain_per_deg << ": over by " << response.overshoot_deg
                     << " deg, settled at " << response.settled_s << " s");
      CHECK(response.overshoot_deg < 9.0);
      CHECK(response.settled_s < 15.0);
    }
    const Response fast = turn_by_30_deg(1.12, gain_per_deg);
    INFO("gain " << gain_per_deg << ": over by " << fast.overshoot_deg << " deg, settled at "
                 << fast.settled_s << " s");
    CHECK(fast.overshoot_deg > 9.0);
    CHECK(fast.settled_s > 15.0);
    CHECK(fast.settled_s < 40.0);
  }
}

// How far the vessel ends from where its heading and surge speed alone would have taken it, on
// the course of tank-static: out to one side, round, and back. The P law steers.
[[nodiscard]] double dead_reckoning_error_m(bool lift) {
  const int surge_ref = 16;
  Vessel vessel{shipped_vessel(), {0.0, 0.0, lift}, {}};
  Eigen::Vector2d reckoned_m = Eigen::Vector2d::Zero();
  for (int i = 0; i < 2000; ++i) {
    const double t_s = i * kStep_s;
    const double course_deg = t_s < 3.0 ? 0.0 : t_s < 19.0 ? 20.0 : t_s < 23.0 ? 0.0 : -22.0;
    const double heading_rad = vessel.state().pose.heading.rad();
    const double deviation_deg = course_deg - to_deg(heading_rad);
    reckoned_m += kStep_s * vessel.state().surge_m_s *
                  Eigen::Vector2d{std::sin(heading_rad), std::cos(heading_rad)};
    vessel.advance(kStep_s,
                   mix(surge_ref, std::clamp(static_cast<int>(3.0 * deviation_deg), -100, 100)));
  }
  return (vessel.state().pose.p_WV.xy_m - reckoned_m).norm();
}

TEST_CASE("vessel: it goes where it points without lift, and slides 0.3-1.5 m off with it",
          "[hal_sim][vessel]") {
  CHECK(dead_reckoning_error_m(false) < 0.1);
  const double lifted_m = dead_reckoning_error_m(true);
  CHECK(lifted_m > 0.3);  // 0.52 m is what a hull without any hold comes to
  CHECK(lifted_m < 1.5);
}

TEST_CASE("vessel: with lift a straight course stays straight, at every speed",
          "[hal_sim][vessel]") {
  for (const double speed_m_s : kPaperSpeeds_m_s) {
    const int surge_ref = shipped_speeds().held(speed_m_s).surge_ref;
    const Vessel vessel = moving_vessel(surge_ref, {0.0, 0.0, true});
    CHECK(std::abs(vessel.state().pose.p_WV.xy_m.x()) < 1e-9);
  }
}

TEST_CASE("vessel: a current carries it along and is no part of its speed through the water",
          "[hal_sim][vessel]") {
  const Vessel still = moving_vessel(16);
  const Vessel carried = moving_vessel(16, {0.1, -0.05, false});
  const Eigen::Vector2d offset_m = carried.state().pose.p_WV.xy_m - still.state().pose.p_WV.xy_m;
  CHECK(offset_m.x() == Approx(6.0));
  CHECK(offset_m.y() == Approx(-3.0));
  CHECK(carried.state().surge_m_s == Approx(still.state().surge_m_s));
  CHECK(carried.ground_velocity_V_m_s().x() == Approx(0.1));
  CHECK(carried.ground_velocity_V_m_s().y() == Approx(still.state().surge_m_s - 0.05));
}

TEST_CASE("vessel: a time that is not positive moves nothing", "[hal_sim][vessel]") {
  Vessel vessel = moving_vessel(16);
  const Eigen::Vector2d before_m = vessel.state().pose.p_WV.xy_m;
  vessel.advance(0.0, mix(16, 0));
  vessel.advance(-1.0, mix(16, 0));
  CHECK((vessel.state().pose.p_WV.xy_m - before_m).norm() == Approx(0.0).margin(0.0));
}

TEST_CASE("vessel: a missing or unknown value is refused", "[hal_sim][vessel]") {
  const TomlDocument empty = TomlDocument::from_text("[vessel]\nmass_kg = 95.0\n", "v.toml");
  CHECK_THROWS_WITH(read_vessel_parameters(empty.root().table("vessel")),
                    "v.toml:1: vessel.yaw_inertia_kg_m2: missing");
  const TomlDocument heavy = TomlDocument::from_text("[vessel]\nmass_kg = 0.0\n", "v.toml");
  CHECK_THROWS_AS(read_vessel_parameters(heavy.root().table("vessel")), StartupError);
}

}  // namespace
}  // namespace lodesman
