// SPDX-License-Identifier: Apache-2.0
// The pose filter beside raw fixes and beside dead reckoning with a fixed gain, on simulated and on
// recorded tracks: a gap of ten seconds and one fix a hundred metres off in each. Prints a table;
// status 1 where a bound is broken.
//   measure_estimator [RUNS]
// RUNS: simulated ones; 100 without. Recordings are read below LODESMAN_DATA_DIR, where it is set.
#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <limits>

#include "deploy/boat/configuration.h"
#include "high_level/estimate/dead_reckoning.h"
#include "high_level/estimate/pose_filter.h"
#include "mid_level/base/random_stream.h"
#include "tests/measure/estimator_tracks.h"

namespace lodesman::measure {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kFixedGain = 0.3;  // of the estimator that the filter took the place of
constexpr double kGapBegins_s = 50.0;
constexpr double kGapEnds_s = 60.0;
constexpr double kOutlierAt_s = 80.0;
constexpr double kOutlier_m = 100.0;
constexpr double kSettled_s = 15.0;  // before, nothing is counted
constexpr double kFixedGainSilent_s = 3.0;
constexpr double kLargestJump_m = 0.05;

struct Receiver {
  double sigma_m = 1.0;
  double rate_hz = 5.0;
};

struct Sum {
  double total = 0.0;
  double largest = 0.0;
  std::size_t count = 0;
  void add(double value) {
    total += value;
    largest = std::max(largest, value);
    ++count;
  }
  [[nodiscard]] double mean() const {
    return count > 0 ? total / static_cast<double>(count)
                     : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] double root() const { return std::sqrt(mean()); }
};

struct Outcome {
  Sum raw_m2, fixed_m2, filter_m2;  // squared errors
  Sum fixed_at_worst_m2;            // after the fix that is far off
  Sum gap_end_m2;                   // the filter's, at the end of the gap
  Sum position_nees, current_nees, jump_m;
  int far_fixes_believed = 0;
};

// Today's rule: dead reckoning drawn to each fix by a fixed share, silent 3 s after the last.
class FixedGain {
 public:
  explicit FixedGain(const SpeedTable& speeds)
      : reckoning_{{std::chrono::milliseconds{200}, speeds}, {}} {}
  void step(const TrackSample& s) {
    heading_ = Heading::clockwise_from_y_rad(s.attitude.heading_rad);
    surge_ref_ = s.surge_ref;
    now_ = s.now;
    reckoning_.advance(s.now, surge_ref_, heading_);
  }
  void fix(const Vec& position_m) {
    reckoning_.correct({position_m}, fixed_ ? kFixedGain : 1.0);
    fixed_ = true;
    last_fix_ = now_;
  }
  [[nodiscard]] bool speaks() const {
    return fixed_ && to_seconds(now_ - last_fix_) <= kFixedGainSilent_s;
  }
  [[nodiscard]] Vec position_m() const {
    return reckoning_.position_at(now_, surge_ref_, heading_).xy_m;
  }

 private:
  DeadReckoning reckoning_;
  Heading heading_;
  int surge_ref_ = 0;
  bool fixed_ = false;
  Time now_{};
  Time last_fix_{};
};

// One track under one receiver.
class Trial {
 public:
  Trial(const Track& track, const Receiver& receiver, std::uint64_t seed, PoseFilterOptions options,
        Outcome& outcome)
      : track_{track},
        receiver_{receiver},
        luck_{"receiver", seed},
        filter_{with_speeds(options, track.speeds)},
        fixed_{track.speeds},
        outcome_{outcome} {}

  void run() {
    const Time begin = track_.samples.front().now;
    double next_fix_s = 0.0;
    bool outlier_due = true;
    for (const TrackSample& sample : track_.samples) {
      t_s_ = to_seconds(sample.now - begin);
      filter_.advance(sample.now, sample.surge_ref, sample.head_ref, sample.attitude);
      fixed_.step(sample);
      if (t_s_ + 1e-6 >= next_fix_s) {
        next_fix_s += 1.0 / receiver_.rate_hz;
        if (t_s_ < kGapBegins_s || t_s_ > kGapEnds_s) {
          const bool outlier = outlier_due && t_s_ >= kOutlierAt_s;
          outlier_due = outlier_due && !outlier;
          give_fix(sample, outlier);
        }
      }
      judge(sample);
    }
  }

 private:
  [[nodiscard]] static PoseFilterOptions with_speeds(PoseFilterOptions options,
                                                     const SpeedTable& speeds) {
    options.speeds = speeds;
    return options;
  }

  void give_fix(const TrackSample& sample, bool outlier) {
    const double x_m = receiver_.sigma_m * luck_.gaussian();
    const Vec error_m{x_m, receiver_.sigma_m * luck_.gaussian()};
    const Vec position_m = sample.truth_m + error_m + (outlier ? Vec{kOutlier_m, 0.0} : Vec{0, 0});
    const FixVerdict verdict = filter_.fix({position_m}, receiver_.sigma_m, sample.now);
    fixed_.fix(position_m);
    outcome_.far_fixes_believed += outlier && verdict == FixVerdict::kBelieved ? 1 : 0;
    if (t_s_ > kSettled_s && !outlier) {
      outcome_.raw_m2.add(error_m.squaredNorm());
    }
  }

  void judge(const TrackSample& sample) {
    const VehicleState state = filter_.state();
    const Vec odometry_m{state.odometry_x_m, state.odometry_y_m};
    if (t_s_ > 1.0) {
      const Vec went_m =
          track_.current_is_known ? Vec{sample.truth_m - last_truth_m_} : last_step_m_;
      outcome_.jump_m.add((odometry_m - last_odometry_m_ - went_m).norm());
    }
    last_step_m_ = odometry_m - last_odometry_m_;
    last_odometry_m_ = odometry_m;
    last_truth_m_ = sample.truth_m;
    if (t_s_ < kSettled_s || !filter_.knows_position()) {
      return;
    }
    const Vec error_m = filter_.mean().head<2>() - sample.truth_m;
    outcome_.filter_m2.add(error_m.squaredNorm());
    const Eigen::Matrix2d place = filter_.covariance().topLeftCorner<2, 2>();
    outcome_.position_nees.add(error_m.dot(place.inverse() * error_m));
    if (std::abs(t_s_ - kGapEnds_s) < 0.011) {
      outcome_.gap_end_m2.add(error_m.squaredNorm());
    }
    if (track_.current_is_known) {
      const Vec off_m_s = filter_.mean().tail<2>() - track_.current_m_s;
      const Eigen::Matrix2d current = filter_.covariance().bottomRightCorner<2, 2>();
      outcome_.current_nees.add(off_m_s.dot(current.inverse() * off_m_s));
    }
    if (fixed_.speaks()) {
      const double fixed_m2 = (fixed_.position_m() - sample.truth_m).squaredNorm();
      const bool after_outlier = t_s_ >= kOutlierAt_s && t_s_ < kOutlierAt_s + 10.0;
      (after_outlier ? outcome_.fixed_at_worst_m2 : outcome_.fixed_m2).add(fixed_m2);
    }
  }

  const Track& track_;
  Receiver receiver_;
  RandomStream luck_;
  PoseFilter filter_;
  FixedGain fixed_;
  Outcome& outcome_;
  double t_s_ = 0.0;
  Vec last_odometry_m_ = Vec::Zero();
  Vec last_step_m_ = Vec::Zero();
  Vec last_truth_m_ = Vec::Zero();
};

class Table {
 public:
  void head() const {
    fmt::print(
        "\n| track | sigma m | Hz | raw fixes m | fixed gain m | filter m | end of the gap m | "
        "far fix: fixed gain off m | NEES position | NEES current | odometry jump cm |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
  }
  void row(const std::string& name, const Receiver& receiver, const Outcome& o) {
    fmt::print(
        "| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.2f} | {} | {:.1f} "
        "|\n",
        name, receiver.sigma_m, receiver.rate_hz, o.raw_m2.root(), o.fixed_m2.root(),
        o.filter_m2.root(), o.gap_end_m2.root(), std::sqrt(o.fixed_at_worst_m2.largest),
        o.position_nees.mean(),
        o.current_nees.count > 0 ? fmt::format("{:.2f}", o.current_nees.mean()) : "-",
        100.0 * o.jump_m.largest);
    std::fflush(stdout);
    broken("a fix far off was believed", o.far_fixes_believed > 0);
    broken("the filter is no better than the fixes", !(o.filter_m2.root() < o.raw_m2.root()));
    broken("the odometry jumps", !(o.jump_m.largest <= kLargestJump_m));
  }
  [[nodiscard]] int status() const { return failed_ ? EXIT_FAILURE : EXIT_SUCCESS; }

 private:
  void broken(const char* what, bool is) {
    if (is) {
      fmt::print(stderr, "broken: {}\n", what);
      failed_ = true;
    }
  }
  bool failed_ = false;
};

[[nodiscard]] std::vector<Track> recorded_tracks() {
  const char* data = std::getenv("LODESMAN_DATA_DIR");
  const std::filesystem::path root = data != nullptr ? data : "";
  std::vector<Track> tracks;
  for (const char* name : {"202412051751.txt", "202412071309.txt"}) {
    if (std::filesystem::exists(root / "nmea_usv_rtk" / name)) {
      tracks.push_back(nmea_track(root / "nmea_usv_rtk" / name));
    }
  }
  const auto lake = root / "asv_catabot" / "lake_china_20201006_slice.csv";
  if (std::filesystem::exists(lake)) {
    tracks.push_back(catabot_track(lake));
  }
  return tracks;
}

int run(int runs) {
  const PoseFilterOptions options = load_configuration("default", {}).high.estimator.filter;
  std::vector<Track> simulated;
  for (int seed = 1; seed <= runs; ++seed) {
    simulated.push_back(simulated_track(static_cast<std::uint64_t>(seed)));
  }
  const std::vector<Track> recorded = recorded_tracks();
  Table table;
  table.head();
  for (const double sigma_m : {0.5, 1.0, 2.0}) {
    for (const double rate_hz : {1.0, 5.0}) {
      const Receiver receiver{sigma_m, rate_hz};
      Outcome outcome;
      std::uint64_t seed = 0;
      for (const Track& track : simulated) {
        Trial{track, receiver, ++seed, options, outcome}.run();
      }
      table.row(fmt::format("{} simulated", runs), receiver, outcome);
    }
  }
  // Of other hulls, and the logged speed is what came of the thrust: no lag, and more noise.
  PoseFilterOptions unknown_hull = options;
  unknown_hull.vehicle.mass_kg = 8.0;
  unknown_hull.vehicle.added_mass_sway_kg = 0.0;
  unknown_hull.surge_noise_m_s_per_sqrt_s = 0.1;
  unknown_hull.sway_noise_m_s_per_sqrt_s = 0.3;
  unknown_hull.current_noise_m_s_per_sqrt_s = 0.05;
  for (const Track& track : recorded) {
    for (const Receiver& receiver : {Receiver{1.0, 1.0}, Receiver{1.0, 5.0}}) {
      Outcome outcome;
      Trial{track, receiver, 1, unknown_hull, outcome}.run();
      table.row(track.name, receiver, outcome);
    }
  }
  return table.status();
}

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  try {
    return lodesman::measure::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 100);
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_estimator: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
