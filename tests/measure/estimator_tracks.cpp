// SPDX-License-Identifier: Apache-2.0
#include "tests/measure/estimator_tracks.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "deploy/boat/configuration.h"
#include "deploy/operator/run/lockstep_run.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/base/random_stream.h"

namespace lodesman::measure {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kKnot_m_s = 1852.0 / 3600.0;
constexpr double kStep_s = 0.02;
constexpr double kLoggedPerSurgeRef_m_s = 0.03;  // recorded boats are faster than ours

// What was logged at one moment.
struct Logged {
  double t_s = 0.0;
  GeoPoint place;
  double heading_rad = 0.0;
  double speed_m_s = 0.0;
};

// 50 samples a second between what was logged.
[[nodiscard]] Track track_of(const std::string& name, const std::vector<Logged>& logged) {
  if (logged.size() < 10) {
    throw std::runtime_error{name + ": too little in it"};
  }
  Track track;
  track.name = name;
  track.speeds = SpeedTable::proportional(kLoggedPerSurgeRef_m_s);
  const LocalFrame frame{logged.front().place};
  const double begin_s = logged.front().t_s;
  const double end_s = logged.back().t_s;
  std::size_t next = 1;
  for (int i = 0; begin_s + i * kStep_s < end_s; ++i) {
    const double t_s = begin_s + i * kStep_s;
    while (logged[next].t_s <= t_s) {
      ++next;
    }
    const Logged& a = logged[next - 1];
    const Logged& b = logged[next];
    const double gap_s = b.t_s - a.t_s;
    const double share = (t_s - a.t_s) / gap_s;
    const double turn_rad = wrap_to_pi(b.heading_rad - a.heading_rad);
    TrackSample sample;
    sample.now = Time{std::chrono::seconds{100}} + from_seconds(i * kStep_s);
    sample.attitude = {sample.now, wrap_to_pi(a.heading_rad + share * turn_rad), turn_rad / gap_s};
    sample.surge_ref =
        std::min(100, static_cast<int>(std::lround(std::lerp(a.speed_m_s, b.speed_m_s, share) /
                                                   kLoggedPerSurgeRef_m_s)));
    const Vec from = frame.to_world(a.place).xy_m;
    sample.truth_m = from + share * (frame.to_world(b.place).xy_m - from);
    track.samples.push_back(sample);
  }
  return track;
}

[[nodiscard]] std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream{line};
  for (std::string field; std::getline(stream, field, ',');) {
    fields.push_back(field);
  }
  return fields;
}

// dddmm.mmmm and its hemisphere.
[[nodiscard]] double degrees_of(const std::string& text, const std::string& hemisphere) {
  const double number = std::stod(text);
  const double whole = std::floor(number / 100.0);
  const double deg = whole + (number - 100.0 * whole) / 60.0;
  return hemisphere == "S" || hemisphere == "W" ? -deg : deg;
}

[[nodiscard]] double seconds_of(const std::string& hhmmss) {
  return 3600.0 * std::stod(hhmmss.substr(0, 2)) + 60.0 * std::stod(hhmmss.substr(2, 2)) +
         std::stod(hhmmss.substr(4));
}

// Takes the readers along with a run, while their rings hold what they have not read.
class Listener {
 public:
  explicit Listener(const Blackboard& board)
      : truth_{board.world_truth}, attitude_{board.attitude}, thrust_{board.thrust_applied} {}

  void listen() {
    while (const auto* truth = truth_.next()) {
      truths.push_back({truth->stamp, truth->value});
    }
    while (const auto* attitude = attitude_.next()) {
      attitudes.push_back({attitude->stamp, attitude->value});
    }
    while (const auto* thrust = thrust_.next()) {
      thrusts.push_back({thrust->stamp, thrust->value});
    }
  }

  std::vector<std::pair<Time, WorldTruth>> truths;
  std::vector<std::pair<Time, Attitude>> attitudes;
  std::vector<std::pair<Time, ThrustApplied>> thrusts;

 private:
  Reader<WorldTruth> truth_;
  Reader<Attitude> attitude_;
  Reader<ThrustApplied> thrust_;
};

void write_samples(const Listener& heard, Track& track) {
  std::size_t truth = 0;
  std::size_t thrust = 0;
  for (const auto& [stamp, attitude] : heard.attitudes) {
    while (truth + 1 < heard.truths.size() && heard.truths[truth + 1].first <= attitude.measured) {
      ++truth;
    }
    while (thrust + 1 < heard.thrusts.size() && heard.thrusts[thrust + 1].first <= stamp) {
      ++thrust;
    }
    const WorldTruth& there = heard.truths[truth].second;
    if (there.scenario_time_s <= 0.0 || heard.truths[truth].first != attitude.measured) {
      continue;
    }
    const ThrustApplied& applied = heard.thrusts[thrust].second;
    track.samples.push_back({attitude.measured, attitude, applied.surge_ref, applied.head_ref,
                             Vec{there.x_m, there.y_m}});
  }
}

}  // namespace

Track simulated_track(std::uint64_t seed) {
  const BoatConfig configuration = load_configuration("default", {});
  Scenario scenario = load_named_scenario("paper-speed-0.74", configuration.speeds);
  scenario.seed = seed;
  scenario.obstacles.clear();
  scenario.time_limit_s = 150.0;
  MissionDefinition& mission = scenario.mission.definition;
  mission.goal_count = 0;
  for (const Vec& goal : {Vec{10, 15}, Vec{-5, 25}, Vec{10, 40}, Vec{-20, 40}, Vec{0, 200}}) {
    mission.goals[mission.goal_count].x_m = goal.x();
    mission.goals[mission.goal_count++].y_m = goal.y();
  }
  RandomStream luck{"current", seed};
  const double speed_m_s = 0.5 * luck.uniform();
  const double towards_rad = 2.0 * std::numbers::pi * luck.uniform();
  Track track;
  track.current_is_known = true;
  track.current_m_s = speed_m_s * Vec{std::sin(towards_rad), std::cos(towards_rad)};
  scenario.environment.current_x_m_s = track.current_m_s.x();
  scenario.environment.current_y_m_s = track.current_m_s.y();
  track.name = "simulated";
  track.speeds = configuration.speeds;
  std::optional<Listener> listener;
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const cli::RunProgress&)> silent = [](const cli::RunProgress&) {};
  cli::LockstepRun run{configuration, scenario, never, silent, {}};
  run.on_plan = [&listener](const Blackboard& board, const Plan&, const SonarPath*,
                            const cli::PlanRecord&) {
    if (!listener) {
      listener.emplace(board);
    }
    listener->listen();
  };
  static_cast<void>(cli::run_lockstep(run));
  if (!listener) {
    throw std::runtime_error{"the simulated boat made no plan"};
  }
  write_samples(*listener, track);
  return track;
}

Track nmea_track(const std::filesystem::path& file) {
  std::ifstream in{file};
  std::vector<Logged> logged;
  Logged now;
  std::optional<double> heading_rad;
  std::string line;
  while (std::getline(in, line)) {
    const std::vector<std::string> f = fields_of(line);
    if (f.size() < 2 || f[0].size() != 6) {
      continue;
    }
    const std::string what = f[0].substr(3);
    if (what == "HDT" && !f[1].empty()) {
      heading_rad = to_rad(std::stod(f[1]));
    } else if (what == "RMC" && f.size() > 8 && !f[7].empty()) {
      now.speed_m_s = kKnot_m_s * std::stod(f[7]);
    } else if (what == "GGA" && f.size() > 9 && f[6] == "4" && heading_rad) {
      now.t_s = seconds_of(f[1]);
      now.place = {degrees_of(f[2], f[3]), degrees_of(f[4], f[5])};
      now.heading_rad = *heading_rad;
      if (logged.empty() || now.t_s > logged.back().t_s) {
        logged.push_back(now);
      }
    }
  }
  return track_of(file.filename().string(), logged);
}

Track catabot_track(const std::filesystem::path& file) {
  std::ifstream in{file};
  std::vector<Logged> logged;
  std::string line;
  std::getline(in, line);  // its header
  std::string second;
  double whole_s = -1.0;
  double last_s = 0.0;
  while (std::getline(in, line)) {
    const std::vector<std::string> f = fields_of(line);
    if (f.size() < 17) {
      continue;
    }
    if (f[1] != second) {
      second = f[1];
      const std::size_t digit = second.find_first_of("0123456789");
      whole_s = 3600.0 * std::stod(second.substr(digit)) +
                60.0 * std::stod(second.substr(second.find(':') + 1)) +
                std::stod(second.substr(second.rfind(':') + 1));
      last_s = whole_s;
    } else {
      last_s += 0.2;  // about four rows a second, with one second's resolution
    }
    Logged now;
    now.t_s = std::min(last_s, whole_s + 0.9);
    now.heading_rad = std::stod(f[4]);
    now.speed_m_s = std::stod(f[8]);
    now.place = {1e-7 * std::stod(f[15]), 1e-7 * std::stod(f[16])};
    const bool held = !logged.empty() &&
                      std::abs(now.place.latitude_deg - logged.back().place.latitude_deg) < 1e-9 &&
                      std::abs(now.place.longitude_deg - logged.back().place.longitude_deg) < 1e-9;
    if (!held && (logged.empty() || now.t_s > logged.back().t_s)) {
      logged.push_back(now);
    }
  }
  return track_of(file.filename().string(), logged);
}

}  // namespace lodesman::measure
