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

TEST_CASE("voyage: the scene is the scenario's, or what the configuration puts in its place",
          "[boat]") {
  using enum SonarScene;
  const auto sonar = [](const std::vector<std::string>& sets, SonarScene scene) {
    const BoatConfig config = config_with(sets);
    Scenario scenario = load_named_scenario("paper-static", config.speeds);
    scenario.sonar.scene = scene;
    scenario.sonar.detections.missed = scene == kDetections ? 0.3 : 0.0;
    CHECK(voyage_of(config, &scenario).known_scene.has_value() ==
          (sailed_sonar(config, scenario).scene == kObstacles));
    return sailed_sonar(config, scenario);
  };
  for (const SonarScene own : {kObstacles, kBeams, kDetections}) {
    CHECK(sonar({}, own).scene == own);
    CHECK(sonar({"simulation.scene=obstacles"}, own).scene == kObstacles);
    CHECK(sonar({"simulation.scene=beams"}, own).scene == kBeams);
    CHECK(sonar({"simulation.scene=detections"}, own).scene == kDetections);
  }
  CHECK(sonar({}, kDetections).detections.missed == Approx(0.3));
  const std::vector<std::string> sets{"simulation.scene=detections",
                                      "simulation.detections.split=0.2"};
  CHECK(sonar(sets, kDetections).detections.missed == Approx(0.0));
  CHECK(sonar(sets, kBeams).detections.split == Approx(0.2));
}

TEST_CASE("voyage: errors of detections beside another scene are refused", "[boat]") {
  std::string refusal;
  try {
    static_cast<void>(config_with({"simulation.detections.split=0.2"}));
  } catch (const StartupError& error) {
    refusal = error.what();
  }
  CHECK(refusal.find("simulation.detections: is of scene = \"detections\" alone") !=
        std::string::npos);
}

TEST_CASE("voyage: detections are of the simulated sonar alone", "[boat]") {
  const auto refusal_of = [](const std::string& sonar, const std::string& scene) {
    const BoatConfig config =
        config_with({"devices.sonar=\"" + sonar + "\"", "simulation.scenario=paper-static",
                     "simulation.scene=" + scene});
    const std::optional<Scenario> scenario = simulated_scenario(config);
    try {
      require_sound(config, &*scenario);
    } catch (const StartupError& error) {
      return std::string{error.what()};
    }
    return std::string{};
  };
  CHECK(refusal_of("sim:", "detections").empty());
  CHECK(refusal_of("loop:delta_t", "beams").empty());
  for (const char* other : {"loop:delta_t", "delta_t:127.0.0.1"}) {
    CHECK(refusal_of(other, "detections").find("devices.sonar: must be sim: in the scene") !=
          std::string::npos);
  }
}
