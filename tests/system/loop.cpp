// SPDX-License-Identifier: Apache-2.0
// The whole boat in lock-step on real drivers, whose devices are emulated to the byte: on lines
// that take no time it does what it does on simulated ones, and nothing but the scenario decides.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <regex>

#include "deploy/operator/run/lockstep_run.h"
#include "tests/system/looped_boat.h"

using namespace lodesman;
using namespace lodesman::cli;
using namespace lodesman::testing;

namespace {

using std::chrono::seconds;
using Sets = std::vector<std::string>;

// Every driver is ready by then, and every simulated device since long before.
constexpr Time kStart{seconds{8}};

const std::string kHeading = R"(devices.heading="loop:nav440")";
const std::string kBatchedHeading = R"(devices.heading="loop:nav440?batch_s=0.016")";
const std::string kMaestro = R"(devices.thrusters="loop:maestro")";
const std::string kRoboClaw = R"(devices.thrusters="loop:roboclaw")";
const std::string kInstantHeading = R"(devices.heading="loop:nav440?wire=instant&flicker=off")";
const std::string kSonar = R"(devices.sonar="loop:delta_t")";
const std::string kInstantSonar = R"(devices.sonar="loop:delta_t?wire=instant")";
const std::string kReceiver = R"(devices.position="loop:nmea?baud=38400&latency_s=0.04")";
const std::string kInstantMaestro = R"(devices.thrusters="loop:maestro?wire=instant")";

struct Sailed {
  std::vector<Publication> plans;
  std::vector<Publication> helm;
  Time first_attitude{};
  RunRecord record;
};

[[nodiscard]] Sailed sail(const std::string& profile, const std::string& scenario,
                          const Sets& sets) {
  LoopedBoat boat{profile, scenario, sets};
  ChannelBook<Plan> plans{boat.board().plan};
  ChannelBook<HelmCommand> helm{boat.board().helm_command};
  Reader<Attitude> attitude{boat.board().attitude};
  Sailed sailed;
  sailed.record = boat.sail(kStart, [&] {
    plans.update();
    helm.update();
    if (const auto* first = attitude.next(); first != nullptr && sailed.first_attitude == Time{}) {
      sailed.first_attitude = first->stamp;
    }
  });
  sailed.plans = plans.publications();
  sailed.helm = helm.publications();
  return sailed;
}

void require_twins(const Sets& looped) {
  for (const char* profile : {"default", "paper"}) {
    for (const char* scenario : {"paper-static", "paper-moving"}) {
      CAPTURE(profile, scenario);
      const Sailed simulated = sail(profile, scenario, {});
      const Sailed real = sail(profile, scenario, looped);
      CHECK(simulated.record.result.outcome == "goal");
      CHECK(simulated.helm.size() > 1000);
      CHECK(simulated.plans.size() > 50);
      CHECK(real.first_attitude > simulated.first_attitude);  // a driver has been at work
      CHECK(where_they_part(simulated.plans, real.plans) == "");
      CHECK(where_they_part(simulated.helm, real.helm) == "");
    }
  }
}

}  // namespace

TEST_CASE("loop: on a line without delay, plans and helm are those of a simulated AHRS",
          "[system][plain]") {
  require_twins({kInstantHeading});
}

TEST_CASE("loop: and so with a Maestro beside it", "[system][plain]") {
  require_twins({kInstantHeading, kInstantMaestro});
}

// A datagram is stamped when it is taken, which is a moment after the world's step.
TEST_CASE("loop: without delay, a Delta T brings the boat the way of a simulated sonar",
          "[system][plain]") {
  for (const char* profile : {"default", "paper"}) {
    for (const char* scenario : {"paper-static", "paper-moving"}) {
      CAPTURE(profile, scenario);
      const RunResult simulated = sail(profile, scenario, {}).record.result;
      const RunResult looped = sail(profile, scenario, {kInstantSonar}).record.result;
      CHECK(looped.outcome == "goal");
      CHECK(looped.time_s == Approx(simulated.time_s).margin(0.5));
      CHECK(looped.min_inoffensive_distance_m.value() ==
            Approx(simulated.min_inoffensive_distance_m.value()).margin(0.02));
    }
  }
}

namespace {

constexpr Time kAfterStart = kStart + std::chrono::milliseconds{50};

// The pings of the first ten seconds under way, and when the task had them.
[[nodiscard]] std::vector<Stamped<SonarPing>> pings_of(const Sets& sets) {
  LoopedBoat boat{"default", "paper-moving", sets};
  Reader<SonarPing> reader{boat.board().sonar_ping};
  std::vector<Stamped<SonarPing>> pings;
  const RunRecord record = boat.sail(kStart, [&] {
    while (const auto* ping = reader.next()) {
      if (ping->value.captured > kAfterStart && pings.size() < 100) {
        pings.push_back(*ping);
      }
    }
  });
  CHECK(record.result.outcome == "goal");
  return pings;
}

[[nodiscard]] bool is_same_picture(const SonarPing& a, const SonarPing& b) {
  return a.beams == b.beams && a.bins == b.bins && a.echo_count == b.echo_count &&
         std::abs(a.range_m - b.range_m) < 1e-9 &&
         std::abs(a.bearing_rad(0) - b.bearing_rad(0)) < 1e-9 &&
         std::equal(a.echo.begin(), a.echo.begin() + a.echo_count, b.echo.begin());
}

}  // namespace

TEST_CASE("loop: the ping that arrives is the ping that was sent, echo by echo", "[system]") {
  const auto simulated = pings_of({});
  const auto looped = pings_of({kInstantSonar});
  REQUIRE(simulated.size() == 100);
  REQUIRE(looped.size() == 100);
  bool any_echo = false;
  for (std::size_t i = 0; i < looped.size(); ++i) {
    const Duration later = looped[i].value.captured - simulated[i].value.captured;
    REQUIRE(later >= Duration::zero());
    REQUIRE(later < std::chrono::milliseconds{1});
    REQUIRE(is_same_picture(looped[i].value, simulated[i].value));
    const auto& echo = looped[i].value.echo;
    any_echo = any_echo || std::any_of(echo.begin(), echo.end(), [](auto e) { return e != 0; });
  }
  CHECK(any_echo);
}

TEST_CASE("loop: a ping's stamp is of its sending, however late it comes", "[system]") {
  for (const auto& ping : pings_of({kSonar})) {
    // 50 ms from ping to datagram, on the world's grid of 20; and a moment until it is polled.
    REQUIRE(ping.stamp - ping.value.captured >= std::chrono::milliseconds{59});
    REQUIRE(ping.stamp - ping.value.captured <= std::chrono::milliseconds{75});
    const Duration past = ping.value.captured.time_since_epoch() % std::chrono::milliseconds{20};
    REQUIRE(std::min(past, Duration{std::chrono::milliseconds{20}} - past) <=
            std::chrono::milliseconds{10});
  }
}

TEST_CASE("loop: a receiver's fixes are of the time that they say, and as far off as they are made",
          "[system]") {
  LoopedBoat boat{"default", "paper-moving", {kReceiver}};
  Reader<PositionFix> fixes{boat.board().position_fix};
  Reader<WorldTruth> truths{boat.board().world_truth};
  const LocalFrame frame{{35.0, 139.0}};
  std::map<Time, WorldPoint> truth_at;
  double sum2_m2 = 0.0;
  int compared = 0;
  const RunRecord record = boat.sail(kStart, [&] {
    while (const auto* truth = truths.next()) {
      truth_at[truth->stamp] = {{truth->value.x_m, truth->value.y_m}};
    }
    while (const auto* fix = fixes.next()) {
      const auto after = truth_at.lower_bound(fix->value.measured);
      if (after == truth_at.end()) {
        continue;
      }
      const WorldPoint at = frame.to_world({fix->value.latitude_deg, fix->value.longitude_deg});
      sum2_m2 += (at.xy_m - after->second.xy_m).squaredNorm();
      ++compared;
      REQUIRE(fix->stamp - fix->value.measured < std::chrono::milliseconds{150});
    }
  });
  CHECK(record.result.outcome == "goal");
  CHECK(compared > 400);
  CHECK(std::sqrt(sum2_m2 / 2.0 / compared) == Approx(1.0).epsilon(0.1));
}

namespace {

// Greater than 0: to the right of the straight way, which is the y axis in both scenarios.
[[nodiscard]] double widest_m(const RunRecord& record) {
  double widest = 0.0;
  for (const TrajectoryRow& row : record.trajectory) {
    widest = std::abs(row.x_m) > std::abs(widest) ? row.x_m : widest;
  }
  return widest;
}

}  // namespace

// Delays move what is decided a little. In paper-static the obstacle lies on the straight way:
// which side the paper's profile takes is decided by less than a line's delay, and by a jitter of 5
// ms too where nothing but simulated devices is aboard.
TEST_CASE("loop: on a line of its real speed the boat arrives as well, on the same side",
          "[system][plain]") {
  for (const char* profile : {"default", "paper"}) {
    for (const char* scenario : {"paper-static", "paper-moving"}) {
      const Sailed simulated = sail(profile, scenario, {});
      for (const Sets& sets : {Sets{kHeading}, Sets{kHeading, kMaestro}, Sets{kHeading, kRoboClaw},
                               Sets{kBatchedHeading, kMaestro}}) {
        CAPTURE(profile, scenario, sets);
        const Sailed real = sail(profile, scenario, sets);
        CHECK(where_they_part(simulated.helm, real.helm) != "");  // it has been another run
        const RunResult& result = real.record.result;
        CHECK(result.outcome == "goal");
        CHECK(result.time_s == Approx(simulated.record.result.time_s).margin(1.0));
        CHECK(result.min_inoffensive_distance_m.value() ==
              Approx(simulated.record.result.min_inoffensive_distance_m.value()).margin(0.05));
        if (std::string_view{profile} == "default" ||
            std::string_view{scenario} != "paper-static") {
          CHECK(widest_m(real.record) * widest_m(simulated.record) > 0.0);
        }
      }
    }
  }
}

namespace {

constexpr double kHalfBit_rad = std::numbers::pi / 65536.0;

struct HeadingErrors {
  double largest_rad = 0.0;
  int compared = 0;
};

// Between each attitude and the truth of the moment that it says it was measured.
[[nodiscard]] HeadingErrors heading_errors(const std::string& heading) {
  LoopedBoat boat{"paper", "paper-moving", {heading}};
  Reader<Attitude> attitudes{boat.board().attitude};
  Reader<WorldTruth> truths{boat.board().world_truth};
  std::map<Time, double> true_rad;
  HeadingErrors errors;
  const RunRecord record = boat.sail(kStart, [&] {
    while (const auto* truth = truths.next()) {
      true_rad[truth->stamp] = truth->value.heading_rad;
    }
    while (const auto* attitude = attitudes.next()) {
      const auto truth = true_rad.find(attitude->value.measured);
      if (truth != true_rad.end()) {
        ++errors.compared;
        errors.largest_rad = std::max(
            errors.largest_rad, std::abs(std::remainder(attitude->value.heading_rad - truth->second,
                                                        2.0 * std::numbers::pi)));
      }
    }
  });
  CHECK(record.result.outcome == "goal");
  return errors;
}

}  // namespace

TEST_CASE("loop: a heading comes through unharmed but for half a bit of the wire", "[system]") {
  const HeadingErrors exact = heading_errors(R"(devices.heading="sim:ahrs?like=nothing")");
  CHECK(exact.compared > 4000);
  CHECK(exact.largest_rad <= 0.0);
  const HeadingErrors looped = heading_errors(kInstantHeading);
  CHECK(looped.compared > 4000);
  CHECK(looped.largest_rad > kHalfBit_rad / 2.0);  // it has been through the wire
  CHECK(looped.largest_rad <= kHalfBit_rad * (1.0 + 1e-9));
}

namespace {

[[nodiscard]] RunRecord sail_by_itself(const std::string& profile, const Sets& sets,
                                       const std::string& faults = {}, std::uint64_t seed = 1) {
  CommonOptions options;
  options.sets = sets;
  const BoatConfig configuration = load_configuration(profile, options);
  Scenario scenario = load_named_scenario("paper-static", configuration.speeds);
  scenario.faults = read_faults(TomlDocument::from_text(faults, "faults.toml").root());
  scenario.seed = seed;
  require_sound(configuration, &scenario);
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const RunProgress&)> silent = [](const RunProgress&) {};
  return run_lockstep({configuration, scenario, never, silent, {}});
}

[[nodiscard]] std::string fault_table(const std::string& device, const std::string& kind,
                                      const std::string& more = {}) {
  return "[[fault]]\ndevice = \"" + device + "\"\nkind = \"" + kind +
         "\"\nat_s = 20.0\nduration_s = 20.0\n" + more;
}

}  // namespace

TEST_CASE("loop: the same scenario gives the same recording, with jitter and faults too",
          "[system][plain]") {
  const std::string faults = fault_table("ahrs", "flip", "rate = 0.01\n") +
                             fault_table("sonar", "drop", "rate = 0.1\n") +
                             fault_table("position", "flip", "rate = 0.01\n");
  for (const std::string& box : {kMaestro, kRoboClaw}) {
    std::vector<std::string> hashes;
    for (const char* jitter_s : {"0.0", "0.002", "0.1"}) {
      CAPTURE(box, jitter_s);
      const Sets sets{kHeading, kSonar, kReceiver, box,
                      std::string{"simulation.lockstep_jitter_s="} + jitter_s};
      const auto hash = [&](std::uint64_t seed) {
        const RunResult result = sail_by_itself("default", sets, faults, seed).result;
        CHECK(result.plans > 100);
        return result.recording_hash.value();
      };
      hashes.push_back(hash(1));
      CHECK(hash(1) == hashes.back());
      CHECK(hash(2) != hashes.back());
    }
    CHECK(hashes[0] != hashes[1]);
    CHECK(hashes[1] != hashes[2]);
  }
}

// A servo box that has forgotten what it was told is tried anew for longer than thrusters stay
// armed without one, so what is left is to say so; the same where it is gone for that long.
TEST_CASE("loop: twenty seconds of a fault cost no collision, and the run says how it ended",
          "[system][plain]") {
  const struct {
    std::string fault;
    bool arrives;
    bool is_of_sonar = false;
  } rows[] = {{fault_table("sonar", "drop", "rate = 0.01\n") +
                   fault_table("sonar", "reorder", "rate = 0.01\n") +
                   fault_table("sonar", "duplicate", "rate = 0.01\n") +
                   fault_table("sonar", "cut", "rate = 0.01\n") + fault_table("sonar", "foreign"),
               true, true},
              {fault_table("ahrs", "flip", "rate = 0.01\n"), true},
              {fault_table("ahrs", "replug", "rate = 10.0\n"), true},
              {fault_table("thruster", "reset"), false},
              {fault_table("thruster", "disconnect"), false}};
  for (const char* profile : {"default", "paper"}) {
    for (const std::string& box : {kMaestro, kRoboClaw}) {
      for (const auto& row : rows) {
        CAPTURE(profile, box, row.fault);
        const Sets sets = row.is_of_sonar ? Sets{kHeading, kSonar, box} : Sets{kHeading, box};
        const RunResult whole = sail_by_itself(profile, sets).result;
        const RunResult result = sail_by_itself(profile, sets, row.fault).result;
        CHECK(result.recording_hash != whole.recording_hash);  // it has been felt
        CHECK_FALSE(result.collided);
        CHECK(result.min_hull_clearance_m.value() > 0.5);
        if (row.arrives) {
          CHECK(result.outcome == "goal");
        } else if (result.outcome != "goal") {
          CHECK(result.outcome == "aborted");
          REQUIRE_FALSE(result.notices.empty());
          CHECK(result.notices.front().text.find("thruster box") != std::string::npos);
        }
      }
    }
  }
}

TEST_CASE("loop: a fault of bytes is refused where a device has none, with the device's place",
          "[system]") {
  const auto refusal = [](const Sets& sets, const std::string& faults) -> std::string {
    try {
      static_cast<void>(sail_by_itself("default", sets, faults));
    } catch (const StartupError& error) {
      return error.what();
    }
    return "";
  };
  const std::string of_ahrs = fault_table("ahrs", "flip", "rate = 0.01\n");
  const std::string of_box = fault_table("thruster", "reset");
  CHECK(std::regex_search(
      refusal({kMaestro}, of_ahrs),
      std::regex{R"(default\.toml:\d+: devices\.heading: the scenario's fault "ahrs flip")"}));
  CHECK(std::regex_search(
      refusal({kHeading}, of_box),
      std::regex{R"(default\.toml:\d+: devices\.thrusters: .*"thruster reset")"}));
  CHECK(refusal({}, fault_table("ahrs", "stall")) == "");
}
