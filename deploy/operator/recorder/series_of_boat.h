// SPDX-License-Identifier: Apache-2.0
// A boat's recordings as its configuration has them: where they go, when they end, and what is said
// of the boat in each. The main thread, at start-up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "deploy/boat/configuration.h"
#include "deploy/boat/recorder_settings.h"
#include "mid_level/recording/file_series.h"

namespace lodesman::cli {

[[nodiscard]] RecorderSettings recorder_settings(const BoatConfig& config);

// In the configuration's directory, which is made where there is none; by the time of day, where
// that is known, and the boat's name. Throws StartupError.
[[nodiscard]] std::filesystem::path recording_name(const BoatConfig& config);

// What stands in each file; `program`: who writes it. `scenario`: its text, empty where none is.
[[nodiscard]] RecordingNotes recording_notes(const BoatConfig& config, const std::string& program,
                                             const std::string& scenario);

// A boat's files, one after another: `first`, and as the configuration says.
[[nodiscard]] std::unique_ptr<FileSeries> series_of_boat(const BoatConfig& config,
                                                         const std::filesystem::path& first,
                                                         RecordingNotes notes);

// In lock-step the boat's time is the run's own, and a run that a power cut ends can be sailed
// again: nothing in the file is of the machine's clock, and a chunk is as large as may be.
enum class Pace : std::uint8_t { kRealTime, kLockstep };

// All of a run in one file.
[[nodiscard]] std::unique_ptr<FileSeries> series_of_run(const BoatConfig& config,
                                                        const std::filesystem::path& file,
                                                        RecordingNotes notes, Pace pace);

}  // namespace lodesman::cli
