// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/calibrate/walk.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "hal_sim/world/vessel.h"
#include "tests/support/catch.h"
#include "tests/support/shipped_vessel.h"

namespace lodesman::cli {
namespace {

// A boat under the stick, in no time.
class HandledBoat {
 public:
  VesselParameters hull = testing::shipped_vessel();
  WaterConditions water{};
  double heading_offset_rad = 0.0;
  double fix_sigma_m = 0.0;
  double stops_at_s = 1e9;
  double farthest_m = 0.0;
  Stick last;

  [[nodiscard]] std::optional<Sighting> steer(Stick stick) {
    last = stick;
    if (!vessel_) {
      vessel_.emplace(hull, water, VehiclePose{{}, Heading::clockwise_from_y_rad(to_rad(50.0))});
    }
    if (time_s_ >= stops_at_s) {
      return std::nullopt;
    }
    const auto command = [](int mixed) {
      const double root = 12.8 * std::sqrt(std::abs(mixed) / 2.0);
      return static_cast<std::uint8_t>(std::clamp(128.0 + (mixed < 0 ? -root : root), 0.0, 255.0));
    };
    vessel_->advance(0.1, ThrustCommand{command(stick.surge_ref + stick.head_ref),
                                        command(stick.surge_ref - stick.head_ref)});
    time_s_ += 0.1;
    const VehiclePose& pose = vessel_->state().pose;
    farthest_m = std::max(farthest_m, pose.p_WV.xy_m.norm());
    if (++steps_ % 2 == 0 || steps_ == 1) {
      seen_.x_m = pose.p_WV.xy_m.x() + fix_sigma_m * noise_(random_);
      seen_.y_m = pose.p_WV.xy_m.y() + fix_sigma_m * noise_(random_);
      seen_.fixed_s = time_s_;
    }
    seen_.time_s = time_s_;
    seen_.heading_rad = wrap_to_pi(pose.heading.rad() + heading_offset_rad);
    return seen_;
  }
  [[nodiscard]] WalkResult walk(const WalkOptions& options) {
    Walk walk{options, [this](Stick stick) { return steer(stick); }, [](const std::string&) {}};
    return walk.sail();
  }

 private:
  std::optional<Vessel> vessel_;
  Sighting seen_;
  double time_s_ = 100.0;
  int steps_ = 0;
  std::mt19937 random_{7};
  std::normal_distribution<double> noise_{0.0, 1.0};
};

void check_speeds(const HandledBoat& boat, const WalkResult& result, double within) {
  REQUIRE(result.fault.empty());
  REQUIRE(result.calibration.pairs.size() == 4);
  for (const PairOfRuns& pair : result.calibration.pairs) {
    INFO("SurgeRef " << pair.surge_ref);
    CHECK(pair.speed_m_s == Approx(steady_speed_m_s(boat.hull, pair.surge_ref)).epsilon(within));
  }
}

TEST_CASE("walk: finds every wiring, and the speeds through it", "[cli]") {
  for (int i = 0; i < 8; ++i) {
    HandledBoat boat;
    boat.hull.wires_swapped = (i & 4) != 0;
    boat.hull.left_reversed = (i & 2) != 0;
    boat.hull.right_reversed = (i & 1) != 0;
    const WalkResult result = boat.walk({});
    REQUIRE(result.wiring.has_value());
    INFO(described(*result.wiring));
    CHECK(result.wiring->swapped == boat.hull.wires_swapped);
    CHECK(result.wiring->left_reversed == boat.hull.left_reversed);
    CHECK(result.wiring->right_reversed == boat.hull.right_reversed);
    // A command is cut to a whole number towards 0: astern that is up to a count more.
    const bool astern = boat.hull.left_reversed || boat.hull.right_reversed;
    check_speeds(boat, result, astern ? 0.06 : 0.03);
    CHECK(boat.last.surge_ref == 0);
    CHECK(boat.last.head_ref == 0);
  }
}

TEST_CASE("walk: a current and a heading sensor that is off are told from the boat", "[cli]") {
  HandledBoat boat;
  boat.water = {0.08, -0.05, false};
  boat.heading_offset_rad = to_rad(7.0);
  WalkOptions options;
  options.room_m = 60.0;  // it is carried along for some minutes
  const WalkResult result = boat.walk(options);
  check_speeds(boat, result, 0.03);
  CHECK(to_deg(result.calibration.heading_offset_rad) == Approx(7.0).margin(1.0));
  CHECK(result.calibration.pairs.back().current_x_m_s == Approx(0.08).margin(0.02));
  CHECK(result.calibration.pairs.back().current_y_m_s == Approx(-0.05).margin(0.02));
}

TEST_CASE("walk: fixes that scatter by half a metre will do for a long walk", "[cli]") {
  HandledBoat boat;
  boat.fix_sigma_m = 0.5;
  WalkOptions options;
  options.leg_s = 60.0;
  options.room_m = 70.0;
  const WalkResult result = boat.walk(options);
  check_speeds(boat, result, 0.05);
  CHECK(std::abs(to_deg(result.calibration.heading_offset_rad)) < 3.0);
}

TEST_CASE("walk: it keeps to its room and its time", "[cli]") {
  HandledBoat boat;
  WalkOptions options;
  options.room_m = 10.0;
  const WalkResult near = boat.walk(options);
  CHECK(boat.farthest_m < 16.0);  // half as much again, and what it coasts
  CHECK(near.wiring.has_value());
  HandledBoat slow;
  options.time_limit_s = 60.0;
  const WalkResult early = slow.walk(options);
  CHECK(early.fault == "not done within 60 s");
  CHECK(slow.last.surge_ref == 0);
  // A current that carries it off ends the walk with the stick at rest.
  HandledBoat adrift;
  adrift.water = {1.5, 0.0, false};
  CHECK(adrift.walk(options).fault.find("m from where it began") != std::string::npos);
  CHECK(adrift.last.surge_ref == 0);
  CHECK(adrift.farthest_m < 20.0);
}

TEST_CASE("walk: a boat that does not answer, or is taken away, ends it", "[cli]") {
  HandledBoat dead;
  dead.hull.thrust_ahead_n = dead.hull.thrust_astern_n = 1e-6;
  CHECK(dead.walk({}).fault.find("nothing moved or turned") != std::string::npos);
  HandledBoat taken;
  taken.stops_at_s = 130.0;
  const WalkResult result = taken.walk({});
  CHECK(result.fault == "stopped");
  CHECK(result.calibration.pairs.empty());
}

}  // namespace
}  // namespace lodesman::cli
