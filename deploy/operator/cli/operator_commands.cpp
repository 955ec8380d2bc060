// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/operator_commands.h"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "deploy/boat/configuration.h"
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

// Throws NoBoat where none has left its token.
class NoBoat : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[nodiscard]] Boat find_boat(const OperatorOptions& options) {
  const auto settings = command_socket_settings(load_configuration("default", options.common));
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

// The boat's line; empty where it gave none.
[[nodiscard]] std::string ask(const Boat& boat, const std::string& command, Duration patience) {
  const nlohmann::json request{
      {"protocol", kCommandProtocol}, {"command", command}, {"token", boat.token}};
  boost::asio::ip::tcp::iostream stream;
  stream.expires_after(patience);
  stream.connect(boat.host, std::to_string(boat.port));
  stream << request.dump() << "\n" << std::flush;
  std::string line;
  std::getline(stream, line);
  return line;
}

// What stops the boat is asked for again and again: a crowd may have pushed it out.
[[nodiscard]] std::string insist(const Boat& boat, const std::string& command) {
  const SteadyClock clock;
  const Time deadline = clock.now() + kPatience;
  std::string line = ask(boat, command, kPatience);
  while (line.empty() && stops_the_boat(command) && clock.now() < deadline) {
    std::this_thread::sleep_for(kRetryPeriod);
    line = ask(boat, command, deadline - clock.now());
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
    fmt::print("{}\n",
               command == "status" ? reply.dump(2) : command + ": " + reply.value("state", "done"));
  }
}

[[nodiscard]] int send(const std::string& command, const OperatorOptions& options) {
  const Boat boat = find_boat(options);
  const std::string line = insist(boat, command);
  if (line.empty()) {
    throw NoBoat(
        fmt::format("no answer from {} port {}: is lodesman-high running?", boat.host, boat.port));
  }
  const auto reply = nlohmann::ordered_json::parse(line, nullptr, false);
  const int status = exit_status_of(command, reply);
  print_reply(command, reply, line, options, status);
  return status;
}

[[nodiscard]] int send_or_say_why(const std::string& command, const OperatorOptions& options) {
  try {
    return send(command, options);
  } catch (const NoBoat& error) {
    fmt::print(stderr, "{}: {}\n", command, error.what());
    return kExitFault;
  }
}

void add(CLI::App& root, const std::string& name, const std::string& description,
         int& exit_status) {
  const auto options = std::make_shared<OperatorOptions>();
  CLI::App* command = root.add_subcommand(name, description);
  command->add_option("--host", options->host, "Where lodesman-high runs: loopback")
      ->type_name("ADDRESS");
  command->add_option("--port", options->port, "Of its command socket")
      ->type_name("N")
      ->check(number_from(1, 65535));
  command->add_option("--token-file", options->token_file, "Instead of the one that it left")
      ->type_name("FILE");
  add_common_options(*command, options->common);
  command->footer("Example: lodesman " + name + " --port 7447");
  command->callback(
      [name, options, &exit_status] { exit_status = send_or_say_why(name, *options); });
}

}  // namespace

void add_operator_commands(CLI::App& root, int& exit_status) {
  add(root, "start", "Start the mission of a running boat", exit_status);
  add(root, "abort", "Thrusters neutral, until a new start", exit_status);
  add(root, "hold", "Stay where it is, and make way for what moves", exit_status);
  add(root, "resume", "Go on with the mission after a hold", exit_status);
  add(root, "status", "What a running boat is doing", exit_status);
}

}  // namespace lodesman::cli
