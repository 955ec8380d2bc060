// SPDX-License-Identifier: Apache-2.0
#include "tests/support/echo_statistics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mid_level/base/heading.h"

namespace lodesman::testing {
namespace {

constexpr double kEcho = 1.6;     // times the background: an echo, and no speckle
constexpr double kDarkest = 3.0;  // [-] of 255; below, speckle is lost in whole levels
constexpr int kBinsAside = 12;    // of the mean round a cell
constexpr int kBeamsAside = 7;
constexpr double kLeastCells = 60.0;  // of that mean
constexpr double kBrightEcho = 120.0;
constexpr int kNearRanges = 45;  // each way; the water is what 70 % of them exceed
constexpr double kWaterShare = 0.3;
constexpr double kPiece_m = 1.5;

// A value a cell, and sums over rectangles of them.
class Plane {
 public:
  Plane(std::uint32_t beams, std::uint32_t bins)
      : beams_{static_cast<int>(beams)},
        bins_{static_cast<int>(bins)},
        cells_(std::size_t{beams} * bins),
        sums_(std::size_t{beams + 1} * (bins + 1)) {}
  [[nodiscard]] double& at(int beam, int bin) {
    return cells_[static_cast<std::size_t>(beam * bins_ + bin)];
  }
  void add_up() {
    for (int beam = 0; beam < beams_; ++beam) {
      for (int bin = 0; bin < bins_; ++bin) {
        sum(beam + 1, bin + 1) =
            at(beam, bin) + sum(beam, bin + 1) + sum(beam + 1, bin) - sum(beam, bin);
      }
    }
  }
  [[nodiscard]] double round(int beam, int bin, int beams_aside, int bins_aside) {
    const int first = std::max(beam - beams_aside, 0);
    const int end = std::min(beam + beams_aside + 1, beams_);
    const int from = std::max(bin - bins_aside, 0);
    const int to = std::min(bin + bins_aside + 1, bins_);
    return sum(end, to) - sum(first, to) - sum(end, from) + sum(first, from);
  }

 private:
  [[nodiscard]] double& sum(int beam, int bin) {
    return sums_[static_cast<std::size_t>(beam * (bins_ + 1) + bin)];
  }
  int beams_;
  int bins_;
  std::vector<double> cells_;
  std::vector<double> sums_;
};

[[nodiscard]] double echo_of(const SonarPing& ping, int beam, int bin) {
  return ping.echo[static_cast<std::size_t>(beam) * ping.bins + static_cast<std::size_t>(bin)];
}

[[nodiscard]] std::vector<double> smoothed(const std::vector<double>& medians) {
  std::vector<double> smooth(medians.size());
  const int count = static_cast<int>(medians.size());
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int k = i - 2; k <= i + 2; ++k) {
      sum += medians[static_cast<std::size_t>(std::clamp(k, 0, count - 1))];
    }
    smooth[static_cast<std::size_t>(i)] = sum / 5.0;
  }
  return smooth;
}

// What each cell without an echo differs by, relative to what is round it; of others nothing.
struct Differences {
  Plane plane;
  Plane is_there;
  int beams;
  int bins;
};

[[nodiscard]] Differences differences(const SonarPing& ping) {
  const int beams = static_cast<int>(ping.beams);
  const int bins = static_cast<int>(ping.bins);
  const auto water = smoothed(range_medians(ping));
  Plane echoes{ping.beams, ping.bins};
  for (int beam = 0; beam < beams; ++beam) {
    for (int bin = 0; bin < bins; ++bin) {
      echoes.at(beam, bin) = echo_of(ping, beam, bin);
    }
  }
  echoes.add_up();
  Plane calm{ping.beams, ping.bins};
  Plane value{ping.beams, ping.bins};
  for (int beam = 0; beam < beams; ++beam) {
    for (int bin = 0; bin < bins; ++bin) {
      const double here = water[static_cast<std::size_t>(bin)];
      const bool is = echoes.round(beam, bin, 1, 3) < kEcho * here * 21.0 && here >= kDarkest;
      calm.at(beam, bin) = is ? 1.0 : 0.0;
      value.at(beam, bin) = is ? echo_of(ping, beam, bin) : 0.0;
    }
  }
  calm.add_up();
  value.add_up();
  Differences result{{ping.beams, ping.bins}, {ping.beams, ping.bins}, beams, bins};
  for (int beam = 0; beam < beams; ++beam) {
    for (int bin = 0; bin < bins; ++bin) {
      const double cells = calm.round(beam, bin, kBeamsAside, kBinsAside);
      const double mean = value.round(beam, bin, kBeamsAside, kBinsAside) / std::max(cells, 1.0);
      const bool is = calm.at(beam, bin) > 0.5 && cells > kLeastCells && mean > kDarkest;
      result.is_there.at(beam, bin) = is ? 1.0 : 0.0;
      result.plane.at(beam, bin) = is ? value.at(beam, bin) / mean - 1.0 : 0.0;
    }
  }
  return result;
}

// The mean product of cells so far apart.
[[nodiscard]] double product(Differences& of, int beams_off, int bins_off) {
  double sum = 0.0;
  double count = 0.0;
  for (int beam = 0; beam + beams_off < of.beams; ++beam) {
    for (int bin = 0; bin + bins_off < of.bins; ++bin) {
      sum += of.plane.at(beam, bin) * of.plane.at(beam + beams_off, bin + bins_off);
      count += of.is_there.at(beam, bin) * of.is_there.at(beam + beams_off, bin + bins_off);
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

std::vector<double> range_medians(const SonarPing& ping) {
  std::vector<double> medians;
  for (std::uint32_t bin = 0; bin < ping.bins; ++bin) {
    std::vector<double> row;
    for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
      row.push_back(ping.echo[std::size_t{beam} * ping.bins + bin]);
    }
    medians.push_back(median(std::move(row)));
  }
  return medians;
}

double background(const SonarPing& ping, double from, double to) {
  const auto medians = range_medians(ping);
  const auto count = static_cast<double>(medians.size());
  return median({medians.begin() + static_cast<std::ptrdiff_t>(from * count),
                 medians.begin() + static_cast<std::ptrdiff_t>(to * count)});
}

Speckle speckle_of(const SonarPing& ping) {
  Differences of = differences(ping);
  const double variance = product(of, 0, 0);
  if (!(variance > 0.0)) {
    return {};
  }
  Speckle speckle;
  speckle.variation = std::sqrt(variance);
  speckle.along = {product(of, 0, 1) / variance, product(of, 0, 2) / variance,
                   product(of, 0, 4) / variance};
  speckle.across = {product(of, 1, 0) / variance, product(of, 2, 0) / variance};
  return speckle;
}

std::vector<double> ring_shares(const SonarPing& ping) {
  const auto medians = range_medians(ping);
  const int bins = static_cast<int>(ping.bins);
  std::vector<double> shares;
  for (int bin = bins / 12; bin < bins; ++bin) {  // not where the head rings down
    double brightest = 0.0;
    for (int beam = 0; beam < static_cast<int>(ping.beams); ++beam) {
      brightest = std::max(brightest, echo_of(ping, beam, bin));
    }
    if (brightest >= kBrightEcho) {
      const double water = quantile({medians.begin() + std::max(bin - kNearRanges, 0),
                                     medians.begin() + std::min(bin + kNearRanges + 1, bins)},
                                    kWaterShare);
      shares.push_back((medians[static_cast<std::size_t>(bin)] - water) / (brightest - water));
    }
  }
  return shares;
}

std::vector<WallPiece> wall_pieces(const SonarPing& ping, const std::vector<Vertex>& wall) {
  const auto medians = range_medians(ping);
  std::vector<WallPiece> pieces;
  for (std::size_t i = 0; i + 1 < wall.size(); ++i) {
    const double dx_m = wall[i + 1].x_m - wall[i].x_m;
    const double dy_m = wall[i + 1].y_m - wall[i].y_m;
    const double length_m = std::hypot(dx_m, dy_m);
    const int parts = std::max(static_cast<int>(std::lround(length_m / kPiece_m)), 1);
    for (int part = 0; part < parts; ++part) {
      const double x_m = wall[i].x_m + (part + 0.5) / parts * dx_m;
      const double y_m = wall[i].y_m + (part + 0.5) / parts * dy_m;
      const double range_m = std::hypot(x_m, y_m);
      const int beam = static_cast<int>(std::floor(ping.beam_at(std::atan2(x_m, y_m))));
      const int bin = static_cast<int>(range_m / ping.range_m * ping.bins);
      if (beam < 1 || beam + 1 >= static_cast<int>(ping.beams) || bin < 20 ||
          bin + 20 >= static_cast<int>(ping.bins)) {
        continue;
      }
      double most = 0.0;
      for (int k = bin - 6; k <= bin + 6; ++k) {
        most = std::max(most, (echo_of(ping, beam - 1, k) + echo_of(ping, beam, k) +
                               echo_of(ping, beam + 1, k)) /
                                  3.0);
      }
      const double cosine = std::abs(x_m * dy_m - y_m * dx_m) / (range_m * length_m);
      const double water = median({medians.begin() + bin - 6, medians.begin() + bin + 7});
      pieces.push_back({std::acos(std::min(cosine, 1.0)), most / std::max(water, 1.0)});
    }
  }
  return pieces;
}

}  // namespace lodesman::testing
