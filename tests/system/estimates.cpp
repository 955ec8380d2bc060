// SPDX-License-Identifier: Apache-2.0
// The whole boat in lock-step on fixes instead of the truth: what its estimate is good for.
#include <cmath>

#include "deploy/boat/configuration.h"
#include "deploy/operator/run/lockstep_run.h"
#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::cli;

namespace {

[[nodiscard]] Scenario on_fixes(double sigma_m, std::uint64_t seed) {
  const BoatConfig configuration = load_configuration("default", {});
  Scenario scenario = load_named_scenario("paper-multiple", configuration.speeds);
  scenario.seed = seed;
  scenario.position = {PositionSource::kGps, sigma_m};
  return scenario;
}

[[nodiscard]] RunResult sail(const Scenario& scenario) {
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const RunProgress&)> silent = [](const RunProgress&) {};
  return run_lockstep({load_configuration("default", {}), scenario, never, silent, {}}).result;
}

[[nodiscard]] Fault fault_of(FaultDevice device, FaultKind kind, double at_s, double for_s) {
  Fault fault;
  fault.device = device;
  fault.kind = kind;
  fault.at_s = at_s;
  fault.duration_s = for_s;
  return fault;
}

}  // namespace

TEST_CASE("estimates: on fixes of 2 m nothing is hit among several obstacles", "[system]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const RunResult result = sail(on_fixes(2.0, seed));
    CHECK(result.outcome == "goal");
    CHECK(result.goal_error_m < 1.5);
  }
}

TEST_CASE("G5: estimates: ten seconds without a fix are sailed through", "[system]") {
  Scenario scenario = on_fixes(1.0, 1);
  scenario.faults = {fault_of(FaultDevice::kPosition, FaultKind::kStall, 30.0, 10.0)};
  const RunResult bridged = sail(scenario);
  CHECK(bridged.outcome == "goal");
  CHECK(bridged.goal_error_m < 1.5);
  scenario.faults = {fault_of(FaultDevice::kPosition, FaultKind::kStall, 30.0, 500.0)};
  CHECK(sail(scenario).outcome == "time_limit");  // lost after a while: it does not sail on
}

TEST_CASE("B1: estimates: with dead thrusters no source of position says goal", "[system]") {
  struct Case {
    PositionSource source;
    FaultKind kind;
  };
  // A box that swallows commands looks alive: only what is measured can tell.
  for (const Case& dead : {Case{PositionSource::kGps, FaultKind::kDisconnect},
                           Case{PositionSource::kGps, FaultKind::kStall},
                           Case{PositionSource::kTruth, FaultKind::kStall},
                           Case{PositionSource::kDeadReckoning, FaultKind::kDisconnect}}) {
    CAPTURE(static_cast<int>(dead.source), static_cast<int>(dead.kind));
    Scenario scenario = on_fixes(1.0, 1);
    scenario.position.source = dead.source;
    scenario.faults = {fault_of(FaultDevice::kThruster, dead.kind, 40.0, 500.0)};
    const RunResult result = sail(scenario);
    // One that is gone has cost the arming, and with it the mission.
    CHECK(result.outcome == (dead.kind == FaultKind::kDisconnect ? "aborted" : "time_limit"));
    CHECK_FALSE(result.reached);
    CHECK(result.estimate_error_m < 2.0);
  }
}
