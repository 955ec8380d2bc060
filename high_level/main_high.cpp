// SPDX-License-Identifier: Apache-2.0
// lodesman-high: estimator, re-planner, waypoint tracking, P controller and mission; owns the
// command socket.
#include <spdlog/spdlog.h>

#include <optional>
#include <string>

#include "deploy/cli/run/log.h"
#include "deploy/cli/run/process_main.h"
#include "deploy/cli/run/settings.h"
#include "high_level/mission/command_socket.h"
#include "high_level/mission/token_file.h"
#include "high_level/tasks/operator_desk.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/runtime/realtime_rights.h"
#include "mid_level/runtime/run_realtime.h"

namespace lodesman {
namespace {

constexpr Duration kSegmentPatience = std::chrono::seconds{5};

// The operator's way in: the desk, the socket before it, and the token that opens it, which is
// given or made for this run.
class WayIn {
 public:
  WayIn(Blackboard& board, const cli::CommandSocketSettings& settings)
      : desk_{board, Role::kHigh, [] { return SteadyClock{}.now(); }},
        token_{settings.token_file.empty() ? random_token() : read_token(settings.token_file)},
        socket_{{settings.address, settings.port, token_},
                [this](const std::string& command) { return desk_.answer(command); }} {
    if (settings.token_file.empty()) {
      token_file_.emplace(socket_.port(), token_);
    }
    if (settings.port == 0) {  // whoever asked for any port must be told which
      cli::say("lodesman-high: command socket on " + settings.address + " port " +
               std::to_string(socket_.port()));
    }
  }

 private:
  OperatorDesk desk_;
  std::string token_;
  CommandSocket socket_;
  std::optional<TokenFile> token_file_;
};

void report_what_was_found(const SharedBlackboard& board) {
  if (!board.found_dead()) {
    return;
  }
  Reader<MissionStatus> mission{board->mission_status};
  const auto* last = mission.latest();
  spdlog::warn("an earlier lodesman-high died; its mission was {}",
               last != nullptr ? to_string(last->value.state) : "not yet begun");
}

int run(const cli::ProcessOptions& options, bool start_by_itself) {
  const TomlDocument configuration = cli::load_whole_configuration(options.configuration_file);
  const Scenario scenario = cli::load_named_scenario(options.scenario_file);
  SharedBlackboard board = SharedBlackboard::open(options.segment, Role::kHigh, kSegmentPatience);
  report_what_was_found(board);
  HighLevelOptions high_options = cli::high_level_options(configuration, scenario);
  high_options.planner.start_by_itself = start_by_itself;
  HighLevel high{board.writable(), Role::kHigh, high_options};
  const WayIn way_in{board.writable(), cli::command_socket_settings(configuration)};
  // lodesman-low, which has the same rights, warns if they are missing.
  (void)set_up_realtime();
  const auto tasks = high.tasks();
  HealthWatch health{*board, tasks, SteadyClock{}.now()};
  const RealtimeRunner runner{tasks, board.writable(), Role::kHigh, cli::end_without};
  bool low_died = false;
  cli::wait_for_stop([&] {
    cli::say_what_hangs(health);
    return low_died = !board.alive(Role::kLow);
  });
  if (low_died) {
    spdlog::error("lodesman-low is gone: stopping");
  }
  return low_died ? cli::kExitFault : cli::kExitDone;
}

}  // namespace
}  // namespace lodesman

int main(int argc, char** argv) {
  namespace cli = lodesman::cli;
  cli::block_stop_signals();
  cli::log_without_blocking();
  CLI::App app{"The high level: estimator, re-planner, guidance, control and mission",
               "lodesman-high"};
  cli::ProcessOptions options;
  cli::add_process_options(app, options);
  bool start_by_itself = false;
  app.add_flag("--start", start_by_itself, "Start the mission without an operator's word");
  spdlog::set_level(spdlog::level::warn);
  return cli::process_main(app, argc, argv,
                           [&] { return lodesman::run(options, start_by_itself); });
}
