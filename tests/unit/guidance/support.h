// SPDX-License-Identifier: Apache-2.0
// Tracks, vehicle and routes for the tests of this room.
#pragma once

#include <initializer_list>
#include <vector>

#include "deploy/boat/level_options.h"
#include "high_level/guidance/manoeuvre.h"
#include "high_level/guidance/zones.h"
#include "high_level/tasks/high_level.h"
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

// What the shipped configuration says, read anew by each test program.
inline const HighLevelOptions& shipped_options() {
  static const HighLevelOptions options = read_high_level_options(
      TomlDocument::from_file(LODESMAN_DEFAULT_CONFIG).root(), SpeedTable::proportional(0.01));
  return options;
}

inline const PilotOptions& shipped_pilot() { return *shipped_options().planner.replanner.pilot; }

inline ZoneOptions default_zones() { return shipped_pilot().zones; }

inline VehicleResponse response_at(const Cruise& cruise) {
  VehicleResponse response = shipped_pilot().response;
  response.cruise = cruise;
  response.look_ahead_m += shipped_options().controller.look_ahead_s * cruise.speed_m_s;
  return response;
}

// At 1 m/s, where nothing flies faster.
inline VehicleResponse default_response() { return response_at({100, 1.0}); }

// Flight is asked for by the tests that are about it.
inline ManoeuvreOptions default_manoeuvres() {
  ManoeuvreOptions options = shipped_pilot().manoeuvres;
  options.flight_speed_m_s = ManoeuvreOptions{}.flight_speed_m_s;
  return options;
}

}  // namespace lodesman::testing
