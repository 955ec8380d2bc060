// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/operator_commands.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "deploy/boat/configuration.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/operator/cli/boat_session.h"
#include "deploy/operator/cli/number_options.h"
#include "mid_level/base/clock.h"

namespace lodesman::cli {
namespace {

constexpr Duration kHeartbeatPeriod = std::chrono::seconds{1};
constexpr std::size_t kMaxMissionText = 32 * 1024;

// "aborted", and why where that was no order and `status`, asked for later, is of the same state.
[[nodiscard]] std::string state_and_cause(const std::string& state, const std::string& status) {
  const auto said = nlohmann::json::parse(status, nullptr, false);
  const auto word = [&](const char* key) {
    const auto at = said.find(key);
    return at != said.end() && at->is_string() ? at->get<std::string>() : std::string{};
  };
  const std::string cause = word("cause");
  const bool tells = word("state") == state && !cause.empty() && cause != "order";
  return tells ? fmt::format("{} ({})", state, cause) : state;
}

// Stays as the mission's commander: its heartbeat is the link that the mission may ask for.
[[nodiscard]] int follow(const nlohmann::json& start, const OperatorOptions& options) {
  const Boat boat = find_boat(options);
  BoatSession session{boat};
  const auto ask = [&](const nlohmann::json& request) {
    std::string line = session.ask(request);
    if (line.empty()) {
      throw no_answer(boat);
    }
    return line;
  };
  for (const nlohmann::json& request :
       {nlohmann::json{{"command", "take"}, {"name", "lodesman start"}}, start}) {
    const std::string line = ask(request);
    if (reply_status("start", nlohmann::ordered_json::parse(line, nullptr, false)) != kExitDone) {
      return conclude("start", line, options);
    }
  }
  catch_stop_signals();
  std::string state;
  while (!stop_caught() && state != "reached" && state != "aborted") {
    const std::string line = ask({{"command", "heartbeat"}});
    const auto beat = nlohmann::ordered_json::parse(line, nullptr, false);
    if (reply_status("start", beat) != kExitDone) {
      return conclude("start", line, options);
    }
    const std::string now = beat.value("state", "");
    if (now != state && !options.common.quiet) {
      fmt::print(stderr, "mission: {}\n", state_and_cause(now, ask({{"command", "status"}})));
    }
    state = now;
    std::this_thread::sleep_for(kHeartbeatPeriod);
  }
  const std::string last = ask({{"command", "status"}});
  static_cast<void>(session.ask({{"command", "release"}}));
  if (options.common.json) {
    fmt::print("{}\n", last);
  }
  return state == "reached" ? kExitDone : kExitNoGoal;
}

// Read here too, so that what is wrong with a file is said with its name and line.
[[nodiscard]] std::string mission_text(const std::string& file, const CommonOptions& common) {
  const BoatConfig config = load_configuration("default", common);
  const TomlDocument document = TomlDocument::from_file(file);
  std::ostringstream text;
  text << std::ifstream{file, std::ios::binary}.rdbuf();
  if (text.str().size() > kMaxMissionText) {
    throw StartupError(file, 1, "file", "is larger than 32 KiB");
  }
  (void)read_mission_text(text.str(), file, config.mission, nullptr);
  return text.str();
}

void add_start(CLI::App& root, int& exit_status) {
  struct StartOptions : OperatorOptions {
    std::string mission;
    bool stay = false;
  };
  const auto options = std::make_shared<StartOptions>();
  CLI::App* command = root.add_subcommand("start", "Start a mission of a running boat");
  command
      ->add_option("--mission", options->mission,
                   "A mission file; without one, the mission that the boat has")
      ->type_name("FILE");
  command->add_flag("--follow", options->stay,
                    "Stay as its commander, with a heartbeat, until the mission ends");
  add_boat_options(*command, *options);
  command->footer("Example: lodesman start --mission pond.toml");
  command->callback([options, &exit_status] {
    nlohmann::json request{{"command", "start"}};
    if (!options->mission.empty()) {
      request["mission"] = mission_text(options->mission, options->common);
    }
    exit_status = or_say_why("start", [&] {
      return options->stay ? follow(request, *options) : send("start", request, *options);
    });
  });
}

// "X,Y" as two finite numbers.
[[nodiscard]] std::pair<double, double> point_of(const std::string& text) {
  std::istringstream stream{text};
  double first = 0.0;
  double second = 0.0;
  char comma = 0;
  std::string rest;
  if (!(stream >> first >> comma >> second) || comma != ',' || (stream >> rest) ||
      !std::isfinite(first) || !std::isfinite(second)) {
    throw CLI::ValidationError("goto", "\"" + text + "\" is no point X,Y");
  }
  return {first, second};
}

void add_goto(CLI::App& root, int& exit_status) {
  struct GotoOptions : OperatorOptions {
    std::vector<std::string> points;
    bool degrees = false;
    std::optional<double> speed_m_s;
  };
  const auto options = std::make_shared<GotoOptions>();
  CLI::App* command = root.add_subcommand("goto", "Send a running boat to a place");
  command->add_option("points", options->points, "Through the first ones to the last one")
      ->required()
      ->type_name("X,Y");
  command->add_flag("--deg", options->degrees, "They are LATITUDE,LONGITUDE, not metres");
  command->add_option("--speed", options->speed_m_s, "Instead of the configuration's")
      ->type_name("M/S")
      ->check(number_from(0.01, 10.0));
  add_boat_options(*command, *options);
  command->footer("Examples: lodesman goto 5,20\n          lodesman goto 0,10 -5,20 --speed 0.74");
  command->callback([options, &exit_status] {
    std::string waypoints;
    std::string goal;
    for (const std::string& text : options->points) {
      waypoints += goal.empty() ? "" : goal + ", ";
      const auto [first, second] = point_of(text);
      goal = fmt::format("[{}, {}]", first, second);
    }
    const char* unit = options->degrees ? "deg" : "m";
    std::string mission =
        fmt::format("goal_{} = {}\nwaypoints_{} = [{}]\n", unit, goal, unit, waypoints);
    if (options->speed_m_s) {
      mission += fmt::format("speed_m_s = {}\n", *options->speed_m_s);
    }
    exit_status = or_say_why("goto", [&] {
      return send("goto", {{"command", "start"}, {"mission", mission}}, *options);
    });
  });
}

void add_tune(CLI::App& root, int& exit_status) {
  struct TuneOptions : OperatorOptions {
    std::vector<std::string> values;
  };
  const auto options = std::make_shared<TuneOptions>();
  CLI::App* command =
      root.add_subcommand("tune", "Show, or change under way, what may be changed under way");
  command->add_option("values", options->values, "zones.margin_m=1.0 and the like")
      ->type_name("SECTION.KEY=VALUE");
  add_boat_options(*command, *options);
  command->footer("Example: lodesman tune mission.speed_limit_m_s=0.5");
  command->callback([options, &exit_status] {
    nlohmann::json set = nlohmann::json::object();
    for (const std::string& text : options->values) {
      const auto equals = text.find('=');
      std::istringstream stream{equals == std::string::npos ? "" : text.substr(equals + 1)};
      double value = 0.0;
      std::string rest;
      if (!(stream >> value) || (stream >> rest)) {
        throw CLI::ValidationError("tune", "\"" + text + "\" is no SECTION.KEY=NUMBER");
      }
      set[text.substr(0, equals)] = value;
    }
    exit_status = or_say_why("tune", [&] {
      return send("tune", {{"command", "tune"}, {"set", set}}, *options);
    });
  });
}

}  // namespace

void add_operator_commands(CLI::App& root, int& exit_status) {
  add_start(root, exit_status);
  add_goto(root, exit_status);
  add_word(root, "abort", "Thrusters neutral, until a new start", exit_status);
  add_word(root, "hold", "Stay where it is, and make way for what moves", exit_status);
  add_word(root, "resume", "Go on with the mission after a hold", exit_status);
  add_word(root, "status", "What a running boat is doing", exit_status);
  add_tune(root, exit_status);
}

}  // namespace lodesman::cli
