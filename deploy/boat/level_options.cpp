// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/level_options.h"

#include <algorithm>

#include "drivers/hal/thrust_shape.h"
#include "mid_level/base/frames.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/config/read_speed_table.h"

namespace lodesman {
namespace {

constexpr double kLongestRamp_s = 10.0;

}  // namespace

namespace {

[[nodiscard]] ContrastOptions read_contrast_options(const TomlTable& table) {
  const auto count = [&table](std::string_view key, std::int64_t max) {
    return static_cast<std::uint32_t>(table.integer(key, 1, max));
  };
  return {
      .most_excess = table.number("contrast_most_excess", Range::between(kLeastExcess, 100.0)),
      .sigmas = table.number("contrast_sigmas", Range::above(0.0, 100.0)),
      .seed = table.number("contrast_seed", Range::between(1.0, 100.0)),
      .side_lobe = table.number("contrast_side_lobe", Range::between(0.0, 0.99)),
      .ring_sector_rad = to_rad(table.number("contrast_ring_sector_deg", Range::above(0.0, 180.0))),
      .min_energy = table.number("contrast_min_energy", Range::above(0.0, 1e6)),
      .join_beams = count("contrast_join_beams", 16),
      .join_bins = count("contrast_join_bins", 64),
  };
}

}  // namespace

SegmentationOptions read_segmentation_options(const TomlTable& table) {
  const auto count = [&table](std::string_view key, std::int64_t min, std::int64_t max) {
    return static_cast<std::uint32_t>(table.integer(key, min, max));
  };
  return {
      .method = static_cast<DetectionMethod>(table.choice("method", {"contrast", "threshold"})),
      .threshold = table.number("threshold", Range::above(0.0, 255.0)),
      .min_range_m = table.number("min_range_m", Range::between(0.0, 300.0)),
      .min_blob_bins = count("min_blob_bins", 1, kMaxBeams * kMaxBins),
      .join_beams = count("join_beams", 1, kMaxJoin),
      .join_bins = count("join_bins", 1, kMaxJoin),
      .max_obstacle_length_m = table.number("max_obstacle_length_m", Range::above(0.0, 300.0)),
      .min_fill = table.number("min_fill", Range::between(0.0, 1.0)),
      .enclosed_fraction = table.number("enclosed_fraction", Range::between(0.5, 0.99)),
      .protection_margin_m = table.number("protection_margin_m", Range::between(0.0, 100.0)),
      .stripe_fraction = table.number("stripe_fraction", Range::above(0.0, 1.0)),
      .stripe_max_beams = count("stripe_max_beams", 0, kMaxBeams),
      .contrast = read_contrast_options(table),
      .profile = {.min_points = count("profile_min_points", 1, kMaxBeams),
                  .least_incidence_rad = to_rad(
                      table.number("profile_least_incidence_deg", Range::between(1.0, 89.0))),
                  .range_noise_m = table.number("profile_range_noise_m", Range::above(0.0, 10.0))},
  };
}

ThrustShapeOptions read_thrust_shape(const TomlTable& vehicle) {
  ThrustShapeOptions shape;
  for (const auto& [in, out] : vehicle.pairs("thrust_curve", Range::between(-1.0, 1.0), 0,
                                             ThrustShapeOptions::kMaxCurvePoints)) {
    shape.curve[shape.curve_points++] = {in, out};
  }
  shape.deadband = vehicle.number("thrust_deadband", Range::between(0.0, 0.9));
  shape.slew_per_s = vehicle.number("thrust_slew_per_s", Range::between(0.0, 100.0));
  shape.zero_pause = vehicle.duration("thrust_zero_pause_s", Range::between(0.0, 10.0));
  try {
    static_cast<void>(ThrustShape{shape});
  } catch (const StartupError& error) {
    vehicle.refuse("thrust_curve", error.what());
  }
  return shape;
}

namespace {

// Starboard and ahead of the vehicle's origin.
[[nodiscard]] VehiclePoint read_place_aboard(const TomlTable& mounting, std::string_view key) {
  const auto place_m = mounting.pair(key, Range::between(-100.0, 100.0));
  return {{place_m[0], place_m[1]}};
}

[[nodiscard]] double read_turn(const TomlTable& mounting, std::string_view key) {
  return to_rad(mounting.number(key, Range::between(-180.0, 180.0)));
}

[[nodiscard]] VehicleModelParameters read_vehicle_model(const TomlTable& vehicle) {
  const auto positive = [&vehicle](std::string_view key, double most) {
    return vehicle.number(key, Range::above(0.0, most));
  };
  const auto any = [&vehicle](std::string_view key, double most) {
    return vehicle.number(key, Range::between(0.0, most));
  };
  VehicleModelParameters model;
  model.mass_kg = positive("mass_kg", 1e6);
  model.added_mass_surge_kg = any("added_mass_surge_kg", 1e6);
  model.added_mass_sway_kg = any("added_mass_sway_kg", 1e6);
  model.yaw_inertia_kg_m2 = positive("yaw_inertia_kg_m2", 1e7);
  model.added_yaw_inertia_kg_m2 = any("added_yaw_inertia_kg_m2", 1e7);
  model.surge_drag_n_s_per_m = positive("surge_drag_n_s_per_m", 1e6);
  model.surge_drag_n_s2_per_m2 = any("surge_drag_n_s2_per_m2", 1e6);
  model.sway_drag_n_s_per_m = positive("sway_drag_n_s_per_m", 1e6);
  model.sway_drag_n_s2_per_m2 = any("sway_drag_n_s2_per_m2", 1e6);
  model.yaw_drag_n_m_s = positive("yaw_drag_n_m_s", 1e7);
  model.yaw_drag_n_m_s2 = any("yaw_drag_n_m_s2", 1e7);
  model.turning_n_m_per_head_ref = positive("turning_n_m_per_head_ref", 1e4);
  return model;
}

[[nodiscard]] HullResponse read_hull_response(const TomlTable& configuration) {
  const TomlTable vehicle = configuration.table("vehicle");
  const VehicleModelParameters model = read_vehicle_model(vehicle);
  HullResponse hull;
  hull.mass_kg = model.mass_kg + model.added_mass_surge_kg;
  hull.surge_drag_n_s_per_m = model.surge_drag_n_s_per_m;
  hull.surge_drag_n_s2_per_m2 = model.surge_drag_n_s2_per_m2;
  hull.yaw_inertia_kg_m2 = model.yaw_inertia_kg_m2 + model.added_yaw_inertia_kg_m2;
  hull.yaw_drag_n_m_s = model.yaw_drag_n_m_s;
  hull.yaw_drag_n_m_s2 = model.yaw_drag_n_m_s2;
  hull.turning_n_m_per_head_ref = model.turning_n_m_per_head_ref;
  hull.astern_share = configuration.table("guard").number("astern_share", Range::above(0.0, 1.0));
  hull.speeds = read_speed_table(vehicle);
  return hull;
}

// Until a box that ramps its thrust, and rests before it reverses, gives half of it.
[[nodiscard]] Duration brake_delay(const ThrustShapeOptions& shape) {
  const double ramp_s = shape.slew_per_s > 0.0 ? 0.5 / shape.slew_per_s : 0.0;
  return shape.zero_pause + from_seconds(std::min(ramp_s, kLongestRamp_s));
}

[[nodiscard]] GuardOptions read_guard_options(const TomlTable& configuration) {
  const TomlTable guard = configuration.table("guard");
  const TomlTable vehicle = configuration.table("vehicle");
  GuardOptions options;
  options.is_on = guard.boolean("enabled");
  options.margin_m = guard.number("margin_m", Range::between(0.0, 20.0));
  options.release_m = guard.number("release_m", Range::between(0.0, 20.0));
  options.reaction = guard.duration("reaction_s", Range::between(0.0, 2.0));
  options.silence_neutral = guard.duration("silence_neutral_s", Range::between(0.0, 60.0));
  options.brake_max = guard.duration("brake_max_s", Range::between(0.1, 120.0));
  options.brake_delay = brake_delay(read_thrust_shape(vehicle));
  options.frame_age_max = max_age::kSonarFrame;
  options.hull_half_length_m = vehicle.number("hull_length_m", Range::above(0.0, 100.0)) / 2.0;
  options.hull_half_beam_m = vehicle.number("hull_beam_m", Range::above(0.0, 50.0)) / 2.0;
  options.hull = read_hull_response(configuration);
  return options;
}

}  // namespace

LowLevelOptions read_low_level_options(const TomlTable& configuration) {
  LowLevelOptions options;
  options.delta_t.segmentation = read_segmentation_options(configuration.table("segmentation"));
  const TomlTable zones = configuration.table("zones");
  const OwnZones own{zones.number("hull_radius_m", Range::between(0.0, 10.0)),
                     zones.number("margin_m", Range::between(0.0, 20.0))};
  if (zones.choice("source", {"own", "protection"}) == 0) {
    options.delta_t.own_zones = own;
  }
  options.position.far_max_m =
      configuration.table("origin").number("far_max_m", Range::above(0.0, 1e6));
  const TomlTable battery = configuration.table("battery");
  const TomlTable mounting = configuration.table("mounting");
  options.heading_turn_rad = read_turn(mounting, "heading_deg");
  const VehiclePoint sonar = read_place_aboard(mounting, "sonar_m");
  options.delta_t.mounting = {sonar.xy_m.x(), sonar.xy_m.y(), read_turn(mounting, "sonar_deg")};
  options.thruster.battery = {battery.number("low_V", Range::between(0.0, 1000.0)),
                              battery.number("critical_V", Range::between(0.0, 1000.0)),
                              battery.number("hysteresis_V", Range::between(0.0, 10.0)),
                              battery.number("sag_V", Range::between(0.0, 100.0))};
  if (options.thruster.battery.low_V > 0.0 &&
      options.thruster.battery.critical_V >= options.thruster.battery.low_V) {
    battery.refuse("critical_V", "must be below low_V");
  }
  const TomlTable tracks = configuration.table("tracks");
  auto& oracle = options.delta_t.track_oracle;
  oracle.delay = tracks.duration("delay_s", Range::between(0.0, 2.0));
  oracle.place_sigma_m = tracks.number("place_sigma_m", Range::between(0.0, 5.0));
  oracle.velocity_sigma_m_s = tracks.number("velocity_sigma_m_s", Range::between(0.0, 1.0));
  oracle.dropout = tracks.number("dropout", Range::between(0.0, 0.99));
  oracle.memory = tracks.duration("memory_s", Range::between(0.0, 3600.0));
  options.thruster.guard = read_guard_options(configuration);
  return options;
}

namespace {

[[nodiscard]] PilotOptions read_pilot_options(const TomlTable& configuration) {
  PilotOptions options;
  const TomlTable zones = configuration.table("zones");
  options.zones.hull_radius_m = zones.number("hull_radius_m", Range::between(0.0, 10.0));
  options.zones.margin_m = zones.number("margin_m", Range::between(0.0, 20.0));
  options.zones.margin_per_stopping_way =
      zones.number("margin_per_stopping_way", Range::between(0.0, 20.0));
  options.zones.margin_per_turning_way =
      zones.number("margin_per_turning_way", Range::between(0.0, 20.0));
  options.zones.least_margin_m = zones.number("least_margin_m", Range::between(0.0, 20.0));
  options.zones.doubt_sigmas = zones.number("doubt_sigmas", Range::between(0.0, 10.0));
  options.zones.own_doubt_share = zones.number("own_doubt_share", Range::between(0.0, 1.0));
  options.zones.doubt_max_m = zones.number("doubt_max_m", Range::between(0.0, 20.0));
  options.zones.slow_share = zones.number("slow_share", Range::between(0.0, 1.0));
  const TomlTable pilot = configuration.table("pilot");
  options.side_gain_m = pilot.number("side_gain_m", Range::between(0.0, 100.0));
  options.narrow_speed_share = pilot.number("narrow_speed_share", Range::above(0.0, 1.0));
  options.latency = pilot.duration("latency_s", Range::between(0.0, 2.0));
  auto& manoeuvres = options.manoeuvres;
  manoeuvres.clearance_m = pilot.number("clearance_m", Range::above(0.0, 20.0));
  manoeuvres.core_m = pilot.number("core_m", Range::between(0.0, 10.0));
  manoeuvres.switch_gain_s = pilot.number("manoeuvre_gain_s", Range::between(0.0, 100.0));
  manoeuvres.flight_speed_m_s = pilot.number("flight_speed_m_s", Range::between(0.0, 20.0));
  manoeuvres.doubt_sigmas = options.zones.doubt_sigmas;
  manoeuvres.doubt_max_m = options.zones.doubt_max_m;
  options.response.look_ahead_m = pilot.number("look_ahead_m", Range::above(0.0, 50.0));
  const TomlTable vehicle = configuration.table("vehicle");
  options.response.hull_half_length_m =
      vehicle.number("hull_length_m", Range::above(0.0, 100.0)) / 2.0;
  options.response.hull_half_beam_m = vehicle.number("hull_beam_m", Range::above(0.0, 50.0)) / 2.0;
  options.sight.unseen_speed_m_s = pilot.number("unseen_speed_m_s", Range::above(0.0, 10.0));
  options.sight.bow_m = options.response.hull_half_length_m + manoeuvres.clearance_m;
  options.sight.latency_s = to_seconds(options.latency);
  return options;
}

[[nodiscard]] FixGateOptions read_fix_gate_options(const TomlTable& estimator) {
  FixGateOptions gate;
  gate.sigmas = estimator.number("gate_sigmas", Range::between(2.0, 10.0));
  gate.speed_m_s = estimator.number("gate_speed_m_s", Range::above(0.0, 10.0));
  gate.sigma_least_m = estimator.number("fix_sigma_least_m", Range::above(0.0, 10.0));
  gate.sigma_unknown_m = estimator.number("fix_sigma_unknown_m", Range::above(0.0, 100.0));
  gate.lasting = estimator.duration("refused_lasting_s", Range::between(0.5, 60.0));
  gate.approach_m_s = estimator.number("approach_m_s", Range::above(0.0, 10.0));
  gate.bridging = estimator.duration("fix_bridged_s", Range::between(0.5, 60.0));
  gate.longest_gap = estimator.duration("fix_gap_max_s", Range::between(1.0, 120.0));
  gate.frozen_way_m = estimator.number("fix_frozen_way_m", Range::above(0.0, 100.0));
  return gate;
}

[[nodiscard]] PoseFilterOptions read_pose_filter_options(const TomlTable& configuration) {
  const TomlTable estimator = configuration.table("estimator");
  const auto noise = [&estimator](std::string_view key) {
    return estimator.number(key, Range::above(0.0, 10.0));
  };
  PoseFilterOptions filter;
  filter.vehicle = read_vehicle_model(configuration.table("vehicle"));
  filter.surge_noise_m_s_per_sqrt_s = noise("surge_noise_m_s_per_sqrt_s");
  filter.sway_noise_m_s_per_sqrt_s = noise("sway_noise_m_s_per_sqrt_s");
  filter.yaw_noise_rad_s_per_sqrt_s = noise("yaw_noise_rad_s_per_sqrt_s");
  filter.current_noise_m_s_per_sqrt_s = noise("current_noise_m_s_per_sqrt_s");
  filter.current_sigma_m_s = noise("current_sigma_m_s");
  filter.heading_sigma_rad = noise("heading_sigma_rad");
  filter.yaw_rate_sigma_rad_s = noise("yaw_rate_sigma_rad_s");
  filter.gate = read_fix_gate_options(estimator);
  return filter;
}

}  // namespace

HighLevelOptions read_high_level_options(const TomlTable& configuration, const SpeedTable& speeds) {
  HighLevelOptions options;
  const TomlTable planner = configuration.table("planner");
  auto& replanner = options.planner.replanner;
  replanner.replan_period = planner.duration("replan_period_s", Range::between(0.0, 60.0));
  replanner.answer_patience = planner.duration("answer_patience_s", Range::between(0.1, 10.0));
  replanner.waypoint_interval_m = planner.number("waypoint_interval_m", Range::between(0.1, 50.0));
  replanner.previous_path_max_age =
      planner.duration("previous_path_max_age_s", Range::between(0.0, 1e6));
  PilotOptions pilot = read_pilot_options(configuration);
  options.controller.steering.heading_lead_s =
      configuration.table("pilot").number("heading_lead_s", Range::between(0.0, 10.0));
  options.controller.look_ahead_s =
      configuration.table("pilot").number("look_ahead_s", Range::between(0.0, 60.0));
  pilot.look_ahead_s = options.controller.look_ahead_s;
  options.controller.look_ahead_m = pilot.response.look_ahead_m;
  options.planner.progress.patience =
      configuration.table("progress").duration("patience_s", Range::between(1.0, 3600.0));
  const TomlTable guidance = configuration.table("guidance");
  options.controller.waypoint_radius_m =
      guidance.number("waypoint_radius_m", Range::between(0.05, 20.0));
  options.planner.mission.waypoint_radius_m = options.controller.waypoint_radius_m;
  options.planner.mission.speeds = speeds;
  const TomlTable control = configuration.table("control");
  options.controller.steering.heading_gain_per_deg =
      control.number("heading_gain_per_deg", Range::above(0.0, 100.0));
  const TomlTable estimator = configuration.table("estimator");
  auto& reckoning = options.estimator.dead_reckoning;
  reckoning.step = estimator.duration("dead_reckoning_step_s", Range::between(0.01, 1.0));
  const double k_m_s = estimator.number("speed_per_surge_ref_m_s", Range::between(0.0, 1.0));
  reckoning.speeds = k_m_s > 0.0 ? SpeedTable::proportional(k_m_s) : speeds;
  options.estimator.surge_at_once = k_m_s > 0.0;
  options.estimator.current_time =
      estimator.duration("current_time_s", Range::between(0.0, 1000.0));
  options.estimator.antenna = read_place_aboard(configuration.table("mounting"), "antenna_m");
  options.estimator.filter = read_pose_filter_options(configuration);
  options.estimator.filter.speeds = speeds;
  pilot.response.model = VehicleModel{options.estimator.filter.vehicle, speeds};
  pilot.response.steering = options.controller.steering;
  if (planner.choice("space", {"world", "sonar_view"}) == 0) {
    replanner.pilot = pilot;
  }
  options.estimator.origin_search = {
      configuration.table("origin").number("at_start_sigma_m", Range::above(0.0, 100.0)),
      options.estimator.filter.gate.sigma_unknown_m};
  return options;
}

}  // namespace lodesman
