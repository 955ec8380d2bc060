// SPDX-License-Identifier: Apache-2.0
// lodesman-high: estimator, re-planner, waypoint tracking, P controller and mission; owns the
// command socket.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <optional>
#include <span>
#include <string>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/exit_status.h"
#include "deploy/boat/log.h"
#include "deploy/boat/process_main.h"
#include "deploy/boat/service_manager.h"
#include "deploy/boat/status_line.h"
#include "deploy/boat/voyage.h"
#include "high_level/mission/command_socket.h"
#include "high_level/mission/network.h"
#include "high_level/mission/token_file.h"
#include "high_level/tasks/operator_desk.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/runtime/realtime_rights.h"
#include "mid_level/runtime/run_realtime.h"

namespace lodesman {
namespace {

constexpr Duration kSegmentPatience = std::chrono::seconds{5};
constexpr Duration kRefusalPatience = std::chrono::milliseconds{300};

enum class Attachment : std::uint8_t { kFirst, kAgain };

[[nodiscard]] CommandTokens lasting_tokens(const CommandSocketSettings& settings) {
  return settings.token_file.empty()
             ? CommandTokens{}
             : read_lasting_tokens(settings.token_file,
                                   reach_of(settings.address).value_or(Reach::kNetwork));
}

// Says that somebody is refused beyond loopback, and not more often than anybody wants to read.
class RefusalLog {
 public:
  void refused(const std::string& address) {
    ++count_;
    if (const Time now = clock_.now(); !said_ || now - *said_ >= kPeriod) {
      spdlog::warn("command socket: a wrong proof of a token from {}; {} since this was said last",
                   address, count_);
      said_ = now;
      count_ = 0;
    }
  }

 private:
  static constexpr Duration kPeriod = std::chrono::seconds{60};
  SteadyClock clock_;
  std::optional<Time> said_;
  std::uint64_t count_ = 0;  // since it was said last
};

// The operator's way in: the desk, the socket before it, and the tokens that open it: those made
// for this run, and those of the boat's own file. The desk is the socket's thread's alone.
class WayIn {
 public:
  WayIn(Blackboard& board, const CommandSocketSettings& settings, const CommandTokens& lasting,
        const DeskOptions& options)
      : desk_{board, Role::kHigh, options, [] { return SteadyClock{}.now(); }},
        socket_{socket_options(settings, tokens_, lasting),
                [this](const CommandRequest& request) { return desk_.answer(request); },
                {[this](std::uint64_t session) { desk_.session_ended(session); },
                 [this] { desk_.look(); },
                 [this](const std::string& address) { refusals_.refused(address); }}},
        token_file_{socket_.port(), tokens_} {
    if (settings.port == 0) {  // whoever asked for any port must be told which
      say("lodesman-high: command socket on " + settings.address + " port " +
          std::to_string(socket_.port()));
    }
  }

 private:
  [[nodiscard]] static CommandSocketOptions socket_options(const CommandSocketSettings& settings,
                                                           const CommandTokens& tokens,
                                                           const CommandTokens& lasting) {
    CommandSocketOptions options{settings.address, settings.port, tokens};
    options.lasting_tokens = lasting;
    return options;
  }

  OperatorDesk desk_;
  RefusalLog refusals_;
  CommandTokens tokens_ = random_tokens();
  CommandSocket socket_;
  TokenFile token_file_;
};

// A channel's last word, on a segment that is left or on one that was found.
template <class Value>
using Last = std::optional<Stamped<Value>>;
template <class Channel>
[[nodiscard]] Last<typename Channel::Value> last_on(const Channel& channel) {
  Reader<typename Channel::Value> reader{channel};
  const auto* last = reader.latest();
  return last != nullptr ? std::optional{*last} : std::nullopt;
}

void report_what_was_found(const SharedBlackboard& board) {
  if (!board.found_dead()) {
    return;
  }
  const auto last = last_on(board->mission_status);
  spdlog::warn("an earlier lodesman-high died; its mission was {}",
               last ? to_string(last->value.state) : "not yet begun");
}

// Looks for a segment with a living low level. The first one is waited for as long as a start may
// take, one that comes back for as long as it takes. What cannot be used is refused, once it cannot
// be what a low level that starts is about to replace.
class SegmentSearch {
 public:
  SegmentSearch(const std::string& segment, Attachment which) : segment_{segment}, which_{which} {}

  // Empty while there is none. Throws NotYetError or StartupError once patience is at its end.
  [[nodiscard]] std::optional<SharedBlackboard> look() {
    const Time now = clock_.now();
    try {
      return SharedBlackboard::open(segment_, Role::kHigh, Duration::zero());
    } catch (const NotYetError&) {
      if (which_ == Attachment::kFirst && now >= begun_ + kSegmentPatience) {
        throw;
      }
      nothing_seen_ = now;
    } catch (const StartupError&) {
      if (now >= nothing_seen_ + kRefusalPatience) {
        throw;
      }
    }
    return std::nullopt;
  }

 private:
  SteadyClock clock_;
  std::string segment_;
  Attachment which_;
  Time begun_ = clock_.now();
  Time nothing_seen_ = begun_;
};

// Empty when told to stop before there was a segment.
[[nodiscard]] std::optional<SharedBlackboard> attach(const std::string& segment, Attachment which,
                                                     ServiceManager& manager) {
  SegmentSearch search{segment, which};
  auto board = search.look();
  if (!board) {
    wait_for_stop([&] {
      manager.wait(SteadyClock{}.now(), "waiting for lodesman-low");
      board = search.look();
      return board.has_value();
    });
  }
  return board;
}

// Says once that the low level has gone, and once that it is back. Meanwhile nothing is to be done:
// its values go stale, and stale means neutral.
class LowLevelWatch {
 public:
  explicit LowLevelWatch(const SharedBlackboard& board) : board_{board} {}
  void look() {
    if (const bool alive = board_.alive(Role::kLow); alive != alive_) {
      alive_ = alive;
      spdlog::warn(alive ? "lodesman-low is back"
                         : "lodesman-low is gone: neutral until it is back");
    }
  }

 private:
  const SharedBlackboard& board_;
  bool alive_ = true;
};

// Says once where an origin lies that the first fixes gave.
class OriginWatch {
 public:
  explicit OriginWatch(const SharedBlackboard& board) : origin_{board->world_origin} {}
  void look() {
    while (const auto* told = origin_.next()) {
      if (const WorldOrigin& o = told->value; o.source == OriginSource::kFirstFix) {
        say(fmt::format("lodesman-high: the world's origin is {:.7f}, {:.7f}, by the first fixes",
                        o.latitude_deg, o.longitude_deg));
      }
    }
  }

 private:
  Reader<WorldOrigin> origin_;
};

// The threads of the tasks, and who notices when one of them hangs.
struct RunningTasks {
  RunningTasks(std::span<const TaskEntry> tasks, SharedBlackboard& board)
      : health{*board, tasks, SteadyClock{}.now()},
        runner{tasks, board.writable(), Role::kHigh, end_without} {}

  HealthWatch health;
  RealtimeRunner runner;
};

struct HighOptions : ProcessOptions {
  bool start = false;
  bool arm = false;
};

// Runs the high level on one segment until a stop is asked for or a new low level has made another.
void sail(SharedBlackboard& board, const BoatConfig& config, const Voyage& voyage,
          const CommandTokens& lasting, bool start_by_itself, bool arms, ServiceManager& manager) {
  HighLevel high{board.writable(), Role::kHigh, high_level_options(config, voyage)};
  DeskOptions at_the_desk = desk_options(config, voyage);
  at_the_desk.starts_by_itself = start_by_itself;
  at_the_desk.arms_by_itself |= start_by_itself && arms;
  const WayIn way_in{board.writable(), config.command_socket, lasting, at_the_desk};
  const auto tasks = high.tasks();
  // Stopped, its tasks leave all safe; they go on where they stood.
  std::optional<RunningTasks> running;
  running.emplace(tasks, board);
  LowLevelWatch low{board};
  OriginWatch origin{board};
  HighStatusLine line{*board};
  const auto status = [&] { return line.text(board.alive(Role::kLow)); };
  wait_for_stop([&] {
    low.look();
    origin.look();
    if (const bool silent = launcher_is_silent(); silent && running) {
      running.reset();
      spdlog::warn("the launcher has fallen silent: neutral until it is heard again");
    } else if (!silent && !running) {
      running.emplace(tasks, board);
    }
    if (running) {
      say_what_hangs(running->health);
      manager.look(running->health, SteadyClock{}.now(), status);
    } else {
      manager.wait(SteadyClock{}.now(), "neutral: the launcher has fallen silent");
    }
    return board.is_superseded();
  });
}

// What the mission was, and where the world's origin is, is told to the new segment as if it had
// been there all along, so that a restarted level finds there what every other one finds: an abort
// stands, nothing sails by itself, and the origin stays.
void hand_on(const Last<MissionStatus>& mission, const Last<WorldOrigin>& origin,
             Blackboard& board) {
  if (mission) {
    Writer<MissionStatus>{board.mission_status, Role::kHigh, "mission_status"}.publish(
        mission->value, mission->stamp);
  }
  if (origin) {
    Writer<WorldOrigin>{board.world_origin, Role::kHigh, "world_origin"}.publish(origin->value,
                                                                                 origin->stamp);
  }
}

int run(const HighOptions& options) {
  bool start_by_itself = options.start;
  const BoatConfig config = load_configuration(options.profile, options.common);
  const std::optional<Scenario> simulated = simulated_scenario(config);
  const Scenario* scenario = simulated ? &*simulated : nullptr;
  require_sound(config, scenario);
  const Voyage voyage = voyage_of(config, scenario);
  const CommandTokens lasting = lasting_tokens(config.command_socket);
  // lodesman-low, which has the same rights, warns if they are missing.
  (void)set_up_realtime();
  ServiceManager manager;
  auto board = attach(config.segment, Attachment::kFirst, manager);
  if (board) {
    report_what_was_found(*board);
  }
  while (board) {
    sail(*board, config, voyage, lasting, start_by_itself, options.arm, manager);
    if (stop_asked()) {
      manager.stopping();
      break;
    }
    const auto mission = last_on((*board)->mission_status);
    const auto origin = last_on((*board)->world_origin);
    start_by_itself &= !mission || mission->value.started == Time{};
    spdlog::warn("a new lodesman-low has made segment {} anew: beginning anew on it",
                 config.segment);
    board.reset();
    board = attach(config.segment, Attachment::kAgain, manager);
    if (board) {
      hand_on(mission, origin, board->writable());
    }
  }
  return kExitDone;
}

}  // namespace
}  // namespace lodesman

int main(int argc, char** argv) {
  lodesman::block_stop_signals();
  lodesman::log_without_blocking();
  CLI::App app{"The high level: estimator, re-planner, guidance, control and mission",
               "lodesman-high"};
  lodesman::HighOptions options;
  lodesman::add_process_options(app, options);
  app.add_flag("--start", options.start,
               "Start the scenario's mission without an operator's word, once the boat is ready");
  app.add_flag("--arm", options.arm,
               "With --start: arm the thrusters too, where they are not simulated (for a bench)");
  app.footer("Example: lodesman-high --config boat.toml");
  spdlog::set_level(spdlog::level::warn);
  return lodesman::process_main(app, argc, argv, [&] { return lodesman::run(options); });
}
