// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/watch_command.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <thread>

#include "deploy/boat/configuration.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/operator/bench/file_check.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/watch/board_watch.h"
#include "deploy/operator/watch/find_segment.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {

struct WatchOptions {
  CommonOptions common;
  std::string segment;
  bool once = false;
};

constexpr Duration kRedrawPeriod = std::chrono::seconds{1};
constexpr Duration kOnceLook = std::chrono::seconds{2};  // plans are 1.6 s apart
constexpr Duration kPatience = std::chrono::milliseconds{200};

// Those of the segments that a living lodesman-low holds.
[[nodiscard]] std::vector<std::string> alive_of(const std::vector<std::string>& names) {
  std::vector<std::string> alive;
  for (const std::string& name : names) {
    try {
      if (SharedBlackboard::observe(name, Duration::zero()).alive(Role::kLow)) {
        alive.push_back(name);
      }
    } catch (const StartupError&) {
      // Another build's, or gone meanwhile: not one to be chosen unasked.
    }
  }
  return alive;
}

// Rows of the terminal; plenty where it does not say.
[[nodiscard]] std::size_t terminal_rows() noexcept {
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 1 ? size.ws_row : 1000;
}

// Over the last table, so that nothing flickers; what does not fit is left out, because scrolling
// would leave the top line behind at every redraw.
void redraw(std::vector<std::string> lines) {
  if (const std::size_t rows = terminal_rows(); lines.size() >= rows) {
    const std::size_t left_out = lines.size() - rows + 2;
    lines.resize(rows - 2);
    lines.push_back(fmt::format("  ... {} more lines need a taller terminal", left_out));
  }
  std::string screen = "\x1b[H";
  for (const std::string& line : lines) {
    screen += line + "\x1b[K\n";
  }
  fmt::print("{}\x1b[J", screen);
  std::fflush(stdout);
}

void print(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    fmt::print("{}\n", line);
  }
  std::fflush(stdout);
}

// Looks on for `period`, or until it is stopped or lodesman-low is gone.
void look_on(BoardWatch& watch, const SharedBlackboard& board, Duration period) {
  const SteadyClock clock;
  const Time until = clock.now() + period;
  watch.poll(clock.now());
  while (!stop_caught() && clock.now() < until && board.alive(Role::kLow)) {
    std::this_thread::sleep_for(BoardWatch::kPollPeriod);
    watch.poll(clock.now());
  }
}

[[nodiscard]] SegmentState state_of(const std::string& segment, const SharedBlackboard& board,
                                    const BoardWatch& watch) {
  return {segment, board.alive(Role::kLow), board.alive(Role::kHigh), watch.state()};
}

[[nodiscard]] int watch(const WatchOptions& options) {
  refuse_bad_configuration(options.common);
  const std::vector<std::string> found = segments_in("/dev/shm");
  // That of the boat whose configuration is given.
  const std::string named = options.segment.empty() && !options.common.config_files.empty()
                                ? load_configuration("default", options.common).segment
                                : options.segment;
  const std::string segment = choose_segment(named, found, alive_of(found));
  const SharedBlackboard board = SharedBlackboard::observe(segment, kPatience);
  catch_stop_signals();
  BoardWatch watch{*board};
  if (options.once || options.common.json) {
    look_on(watch, board, kOnceLook);
    const SegmentState state = state_of(segment, board, watch);
    if (options.common.json) {
      fmt::print("{}\n", to_json(state).dump(-1, ' ', false,
                                             nlohmann::ordered_json::error_handler_t::replace));
    } else {
      print(table_lines(state, isatty(STDOUT_FILENO) == 1));
    }
    return kExitDone;
  }
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  if (terminal) {
    fmt::print("\x1b[2J");
  }
  for (;;) {
    look_on(watch, board, kRedrawPeriod);
    if (stop_caught()) {
      break;
    }
    const SegmentState state = state_of(segment, board, watch);
    terminal ? redraw(table_lines(state, true)) : print(table_lines(state, false));
    if (std::ferror(stdout) != 0) {
      break;  // nobody looks any more
    }
    if (!state.low_alive) {
      fmt::print("{}: lodesman-low is gone\n", segment);
      break;
    }
  }
  return kExitDone;
}

}  // namespace

void add_watch_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<WatchOptions>();
  CLI::App* command =
      root.add_subcommand("watch", "Channels and tasks of a running boat, live; Ctrl-C ends it");
  command
      ->add_option("--segment", options->segment,
                   "Which one, where several boats run; default: the only /dev/shm/lodesman*")
      ->type_name("NAME");
  command->add_flag("--once", options->once, "Look on for two seconds and print one table");
  add_common_options(*command, options->common);
  command->footer("Example: lodesman watch --once\n\n'!' marks what is stale or gone.");
  command->callback([options, &exit_status] { exit_status = watch(*options); });
}

}  // namespace lodesman::cli
