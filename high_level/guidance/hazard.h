// SPDX-License-Identifier: Apache-2.0
// What is known of an obstacle, as looking ahead needs it: where it will be, and how likely.
// Whether it rests or moves is a hypothesis with a probability: one that may do either is foreseen
// twice. Plain values, bounded work, no allocation; any thread.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "high_level/estimate/vehicle_model.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

// [-] [0, 1] that it moves at all, by its velocity and that velocity's covariance. Bayes: most
// things rest, and what moves does so at some tenths of a metre a second.
[[nodiscard]] double probability_of_motion(const Track& track) noexcept;

// A hypothesis on one track: what is constant while one choice is made.
struct Hazard {
  const Track* track = nullptr;
  double probability = 1.0;                                // [-] (0, 1]
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();  // [m/s] [world]
  double age_s = 0.0;                                      // [s] of its place
  double place_sigma_m = 0.0;                        // [m] of its place against the vehicle's own
  double velocity_sigma_m_s = 0.0;                   // [m/s]
  double around_m = 0.0;                             // [m] no part of it is farther from its centre
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // [m] [world] at the track's time
};

struct Hazards {
  std::array<Hazard, 2 * kMaxObstacles> list{};
  std::size_t count = 0;
  double fastest_m_s = 0.0;  // of them
};

// own_sigma_m: [m] of the vehicle's place against the tracks, one standard deviation. The tracks
// must outlive what is made of them.
void foresee_hazards(Time now, const Tracks& tracks, double own_sigma_m, Hazards& out) noexcept;

// What the clearance is from: two discs cover the hull.
struct HullDiscs {
  double at_m = 0.0;      // [m] ahead of and astern of the vehicle's centre
  double radius_m = 0.0;  // [m]
  [[nodiscard]] static HullDiscs of(double half_length_m, double half_beam_m) noexcept;
};

// [m] From hull to obstacle `after_s` after the track's time, negative where they overlap; beyond
// wanted_m a lower bound.
[[nodiscard]] double clearance_m(const Hazard& hazard, double after_s, const VehicleMotion& own,
                                 const HullDiscs& hull, double wanted_m) noexcept;

// [-] [0, 1] how close ahead of something that moves the vehicle is, in its way; 0: not at all.
[[nodiscard]] double closeness_ahead(const Hazard& hazard, double after_s,
                                     const VehicleMotion& own) noexcept;

}  // namespace lodesman
