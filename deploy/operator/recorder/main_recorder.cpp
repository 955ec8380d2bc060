// SPDX-License-Identifier: Apache-2.0
// lodesman-recorder: the black box. Follows every channel of the boat's blackboard, which it maps
// read-only, and writes all of it to MCAP files; whatever becomes of it, nothing happens to the
// boat.
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "deploy/boat/exit_status.h"
#include "deploy/boat/log.h"
#include "deploy/boat/named_scenario.h"
#include "deploy/boat/process_main.h"
#include "deploy/operator/recorder/recorder_loop.h"
#include "deploy/operator/recorder/series_of_boat.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {

// As long as lodesman-high waits for its first segment.
constexpr Duration kFirstPatience = std::chrono::seconds{5};
// What is started again is back by then; later the file is closed.
constexpr Duration kBoatPatience = std::chrono::seconds{5};
constexpr Duration kLookPeriod = std::chrono::milliseconds{100};
// What cannot be used may be what a low level that starts is about to replace.
constexpr Duration kRefusalPatience = std::chrono::milliseconds{300};

struct RecorderOptions : ProcessOptions {
  std::string out;
};

// Gone on with for as long as it takes, but for the first time. Empty when told to stop.
[[nodiscard]] std::optional<SharedBlackboard> attach(const std::string& segment, bool first) {
  const SteadyClock clock;
  const Time begun = clock.now();
  Time nothing_seen = begun;
  std::optional<SharedBlackboard> board;
  const auto look = [&] {
    const Time now = clock.now();
    try {
      board.emplace(SharedBlackboard::observe(segment, Duration::zero()));
    } catch (const NotYetError&) {
      if (first && now - begun >= kFirstPatience) {
        throw;
      }
      nothing_seen = now;
    } catch (const StartupError&) {
      if (now - nothing_seen >= kRefusalPatience) {
        throw;
      }
    }
    return board.has_value();
  };
  while (!look() && !stop_asked()) {
    wait_for_stop(look);
  }
  return board;
}

// Asks now and then, since each time opens the segment.
class BoatLife {
 public:
  explicit BoatLife(const SharedBlackboard& board) : board_{board} {}

  void look() {
    const Time now = clock_.now();
    if (now - looked_ < kLookPeriod) {
      return;
    }
    looked_ = now;
    superseded_ = board_.is_superseded();
    // What one of them publishes is recorded, whatever has become of the other.
    if (board_.alive(Role::kLow) || board_.alive(Role::kHigh)) {
      alive_at_ = now;
    }
  }
  [[nodiscard]] bool is_superseded() const noexcept { return superseded_; }
  [[nodiscard]] bool is_alive() const noexcept { return alive_at_ == looked_; }
  [[nodiscard]] bool is_gone() const noexcept { return looked_ - alive_at_ > kBoatPatience; }

 private:
  const SharedBlackboard& board_;
  SteadyClock clock_;
  Time looked_{};
  Time alive_at_ = clock_.now();
  bool superseded_ = false;
};

// Until this segment is left for good, or a stop. A boat that is gone for longer ends the file; if
// it comes back to this segment, another one goes on where that ended.
void record(const SharedBlackboard& board, FileSeries& series, std::size_t queue_bytes) {
  BoardTap tap{*board};
  BoatLife boat{board};
  const auto say_news = [&series] {
    for (const std::string& line : series.news()) {
      say(line);
    }
  };
  while (!stop_asked() && !boat.is_superseded()) {
    {
      const RecorderLoop loop{tap, series, queue_bytes, say};
      wait_for_stop([&] {
        boat.look();
        return boat.is_superseded() || boat.is_gone();
      });
    }
    series.close();
    say_news();
    wait_for_stop([&] {
      boat.look();
      return boat.is_superseded() || boat.is_alive();
    });
  }
}

[[nodiscard]] std::string scenario_text(const BoatConfig& config) {
  if (config.simulation.scenario.empty()) {
    return {};
  }
  std::ostringstream text;
  text << std::ifstream{scenario_file(config.simulation.scenario), std::ios::binary}.rdbuf();
  return text.str();
}

int run(const RecorderOptions& options) {
  const BoatConfig config = load_configuration(options.profile, options.common);
  const RecorderSettings settings = recorder_settings(config);
  const RecordingNotes notes = recording_notes(config, "lodesman-recorder", scenario_text(config));
  const auto series = options.out.empty()
                          ? series_of_boat(config, recording_name(config), notes)
                          : series_of_run(config, options.out, notes, settings.chunk_span);
  for (bool first = true; !stop_asked(); first = false) {
    const auto board = attach(config.segment, first);
    if (!board) {
      break;
    }
    record(*board, *series, settings.queue_bytes);
  }
  say("recorded " + std::to_string(series->recorded()) + " publications, " +
      std::to_string(series->lost()) + " are missing");
  return series->has_failed() ? kExitFault : kExitDone;
}

}  // namespace
}  // namespace lodesman::cli

int main(int argc, char** argv) {
  lodesman::block_stop_signals();
  lodesman::log_without_blocking();
  CLI::App app{"The black box: every publication of a running boat, to MCAP files",
               "lodesman-recorder"};
  lodesman::cli::RecorderOptions options;
  lodesman::add_process_options(app, options);
  app.add_option("--out", options.out, "One file for all of it, instead of [recorder] directory")
      ->type_name("FILE");
  app.footer("Example: lodesman-recorder --config boat.toml");
  return lodesman::process_main(app, argc, argv, [&] { return lodesman::cli::run(options); });
}
