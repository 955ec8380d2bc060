// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/thrust_commands.h"

#include <memory>
#include <thread>

#include "deploy/boat/stop_signals.h"
#include "deploy/operator/cli/boat_session.h"
#include "deploy/operator/cli/number_options.h"
#include "mid_level/base/clock.h"

namespace lodesman::cli {
namespace {

void add_estop(CLI::App& root, int& exit_status) {
  struct StopOptions : OperatorOptions {
    bool release = false;
  };
  const auto options = std::make_shared<StopOptions>();
  CLI::App* command = root.add_subcommand(
      "estop", "Thrusters neutral by emergency, until it is released and they are armed again");
  command->add_flag("--release", options->release, "End it; the thrusters are disarmed then");
  add_boat_options(*command, *options);
  command->footer("Examples: lodesman estop\n          lodesman estop --release");
  command->callback([options, &exit_status] {
    const std::string name = options->release ? "estop --release" : "estop";
    exit_status = or_say_why(name, [&] {
      return send(name, {{"command", "estop"}, {"release", options->release}}, *options);
    });
  });
}

// The stick's word, again and again for as long as asked; the boat is neutral 0.5 s after the last.
[[nodiscard]] int move_stick(const nlohmann::json& word, double for_s,
                             const OperatorOptions& options) {
  constexpr Duration kWordPeriod = std::chrono::milliseconds{100};
  const Boat boat = find_boat(options);
  BoatSession session{boat};
  const SteadyClock clock;
  const Time end = clock.now() + from_seconds(for_s);
  catch_stop_signals();
  std::string line;
  while (true) {
    line = session.ask(word);
    if (line.empty()) {
      throw no_answer(boat);
    }
    const auto reply = nlohmann::ordered_json::parse(line, nullptr, false);
    if (stop_caught() || clock.now() + kWordPeriod >= end ||
        reply_status("manual", reply) != kExitDone) {
      return conclude("manual", line, options);
    }
    std::this_thread::sleep_for(kWordPeriod);
  }
}

void add_manual(CLI::App& root, int& exit_status) {
  struct ManualOptions : OperatorOptions {
    int surge = 0;
    int head = 0;
    double for_s = 0.0;
    bool overrides_guard = false;
  };
  const auto options = std::make_shared<ManualOptions>();
  CLI::App* command = root.add_subcommand(
      "manual", "Steer by hand: outranks the mission, not an abort; neutral 0.5 s after the last");
  command->add_option("surge", options->surge, "Ahead, or astern if below 0")
      ->required()
      ->type_name("SURGE")
      ->check(number_from(-100, 100));
  command->add_option("head", options->head, "To starboard, or to port if below 0")
      ->required()
      ->type_name("HEAD")
      ->check(number_from(-100, 100));
  command->add_option("--for", options->for_s, "Say it again for so long")
      ->type_name("S")
      ->check(number_from(0, 3600));
  command->add_flag("--override", options->overrides_guard,
                    "Closer in than the guard lets it, for as long as this is said");
  add_boat_options(*command, *options);
  command->footer("Examples: lodesman manual 30 0 --for 5\n          lodesman manual -- -20 40");
  command->callback([options, &exit_status] {
    const nlohmann::json word{{"command", "manual"},
                              {"surge", options->surge},
                              {"head", options->head},
                              {"override", options->overrides_guard}};
    exit_status = or_say_why("manual", [&] { return move_stick(word, options->for_s, *options); });
  });
}

}  // namespace

void add_thrust_commands(CLI::App& root, int& exit_status) {
  add_word(root, "arm", "Let the thrusters turn: they are disarmed at power-up", exit_status);
  add_word(root, "disarm", "Thrusters neutral, and no mission", exit_status);
  add_estop(root, exit_status);
  add_manual(root, exit_status);
}

}  // namespace lodesman::cli
