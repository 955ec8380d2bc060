// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/segment_text.h"

#include <array>
#include <cstdio>
#include <iostream>
#include <string>

namespace lodesman::cli {
namespace {

using nlohmann::ordered_json;

void print_obstacle(const ordered_json& o) {
  std::array<char, 64> place{};
  std::snprintf(place.data(), place.size(), "  %7.2f m %+7.2f deg  ", o["range_m"].get<double>(),
                o["bearing_deg"].get<double>());
  std::array<char, 64> shape{};
  if (o.contains("vertices_m")) {
    std::snprintf(shape.data(), shape.size(), "polygon of %zu corners", o["vertices_m"].size());
  } else {
    std::snprintf(shape.data(), shape.size(), "%5.2f x %5.2f m at %+4.0f deg",
                  o["semi_axes_m"][0].get<double>(), o["semi_axes_m"][1].get<double>(),
                  o["angle_deg"].get<double>());
  }
  std::array<char, 32> peak{};
  std::snprintf(peak.data(), peak.size(), "  peak %3.0f\n", o["peak"].get<double>());
  std::cout << place.data() << shape.data() << peak.data();
}

}  // namespace

void print_frame(const nlohmann::ordered_json& frame) {
  std::cout << frame["file"].get<std::string>() << ": " << frame["obstacles"].size()
            << " obstacles\n";
  for (const nlohmann::ordered_json& o : frame["obstacles"]) {
    print_obstacle(o);
  }
  if (frame.contains("reason")) {
    std::cout << "  path: " << frame["reason"].get<std::string>() << ", " << frame["path_m"].size()
              << " pixels\n";
  }
}

}  // namespace lodesman::cli
