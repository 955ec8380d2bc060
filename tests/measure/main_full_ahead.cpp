// SPDX-License-Identifier: Apache-2.0
// The guard alone against full ahead, from many sides: at shapes in open water, and at each thing
// that rests in the scenarios that are named. Prints a table by speed; status 1 where something was
// touched though the low level was shown it (scene `obstacles`), or where too few came near
// anything for that to say much. What is touched in `beams` is told: it stands for what nobody
// segments in time, a bare post or a sonar that sees 2 m.
//   full_ahead RUNS [SCENARIO...]
// RUNS: of each shape, and of each scenario, at each of the four speeds and in both kinds of scene.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "deploy/boat/named_scenario.h"
#include "mid_level/base/random_stream.h"
#include "mid_level/config/toml_document.h"
#include "tests/system/full_ahead.h"

namespace lodesman::measure {
namespace {

using namespace lodesman::testing;

constexpr std::array kSpeeds_m_s{0.22, 0.45, 0.74, 1.12};
constexpr double kLeastRoom_m = 2.0;  // of the hull at the start, or the draw is another one
constexpr int kDraws = 50;

// In open water, round (0, 0).
constexpr std::array kShapes{
    "shape = \"circle\"\ncentre_m = [0.0, 0.0]\nradius_m = 0.1\nprotection_m = 3.0\n",
    "shape = \"circle\"\ncentre_m = [0.0, 0.0]\nradius_m = 0.5\nprotection_m = 3.0\n",
    "shape = \"circle\"\ncentre_m = [0.0, 0.0]\nradius_m = 2.5\nprotection_m = 3.0\n",
    "shape = \"ellipse\"\ncentre_m = [0.0, 0.0]\nsemi_axes_m = [3.0, 0.3]\nangle_deg = 0.0\n"
    "protection_semi_axes_m = [4.0, 1.0]\n",
    "shape = \"polyline\"\npoints_m = [[-8.0, 0.0], [8.0, 0.0]]\nprotection_m = 1.0\n",
    "shape = \"polygon\"\npoints_m = [[-1.5, -1.5], [1.5, -1.5], [1.5, 1.5], [-1.5, 1.5]]\n"
    "protection_m = 1.0\n"};

// [m] From bow to edge, about: enough to come to speed.
[[nodiscard]] double run_up_m(double speed_m_s) { return 2.0 + 4.0 * speed_m_s; }

struct Row {
  int runs = 0;
  int met = 0;  // the guard tripped
  int touched = 0;
  double least_m = std::numeric_limits<double>::infinity();
  double most_m = 0.0;  // of those that were met
};

class Campaign {
 public:
  explicit Campaign(int runs) : runs_{runs} {}

  void sail(Scenario scenario, const std::string& name) {
    if (scenario.obstacles.empty() || !all_rests(scenario)) {
      ++left_out_;
      return;
    }
    ++scenarios_;
    scenario.faults.clear();  // a box that is dead is no matter of the guard's
    scenario.position.source = PositionSource::kTruth;
    scenario.environment.lift = false;
    RandomStream random{"full ahead at " + name, 1};
    for (int i = 0; i < runs_; ++i) {
      for (std::size_t speed = 0; speed < kSpeeds_m_s.size(); ++speed) {
        const auto start = a_start(scenario, run_up_m(kSpeeds_m_s[speed]), random);
        if (!start) {
          ++without_room_;
          continue;
        }
        scenario.mission.start = *start;
        for (const SonarScene scene : {SonarScene::kObstacles, SonarScene::kBeams}) {
          scenario.sonar.scene = scene;
          sail_at(scenario, speed, name);
        }
      }
    }
  }

  [[nodiscard]] int tell() const {
    fmt::print(
        "\n| speed m/s | scene | runs | stopped by the guard | touched | least clearance m | "
        "most of those stopped m |\n|---|---|---|---|---|---|---|\n");
    int met = 0;
    int touched_though_shown = 0;
    for (std::size_t scene = 0; scene < 2; ++scene) {
      for (std::size_t i = 0; i < kSpeeds_m_s.size(); ++i) {
        const Row& row = rows_[scene][i];
        fmt::print("| {} | {} | {} | {} | {} | {:.2f} | {:.2f} |\n", kSpeeds_m_s[i],
                   scene == 0 ? "obstacles" : "beams", row.runs, row.met, row.touched, row.least_m,
                   row.most_m);
        met += row.met;
        touched_though_shown += scene == 0 ? row.touched : 0;
      }
    }
    fmt::print(
        "\n{} scenarios and shapes; {} left out: something moves, or the water; {} draws "
        "found no room to start\n",
        scenarios_, left_out_, without_room_);
    return touched_though_shown == 0 && met > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }

 private:
  // Somewhere off one of its obstacles, bound for it, more or less.
  [[nodiscard]] static std::optional<VehiclePose> a_start(const Scenario& scenario, double run_up_m,
                                                          RandomStream& random) {
    for (int i = 0; i < kDraws; ++i) {
      const std::size_t which = static_cast<std::size_t>(
          random.uniform() * static_cast<double>(scenario.obstacles.size()));
      const Obstacle& at = scenario.obstacles[which].at_start;
      const double from_rad = 2.0 * std::numbers::pi * random.uniform();
      const double off_m = run_up_m + 1.02 + size_m(at);
      const double aside_m = (2.0 * random.uniform() - 1.0) * (0.6 + size_m(at));
      const double sine = std::sin(from_rad);
      const double cosine = std::cos(from_rad);
      const Eigen::Vector2d place =
          centre(at, random) +
          Eigen::Vector2d{-off_m * sine + aside_m * cosine, -off_m * cosine - aside_m * sine};
      const VehiclePose pose{{place}, Heading::clockwise_from_y_rad(from_rad)};
      if (clearance_m(scenario, pose) >= kLeastRoom_m) {
        return pose;
      }
    }
    return std::nullopt;
  }
  [[nodiscard]] static double size_m(const Obstacle& obstacle) {
    return obstacle.shape == ObstacleShape::kEllipse
               ? std::max(obstacle.semi_axis_first_m, obstacle.semi_axis_second_m)
               : 0.0;
  }
  // Of a wall: a point on one of its sides.
  [[nodiscard]] static Eigen::Vector2d centre(const Obstacle& obstacle, RandomStream& random) {
    if (obstacle.shape == ObstacleShape::kEllipse) {
      return {obstacle.centre_x_m, obstacle.centre_y_m};
    }
    const std::uint32_t sides = obstacle.vertex_count - 1;
    const auto side = static_cast<std::uint32_t>(random.uniform() * sides);
    const double share = random.uniform();
    const Vertex& a = obstacle.vertices[side];
    const Vertex& b = obstacle.vertices[side + 1];
    return {std::lerp(a.x_m, b.x_m, share), std::lerp(a.y_m, b.y_m, share)};
  }

  void sail_at(const Scenario& scenario, std::size_t speed, const std::string& name) {
    const double speed_m_s = kSpeeds_m_s[speed];
    FullAhead order;
    order.surge_ref = config_.speeds.held(speed_m_s).surge_ref;
    order.for_s = (run_up_m(speed_m_s) + 5.0) / speed_m_s + 5.0;
    const FullAheadEnd end = sail_full_ahead(config_, scenario, order);
    Row& row = rows_[scenario.sonar.scene == SonarScene::kObstacles ? 0 : 1][speed];
    ++row.runs;
    const bool met = end.guard.trips > 0;
    const bool touched = end.least_clearance_m <= 0.0;
    row.met += met ? 1 : 0;
    row.touched += touched ? 1 : 0;
    row.least_m = std::min(row.least_m, end.least_clearance_m);
    row.most_m = met ? std::max(row.most_m, end.least_clearance_m) : row.most_m;
    if (touched) {
      const auto& at = scenario.mission.start;
      fmt::print(stderr, "touched: {} at {} m/s from ({:.3f}, {:.3f}) heading {:.1f}, {} trips\n",
                 name, speed_m_s, at.p_WV.xy_m.x(), at.p_WV.xy_m.y(), to_deg(at.heading.rad()),
                 end.guard.trips);
    }
  }

  int runs_;
  BoatConfig config_ = load_configuration("default", {});
  std::array<std::array<Row, kSpeeds_m_s.size()>, 2> rows_{};
  int scenarios_ = 0;
  int left_out_ = 0;
  int without_room_ = 0;
};

[[nodiscard]] Scenario open_water(const char* shape, const SpeedTable& speeds) {
  return read_scenario(
      TomlDocument::from_text(
          std::string{"name = \"open\"\nseed = 1\ntime_limit_s = 1000.0\n[mission]\nstart_m = "
                      "[0.0, -20.0]\nstart_heading_deg = 0.0\ngoal_m = [0.0, 20.0]\n"
                      "goal_radius_m = 0.5\n[vehicle]\nspeed_m_s = 0.22\nradius_m = 0.5\n"
                      "[[obstacle]]\n"} +
              shape,
          "open water"),
      speeds);
}

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  using namespace lodesman;
  if (argc < 2) {
    fmt::print(stderr, "full_ahead RUNS [SCENARIO...]\n");
    return EXIT_FAILURE;
  }
  try {
    const SpeedTable speeds = load_configuration("default", {}).speeds;
    measure::Campaign campaign{std::atoi(argv[1])};
    for (const char* shape : measure::kShapes) {
      campaign.sail(measure::open_water(shape, speeds), shape);
    }
    for (int i = 2; i < argc; ++i) {
      campaign.sail(load_named_scenario(argv[i], speeds), argv[i]);
    }
    return campaign.tell();
  } catch (const std::exception& error) {
    fmt::print(stderr, "full_ahead: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
