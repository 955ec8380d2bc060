// SPDX-License-Identifier: Apache-2.0
// Tracks, vehicle and routes for the tests of this room.
#pragma once

#include <initializer_list>
#include <vector>

#include "high_level/guidance/manoeuvre.h"
#include "high_level/guidance/zones.h"
#include "mid_level/messages/tracks.h"

namespace lodesman::testing {

inline Time at_s(double seconds) { return Time{from_seconds(seconds)}; }

// A disc of 0.5 m, seen at time 0 without any doubt.
inline Track disc_track(std::uint32_t id, double x_m, double y_m, double velocity_x_m_s = 0.0,
                        double velocity_y_m_s = 0.0) {
  Track track;
  track.id = id;
  track.shape.id = id;
  track.shape.centre_x_m = x_m;
  track.shape.centre_y_m = y_m;
  track.shape.semi_axis_first_m = track.shape.semi_axis_second_m = 0.5;
  track.velocity_x_m_s = velocity_x_m_s;
  track.velocity_y_m_s = velocity_y_m_s;
  return track;
}

inline Track wall_track(std::uint32_t id, std::initializer_list<Vertex> vertices) {
  Track track;
  track.id = id;
  track.shape.id = id;
  track.shape.shape = ObstacleShape::kPolyline;
  for (const Vertex& vertex : vertices) {
    track.shape.vertices[track.shape.vertex_count++] = vertex;
  }
  return track;
}

inline Tracks tracks_of(std::initializer_list<Track> all) {
  Tracks tracks;
  tracks.frame = 1;
  for (const Track& track : all) {
    tracks.tracks[tracks.count++] = track;
  }
  return tracks;
}

inline Route route_of(std::initializer_list<Eigen::Vector2d> points) {
  Route route;
  for (const Eigen::Vector2d& point : points) {
    (void)route.add(point);
  }
  return route;
}

// As the default profile has them, at 1 m/s.
inline ZoneOptions default_zones() {
  ZoneOptions options;
  options.hull_radius_m = 0.6;
  options.margin_m = 0.8;
  options.margin_per_speed_s = 0.2;
  options.margin_per_turning_radius = 0.07;
  options.turn_rate_max_rad_s = 0.35;
  options.least_margin_m = 0.45;
  options.doubt_sigmas = 2.0;
  options.doubt_max_m = 1.5;
  options.slow_share = 0.3;
  return options;
}

inline VehicleResponse default_response() {
  VehicleResponse response;
  response.speed_max_m_s = 1.0;
  response.surge_time_s = 2.3;
  response.turn_rate_max_rad_s = 0.35;
  response.heading_gain_per_s = 0.7;
  response.hull_half_length_m = 1.02;
  response.hull_half_beam_m = 0.6;
  response.look_ahead_m = 2.8;
  return response;
}

inline ManoeuvreOptions default_manoeuvres() {
  ManoeuvreOptions options;
  options.clearance_m = 0.4;
  options.core_m = 0.15;
  options.doubt_sigmas = 2.0;
  options.doubt_max_m = 1.5;
  options.switch_gain_s = 2.0;
  return options;
}

}  // namespace lodesman::testing
