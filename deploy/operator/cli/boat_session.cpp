// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/boat_session.h"

#include <fmt/format.h>

#include <memory>
#include <thread>

#include "deploy/boat/configuration.h"
#include "deploy/operator/cli/number_options.h"
#include "high_level/mission/command_line.h"
#include "high_level/mission/handshake.h"
#include "high_level/mission/network.h"
#include "high_level/mission/token_file.h"
#include "mid_level/base/clock.h"

namespace lodesman::cli {
namespace {

constexpr Duration kRetryPeriod = std::chrono::milliseconds{20};

constexpr std::size_t kMaxReply = 1024 * 1024;  // [bytes] whatever it is that answers

// A name is looked up later, and may be anybody's.
[[nodiscard]] bool is_own_machine(const std::string& host) {
  return host == "localhost" || reach_of(host) == Reach::kLoopback;
}

// Without the line feed; empty where none came, or no end of it.
[[nodiscard]] std::string line_from(std::istream& stream) {
  std::string line;
  for (char c = 0; stream.get(c) && line.size() < kMaxReply; line += c) {
    if (c == '\n') {
      return line;
    }
  }
  return "";
}

// What stops the boat is asked for again and again: a crowd may have pushed it out.
[[nodiscard]] std::string insist(const Boat& boat, const nlohmann::json& request) {
  const SteadyClock clock;
  const Time deadline = clock.now() + kBoatPatience;
  std::string line = BoatSession{boat}.ask(request);
  while (line.empty() && stops_the_boat(request["command"]) && clock.now() < deadline) {
    std::this_thread::sleep_for(kRetryPeriod);
    const Duration left = deadline - clock.now();
    line = BoatSession{boat, left}.ask(request, left);
  }
  return line;
}

void print_warnings(const std::string& command, const nlohmann::ordered_json& reply) {
  const auto warnings = reply.find("warnings");
  if (warnings == reply.end() || !warnings->is_array()) {
    return;
  }
  for (const auto& warning : *warnings) {
    if (warning.is_string()) {
      fmt::print(stderr, "{}: warning: {}\n", command, warning.get<std::string>());
    }
  }
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
    if (!says_more) {
      print_warnings(command, reply);
    }
  }
}

}  // namespace

Boat find_boat(const OperatorOptions& options) {
  const auto settings = load_configuration("default", options.common).command_socket;
  const bool own_machine = is_own_machine(options.host);
  if (options.host.empty()) {
    throw CLI::ValidationError("--host", "must be an IP address or a name");
  }
  Boat boat{options.host == "localhost" ? "127.0.0.1" : options.host,
            options.port.value_or(settings.port), "", Credential::kProved};
  const std::string& given = options.token_file.empty() ? settings.token_file : options.token_file;
  if (!given.empty()) {
    boat.token = read_token(given);
    if (!own_machine && !is_random_token(boat.token)) {
      throw StartupError(given, 1, "token", "is none that lodesman token --new FILE makes");
    }
  } else if (!own_machine) {
    throw CLI::ValidationError("--host",
                               "beyond loopback needs --token-file, a copy of the file that the "
                               "boat's token_file names");
  } else if (const auto found = find_token_file(boat.port); found) {
    boat.token = read_token(*found);
    boat.credential = Credential::kShown;
  } else {
    throw NoBoat(fmt::format("no boat with a command socket on port {}: is lodesman-high running?",
                             boat.port));
  }
  return boat;
}

BoatSession::BoatSession(const Boat& boat, Duration patience) : boat_{boat} {
  stream_.expires_after(patience);
  stream_.connect(boat.host, std::to_string(boat.port));
  if (stream_ && boat.credential == Credential::kProved) {
    prove();
  }
}

NoBoat BoatSession::fault(const std::string& what) const {
  return NoBoat{fmt::format("{} port {} {}", boat_.host, boat_.port, what)};
}

std::string BoatSession::exchange(const std::string& line) {
  stream_ << line << "\n" << std::flush;
  return line_from(stream_);
}

// An end of the connection is no fault: asked for anything, it then gives no line.
void BoatSession::prove() {
  require_cryptography();
  ClientHandshake handshake{boat_.token, random_digest()};
  const std::string challenge = exchange(handshake_request());
  if (challenge.empty()) {
    return;
  }
  if (const auto wrong = handshake.hear_challenge(challenge)) {
    throw fault(*wrong);
  }
  const std::string proof = exchange(handshake.answer());
  if (proof.empty()) {
    return;
  }
  if (const auto wrong = handshake.hear_proof(proof)) {
    throw fault(*wrong);
  }
  sealed_.emplace(handshake.keys(), SessionEnd::kClient);
}

std::string BoatSession::ask(nlohmann::json request, Duration patience) {
  if (boat_.credential == Credential::kProved && !sealed_) {
    return "";
  }
  request["protocol"] = kCommandProtocol;
  if (!sealed_) {
    request["token"] = boat_.token;
  }
  stream_.expires_after(patience);
  const std::string text = request.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string line = exchange(sealed_ ? sealed_->seal(text) : text);
  if (!sealed_ || line.empty()) {
    return line;
  }
  const auto opened = sealed_->open(line);
  if (!opened) {
    throw fault(
        "gave an answer that was altered on its way: what was asked for may be done or not");
  }
  return *opened;
}

int reply_status(const std::string& command, const nlohmann::ordered_json& reply) {
  const auto flag = [&](const char* key, bool otherwise) {
    return reply.contains(key) && reply[key].is_boolean() ? reply[key].get<bool>() : otherwise;
  };
  if (!reply.is_object() || (!flag("ok", false) && !flag("confirmed", true))) {
    return kExitFault;
  }
  const int refused = stops_the_boat(command) ? kExitFault : kExitNoGoal;
  return flag("ok", false) ? kExitDone : refused;
}

NoBoat no_answer(const Boat& boat) {
  return NoBoat{
      fmt::format("no answer from {} port {}: is lodesman-high running?", boat.host, boat.port)};
}

int conclude(const std::string& command, const std::string& line, const OperatorOptions& options) {
  const auto reply = nlohmann::ordered_json::parse(line, nullptr, false);
  const int status = reply_status(command, reply);
  print_reply(command, reply, line, options, status);
  return status;
}

int send(const std::string& name, const nlohmann::json& request, const OperatorOptions& options) {
  const Boat boat = find_boat(options);
  const std::string line = insist(boat, request);
  if (line.empty()) {
    throw no_answer(boat);
  }
  return conclude(name, line, options);
}

int or_say_why(const std::string& command, const std::function<int()>& act) {
  try {
    return act();
  } catch (const NoBoat& error) {
    fmt::print(stderr, "{}: {}\n", command, error.what());
    return kExitFault;
  }
}

void add_boat_options(CLI::App& command, OperatorOptions& options) {
  command
      .add_option("--host", options.host,
                  "Where lodesman-high runs; beyond this machine with --token-file")
      ->type_name("ADDRESS");
  command.add_option("--port", options.port, "Of its command socket")
      ->type_name("N")
      ->check(number_from(1, 65535));
  command
      .add_option("--token-file", options.token_file,
                  "The boat's lasting one, or a copy; else the one it left here")
      ->type_name("FILE");
  add_common_options(command, options.common);
}

void add_word(CLI::App& root, const std::string& name, const std::string& description,
              int& exit_status) {
  const auto options = std::make_shared<OperatorOptions>();
  CLI::App* command = root.add_subcommand(name, description);
  add_boat_options(*command, *options);
  command->footer("Example: lodesman " + name + " --port 7447");
  command->callback([name, options, &exit_status] {
    exit_status = or_say_why(name, [&] { return send(name, {{"command", name}}, *options); });
  });
}

}  // namespace lodesman::cli
