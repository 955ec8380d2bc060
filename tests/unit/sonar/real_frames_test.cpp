// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "low_level/sonar/contrast.h"
#include "low_level/sonar/ping_image.h"
#include "low_level/sonar/segmentation.h"
#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<SonarPing> read_polar(const fs::path& file, double range_m) {
  auto ping = testing::empty_ping(range_m);
  polar_to_ping(read_grey_image(file), file, *ping);
  return ping;
}

struct Frame {
  std::string name;
  std::string sequence;
};

std::vector<Frame> frames_of(const fs::path& csv) {
  std::vector<Frame> frames;
  std::ifstream file{csv};
  std::string line;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) {
    std::istringstream cells{line};
    Frame frame;
    std::getline(cells, frame.name, ',');
    std::getline(cells, frame.sequence, ',');
    frames.push_back(frame);
  }
  return frames;
}

struct Coverage {
  int target = 0;         // target bins in an obstacle's body (not its protection zone)
  int bright = 0;         // target bins whose echo reaches the threshold
  int bright_inside = 0;  // those of them in an obstacle's body
};

Coverage coverage_of(const SonarObstacles& seen, const SonarPing& ping, const SonarPing& mask,
                     double threshold) {
  Coverage coverage;
  for (std::uint32_t beam = 0; beam < mask.beams; ++beam) {
    for (std::uint32_t bin = 0; bin < mask.bins; ++bin) {
      const double x_m = mask.bin_range_m(bin) * std::sin(mask.bearing_rad(beam));
      const double y_m = mask.bin_range_m(bin) * std::cos(mask.bearing_rad(beam));
      const std::uint32_t cell = beam * mask.bins + bin;
      if (mask.echo[cell] == 0) {
        continue;
      }
      const bool inside =
          std::any_of(seen.obstacles.begin(), seen.obstacles.begin() + seen.count,
                      [&](const Obstacle& o) { return testing::holds(o, x_m, y_m); });
      const bool bright = ping.echo[cell] >= threshold;
      coverage.target += inside ? 1 : 0;
      coverage.bright += bright ? 1 : 0;
      coverage.bright_inside += inside && bright ? 1 : 0;
    }
  }
  return coverage;
}

struct Tally {
  int frames = 0;
  int found = 0;
  int bright = 0;
  int bright_inside = 0;
  std::uint32_t obstacles = 0;
  std::uint32_t most_obstacles = 0;
};

std::map<std::string, Tally> tally_by_sequence(const fs::path& root, double threshold) {
  SegmentationOptions options = testing::shipped_options();
  options.threshold = threshold;
  Segmenter segmenter{options};
  const auto seen = std::make_unique<SonarObstacles>();
  std::map<std::string, Tally> tallies;
  for (const Frame& frame : frames_of(root / "frames.csv")) {
    const std::string file = frame.name + ".pgm";
    const auto ping = read_polar(root / "polar_120x500" / file, 30.0);
    segmenter.segment(*ping, *seen);
    const auto mask = read_polar(root / "polar_mask_120x500" / file, 30.0);
    const Coverage coverage = coverage_of(*seen, *ping, *mask, threshold);
    Tally& tally = tallies[frame.sequence];
    ++tally.frames;
    tally.found += coverage.target > 0 ? 1 : 0;
    tally.bright += coverage.bright;
    tally.bright_inside += coverage.bright_inside;
    tally.obstacles += seen->count;
    tally.most_obstacles = std::max(tally.most_obstacles, seen->count);
  }
  return tallies;
}

// The brightest obstacle of a frame whose range setting is known.
Obstacle brightest(const fs::path& file, double range_m) {
  const auto seen = std::make_unique<SonarObstacles>();
  Segmenter{testing::shipped_options()}.segment(*read_polar(file, range_m), *seen);
  REQUIRE(seen->count > 0);
  return *std::max_element(seen->obstacles.begin(), seen->obstacles.begin() + seen->count,
                           [](const Obstacle& a, const Obstacle& b) { return a.peak < b.peak; });
}

bool in_body(const Obstacle& o, double x_m, double y_m) {
  return o.shape == ObstacleShape::kEllipse ? testing::holds(o, x_m, y_m) : encloses(o, {x_m, y_m});
}

// Areas of the ping's cells, which grow with range: what both hold over what either holds.
double overlap(const Obstacle& o, const SonarPing& mask) {
  double both = 0.0;
  double either = 0.0;
  for (std::uint32_t beam = 0; beam < mask.beams; ++beam) {
    for (std::uint32_t bin = 0; bin < mask.bins; ++bin) {
      const double range_m = mask.bin_range_m(bin);
      const bool labelled = mask.echo[beam * mask.bins + bin] != 0;
      const bool inside = in_body(o, range_m * std::sin(mask.bearing_rad(beam)),
                                  range_m * std::cos(mask.bearing_rad(beam)));
      both += labelled && inside ? range_m : 0.0;
      either += labelled || inside ? range_m : 0.0;
    }
  }
  return both / either;
}

}  // namespace

TEST_CASE("real frames: by contrast the labelled target is one obstacle in every frame",
          "[low_level][sonar][data]") {
  const auto root = testing::data_path("fls_oculus_m1200d");
  if (!root) {
    return;
  }
  ContrastDetector detector{testing::shipped_options()};
  const auto seen = std::make_unique<SonarObstacles>();
  double sum = 0.0;
  int frames = 0;
  for (const Frame& frame : frames_of(*root / "frames.csv")) {
    const std::string file = frame.name + ".pgm";
    detector.detect(*read_polar(*root / "polar_120x500" / file, 30.0), *seen);
    const auto mask = read_polar(*root / "polar_mask_120x500" / file, 30.0);
    double best = 0.0;
    for (std::uint32_t i = 0; i < seen->count; ++i) {
      best = std::max(best, overlap(seen->obstacles[i], *mask));
    }
    CAPTURE(frame.name);
    CHECK(best >= 0.2);
    CHECK(seen->count <= 8);
    sum += best;
    ++frames;
  }
  REQUIRE(frames == 31);
  std::printf("mean overlap %.2f\n", sum / frames);
  CHECK(sum / frames >= 0.45);
}

TEST_CASE("real frames: by contrast the same object is found at three range settings",
          "[low_level][sonar][data]") {
  const auto root = testing::data_path("fls_oculus_known_range");
  if (!root) {
    return;
  }
  ContrastDetector detector{testing::shipped_options()};
  const auto seen = std::make_unique<SonarObstacles>();
  for (const auto& [name, range_m] :
       {std::pair{"img_508_5m_1.2MHz.pgm", 5.0}, std::pair{"img_512_10m_1.2MHz.pgm", 10.0},
        std::pair{"img_514_15m_1.2MHz.pgm", 15.0}}) {
    detector.detect(*read_polar(*root / "polar_120x500" / name, range_m), *seen);
    REQUIRE(seen->count == 1);  // neither the stripe ahead nor a ring is another
    const Obstacle& o = seen->obstacles[0];
    CHECK(std::hypot(o.centre_x_m, o.centre_y_m) == Approx(3.43).margin(0.12));
    CHECK(to_deg(std::atan2(o.centre_x_m, o.centre_y_m)) == Approx(22.8).margin(0.8));
  }
}

TEST_CASE("real frames: by contrast a cluttered fan is never cut short",
          "[low_level][sonar][data]") {
  const auto root = testing::data_path("fls_moving_auv");
  if (!root) {
    return;
  }
  ContrastDetector detector{testing::shipped_options()};
  const auto seen = std::make_unique<SonarObstacles>();
  int frames = 0;
  for (const auto& entry : fs::directory_iterator{*root / "sonar4"}) {
    detector.detect(*read_polar(entry.path(), 30.0), *seen);
    CHECK(seen->dropped == 0);
    CHECK(seen->count < kMaxObstacles / 2);
    ++frames;
  }
  CHECK(frames == 190);
}

TEST_CASE("real frames: the labelled target is found in every pass", "[low_level][sonar][data]") {
  const auto root = testing::data_path("fls_oculus_m1200d");
  if (!root) {
    return;
  }
  for (const double threshold : {40.0, 50.0, 60.0, 80.0}) {
    std::printf("threshold %.0f\n", threshold);
    for (const auto& [sequence, tally] : tally_by_sequence(*root, threshold)) {
      std::printf(
          "  %-32s found %2d of %2d, holding %2.0f %% of bright target bins, "
          "%4.1f obstacles a frame, at most %u\n",
          sequence.c_str(), tally.found, tally.frames,
          100.0 * tally.bright_inside / std::max(tally.bright, 1),
          static_cast<double>(tally.obstacles) / tally.frames, tally.most_obstacles);
    }
  }
  const auto shipped = tally_by_sequence(*root, testing::shipped_options().threshold);
  CHECK(shipped.at("seqA_target_and_right_wall").found >= 13);
  CHECK(shipped.at("seqB_target_and_oblique_wall").found >= 9);
  CHECK(shipped.at("seqC_boat").found >= 6);
  CHECK(shipped.at("single_boat_left_wall").found >= 1);
  CHECK(shipped.at("single_boat_768").found >= 2);
  for (const auto& [sequence, tally] : shipped) {
    CHECK(tally.most_obstacles <= 40);  // no runaway count, and none dropped
  }
}

TEST_CASE("real frames: the same object is found at three range settings",
          "[low_level][sonar][data]") {
  const auto root = testing::data_path("fls_oculus_known_range");
  if (!root) {
    return;
  }
  const fs::path polar = *root / "polar_120x500";
  const std::vector<Obstacle> found{brightest(polar / "img_508_5m_1.2MHz.pgm", 5.0),
                                    brightest(polar / "img_512_10m_1.2MHz.pgm", 10.0),
                                    brightest(polar / "img_514_15m_1.2MHz.pgm", 15.0)};
  for (const Obstacle& a : found) {
    const double range_m = std::hypot(a.centre_x_m, a.centre_y_m);
    const double bearing_deg = to_deg(std::atan2(a.centre_x_m, a.centre_y_m));
    std::printf("%.2f m at %+.2f deg\n", range_m, bearing_deg);
    CHECK(range_m == Approx(3.42).margin(0.1));
    CHECK(bearing_deg == Approx(22.8).margin(0.75));
  }
}

TEST_CASE("real frames: the interference stripe ahead is no obstacle", "[low_level][sonar][data]") {
  const auto root = testing::data_path("fls_oculus_known_range");
  if (!root) {
    return;
  }
  const std::map<std::string, double> ranges_m{{"img_2820_3m_1.2MHz.pgm", 3.0},
                                               {"img_508_5m_1.2MHz.pgm", 5.0},
                                               {"img_512_10m_1.2MHz.pgm", 10.0},
                                               {"img_514_15m_1.2MHz.pgm", 15.0},
                                               {"img_970_30m_1.2MHz.pgm", 30.0}};
  const auto seen = std::make_unique<SonarObstacles>();
  Segmenter segmenter{testing::shipped_options()};
  for (const auto& [name, range_m] : ranges_m) {
    segmenter.segment(*read_polar(*root / "polar_120x500" / name, range_m), *seen);
    for (std::uint32_t i = 0; i < seen->count; ++i) {
      const Obstacle& o = seen->obstacles[i];
      CHECK(std::abs(to_deg(std::atan2(o.centre_x_m, o.centre_y_m))) > 5.0);
    }
  }
}

}  // namespace lodesman
