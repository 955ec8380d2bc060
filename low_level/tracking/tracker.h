// SPDX-License-Identifier: Apache-2.0
// Detections of pings, one after another, to tracks: what moves is followed, each by a filter of
// its own; what rests is evidence in a grid, of which polygons are traced, so that it is remembered
// without a time-out and forgotten where the sonar looks and sees water. All in the odometry frame,
// which is smooth. One thread owns a Tracker; it allocates when made and never after.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "low_level/tracking/evidence_grid.h"
#include "low_level/tracking/fan_view.h"
#include "low_level/tracking/followed.h"
#include "low_level/tracking/still_shapes.h"
#include "mid_level/base/frames.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

class Tracker {
 public:
  // [m] Nothing is heard nearer, at long range settings.
  explicit Tracker(double nearest_m);

  // What one ping shows. `seen` is in the head's frame, whose place and direction `head` is
  // [odometry]. `out` is in the odometry frame: what moves first, then what rests. Beams for which
  // `blind` is not 0 show nothing but what was found in them; empty: none is.
  void see(const SonarPing& ping, const SonarObstacles& seen, const VehiclePose& head, Tracks& out,
           std::span<const std::uint8_t> blind = {}) noexcept;

  // What one that was here before knew last [odometry], before the first ping. What no tracker
  // would have written is passed over.
  void resume(const Tracks& last, const VehiclePose& head, Time now) noexcept;

  [[nodiscard]] std::span<const Followed> followed() const noexcept {
    return std::span{followed_}.first(count_);
  }
  [[nodiscard]] const EvidenceGrid& water() const noexcept { return *water_; }

 private:
  static constexpr std::size_t kMostFollowed = kMaxObstacles;
  static constexpr std::size_t kNone = kMaxObstacles;
  static constexpr std::uint32_t kMostMovers = 48;        // some room is always left for what rests
  static constexpr std::uint32_t kMostIds = 999'999'999;  // others' are greater
  struct Seen {        // one obstacle of the ping, in the odometry frame
    Obstacle outline;  // of what was heard
    Obstacle shape;    // of what that is taken to be
    Sighting sighting;
    bool compact = false;  // small enough to be followed
    std::size_t follower = kNone;
  };
  struct Pair {
    double squared = 0.0;  // Mahalanobis distance
    std::size_t follower = 0;
    std::size_t seen = 0;
  };

  void place(const SonarPing& ping, const SonarObstacles& seen, const VehiclePose& head) noexcept;
  void associate() noexcept;
  void update_followed(const VehiclePose& head, double dt_s) noexcept;
  [[nodiscard]] bool in_open_water(const Followed& one) const noexcept;
  void clear_wake(const Followed& one) noexcept;
  void begin_new() noexcept;
  void feed_grid() noexcept;
  void forget_gone() noexcept;
  [[nodiscard]] bool is_shown(const Followed& one) const noexcept;
  void pick_shown(const VehiclePose& head) noexcept;
  [[nodiscard]] bool is_far(const Seen& seen, const VehiclePose& head) const noexcept;
  void write_far(const SonarPing& ping, const VehiclePose& head, Tracks& out) const noexcept;
  void write(const SonarPing& ping, const VehiclePose& head, Tracks& out) noexcept;

  double nearest_m_;
  double now_s_ = 0.0;
  double last_s_ = -1.0;
  std::uint32_t next_id_ = 1;
  std::size_t seen_count_ = 0;
  std::size_t count_ = 0;
  FanView fan_;
  std::array<Seen, kMaxObstacles> seen_{};
  std::array<Followed, kMostFollowed> followed_{};
  std::array<std::size_t, kMostFollowed> sighting_of_{};
  std::array<Pair, kMostFollowed * kMaxObstacles> pairs_{};
  std::size_t pair_count_ = 0;
  std::array<std::size_t, kMostFollowed> shown_{};  // of those followed, nearest first
  std::size_t shown_count_ = 0;
  std::unique_ptr<EvidenceGrid> water_;
  std::unique_ptr<StillShapes> still_;
};

}  // namespace lodesman
