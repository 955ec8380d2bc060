// SPDX-License-Identifier: Apache-2.0
// The tables of docs/sonar_simulation.md: figures of simulated pings beside the same of real
// frames, what the contrast detector finds in simulated ones, and the processor time of a ping.
// Status 1 where a figure of `sea` is farther off than it may be, or a disc or a wall is not found;
// how long a ping takes is not judged.
//   measure_sonar_noise [PINGS]
// PINGS: of each row; 480 without. Real frames are read below LODESMAN_DATA_DIR, where it is set.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <optional>

#include "deploy/boat/level_options.h"
#include "low_level/sonar/contrast.h"
#include "mid_level/geometry/obstacle_distance.h"
#include "tests/measure/sonar_figures.h"
#include "tests/support/echo_statistics.h"
#include "tests/support/noisy_pings.h"

namespace lodesman::measure {
namespace {

namespace fs = std::filesystem;
using testing::NoisyPings;

constexpr double kMostOff = 0.2;        // of a figure, as a share of the real frames'
constexpr double kLeastFound = 0.9;     // of the pings in which something is there
constexpr double kMostFalse = 0.3;      // obstacles a ping of empty water
constexpr int kLeastPingsToJudge = 96;  // of fewer the figures are not steady

class Report {
 public:
  Report(int pings, const std::optional<fs::path>& frames) : pings_{pings} {
    sea_ = simulated_figures(kSeaWater, pings);
    tank_ = simulated_figures(kTankWater, pings);
    if (frames) {
      real_ = real_figures(*frames);
    }
  }

  void print_figures() {
    fmt::print("\n| figure | real frames | `sea` | `tank` |\n|---|---|---|---|\n");
    row("speckle: coefficient of variation", [](const Figures& f) { return f.variation; });
    row("speckle: correlation at 1 bin", [](const Figures& f) { return f.along[0]; });
    row("speckle: at 2 bins", [](const Figures& f) { return f.along[1]; });
    row(
        "speckle: at 4 bins", [](const Figures& f) { return f.along[2]; }, Judged::kNo);
    row("speckle: at 1 beam", [](const Figures& f) { return f.across[0]; });
    row("speckle: at 2 beams", [](const Figures& f) { return f.across[1]; });
    row(
        "water near by", [](const Figures& f) { return f.near_level; }, Judged::kNo);
    row("water far off", [](const Figures& f) { return f.far_level; });
    row("ring of side lobes, share of the brightest",
        [](const Figures& f) { return f.ring_share; });
    row("wall within 60 degrees of square on, times the water",
        [](const Figures& f) { return f.wall; });
    row("wall beyond 70 degrees", [](const Figures& f) { return f.grazing_wall; });
    row("target: median", [](const Figures& f) { return f.target_median; });
    row("target: p90", [](const Figures& f) { return f.target_p90; });
    row("target: peak", [](const Figures& f) { return f.target_peak; });
    row("target: share below 3 times the water", [](const Figures& f) { return f.target_faint; });
  }

  // What is found of a disc or a wall, and what else there is.
  void print_found() {
    fmt::print(
        "\n| `sea` and `tank`: in the water | found | others a ping | found | others a ping | "
        "us a ping |\n|---|---|---|---|---|---|\n");
    found("nothing", {});
    for (const double range_m : {10.0, 15.0, 20.0}) {
      for (const double radius_m : {0.5, 1.0}) {
        const double bearing_rad = to_rad(-25.0);
        found(fmt::format("a disc of {} m at {} m", radius_m, range_m),
              {testing::ellipse_at(range_m * std::sin(bearing_rad), range_m * std::cos(bearing_rad),
                                   radius_m, radius_m)});
      }
    }
    found("a wall ahead at 15 m", {testing::wall_through({{-40.0, 18.0}, {40.0, 12.0}})});
  }
  [[nodiscard]] int status() const { return failed_ ? EXIT_FAILURE : EXIT_SUCCESS; }

 private:
  enum class Judged { kNo, kYes };

  template <class Of>
  void row(const char* name, Of of, Judged judged = Judged::kYes) {
    const auto text = [&](const Figures& figures) {
      const auto values = of(figures);
      return fmt::format("{:.2f} ({:.2f} to {:.2f})", testing::median(values),
                         testing::quantile(values, 0.1), testing::quantile(values, 0.9));
    };
    fmt::print("| {} | {} | {} | {} |\n", name, real_ ? text(*real_) : "-", text(sea_),
               text(tank_));
    if (real_ && judged == Judged::kYes && pings_ >= kLeastPingsToJudge) {
      const double real = testing::median(of(*real_));
      const double simulated = testing::median(of(sea_));
      broken(name, std::abs(simulated - real) > kMostOff * real);
    }
  }

  struct Seen {
    double found = 0.0;   // share of the pings
    double others = 0.0;  // obstacles a ping
    double us = 0.0;      // of processor time, to draw it
  };
  [[nodiscard]] Seen look(const WaterKind& kind, const std::vector<MovingObstacle>& scene) {
    constexpr int kSeeds = 24;
    ContrastDetector detector{options_};
    const auto seen = std::make_unique<SonarObstacles>();
    const int each = std::max(pings_ / kSeeds, 1);
    Seen sum;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      NoisyPings water{kind, scene, static_cast<std::uint64_t>(seed)};
      water.go_on(testing::kUntilUsual);
      for (int i = 0; i < each; ++i) {
        const double before_us = spent_us();
        const SonarPing& ping = water.next();
        sum.us += spent_us() - before_us;
        detector.detect(ping, *seen);
        add_seen(*seen, scene, sum);
      }
    }
    const double count = kSeeds * each;
    return {sum.found / count, sum.others / count, sum.us / count};
  }

  static void add_seen(const SonarObstacles& seen, const std::vector<MovingObstacle>& scene,
                       Seen& sum) {
    bool found = false;
    for (std::uint32_t i = 0; i < seen.count; ++i) {
      bool is_there = false;
      for (const MovingObstacle& mover : scene) {
        is_there = is_there || testing::touches(seen.obstacles[i], mover.at_start);
      }
      found = found || is_there;
      sum.others += is_there ? 0.0 : 1.0;
    }
    sum.found += found ? 1.0 : 0.0;
  }

  [[nodiscard]] static double spent_us() {
    timespec spent{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
    return 1e6 * static_cast<double>(spent.tv_sec) + 1e-3 * static_cast<double>(spent.tv_nsec);
  }

  void found(const std::string& name, const std::vector<MovingObstacle>& scene) {
    const Seen sea = look(kSeaWater, scene);
    const Seen tank = look(kTankWater, scene);
    const bool any = !scene.empty();
    fmt::print("| {} | {} | {:.2f} | {} | {:.2f} | {:.0f} |\n", name,
               any ? fmt::format("{:.2f}", sea.found) : "-", sea.others,
               any ? fmt::format("{:.2f}", tank.found) : "-", tank.others, sea.us);
    broken("not found", any && sea.found < kLeastFound);
    broken("too much in empty water", !any && sea.others > kMostFalse);
  }

  void broken(const std::string& what, bool is) {
    if (is) {
      fmt::print(stderr, "broken: {}\n", what);
      failed_ = true;
    }
  }

  int pings_;
  SegmentationOptions options_ = read_segmentation_options(
      TomlDocument::from_file(LODESMAN_DEFAULT_CONFIG).root().table("segmentation"));
  Figures sea_;
  Figures tank_;
  std::optional<Figures> real_;
  bool failed_ = false;
};

[[nodiscard]] std::optional<fs::path> real_frames() {
  const char* const data = std::getenv("LODESMAN_DATA_DIR");
  const fs::path folder = fs::path{data != nullptr ? data : ""} / "fls_oculus_m1200d";
  return fs::exists(folder / "truth.json") ? std::optional{folder} : std::nullopt;
}

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  using namespace lodesman::measure;
  try {
    Report report{argc > 1 ? std::max(1, std::atoi(argv[1])) : 480, real_frames()};
    report.print_figures();
    report.print_found();
    return report.status();
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_sonar_noise: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
