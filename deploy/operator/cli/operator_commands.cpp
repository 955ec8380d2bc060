// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/operator_commands.h"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "deploy/boat/configuration.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/cli/number_options.h"
#include "high_level/mission/command_line.h"
#include "high_level/mission/token_file.h"
#include "mid_level/base/clock.h"

namespace lodesman::cli {
namespace {

struct OperatorOptions {
  CommonOptions common;
  std::string host = "127.0.0.1";
  std::optional<std::uint16_t> port;  // instead of the configuration's
  std::string token_file;             // instead of the configuration's, or the boat's own
};

constexpr Duration kPatience = std::chrono::seconds{5};
constexpr Duration kRetryPeriod = std::chrono::milliseconds{20};
constexpr Duration kHeartbeatPeriod = std::chrono::seconds{1};
constexpr std::size_t kMaxMissionText = 32 * 1024;

struct Boat {
  std::string host;
  std::uint16_t port = 0;
  std::string token;
};

// The token never crosses a network in the clear: a name might.
[[nodiscard]] std::string loopback_only(const std::string& host) {
  boost::system::error_code error;
  const auto address =
      boost::asio::ip::make_address(host == "localhost" ? "127.0.0.1" : host, error);
  if (error) {
    throw CLI::ValidationError("--host", "must be an IP address");
  }
  if (!address.is_loopback()) {
    throw CLI::ValidationError(
        "--host", "must be loopback, as the token would cross the network in the clear");
  }
  return address.to_string();
}

// Thrown where none has left its token, or none answers.
class NoBoat : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[nodiscard]] Boat find_boat(const OperatorOptions& options) {
  const auto settings = load_configuration("default", options.common).command_socket;
  Boat boat{loopback_only(options.host), options.port.value_or(settings.port), ""};
  const std::string& given = options.token_file.empty() ? settings.token_file : options.token_file;
  if (!given.empty()) {
    boat.token = read_token(given);
  } else if (const auto found = find_token_file(boat.port); found) {
    boat.token = read_token(*found);
  } else {
    throw NoBoat(fmt::format("no boat with a command socket on port {}: is lodesman-high running?",
                             boat.port));
  }
  return boat;
}

// A conversation with the boat.
class Session {
 public:
  Session(const Boat& boat, Duration patience) : boat_{boat} {
    stream_.expires_after(patience);
    stream_.connect(boat.host, std::to_string(boat.port));
  }
  // The boat's line; empty where it gave none.
  [[nodiscard]] std::string ask(nlohmann::json request, Duration patience) {
    request["protocol"] = kCommandProtocol;
    request["token"] = boat_.token;
    stream_.expires_after(patience);
    stream_ << request.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << "\n"
            << std::flush;
    std::string line;
    std::getline(stream_, line);
    return line;
  }

 private:
  const Boat& boat_;
  boost::asio::ip::tcp::iostream stream_;
};

// What stops the boat is asked for again and again: a crowd may have pushed it out.
[[nodiscard]] std::string insist(const Boat& boat, const nlohmann::json& request) {
  const SteadyClock clock;
  const Time deadline = clock.now() + kPatience;
  std::string line = Session{boat, kPatience}.ask(request, kPatience);
  while (line.empty() && stops_the_boat(request["command"]) && clock.now() < deadline) {
    std::this_thread::sleep_for(kRetryPeriod);
    const Duration left = deadline - clock.now();
    line = Session{boat, left}.ask(request, left);
  }
  return line;
}

// A refusal is 1; what may have been done or not is 4, as is every abort that is not confirmed.
[[nodiscard]] int exit_status_of(const std::string& command, const nlohmann::ordered_json& reply) {
  const auto flag = [&](const char* key, bool otherwise) {
    return reply.contains(key) && reply[key].is_boolean() ? reply[key].get<bool>() : otherwise;
  };
  if (!reply.is_object() || (!flag("ok", false) && !flag("confirmed", true))) {
    return kExitFault;
  }
  const int refused = stops_the_boat(command) ? kExitFault : kExitNoGoal;
  return flag("ok", false) ? kExitDone : refused;
}

void print_reply(const std::string& command, const nlohmann::ordered_json& reply,
                 const std::string& line, const OperatorOptions& options, int status) {
  if (options.common.json) {
    fmt::print("{}\n", line);
  } else if (status != kExitDone) {
    const bool has_reason =
        reply.is_object() && reply.contains("error") && reply["error"].is_string();
    fmt::print(stderr, "{}: {}\n", command,
               has_reason ? reply["error"].get<std::string>() : "no proper answer: " + line);
  } else if (!options.common.quiet) {
    const bool says_more = command == "status" || command == "tune";
    fmt::print("{}\n", says_more ? reply.dump(2) : command + ": " + reply.value("state", "done"));
  }
}

[[nodiscard]] NoBoat no_answer(const Boat& boat) {
  return NoBoat{
      fmt::format("no answer from {} port {}: is lodesman-high running?", boat.host, boat.port)};
}

// What the reply comes to, said as it was asked for.
[[nodiscard]] int conclude(const std::string& command, const std::string& line,
                           const OperatorOptions& options) {
  const auto reply = nlohmann::ordered_json::parse(line, nullptr, false);
  const int status = exit_status_of(command, reply);
  print_reply(command, reply, line, options, status);
  return status;
}

// `name`: of the command as it was typed.
[[nodiscard]] int send(const std::string& name, const nlohmann::json& request,
                       const OperatorOptions& options) {
  const Boat boat = find_boat(options);
  const std::string line = insist(boat, request);
  if (line.empty()) {
    throw no_answer(boat);
  }
  return conclude(name, line, options);
}

[[nodiscard]] int or_say_why(const std::string& command, const std::function<int()>& act) {
  try {
    return act();
  } catch (const NoBoat& error) {
    fmt::print(stderr, "{}: {}\n", command, error.what());
    return kExitFault;
  }
}

// Stays as the mission's commander: its heartbeat is the link that the mission may ask for.
[[nodiscard]] int follow(const nlohmann::json& start, const OperatorOptions& options) {
  const Boat boat = find_boat(options);
  Session session{boat, kPatience};
  const auto ask = [&](const nlohmann::json& request) {
    std::string line = session.ask(request, kPatience);
    if (line.empty()) {
      throw no_answer(boat);
    }
    return line;
  };
  for (const nlohmann::json& request :
       {nlohmann::json{{"command", "take"}, {"name", "lodesman start"}}, start}) {
    const std::string line = ask(request);
    if (exit_status_of("start", nlohmann::ordered_json::parse(line, nullptr, false)) != kExitDone) {
      return conclude("start", line, options);
    }
  }
  catch_stop_signals();
  std::string state;
  while (!stop_caught() && state != "reached" && state != "aborted") {
    const std::string line = ask({{"command", "heartbeat"}});
    const auto beat = nlohmann::ordered_json::parse(line, nullptr, false);
    if (exit_status_of("start", beat) != kExitDone) {
      return conclude("start", line, options);
    }
    const std::string now = beat.value("state", "");
    if (now != state && !options.common.quiet) {
      fmt::print(stderr, "mission: {}\n", now);
    }
    state = now;
    std::this_thread::sleep_for(kHeartbeatPeriod);
  }
  const std::string last = ask({{"command", "status"}});
  static_cast<void>(session.ask({{"command", "release"}}, kPatience));
  if (options.common.json) {
    fmt::print("{}\n", last);
  }
  return state == "reached" ? kExitDone : kExitNoGoal;
}

void add_boat_options(CLI::App& command, OperatorOptions& options) {
  command.add_option("--host", options.host, "Where lodesman-high runs: loopback")
      ->type_name("ADDRESS");
  command.add_option("--port", options.port, "Of its command socket")
      ->type_name("N")
      ->check(number_from(1, 65535));
  command.add_option("--token-file", options.token_file, "Instead of the one that it left")
      ->type_name("FILE");
  add_common_options(command, options.common);
}

void add(CLI::App& root, const std::string& name, const std::string& description,
         int& exit_status) {
  const auto options = std::make_shared<OperatorOptions>();
  CLI::App* command = root.add_subcommand(name, description);
  add_boat_options(*command, *options);
  command->footer("Example: lodesman " + name + " --port 7447");
  command->callback([name, options, &exit_status] {
    exit_status = or_say_why(name, [&] { return send(name, {{"command", name}}, *options); });
  });
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
      goal = fmt::format("[{:#}, {:#}]", first, second);
    }
    const char* unit = options->degrees ? "deg" : "m";
    std::string mission =
        fmt::format("goal_{} = {}\nwaypoints_{} = [{}]\n", unit, goal, unit, waypoints);
    if (options->speed_m_s) {
      mission += fmt::format("speed_m_s = {:#}\n", *options->speed_m_s);
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
  add(root, "abort", "Thrusters neutral, until a new start", exit_status);
  add(root, "hold", "Stay where it is, and make way for what moves", exit_status);
  add(root, "resume", "Go on with the mission after a hold", exit_status);
  add(root, "status", "What a running boat is doing", exit_status);
  add_tune(root, exit_status);
}

}  // namespace lodesman::cli
