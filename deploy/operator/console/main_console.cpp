// SPDX-License-Identifier: Apache-2.0
// lodesman-console: the page in a browser, and the boat for viewers of the Foxglove protocol. Maps
// the boat's blackboard read-only and commands by the command socket alone, as any client of it.
#include "deploy/boat/configuration.h"
#include "deploy/boat/console_settings.h"
#include "deploy/boat/exit_status.h"
#include "deploy/boat/log.h"
#include "deploy/boat/process_main.h"
#include "deploy/operator/console/console_server.h"
#include "high_level/mission/message_code.h"

namespace lodesman::console {
namespace {

struct ProgramOptions : ProcessOptions {
  bool or_next = false;
  bool sign_in_once = false;
  std::string page;
};

// Where lodesman-high listens for its own machine.
[[nodiscard]] std::string command_address(const std::string& configured) {
  return reach_of(configured) == Reach::kLoopback ? configured : "127.0.0.1";
}

[[nodiscard]] std::string url_of(const std::string& address, std::uint16_t port) {
  const bool is_v6 = address.find(':') != std::string::npos;
  const std::string host = is_v6 ? "[" + address + "]" : address;
  return "http://" + host + ":" + std::to_string(port) + "/";
}

[[nodiscard]] ConsoleOptions console_options(const BoatConfig& config,
                                             const ConsoleSettings& settings,
                                             const std::string& page) {
  ConsoleOptions options;
  options.boat = config.name;
  options.segment = config.segment;
  options.command_port = config.command_socket.port;
  options.lasting_tokens = config.command_socket.token_file;
  options.names = settings.names;
  options.names.push_back(settings.address);
  const TomlTable vehicle = config.document.root().table("vehicle");
  options.hull = {vehicle.number("hull_length_m", Range::above(0.0, 100.0)),
                  vehicle.number("hull_beam_m", Range::above(0.0, 50.0))};
  options.min_range_m = config.low.delta_t.segmentation.min_range_m;
  options.page = page.empty() ? page_directory() : std::filesystem::path{page};
  return options;
}

int run(const ProgramOptions& program) {
  require_cryptography();
  const BoatConfig config = load_configuration(program.profile, program.common);
  const ConsoleSettings settings = read_console(config.document.root().table("console"));
  ServerOptions options;
  options.address = settings.address;
  options.port = settings.port;
  options.or_next = program.or_next;
  options.command_address = command_address(config.command_socket.address);
  try {
    ConsoleServer server{options, console_options(config, settings, program.page)};
    if (reach_of(settings.address) == Reach::kNetwork) {
      log_with_fields(
          LineLevel::kWarning,
          "the console listens beyond loopback: tokens and orders cross that network in "
          "the clear",
          {});
    }
    const std::string url = url_of(settings.address, server.port());
    say("the console is at " + url);
    if (program.sign_in_once) {
      say("to command, once: " + url + "#token=" + server.make_one_time_token());
    }
    server.start();
    wait_for_stop([] { return false; });
  } catch (const PortTaken& error) {
    say(error.what());
    return kExitFault;
  }
  return kExitDone;
}

}  // namespace
}  // namespace lodesman::console

int main(int argc, char** argv) {
  lodesman::block_stop_signals();
  lodesman::log_without_blocking();
  CLI::App app{"The console: a boat in a browser, and for viewers of the Foxglove protocol",
               "lodesman-console"};
  lodesman::console::ProgramOptions options;
  lodesman::add_process_options(app, options);
  app.add_flag("--or-next-port", options.or_next, "Where its port is taken, one of the next");
  app.add_flag("--sign-in-once", options.sign_in_once,
               "Prints an address that signs in once, to command");
  app.add_option("--page", options.page, "The page's files, instead of the installed ones")
      ->type_name("DIR");
  app.footer("Example: lodesman-console --config boat.toml");
  return lodesman::process_main(app, argc, argv, [&] { return lodesman::console::run(options); });
}
