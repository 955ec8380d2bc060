// SPDX-License-Identifier: Apache-2.0
// The hull `otter` beside ten manoeuvres of the published model in six degrees of freedom.
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "hal_sim/world/vessel.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"

namespace lodesman {
namespace {

const std::array<std::string, 10> kPublished = {
    "straight_60", "straight_100", "astern_60", "turn_80_60",    "turn_100_40",
    "spin_60",     "zigzag",       "coast",     "abeam_current", "turn_in_current"};

constexpr double kRow_s = 0.1;
constexpr double kSteady_s = 5.0;  // the last seconds of a manoeuvre, averaged
constexpr double kSteadyMax = 0.03;
constexpr double kTrackMax = 0.05;
// What is nothing but noise of a straight course.
constexpr double kLeastSpeed_m_s = 0.002;
constexpr double kLeastYawRate_rad_s = 0.002;

struct Row {
  PropellerSpeeds told;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  double surge_m_s = 0.0;  // over ground
  double sway_m_s = 0.0;
  double yaw_rate_rad_s = 0.0;
};

[[nodiscard]] std::vector<Row> read_rows(const std::filesystem::path& file) {
  std::vector<Row> rows;
  std::ifstream stream{file};
  std::string line;
  std::getline(stream, line);  // names
  while (std::getline(stream, line)) {
    std::istringstream fields{line};
    std::array<double, 11> v{};
    for (double& value : v) {
      std::string field;
      std::getline(fields, field, ',');
      value = std::stod(field);
    }
    rows.push_back({{v[1], v[2]}, v[5], v[6], to_rad(v[7]), v[8], v[9], v[10]});
  }
  return rows;
}

[[nodiscard]] WaterConditions water_of(const std::string& manoeuvre) {
  if (manoeuvre == "abeam_current") {
    return {0.3, 0.0, false};
  }
  const double diagonal_m_s = 0.2 / std::numbers::sqrt2;
  return manoeuvre == "turn_in_current" ? WaterConditions{diagonal_m_s, diagonal_m_s, false}
                                        : WaterConditions{};
}

// Through the water.
struct Motion {
  double speed_m_s = 0.0;
  double sway_m_s = 0.0;
  double yaw_rate_rad_s = 0.0;

  void add(double surge, double sway, double yaw_rate, double weight) {
    speed_m_s += weight * std::hypot(surge, sway);
    sway_m_s += weight * sway;
    yaw_rate_rad_s += weight * yaw_rate;
  }
};

struct Compared {
  Motion published;
  Motion ours;
  double sailed_m = 0.0;
  double off_at_end = 0.0;  // share of what was sailed
  double off_at_most = 0.0;
};

[[nodiscard]] Compared compare(const std::vector<Row>& rows, const WaterConditions& water) {
  VesselState at_rest;  // over ground
  at_rest.surge_m_s = -water.current_y_m_s;
  at_rest.sway_m_s = -water.current_x_m_s;
  Vessel vessel = Vessel::under_way(load_vessel(LODESMAN_OTTER), water, at_rest);
  Compared result;
  const double steady_from = static_cast<double>(rows.size()) - 1.0 - kSteady_s / kRow_s;
  const double weight = kRow_s / kSteady_s;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    vessel.advance(kRow_s, rows[i].told);
    const Row& row = rows[i + 1];
    result.sailed_m += std::hypot(row.x_m - rows[i].x_m, row.y_m - rows[i].y_m);
    const VesselState& state = vessel.state();
    const Eigen::Vector2d off_m = state.pose.p_WV.xy_m - Eigen::Vector2d{row.x_m, row.y_m};
    // Of two metres at least: nothing has a share of the first centimetres.
    result.off_at_end = off_m.norm() / std::max(result.sailed_m, 2.0);
    result.off_at_most = std::max(result.off_at_most, result.off_at_end);
    if (static_cast<double>(i) + 0.5 >= steady_from) {
      const double c = std::cos(row.heading_rad);
      const double s = std::sin(row.heading_rad);
      result.published.add(row.surge_m_s - water.current_x_m_s * s - water.current_y_m_s * c,
                           row.sway_m_s - water.current_x_m_s * c + water.current_y_m_s * s,
                           row.yaw_rate_rad_s, weight);
      result.ours.add(state.surge_m_s, state.sway_m_s, state.yaw_rate_rad_s, weight);
    }
  }
  return result;
}

void print(const std::string& name, const Compared& c) {
  std::printf("| `%s` | %.3f | %.3f | %.3f | %.3f | %.4f | %.4f | %.1f | %.2f | %.2f |\n",
              name.c_str(), c.published.speed_m_s, c.ours.speed_m_s, c.published.sway_m_s,
              c.ours.sway_m_s, c.published.yaw_rate_rad_s, c.ours.yaw_rate_rad_s, c.sailed_m,
              100.0 * c.off_at_end, 100.0 * c.off_at_most);
}

TEST_CASE("otter: steady speed, drift and yaw rate within 3 %, tracks within 5 % of the published",
          "[hal_sim][vessel]") {
  const auto directory = testing::data_path("otter_manoeuvres");
  if (!directory) {
    return;
  }
  for (const std::string& name : kPublished) {
    INFO(name);
    const std::vector<Row> rows = read_rows(*directory / (name + ".csv"));
    REQUIRE(rows.size() > 500);
    const Compared c = compare(rows, water_of(name));
    REQUIRE(c.sailed_m > 10.0);
    CHECK(c.ours.speed_m_s ==
          Approx(c.published.speed_m_s).epsilon(kSteadyMax).margin(kLeastSpeed_m_s));
    CHECK(c.ours.sway_m_s ==
          Approx(c.published.sway_m_s).epsilon(kSteadyMax).margin(kLeastSpeed_m_s));
    CHECK(c.ours.yaw_rate_rad_s ==
          Approx(c.published.yaw_rate_rad_s).epsilon(kSteadyMax).margin(kLeastYawRate_rad_s));
    CHECK(c.off_at_most <= kTrackMax);
    print(name, c);
  }
}

// The published hydrostatics, for what they leave in the plane: the payload's weight, resolved in
// the axes of a hull that is trimmed and heeled (docs/vessels.md).
struct Hydrostatics {
  double payload_n = 25.0 * 9.81;
  double payload_ahead_m = 0.05;
  double payload_above_m = 0.35;
  double gravity_above_m = (55.0 * 0.2 + 25.0 * 0.35) / 80.0;
  double length_m = 2.0;
  double pontoon_beam_m = 0.25;
  double pontoon_m = 0.395;  // from the centre line
  double waterline = 0.75;   // coefficient of its area
  double flotation_astern_m = 0.2;

  [[nodiscard]] double volume_m3() const { return 80.0 / 1025.0; }
  [[nodiscard]] double draught_m() const {
    return volume_m3() / (2.0 * 0.4 * pontoon_beam_m * length_m);
  }
  [[nodiscard]] double area_m2() const { return 2.0 * waterline * length_m * pontoon_beam_m; }
  [[nodiscard]] double heave_n_per_m() const { return 1025.0 * 9.81 * area_m2(); }
  // Metacentres above the centre of gravity.
  [[nodiscard]] double above_gravity_m(double second_moment_m4) const {
    const double buoyancy_m =
        (5.0 * draught_m() / 2.0 - 0.5 * volume_m3() / (length_m * pontoon_beam_m)) / 3.0;
    return buoyancy_m + second_moment_m4 / volume_m3() - (draught_m() + gravity_above_m);
  }
  [[nodiscard]] double pitch_n_m() const {
    return 80.0 * 9.81 * above_gravity_m(0.8 * 2.0 / 12.0 * pontoon_beam_m * std::pow(length_m, 3));
  }
  [[nodiscard]] double roll_n_m() const {
    const double own = 2.0 / 12.0 * length_m * std::pow(pontoon_beam_m, 3) * 6.0 *
                       std::pow(waterline, 3) / ((1.0 + waterline) * (1.0 + 2.0 * waterline));
    return 80.0 * 9.81 * above_gravity_m(own + area_m2() * pontoon_m * pontoon_m);
  }
};

// The payload's force ahead where heave and pitch are at rest, at a surge speed.
[[nodiscard]] double trim_force_n(const Hydrostatics& h, double surge_m_s) {
  const double heave_kg = 80.0 + 55.0;
  const double heave_drag = 2.0 * 0.3 * std::sqrt(h.heave_n_per_m() * heave_kg);
  const double coupling_n = h.heave_n_per_m() * h.flotation_astern_m;
  const double pitch_n_m = h.pitch_n_m() + coupling_n * h.flotation_astern_m;
  double trim_rad = 0.0;  // bow up positive
  for (int i = 0; i < 500; ++i) {
    const double down_m_s = surge_m_s * std::tan(trim_rad);
    const double ahead_n = -h.payload_n * std::sin(trim_rad);
    const double down_n = h.payload_n * std::cos(trim_rad) - heave_drag * down_m_s;
    const double moment_n_m = -h.payload_above_m * ahead_n -
                              h.payload_ahead_m * h.payload_n * std::cos(trim_rad) +
                              (55.0 - 5.5) * surge_m_s * down_m_s;  // Munk
    const double wanted_rad = (moment_n_m * h.heave_n_per_m() - coupling_n * down_n) /
                              (h.heave_n_per_m() * pitch_n_m - coupling_n * coupling_n);
    trim_rad += 0.3 * (wanted_rad - trim_rad);
  }
  return -h.payload_n * std::sin(trim_rad);
}

TEST_CASE("otter: its trim and heel follow from the published hydrostatics", "[hal_sim][vessel]") {
  const VesselParameters otter = load_vessel(LODESMAN_OTTER);
  const Hydrostatics h;
  CHECK(otter.trim_force_n == Approx(trim_force_n(h, 0.0)).epsilon(0.002));
  for (double surge_m_s = -1.0; surge_m_s <= 3.0; surge_m_s += 0.5) {
    INFO(surge_m_s << " m/s");
    const double by_speed_n =
        (otter.trim_force_n_s_per_m + otter.trim_force_n_s2_per_m2 * surge_m_s) * surge_m_s;
    CHECK(otter.trim_force_n + by_speed_n == Approx(trim_force_n(h, surge_m_s)).margin(0.4));
  }
  // Heeled by m z u r, the payload weighs on the side that is low, and helps to heel.
  const double heel_mass_kg =
      h.payload_n * 80.0 * h.gravity_above_m / (h.roll_n_m() - h.payload_above_m * h.payload_n);
  CHECK(otter.heel_mass_kg == Approx(heel_mass_kg).epsilon(0.01));
}

}  // namespace
}  // namespace lodesman
