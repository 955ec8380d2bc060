// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/recorder/series_of_boat.h"

#include <array>
#include <chrono>
#include <ctime>
#include <utility>

#include "deploy/boat/version.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/base/utc.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

[[nodiscard]] std::int64_t utc_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

// What is to be added to a time in the file to make it UTC, as the machine's clock has it now: that
// may be set long after the boat was switched on.
void renew_utc(std::map<std::string, std::string>& about) {
  if (const std::int64_t utc_ns = utc_now_ns(); is_plausible_utc(utc_ns)) {
    about["utc_minus_boat_ns"] =
        std::to_string(utc_ns - SteadyClock{}.now().time_since_epoch().count());
  } else {
    about.erase("utc_minus_boat_ns");
  }
}

[[nodiscard]] std::unique_ptr<FileSeries> series(const BoatConfig& config, SeriesOptions options,
                                                 RecordingNotes notes) {
  options.free_floor_bytes = recorder_settings(config).free_floor_bytes;
  // What is published once and holds on.
  options.said_again = {"world_origin", "mission_definition", "tunables", "box_proof"};
  const fs::path where = options.first;
  return std::make_unique<FileSeries>(
      std::move(options), std::move(notes),
      [](const fs::path& path) { return std::make_unique<DiskFile>(path); },
      [where] { return free_bytes_at(where); });
}

}  // namespace

RecorderSettings recorder_settings(const BoatConfig& config) {
  return read_recorder(config.document.root().table("recorder"));
}

fs::path recording_name(const BoatConfig& config) {
  const fs::path directory = recorder_settings(config).directory;
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) {
    throw StartupError(directory.string() + ": cannot be made: " + error.message());
  }
  const std::int64_t now_ns = utc_now_ns();
  const auto now = static_cast<std::time_t>(now_ns / 1'000'000'000);
  std::tm parts{};
  std::array<char, 32> when{"no-clock"};
  if (is_plausible_utc(now_ns) && gmtime_r(&now, &parts) != nullptr) {
    static_cast<void>(std::strftime(when.data(), when.size(), "%Y%m%dT%H%M%SZ", &parts));
  }
  std::string boat = config.name;
  for (char& c : boat) {
    c = c == '/' || c == ' ' ? '-' : c;
  }
  return directory / (std::string{when.data()} + "-" + boat + ".mcap");
}

RecordingNotes recording_notes(const BoatConfig& config, const std::string& program,
                               const std::string& scenario) {
  RecordingNotes notes;
  notes.library = program + " " + kVersion;
  notes.about = {{"version", kVersion},
                 {"boat", config.name},
                 {"segment", config.segment},
                 {"layout_hash", std::to_string(layout_hash())}};
  notes.attachments["config.toml"] = config.to_text();
  if (!scenario.empty()) {
    notes.attachments["scenario.toml"] = scenario;
  }
  return notes;
}

std::unique_ptr<FileSeries> series_of_boat(const BoatConfig& config, const fs::path& first,
                                           RecordingNotes notes) {
  SeriesOptions options;
  options.first = first;
  options.renew_about = renew_utc;
  const RecorderSettings settings = recorder_settings(config);
  options.rotate_bytes = settings.rotate_bytes;
  options.rotate_after = settings.rotate_after;
  options.chunk_span = settings.chunk_span;
  return series(config, std::move(options), std::move(notes));
}

std::unique_ptr<FileSeries> series_of_run(const BoatConfig& config, const fs::path& file,
                                          RecordingNotes notes, Pace pace) {
  SeriesOptions options;
  options.first = file;
  if (pace == Pace::kRealTime) {
    options.chunk_span = recorder_settings(config).chunk_span;
    options.renew_about = renew_utc;
  }
  return series(config, std::move(options), std::move(notes));
}

}  // namespace lodesman::cli
