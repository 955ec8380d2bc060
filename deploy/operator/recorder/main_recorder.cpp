// SPDX-License-Identifier: Apache-2.0
// lodesman-recorder: the black box. Follows every channel of the boat's blackboard, which it maps
// read-only, and writes all of it to MCAP files; whatever becomes of it, nothing happens to the
// boat.
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

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
namespace fs = std::filesystem;

// As long as lodesman-high waits for its first segment.
constexpr Duration kFirstPatience = std::chrono::seconds{5};
// What is started again is back by then; later the file is closed.
constexpr Duration kBoatPatience = std::chrono::seconds{5};
constexpr Duration kLookPeriod = std::chrono::milliseconds{20};
// What cannot be used may be what a low level that starts is about to replace.
constexpr Duration kRefusalPatience = std::chrono::milliseconds{300};
// A stop of the whole boat comes to all its programs at once: this one ends after the others, so
// that it has their last words, or after so long.
constexpr Duration kLastWords = std::chrono::seconds{1};
constexpr Duration kLastWordsPeriod = std::chrono::milliseconds{20};

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
    } catch (const StartupError& error) {
      if (now - nothing_seen >= kRefusalPatience) {
        if (first) {
          throw;
        }
        // The boat was started anew as another version: whoever starts this one again has that too.
        throw NotYetError(error.what());
      }
    }
    return board.has_value();
  };
  if (!look()) {
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

// Once a stop is asked for.
void hear_last_words(BoatLife& boat) {
  const SteadyClock clock;
  const Time until = clock.now() + kLastWords;
  while (stop_asked() && boat.is_alive() && clock.now() < until) {
    std::this_thread::sleep_for(kLastWordsPeriod);
    boat.look();
  }
}

void close(FileSeries& series) {
  series.close();
  for (const std::string& line : series.news()) {
    say(line);
  }
}

// Until this segment is left for good, or a stop. A boat that is gone for longer ends the file; if
// it comes back to this segment, another one goes on where that ended.
void record(const SharedBlackboard& board, bool first, FileSeries& series,
            std::size_t queue_bytes) {
  // A segment that came while this program was there is recorded from its first publication on.
  BoardTap tap{*board, first ? BoardTap::Past::kNoGap : BoardTap::Past::kGap};
  auto which = first ? RecorderLoop::Board::kTheSame : RecorderLoop::Board::kAnother;
  BoatLife boat{board};
  while (!stop_asked()) {
    {
      const RecorderLoop loop{tap, which, series, queue_bytes, say};
      wait_for_stop([&] {
        boat.look();
        return boat.is_superseded() || boat.is_gone();
      });
      hear_last_words(boat);
    }
    if (boat.is_superseded()) {
      say("lodesman-low has made another segment, which is recorded in another file");
      return;
    }
    if (boat.is_gone()) {
      say("neither lodesman-low nor lodesman-high is there any more");
    }
    close(series);
    which = RecorderLoop::Board::kTheSame;
    wait_for_stop([&] {
      boat.look();
      return boat.is_superseded() || boat.is_alive();
    });
    if (boat.is_superseded()) {
      return;
    }
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

// Later there is nobody to tell it to; what comes and goes, as a disk's room, is no reason.
void refuse_no_place(const std::string& out) {
  const fs::path directory = fs::path{out}.parent_path();
  std::error_code error;
  if (!directory.empty() && !fs::is_directory(directory, error)) {
    throw StartupError("--out " + out + ": " + directory.string() + " is no directory");
  }
  if (fs::is_directory(out, error)) {
    throw StartupError("--out " + out + ": is a directory");
  }
}

int run(const RecorderOptions& options) {
  const BoatConfig config = load_configuration(options.profile, options.common);
  const RecorderSettings settings = recorder_settings(config);
  if (!options.out.empty()) {
    refuse_no_place(options.out);
  }
  const RecordingNotes notes = recording_notes(config, "lodesman-recorder", scenario_text(config));
  const auto series = options.out.empty()
                          ? series_of_boat(config, recording_name(config), notes)
                          : series_of_run(config, options.out, notes, Pace::kRealTime);
  for (bool first = true; !stop_asked(); first = false) {
    const auto board = attach(config.segment, first);
    if (!board) {
      break;
    }
    record(*board, first, *series, settings.queue_bytes);
  }
  close(*series);
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
  app.add_option("--out", options.out,
                 "Instead of [recorder] directory; ends neither by size nor by age")
      ->type_name("FILE");
  app.footer("Example: lodesman-recorder --config boat.toml");
  return lodesman::process_main(app, argc, argv, [&] { return lodesman::cli::run(options); });
}
