// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/segmentation_config.h"

namespace lodesman {

SegmentationOptions read_segmentation_options(const TomlTable& table) {
  const auto count = [&table](std::string_view key, std::int64_t min, std::int64_t max) {
    return static_cast<std::uint32_t>(table.integer(key, min, max));
  };
  return {
      .threshold = table.number("threshold", Range::above(0.0, 255.0)),
      .min_range_m = table.number("min_range_m", Range::between(0.0, 300.0)),
      .min_blob_bins = count("min_blob_bins", 1, kMaxBeams * kMaxBins),
      .join_beams = count("join_beams", 1, kMaxJoin),
      .join_bins = count("join_bins", 1, kMaxJoin),
      .max_obstacle_length_m = table.number("max_obstacle_length_m", Range::above(0.0, 300.0)),
      .min_fill = table.number("min_fill", Range::between(0.0, 1.0)),
      .enclosed_fraction = table.number("enclosed_fraction", Range::between(0.5, 0.99)),
      .protection_margin_m = table.number("protection_margin_m", Range::between(0.0, 100.0)),
      .stripe_fraction = table.number("stripe_fraction", Range::above(0.0, 1.0)),
      .stripe_max_beams = count("stripe_max_beams", 0, kMaxBeams),
  };
}

}  // namespace lodesman
