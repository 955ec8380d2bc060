// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/operator_commands.h"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "deploy/cli/common_options.h"
#include "deploy/cli/run/settings.h"

namespace lodesman::cli {
namespace {

struct OperatorOptions {
  CommonOptions common;
  std::string host = "127.0.0.1";
  std::string port;  // empty: the configuration's
  std::string token_file;
};

constexpr std::chrono::seconds kPatience{5};

[[nodiscard]] std::string token_of(const std::string& file) {
  if (file.empty()) {
    return {};
  }
  std::ifstream stream{file};
  std::string token;
  if (!std::getline(stream, token)) {
    throw StartupError(file, 1, "token", "cannot be read");
  }
  return token;
}

[[nodiscard]] int send(const std::string& command, const OperatorOptions& options) {
  nlohmann::json request{{"command", command}};
  if (const std::string token = token_of(options.token_file); !token.empty()) {
    request["token"] = token;
  }
  const std::string port =
      options.port.empty()
          ? std::to_string(
                command_socket_settings(load_configuration("default", options.common)).port)
          : options.port;
  boost::asio::ip::tcp::iostream stream;
  stream.expires_after(kPatience);
  stream.connect(options.host, port);
  stream << request.dump() << "\n" << std::flush;
  std::string line;
  if (!std::getline(stream, line)) {
    fmt::print(stderr, "no answer from {}:{}: is lodesman-high running?\n", options.host, port);
    return kExitFault;
  }
  const auto reply = nlohmann::ordered_json::parse(line, nullptr, false);
  const bool ok = reply.is_object() && reply.value("ok", false);
  if (options.common.json) {
    fmt::print("{}\n", line);
  } else if (!options.common.quiet) {
    fmt::print("{}\n", ok && reply.size() == 1 ? command + ": done"
                       : reply.is_discarded()  ? line
                                               : reply.dump(2));
  }
  return ok ? kExitDone : kExitFault;
}

void add(CLI::App& root, const std::string& name, const std::string& description,
         int& exit_status) {
  const auto options = std::make_shared<OperatorOptions>();
  CLI::App* command = root.add_subcommand(name, description);
  command->add_option("--host", options->host, "Where lodesman-high runs")->type_name("ADDRESS");
  command->add_option("--port", options->port, "Of its command socket")->type_name("N");
  command->add_option("--token-file", options->token_file, "Needed on any but loopback")
      ->type_name("FILE");
  add_common_options(*command, options->common);
  command->footer("Example: lodesman " + name + " --host 127.0.0.1");
  command->callback([name, options, &exit_status] { exit_status = send(name, *options); });
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
