// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/frame_tracks.h"

#include <algorithm>

namespace lodesman {
namespace {

// Ours: half the length of a bin's footprint at 10 m, and a slow boat's speed.
constexpr double kPlaceSigma_m = 0.1;
constexpr double kVelocitySigma_m_s = 0.3;

}  // namespace

Obstacle to_world(const VehiclePose& pose, const Obstacle& in_vehicle) noexcept {
  Obstacle placed = in_vehicle;
  const WorldPoint centre = pose.to_world({{in_vehicle.centre_x_m, in_vehicle.centre_y_m}});
  placed.centre_x_m = centre.xy_m.x();
  placed.centre_y_m = centre.xy_m.y();
  placed.angle_rad = pose.angle_to_world_rad(in_vehicle.angle_rad);
  placed.vertex_count = std::min<std::uint32_t>(in_vehicle.vertex_count, kMaxVertices);
  for (std::uint32_t i = 0; i < placed.vertex_count; ++i) {
    const WorldPoint p = pose.to_world({{in_vehicle.vertices[i].x_m, in_vehicle.vertices[i].y_m}});
    placed.vertices[i] = {p.xy_m.x(), p.xy_m.y()};
  }
  return placed;
}

void tracks_of_frame(const SonarObstacles& obstacles, const VehiclePose& pose,
                     Tracks& out) noexcept {
  out.frame = obstacles.frame;
  out.captured = obstacles.captured;
  out.dropped = obstacles.dropped;
  out.count = std::min<std::uint32_t>(obstacles.count, kMaxObstacles);
  for (std::uint32_t i = 0; i < out.count; ++i) {
    Track& track = out.tracks[i];
    track = {};
    track.last_seen = obstacles.captured;
    track.shape = to_world(pose, obstacles.obstacles[i]);
    track.shape.id = 0;
    track.place_xx_m2 = track.place_yy_m2 = kPlaceSigma_m * kPlaceSigma_m;
    track.velocity_xx_m2_s2 = track.velocity_yy_m2_s2 = kVelocitySigma_m_s * kVelocitySigma_m_s;
  }
}

}  // namespace lodesman
