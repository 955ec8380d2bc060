// SPDX-License-Identifier: Apache-2.0
// lodesman calibrate on a simulated boat in real time, whose thrusters are exchanged in the water.
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "deploy/boat/named_scenario.h"
#include "high_level/mission/token_file.h"
#include "tests/support/catch.h"
#include "tests/system/listening_port.h"
#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// A boat that waits for its start and has a receiver, with left and right exchanged.
class MiswiredBoat {
 public:
  MiswiredBoat() {
    std::ostringstream hull;
    hull << std::ifstream{*hull_file("paper-asv")}.rdbuf();
    const auto swapped = scratch_.file("hull.toml", hull.str() + "wires_swapped = true\n");
    const auto scenario = scratch_.file(
        "pond.toml", scenario_text(25.0) + "[position]\nsource = \"gps\"\ngps_sigma_m = 0.02\n");
    launcher_.emplace(program("lodesman"), sim(scenario, scratch_.file("run"),
                                               {"--wait-start", "--quiet", "--set",
                                                "simulation.hull=" + swapped.string()}));
    segment = "lodesman-sim-" + std::to_string(launcher_->pid());
    REQUIRE(eventually([&] {
      const pid_t high = child_of(launcher_->pid(), "lodesman-high");
      port_ = high != 0 ? listening_port(high) : 0;
      return port_ != 0 && find_token_file(static_cast<std::uint16_t>(port_)).has_value();
    }));
  }
  ~MiswiredBoat() { kill(launcher_->pid(), SIGTERM); }
  MiswiredBoat(const MiswiredBoat&) = delete;
  MiswiredBoat& operator=(const MiswiredBoat&) = delete;

  // What it says is kept in `said`.
  [[nodiscard]] std::vector<std::string> calibrate(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"calibrate", "--port",  std::to_string(port_),
                                       "--segment", segment,   "--room",
                                       "30",        "--quiet", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  [[nodiscard]] std::string said() const {
    std::ostringstream text;
    text << std::ifstream{scratch_.file("said")}.rdbuf();
    return text.str();
  }
  // Standard error of a child, and with it its standard output, into `said`.
  [[nodiscard]] std::function<void()> into_said() const {
    return [file = scratch_.file("said").string()] {
      redirect(STDOUT_FILENO, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
    };
  }

  std::string segment;

 private:
  Scratch scratch_{"calibrate"};
  std::optional<Program> launcher_;
  int port_ = 0;
};

}  // namespace

TEST_CASE("calibrate: it finds exchanged thrusters and a speed, and leaves the boat disarmed",
          "[system]") {
  const MiswiredBoat boat;
  Program calibrate{program("lodesman"), boat.calibrate({"--surge", "91", "--leg", "14"}),
                    boat.into_said()};
  REQUIRE(calibrate.status(seconds{250}) == 0);
  INFO(boat.said());
  const auto found = nlohmann::json::parse(boat.said());
  CHECK(found["wiring"]["swapped"] == true);
  CHECK(found["wiring"]["left_reversed"] == false);
  CHECK(found["wiring"]["right_reversed"] == false);
  REQUIRE(found["speeds"].size() == 1);
  CHECK(found["speeds"][0]["speed_m_s"].get<double>() == Approx(1.116).epsilon(0.05));
  CHECK(std::abs(found["heading_offset_deg"].get<double>()) < 3.0);
  const auto board = SharedBlackboard::observe(boat.segment, kPatience);
  Reader<ThrustStatus> thrust{board->thrust_status};
  CHECK(await_first(thrust).value.state == ThrustState::kDisarmed);
}

TEST_CASE("calibrate: told to end, it leaves the boat neutral and disarmed", "[system]") {
  const MiswiredBoat boat;
  const auto board = SharedBlackboard::observe(boat.segment, kPatience);
  Reader<ThrustApplied> applied{board->thrust_applied};
  Reader<ThrustStatus> thrust{board->thrust_status};
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Program calibrate{program("lodesman"), boat.calibrate({"--surge", "57"}), boat.into_said()};
    REQUIRE(eventually([&] { return await_first(applied).value.left > 128; }));
    kill(calibrate.pid(), signal);
    CHECK(calibrate.status() == 1);
    CHECK(boat.said().find("\"fault\":\"stopped\"") != std::string::npos);
    REQUIRE(eventually([&] { return await_first(applied).value.left == 128; }));
    CHECK(await_first(thrust).value.state == ThrustState::kDisarmed);
  }
}
