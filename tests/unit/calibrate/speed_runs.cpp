// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/calibrate/speed_runs.h"

#include <cmath>
#include <fstream>

#include "mid_level/base/heading.h"
#include "mid_level/config/read_speed_table.h"
#include "mid_level/config/toml_document.h"
#include "tests/support/catch.h"

namespace lodesman::cli {
namespace {

// A run of a boat that truly points there, whose sensor says `offset` more.
[[nodiscard]] StraightRun run(double speed_m_s, double true_deg, double offset_deg,
                              double current_x_m_s, double current_y_m_s) {
  StraightRun run;
  for (int i = 0; i < 50; ++i) {
    const double t = 1e5 + 0.2 * i;
    const double x = (speed_m_s * std::sin(to_rad(true_deg)) + current_x_m_s) * (t - 1e5);
    const double y = (speed_m_s * std::cos(to_rad(true_deg)) + current_y_m_s) * (t - 1e5);
    run.add(t, 40.0 + x, -7.0 + y, to_rad(true_deg + offset_deg));
  }
  return run;
}

TEST_CASE("speed runs: there and back give speed, current and the sensor's offset", "[cli]") {
  for (const double back_deg : {220.0, 235.0}) {  // not quite opposite will do
    const auto pair =
        compare(31, run(0.42, 40.0, 6.0, 0.1, -0.2), run(0.42, back_deg, 6.0, 0.1, -0.2));
    REQUIRE(pair.has_value());
    CHECK(pair->surge_ref == 31);
    CHECK(pair->speed_m_s == Approx(0.42).epsilon(1e-6));
    CHECK(to_deg(pair->heading_offset_rad) == Approx(6.0).margin(1e-6));
    CHECK(pair->current_x_m_s == Approx(0.1).margin(1e-6));
    CHECK(pair->current_y_m_s == Approx(-0.2).margin(1e-6));
  }
}

TEST_CASE("speed runs: what tells nothing gives nothing", "[cli]") {
  CHECK_FALSE(compare(31, {}, run(0.42, 220.0, 0.0, 0.0, 0.0)).has_value());
  // Not back, or not moved.
  CHECK_FALSE(
      compare(31, run(0.42, 40.0, 0.0, 0.0, 0.0), run(0.42, 70.0, 0.0, 0.0, 0.0)).has_value());
  CHECK_FALSE(
      compare(31, run(0.0, 40.0, 0.0, 0.1, 0.0), run(0.0, 220.0, 0.0, 0.1, 0.0)).has_value());
}

TEST_CASE("speed runs: what is printed is a speed table that the boat takes", "[cli]") {
  const Calibration calibration =
      calibration_of({{57, 0.735, to_rad(-3.0), 0.0, 0.0},
                      {16, 0.222, to_rad(-3.0), 0.0, 0.0},
                      {60, 0.7, to_rad(-3.0), 0.0, 0.0}});  // not faster: left out
  const std::string toml = to_toml(calibration, true);
  const TomlDocument document = TomlDocument::from_text(toml, "printed");
  const SpeedTable speeds = read_speed_table(document.root().table("vehicle"));
  CHECK(speeds.speed_m_s(16) == Approx(0.222));
  CHECK(speeds.speed_m_s(57) == Approx(0.735));
  CHECK(document.root().table("mounting").number("heading_deg", Range::any()) == Approx(-3.0));
  CHECK_NOTHROW(document.require_all_keys_read());
  // Where a boat has no such section, it is said and not set.
  const TomlDocument without = TomlDocument::from_text(to_toml(calibration, false), "printed");
  CHECK_FALSE(without.root().has("mounting"));
}

}  // namespace
}  // namespace lodesman::cli
