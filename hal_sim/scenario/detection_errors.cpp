// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/detection_errors.h"

namespace lodesman {

DetectionErrors read_detection_errors(const TomlTable& table) {
  const auto value = [&table](std::string_view key, double most) {
    return table.number_or(key, Range::between(0.0, most), 0.0);
  };
  return {.missed = value("missed", 0.9),
          .split = value("split", 1.0),
          .displaced_m = value("displaced_m", 5.0),
          .false_per_ping = value("false_per_ping", 10.0),
          .noise_m = value("noise_m", 1.0)};
}

}  // namespace lodesman
