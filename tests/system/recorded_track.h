// SPDX-License-Identifier: Apache-2.0
// Recorded tracks of boats as the sentences of a receiver, epoch by epoch, and where they go.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mid_level/base/geodesy.h"

namespace lodesman::testing {

// What a receiver says at one time.
struct Epoch {
  double second_s = 0.0;  // of its day
  GeoPoint place;
  std::string sentences;
};

// Of a receiver's own log: from its first whole epoch with a fix, `count` of them, after `skipped`.
[[nodiscard]] std::vector<Epoch> nmea_epochs(const std::filesystem::path& log, std::size_t skipped,
                                             std::size_t count);

// The lake boat's table as GGA and RMC once a second, its heading as the course.
[[nodiscard]] std::vector<Epoch> catabot_epochs(const std::filesystem::path& csv,
                                                std::size_t skipped, std::size_t count);

}  // namespace lodesman::testing
