// SPDX-License-Identifier: Apache-2.0
// What is counted of simulated and of real pings, and where both come from. Of one program that
// measures, on its one thread.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hal_sim/sonar/water_kind.h"
#include "mid_level/messages/sonar.h"

namespace lodesman::measure {

using Walls = std::vector<std::vector<Vertex>>;

// Each of every ping, in the order of the table.
struct Figures {
  std::vector<double> variation;           // of speckle
  std::vector<std::vector<double>> along;  // its correlation at 1, 2 and 4 bins
  std::vector<std::vector<double>> across;
  std::vector<double> near_level;
  std::vector<double> far_level;
  std::vector<double> ring_share;    // all ranges of all pings
  std::vector<double> wall;          // pieces met within 60 degrees of square on
  std::vector<double> grazing_wall;  // beyond 70 degrees
  std::vector<double> target_median;
  std::vector<double> target_p90;
  std::vector<double> target_peak;
  std::vector<double> target_faint;  // share of its cells below 3 times the range's median
};

// Adds a ping's; `is_target(beam, bin)`, walls in the vehicle frame.
void add_figures(const SonarPing& ping,
                 const std::function<bool(std::uint32_t, std::uint32_t)>& is_target,
                 const Walls& walls, Figures& figures);

// Of as many pings, from several seeds, of scenes like those of the real frames.
[[nodiscard]] Figures simulated_figures(const WaterKind& kind, int pings);

// Of the labelled frames in that folder of the shared data; throws where one cannot be read.
[[nodiscard]] Figures real_figures(const std::filesystem::path& folder);

}  // namespace lodesman::measure
