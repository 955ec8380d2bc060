// SPDX-License-Identifier: Apache-2.0
// A boat that is started by hand, with nothing but its configuration, and told where to go: two
// real processes and the operator's command.
#include <iostream>

#include "high_level/mission/token_file.h"
#include "tests/support/catch.h"
#include "tests/support/text_of.h"
#include "tests/system/boat.h"
#include "tests/system/listening_port.h"
#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

class HandStartedBoat {
 public:
  explicit HandStartedBoat(const std::string& name) : scratch_{name} {
    const fs::path config = scratch_.file(
        "boat.toml", "[boat]\nsegment = \"" + segment_ + "\"\n[simulation]\nscenario = \"" +
                         water().string() + "\"\n[command_socket]\nport = 0\n");
    low_ = std::make_unique<ChildProcess>("lodesman-low",
                                          std::vector<std::string>{"--config", config.string()});
    high_ = std::make_unique<ChildProcess>("lodesman-high",
                                           std::vector<std::string>{"--config", config.string()});
    board_.emplace(SharedBlackboard::observe(segment_, kPatience));
    mission_.emplace((*board_)->mission_status);
    truth_.emplace((*board_)->world_truth);
    thrust_.emplace((*board_)->thrust_applied);
    REQUIRE(eventually([&] {
      port_ = static_cast<std::uint16_t>(listening_port(high_->pid()));
      return port_ != 0 && find_token_file(port_).has_value();
    }));
    REQUIRE(eventually([&] { return tell({"status"}) == 0 && mission_->latest() != nullptr; }));
  }
  ~HandStartedBoat() {
    high_.reset();
    low_.reset();
    board_.reset();
    remove_dead_segment(segment_);
  }

  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    return scratch_.file(name, text).string();
  }
  [[nodiscard]] std::unique_ptr<ChildProcess> call(std::vector<std::string> words) const {
    words.insert(words.end(), {"--port", std::to_string(port_), "--quiet"});
    return std::make_unique<ChildProcess>("lodesman", words);
  }
  // Follows a mission, and writes what it says into that file.
  [[nodiscard]] std::unique_ptr<Program> follow(const std::string& mission,
                                                const std::string& file) const {
    return std::make_unique<Program>(
        program("lodesman"),
        std::vector<std::string>{"start", "--mission", mission, "--follow", "--port",
                                 std::to_string(port_)},
        [&] { redirect(STDERR_FILENO, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC); });
  }
  [[nodiscard]] int tell(const std::vector<std::string>& words) const {
    const auto teller = call(words);
    REQUIRE(eventually([&] { return teller->ended().has_value(); }));
    return teller->exit_status().value_or(-1);
  }
  // As soon as the boat is ready.
  [[nodiscard]] bool is_obeyed(const std::vector<std::string>& words) const {
    return eventually([&] { return tell(words) == 0; });
  }
  [[nodiscard]] MissionStatus mission() { return await_first(*mission_).value; }
  [[nodiscard]] bool becomes(MissionState state) {
    return eventually([&] { return mission().state == state; });
  }
  [[nodiscard]] WorldTruth truth() { return await_first(*truth_).value; }
  [[nodiscard]] ThrustApplied thrust() { return await_first(*thrust_).value; }

 private:
  // Open water; the mission of this scenario is not sailed.
  [[nodiscard]] fs::path water() const {
    return scratch_.file("water.toml", scenario_text(60.0, 300.0));
  }

  Scratch scratch_;
  std::string segment_ = "lodesman-test-hand-" + std::to_string(getpid());
  std::unique_ptr<ChildProcess> low_;
  std::unique_ptr<ChildProcess> high_;
  std::optional<SharedBlackboard> board_;
  std::optional<Reader<MissionStatus>> mission_;
  std::optional<Reader<WorldTruth>> truth_;
  std::optional<Reader<ThrustApplied>> thrust_;
  std::uint16_t port_ = 0;
};

}  // namespace

TEST_CASE("missions: one after another, a goal changed under way, and an abort in the middle",
          "[system]") {
  HandStartedBoat boat{"missions"};
  CHECK(boat.mission().state == MissionState::kIdle);
  const std::string first =
      boat.file("first.toml", "goal_m = [0.0, 2.0]\ngoal_radius_m = 1.0\nspeed_m_s = 0.74\n");
  REQUIRE(boat.is_obeyed({"start", "--mission", first}));
  REQUIRE(boat.becomes(MissionState::kReached));
  CHECK(boat.truth().y_m > 0.5);
  const double time_s = boat.truth().scenario_time_s;
  const std::string second = boat.file(
      "second.toml", "waypoints_m = [[0.0, 6.0]]\ngoal_m = [0.0, 40.0]\nspeed_m_s = 1.12\n");
  REQUIRE(boat.tell({"start", "--mission", second}) == 0);
  CHECK(boat.mission().surge_ref == 91);
  REQUIRE(eventually([&] { return boat.mission().goal_index == 1; }));
  CHECK(boat.truth().scenario_time_s > time_s);  // the world's time goes on
  REQUIRE(boat.tell({"goto", "-5,9", "8,9", "--speed", "0.74"}) == 0);
  CHECK(boat.mission().state == MissionState::kUnderWay);
  CHECK(boat.mission().goal_x_m == Approx(-5.0));
  CHECK(boat.mission().surge_ref == 57);
  REQUIRE(boat.tell({"hold"}) == 0);
  REQUIRE(boat.tell({"resume"}) == 0);
  REQUIRE(boat.tell({"abort"}) == 0);
  CHECK(boat.mission().state == MissionState::kAborted);
  REQUIRE(eventually([&] { return boat.thrust().left == 128 && boat.thrust().right == 128; }));
}

TEST_CASE("missions: what cannot be is refused, and what is sailed goes on", "[system]") {
  HandStartedBoat boat{"refused"};
  REQUIRE(boat.is_obeyed({"goto", "0,50"}));
  const std::uint64_t mission = boat.mission().mission;
  CHECK(boat.tell({"goto", "0,50", "--speed", "5"}) == 1);  // faster than the boat is
  CHECK(boat.tell({"goto", "north"}) == 2);
  const std::string typo = boat.file("typo.toml", "goal_m = [0.0, 2.0]\nspead = 1.0\n");
  CHECK(boat.tell({"start", "--mission", typo}) == 2);
  const std::string here = boat.file(
      "here.toml", "goal_m = [0, 30]\nkeep_out_m = [[-5, -5], [5, -5], [5, 5], [-5, 5]]\n");
  CHECK(boat.tell({"start", "--mission", here}) == 1);
  CHECK(boat.tell({"tune", "zones.least_margin_m=0"}) == 1);
  CHECK(boat.mission().mission == mission);
  CHECK(boat.mission().state == MissionState::kUnderWay);
  CHECK(boat.tell({"tune", "mission.speed_limit_m_s=0.222"}) == 0);
  REQUIRE(eventually([&] { return boat.mission().surge_ref == 16; }));
}

TEST_CASE("missions: a commander that dies is missed, and the mission does what it says",
          "[system]") {
  HandStartedBoat boat{"link"};
  const std::string mission =
      boat.file("m.toml", "goal_m = [0.0, 50.0]\nlink_lost = \"hold\"\nlink_lost_after_s = 1.5\n");
  REQUIRE(eventually([&] { return boat.tell({"goto", "0,50"}) == 0; }));
  auto commander = boat.call({"start", "--mission", mission, "--follow"});
  REQUIRE(eventually([&] { return boat.mission().mission >= 3; }));
  CHECK(boat.tell({"hold"}) == 1);  // somebody else commands
  kill(commander->pid(), SIGKILL);
  REQUIRE(boat.becomes(MissionState::kHolding));
  CHECK(boat.mission().cause == MissionCause::kLinkLost);
  REQUIRE(boat.is_obeyed({"resume"}));
  CHECK(boat.mission().state == MissionState::kUnderWay);
}

TEST_CASE("missions: who follows one is told why it holds, where that was no order", "[system]") {
  HandStartedBoat boat{"cause"};
  const std::string mission =
      boat.file("m.toml", "goal_m = [0.0, 50.0]\nlink_lost = \"hold\"\nlink_lost_after_s = 1.5\n");
  REQUIRE(eventually([&] { return boat.tell({"goto", "0,50"}) == 0; }));
  const std::string said = boat.file("said.txt", "");
  const auto commander = boat.follow(mission, said);
  const auto says = [&](const char* words) {
    return eventually([&] { return text_of(said).find(words) != std::string::npos; });
  };
  REQUIRE(says("mission: under_way\n"));
  kill(commander->pid(), SIGSTOP);
  CHECK(boat.becomes(MissionState::kHolding));
  kill(commander->pid(), SIGCONT);
  CHECK(says("mission: holding (link_lost)\n"));
  kill(commander->pid(), SIGTERM);
}
