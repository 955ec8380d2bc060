// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/frames_file.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace lodesman::bench {
namespace {

using testing::FrameKind;

// Names in files are not quite those of the table.
FrameKind kind_of(const std::string& category) {
  const std::string name = category == "headon"           ? "head-on"
                           : category == "Ushape"         ? "U"
                           : category == "goal-in-pocket" ? "pocket"
                                                          : category;
  const auto& names = testing::kFrameKindNames;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw std::runtime_error("no such kind of frame: " + category);
  }
  return static_cast<FrameKind>(found - names.begin());
}

PathPixel pixel_of(const nlohmann::json& pair) {
  return {pair.at(0).get<std::int16_t>(), pair.at(1).get<std::int16_t>()};
}

}  // namespace

std::vector<testing::RandomFrame> read_frames(const std::string& path) {
  std::ifstream file{path};
  if (!file) {
    throw std::runtime_error(path + ": cannot be read");
  }
  std::vector<testing::RandomFrame> frames;
  for (std::string line; std::getline(file, line);) {
    const auto json = nlohmann::json::parse(line);
    testing::RandomFrame frame;
    frame.kind = kind_of(json.at("category"));
    frame.start = pixel_of(json.at("start_px"));
    frame.goal = pixel_of(json.at("goal_px"));
    for (const auto& o : json.at("obstacles")) {
      frame.obstacles.push_back(
          EllipsePx::with_angle({o.at("cx"), o.at("cy")}, o.at("a"), o.at("b"), o.at("theta_rad")));
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace lodesman::bench
