// SPDX-License-Identifier: Apache-2.0
// Where the vehicle is and which way it points: what the sensors say, and what is made of it.
// Plain data for the blackboard; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"

namespace lodesman {

// Written by the AHRS task at 50 Hz; read by the estimator and the controller.
struct Attitude {
  Time measured{};              // [ns] when the sensor measured it
  double heading_rad = 0.0;     // [rad] [-pi, pi] true, clockwise from north
  double yaw_rate_rad_s = 0.0;  // [rad/s] [-100, 100] clockwise positive

  [[nodiscard]] Time measured_at() const noexcept { return measured; }

  static constexpr auto fields() noexcept {
    using A = Attitude;
    return field_list(field("measured", &A::measured),
                      field("heading_rad", &A::heading_rad).within(-kHalfTurn_rad, kHalfTurn_rad),
                      field("yaw_rate_rad_s", &A::yaw_rate_rad_s).within(-100.0, 100.0));
  }
};

// How a receiver came by a fix, by its own word.
enum class FixQuality : std::uint8_t {
  kUnknown,       // it does not say
  kSingle,        // of the satellites alone
  kDifferential,  // corrected
  kRtkFloat,      // by carrier phases, their whole numbers not settled
  kRtkFixed,      // settled
};
[[nodiscard]] constexpr auto enumerators(FixQuality) noexcept {
  return enumerators_to<FixQuality::kRtkFixed>("unknown", "single", "differential", "rtk_float",
                                               "rtk_fixed");
}

// Who says it.
enum class FixSource : std::uint8_t { kUnknown, kSimulated, kNmea, kGpsd, kNav440 };
[[nodiscard]] constexpr auto enumerators(FixSource) noexcept {
  return enumerators_to<FixSource::kNav440>("unknown", "simulated", "nmea", "gpsd", "nav440");
}

// Written by the position task at the receiver's rate (1-10 Hz); read by the estimator, and by
// programs that say what time it is.
struct PositionFix {
  Time measured{};             // [ns] when the receiver fixed it, by our clock
  double latitude_deg = 0.0;   // [deg] [-90, 90] WGS-84, of the antenna
  double longitude_deg = 0.0;  // [deg] [-180, 180]
  double sigma_m = 0.0;        // [m] [0, 1e5] one standard deviation, horizontal
  FixQuality quality = FixQuality::kUnknown;
  FixSource source = FixSource::kUnknown;
  std::int64_t utc_ns = 0;  // [ns] since 1970, of the fix by the receiver; 0: not known
  double speed_m_s = 0.0;   // [m/s] [0, 1000] over ground, where has_speed
  double course_rad = 0.0;  // [rad] [-pi, pi] over ground, from true north, where has_course
  bool has_speed = false;
  bool has_course = false;

  [[nodiscard]] Time measured_at() const noexcept { return measured; }

  static constexpr auto fields() noexcept {
    using P = PositionFix;
    return field_list(field("measured", &P::measured),
                      field("latitude_deg", &P::latitude_deg).within(-90.0, 90.0),
                      field("longitude_deg", &P::longitude_deg).within(-180.0, 180.0),
                      field("sigma_m", &P::sigma_m).within(0.0, 1e5), field("quality", &P::quality),
                      field("source", &P::source), field("utc_ns", &P::utc_ns).within(0.0, 4e18),
                      field("speed_m_s", &P::speed_m_s).within(0.0, 1000.0),
                      field("course_rad", &P::course_rad).within(-kHalfTurn_rad, kHalfTurn_rad),
                      field("has_speed", &P::has_speed), field("has_course", &P::has_course));
  }
};

// What the estimator takes its position from.
enum class PositionSource : std::uint8_t { kTruth, kGps, kDeadReckoning };

// What the position of an estimate rests on.
enum class PositionTrust : std::uint8_t {
  kLost,         // no fix was believed for too long
  kTracked,      // on fixes that are believed
  kBridged,      // on the model: the last believed fix is some time ago
  kApproaching,  // fixes that were refused go on to agree: it moves towards them, no faster than
                 // set
  kFrozen,       // on the model: the receiver repeats itself though the boat is under way
  kReckoned,     // on the model alone, as is the source `dead_reckoning`
};
[[nodiscard]] constexpr auto enumerators(PositionTrust) noexcept {
  return enumerators_to<PositionTrust::kReckoned>("lost", "tracked", "bridged", "approaching",
                                                  "frozen", "reckoned");
}

// The estimate that everything steers by. Written by the estimator task at 20 Hz and more, and only
// while its inputs are fresh; read by DeltaT, the planner, the controller.
//
// Two poses with one heading. The world pose is the best estimate and moves by a step where a fix
// comes: the pilot, the controller, the mission and displays read it. The odometry pose is how the
// boat has moved, in a frame that drifts off the world's and never jumps: what is seen at different
// times is put side by side in it (DeltaT places echoes by it). Where the source of position is
// another than `gps` the two are one.
struct VehicleState {
  Time valid_at{};              // [ns] the time this pose belongs to
  double x_m = 0.0;             // [m] [world] east
  double y_m = 0.0;             // [m] [world] north
  double heading_rad = 0.0;     // [rad] [-pi, pi] clockwise from north
  double surge_m_s = 0.0;       // [m/s] speed ahead through the water, estimated
  double sway_m_s = 0.0;        // [m/s] to starboard through the water; 0 where none is estimated
  double yaw_rate_rad_s = 0.0;  // [rad/s] clockwise positive
  // Of the water, estimated; 0 where nothing is measured that could tell it.
  double current_x_m_s = 0.0;  // [m/s] [world]
  double current_y_m_s = 0.0;  // [m/s] [world]
  // Covariances; all 0 where none is kept (sources `truth` and `dead_reckoning`).
  double position_xx_m2 = 0.0;         // [m^2] >= 0
  double position_xy_m2 = 0.0;         // [m^2]
  double position_yy_m2 = 0.0;         // [m^2] >= 0
  double heading_variance_rad2 = 0.0;  // [rad^2] >= 0
  double current_xx_m2_s2 = 0.0;       // [m^2/s^2] >= 0
  double current_xy_m2_s2 = 0.0;       // [m^2/s^2]
  double current_yy_m2_s2 = 0.0;       // [m^2/s^2] >= 0
  double odometry_x_m = 0.0;           // [m] [odometry] as the world's x, but for the drift
  double odometry_y_m = 0.0;           // [m] [odometry]
  PositionTrust trust = PositionTrust::kTracked;
  Time fix_measured{};  // [ns] of the last fix that was believed; 0: none

  [[nodiscard]] Time measured_at() const noexcept { return valid_at; }
  // What takes a point of the odometry frame to the world: both have one heading, so that it is a
  // shift. It takes the whole of a fix's correction.
  [[nodiscard]] double world_from_odometry_x_m() const noexcept { return x_m - odometry_x_m; }
  [[nodiscard]] double world_from_odometry_y_m() const noexcept { return y_m - odometry_y_m; }

  static constexpr auto fields() noexcept {
    using V = VehicleState;
    return field_list(field("valid_at", &V::valid_at), field("x_m", &V::x_m), field("y_m", &V::y_m),
                      field("heading_rad", &V::heading_rad).within(-kHalfTurn_rad, kHalfTurn_rad),
                      field("surge_m_s", &V::surge_m_s).within(-1e3, 1e3),
                      field("sway_m_s", &V::sway_m_s).within(-1e3, 1e3),
                      field("yaw_rate_rad_s", &V::yaw_rate_rad_s).within(-100.0, 100.0),
                      field("current_x_m_s", &V::current_x_m_s).within(-1e3, 1e3),
                      field("current_y_m_s", &V::current_y_m_s).within(-1e3, 1e3),
                      field("position_xx_m2", &V::position_xx_m2).within(0.0, 1e9),
                      field("position_xy_m2", &V::position_xy_m2),
                      field("position_yy_m2", &V::position_yy_m2).within(0.0, 1e9),
                      field("heading_variance_rad2", &V::heading_variance_rad2).within(0.0, 100.0),
                      field("current_xx_m2_s2", &V::current_xx_m2_s2).within(0.0, 1e6),
                      field("current_xy_m2_s2", &V::current_xy_m2_s2),
                      field("current_yy_m2_s2", &V::current_yy_m2_s2).within(0.0, 1e6),
                      field("odometry_x_m", &V::odometry_x_m),
                      field("odometry_y_m", &V::odometry_y_m), field("trust", &V::trust),
                      field("fix_measured", &V::fix_measured));
  }
};

// What an estimator needs besides to go on with the estimate of one that died. Written by the
// estimator task with each estimate; read by the estimator that comes after. Of sources without a
// covariance only the first three and `surge_m_s` mean anything.
struct EstimatorMemory {
  static constexpr std::size_t kStates = 8;

  Time at{};         // [ns] the time it belongs to
  double x_m = 0.0;  // [m] [world] of the position that is reckoned on from
  double y_m = 0.0;  // [m] [world]
  // Of the pose filter, in the order of its states, and row by row; in their SI units.
  std::array<double, kStates> mean{};                  // [m, rad, m/s, rad/s]
  std::array<double, kStates * kStates> covariance{};  // [the same by the same]
  double surge_m_s = 0.0;                              // [m/s] of the lag behind thrust
  double odometry_x_m = 0.0;                           // [m] [odometry]
  double odometry_y_m = 0.0;                           // [m] [odometry]
  double way_m = 0.0;                                  // [m] >= 0 through the water, ever
  // Of the gate: the last fix that came and the last that was believed; 0: none.
  Time fix_last{};                   // [ns]
  Time fix_believed{};               // [ns]
  double fix_sigma_m = 0.0;          // [m] >= 0 of that
  std::uint64_t fixes_believed = 0;  // [-]
  bool has_filter = false;

  static constexpr auto fields() noexcept {
    using E = EstimatorMemory;
    return field_list(
        field("at", &E::at), field("x_m", &E::x_m), field("y_m", &E::y_m), field("mean", &E::mean),
        field("covariance", &E::covariance), field("surge_m_s", &E::surge_m_s).within(-1e3, 1e3),
        field("odometry_x_m", &E::odometry_x_m), field("odometry_y_m", &E::odometry_y_m),
        field("way_m", &E::way_m).within(0.0, 1e9), field("fix_last", &E::fix_last),
        field("fix_believed", &E::fix_believed),
        field("fix_sigma_m", &E::fix_sigma_m).within(0.0, 1e6),
        field("fixes_believed", &E::fixes_believed), field("has_filter", &E::has_filter));
  }
};

// The simulated truth. Written by the world task at every physics step; read by the estimator's
// `truth` source and by the run-directory writer, and by nobody else (a test sees to it).
struct WorldTruth {
  double scenario_time_s = 0.0;  // [s] since the mission's start; 0 before it
  double x_m = 0.0;              // [m] [world]
  double y_m = 0.0;              // [m] [world]
  double heading_rad = 0.0;      // [rad] [-pi, pi]
  double surge_m_s = 0.0;        // [m/s] over ground, along the heading
  double sway_m_s = 0.0;         // [m/s] over ground, to starboard
  double yaw_rate_rad_s = 0.0;   // [rad/s] clockwise positive
  // [m] signed; +infinity without obstacles
  double inoffensive_distance_m = 0.0;
  double hull_clearance_m = 0.0;  // [m] signed, from the oriented rectangle; +infinity likewise
  // The least of both since the mission's start, so that nobody who looked away misses it.
  double least_inoffensive_distance_m = 0.0;     // [m]
  double least_inoffensive_distance_at_s = 0.0;  // [s] its scenario time
  double least_hull_clearance_m = 0.0;           // [m]
  // What the propellers run at: the box's output, its own time-out included.
  std::uint8_t thrust_left = 128;   // [-] [0, 255] 127 and 128 stop
  std::uint8_t thrust_right = 128;  // [-] [0, 255]

  static constexpr auto fields() noexcept {
    using W = WorldTruth;
    return field_list(
        field("scenario_time_s", &W::scenario_time_s), field("x_m", &W::x_m), field("y_m", &W::y_m),
        field("heading_rad", &W::heading_rad).within(-kHalfTurn_rad, kHalfTurn_rad),
        field("surge_m_s", &W::surge_m_s), field("sway_m_s", &W::sway_m_s),
        field("yaw_rate_rad_s", &W::yaw_rate_rad_s),
        field("inoffensive_distance_m", &W::inoffensive_distance_m).or_infinite(),
        field("hull_clearance_m", &W::hull_clearance_m).or_infinite(),
        field("least_inoffensive_distance_m", &W::least_inoffensive_distance_m).or_infinite(),
        field("least_inoffensive_distance_at_s", &W::least_inoffensive_distance_at_s),
        field("least_hull_clearance_m", &W::least_hull_clearance_m).or_infinite(),
        field("thrust_left", &W::thrust_left), field("thrust_right", &W::thrust_right));
  }
};

}  // namespace lodesman
