// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/voyage.h"

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/named_scenario.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

BoatConfig config_with(std::vector<std::string> sets) {
  CommonOptions options;
  options.sets = std::move(sets);
  options.sets.emplace_back("origin.deg=[60.0, 20.0]");
  return load_configuration("default", options);
}

Voyage simulated(const BoatConfig& config) {
  const Scenario scenario = load_named_scenario("paper-static", config.speeds);
  return voyage_of(config, &scenario);
}

}  // namespace

TEST_CASE("voyage: a simulated boat lies in its scenario's waters, a real one where its fixes say",
          "[boat]") {
  CHECK(simulated(config_with({})).origin.value().latitude_deg == Approx(35.0));
  CHECK(simulated(config_with({"simulation.vessel=estimate"})).origin.value().latitude_deg ==
        Approx(60.0));
  CHECK(voyage_of(config_with({}), nullptr).origin.value().latitude_deg == Approx(60.0));
}

TEST_CASE("voyage: at_start leaves the origin to the first fixes, a scenario's own stands",
          "[boat]") {
  CHECK_FALSE(voyage_of(config_with({"origin.at_start=true"}), nullptr).origin);
  CHECK(simulated(config_with({"origin.at_start=true"})).origin.value().latitude_deg ==
        Approx(35.0));
}

TEST_CASE("voyage: at_start is refused where no fixes are taken", "[boat]") {
  const auto refusal_of = [](const std::string& position) {
    const BoatConfig config = config_with(
        {"devices.heading=nav440:/dev/a", "devices.sonar=sim:", "devices.position=" + position,
         "devices.thrusters=none", "simulation.vessel=estimate",
         "simulation.scenario=tank-straight", "origin.at_start=true"});
    const std::optional<Scenario> scenario = simulated_scenario(config);
    try {
      require_sound(config, &*scenario);
    } catch (const StartupError& error) {
      return std::string{error.what()};
    }
    return std::string{};
  };
  CHECK(refusal_of("none").find("origin.at_start: the first fixes would be the origin") !=
        std::string::npos);
  CHECK(refusal_of("nmea:/dev/b").empty());
}

TEST_CASE("voyage: the position comes from what there is, unless the configuration says from where",
          "[boat]") {
  using enum PositionSource;
  CHECK(simulated(config_with({})).position_source == kTruth);  // as the scenario has it
  CHECK(simulated(config_with({"simulation.vessel=estimate"})).position_source == kGps);
  CHECK(voyage_of(config_with({}), nullptr).position_source == kGps);
  CHECK(voyage_of(config_with({"devices.position=none"}), nullptr).position_source ==
        kDeadReckoning);
  CHECK(simulated(config_with({"estimator.position_source=gps"})).position_source == kGps);
}

TEST_CASE("voyage: without a scenario there is neither a mission nor a known scene", "[boat]") {
  const Voyage voyage = voyage_of(config_with({}), nullptr);
  CHECK_FALSE(voyage.mission);
  CHECK_FALSE(voyage.known_scene);
  CHECK(simulated(config_with({})).mission.value().goal_count == 1);
}
