// SPDX-License-Identifier: Apache-2.0
// Zones of our own making round tracks: shape + hull + a margin that grows with the ways that the
// vehicle needs to stop and to turn at the planned speed, and with doubt; and what to do when start
// or goal lie in one. Pure functions; any thread.
#pragma once

#include <optional>

#include "high_level/estimate/vehicle_model.h"
#include "mid_level/base/frames.h"
#include "mid_level/messages/path.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

struct ZoneOptions {
  double hull_radius_m = 0.0;            // [m] half the beam
  double margin_m = 0.0;                 // [m] at no speed and no doubt
  double margin_per_stopping_way = 0.0;  // [-] more of it for the way to stop at that speed ...
  double margin_per_turning_way = 0.0;   // [-] ... and for the way to turn: vehicle_model.h
  double least_margin_m = 0.0;           // [m] in water that is too narrow for more
  double doubt_sigmas = 0.0;  // [-] standard deviations of a track's place that are added ...
  double doubt_max_m = 0.0;   // [m] ... up to this
  // Of the own place's standard deviation, what comes on top of a track's: 1 where tracks are
  // places in the world, 0 where they were placed from the own estimate and err with it.
  double own_doubt_share = 0.0;  // [-] [0, 1]
  // A track that moves faster than this share of the planned speed has no zone: where it will be
  // when the vehicle is there is the manoeuvres' to foresee.
  double slow_share = 0.0;  // [-]
};

// [m] from an obstacle that nothing is doubtful about to the edge of its zone.
[[nodiscard]] double sure_zone_m(const ZoneOptions& options, const VehicleModel& vehicle,
                                 double speed_m_s) noexcept;

// Makes a shape's protection a zone that begins so far from it.
void put_zone(Obstacle& shape, double clear_m) noexcept;

// Makes the request's zones, each placed where its obstacle will be when a vehicle at `from` with
// that speed can be there. own_sigma_m: of the own place, as far as it counts. protection_first/
// second_m are the full zone, give_m what of it may be given up.
void make_zones(const ZoneOptions& options, const VehicleModel& vehicle, const Tracks& tracks,
                Time now, const Eigen::Vector2d& from_W, double speed_m_s, PathRequest& request,
                double own_sigma_m = 0.0) noexcept;

// From a point to the nearest zone's edge, negative inside; infinity without zones.
[[nodiscard]] double zone_clearance_m(const PathRequest& request,
                                      const Eigen::Vector2d& point_W) noexcept;

// Makes zones that a point lies in as narrow as it needs to lie outside them, where they may give
// so much. False: it was outside already, or one of them may not, and all stay as they are.
bool make_room(PathRequest& request, const Eigen::Vector2d& point_W) noexcept;

// The nearest point outside every zone to a point inside one, reached in a straight line that
// leads into no obstacle deeper than it starts. Nothing where there is none within 12 m.
[[nodiscard]] std::optional<Eigen::Vector2d> way_out(const PathRequest& request,
                                                     const Eigen::Vector2d& point_W) noexcept;

// The point that far outside every zone that lies nearest to a point inside one; of equally near
// ones the one nearest to `from`. Nothing where there is none within 12 m.
[[nodiscard]] std::optional<Eigen::Vector2d> nearest_free(const PathRequest& request,
                                                          const Eigen::Vector2d& point_W,
                                                          const Eigen::Vector2d& from_W,
                                                          double outside_m = 0.05) noexcept;

}  // namespace lodesman
