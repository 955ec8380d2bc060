// SPDX-License-Identifier: Apache-2.0
// lodesman-high: estimator, re-planner, waypoint tracking, P controller and mission; owns the
// command socket.
#include <spdlog/spdlog.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "deploy/cli/run/log.h"
#include "deploy/cli/run/process_main.h"
#include "deploy/cli/run/settings.h"
#include "high_level/mission/command_socket.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/runtime/run_realtime.h"

namespace lodesman {
namespace {

const std::map<std::string, OperatorOrder> kOrders{{"start", OperatorOrder::kStart},
                                                   {"abort", OperatorOrder::kAbort},
                                                   {"hold", OperatorOrder::kHold},
                                                   {"resume", OperatorOrder::kResume}};
constexpr Duration kSegmentPatience = std::chrono::seconds{5};

// Answers the operator; lives on the command socket's thread.
class OperatorDesk {
 public:
  explicit OperatorDesk(Blackboard& board)
      : orders_{board.operator_command, Role::kHigh, "operator_command"},
        mission_{board.mission_status},
        state_{board.vehicle_state},
        plan_{board.plan},
        helm_{board.helm_command} {}

  [[nodiscard]] std::string reply_to(const std::string& command) {
    if (command == "status") {
      return status().dump();
    }
    if (const auto order = kOrders.find(command); order != kOrders.end()) {
      orders_.publish({order->second}, SteadyClock{}.now());
      return nlohmann::json{{"ok", true}}.dump();
    }
    return nlohmann::json{{"ok", false}, {"error", "unknown command: " + command}}.dump();
  }

 private:
  [[nodiscard]] nlohmann::ordered_json status() {
    const Time now = SteadyClock{}.now();
    nlohmann::ordered_json reply{{"ok", true}};
    if (const auto* mission = mission_.latest(); mission != nullptr) {
      const MissionStatus& m = mission->value;
      reply["state"] = to_string(m.state);
      reply["time_s"] = m.started == Time{} ? 0.0 : to_seconds(now - m.started);
      reply["goal_m"] = {m.goal_x_m, m.goal_y_m};
    }
    if (const auto* state = state_.latest(); state != nullptr) {
      reply["position_m"] = {state->value.x_m, state->value.y_m};
      reply["heading_deg"] = compass_deg(state->value.heading_rad);
      reply["state_age_s"] = to_seconds(now - state->stamp);
    }
    if (const auto* plan = plan_.latest(); plan != nullptr) {
      reply["plan"] = {{"id", plan->value.id},
                       {"reason", to_string(plan->value.reason)},
                       {"rung", to_string(plan->value.rung)},
                       {"waypoints", to_string(plan->value.source)},
                       {"age_s", to_seconds(now - plan->stamp)}};
    }
    if (const auto* helm = helm_.latest(); helm != nullptr) {
      reply["helm"] = to_string(helm->value.reason);
    }
    return reply;
  }

  Writer<OperatorCommand> orders_;
  Reader<MissionStatus> mission_;
  Reader<VehicleState> state_;
  Reader<Plan> plan_;
  Reader<HelmCommand> helm_;
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
  OperatorDesk desk{board.writable()};
  const auto settings = cli::command_socket_settings(configuration);
  const CommandSocket socket{{settings.address, settings.port, ""},
                             [&](const std::string& command) { return desk.reply_to(command); }};
  spdlog::info("command socket on {}:{}", settings.address, socket.port());
  // lodesman-low, which has the same rights, warns if they are missing.
  (void)set_up_realtime();
  const auto tasks = high.tasks();
  const RealtimeRunner runner{tasks, board.writable(), Role::kHigh};
  bool low_died = false;
  cli::wait_for_stop([&] { return low_died = !board.alive(Role::kLow); });
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
