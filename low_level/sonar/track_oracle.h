// SPDX-License-Identifier: Apache-2.0
// Tracks from a known scene: what a perfect tracker behind this sonar could know, no more. It sees
// obstacles of the scenario only in the fan, within range and where nothing nearer hides them, and
// may be made late, noisy and forgetful. It stands in for tracking from echoes. Owned by one
// thread; it allocates when made and never after.
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "low_level/sonar/known_obstacles.h"
#include "mid_level/base/random_stream.h"
#include "mid_level/geometry/moving_obstacle.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

struct TrackOracleOptions {
  double sector_rad = 0.0;  // (0, 2 pi] of the fan
  Duration delay{};         // [0, 2 s] what is known is so old
  double place_sigma_m = 0.0;
  double velocity_sigma_m_s = 0.0;
  double dropout = 0.0;  // [0, 1) share of the pings in which an obstacle is not seen
  Duration memory{};     // what has left the view is kept for so long
  std::uint64_t seed = 0;
};

class TrackOracle {
 public:
  // `world` must outlive this object.
  TrackOracle(std::span<const MovingObstacle> world, const TrackOracleOptions& options);

  // What one that was here before knew last; it is forgotten as if it had been seen here.
  void resume(const Tracks& last) noexcept;

  // One ping. `out` is what is known now, as old as the delay makes it, in the scene's order. Of
  // more than it holds the farthest are left out.
  void see(const KnownView& view, Tracks& out) noexcept;

 private:
  struct Known {
    Track track;
    Time first_seen{};
    double from_m = 0.0;  // polylines: what is known of its length ...
    double to_m = 0.0;    // ... lies between these
    bool known = false;
  };
  struct Near {
    double distance_m = 0.0;
    std::uint32_t index = 0;
    [[nodiscard]] bool operator<(const Near& other) const noexcept {
      return std::tie(distance_m, index) < std::tie(other.distance_m, other.index);
    }
  };
  struct Seen {
    bool any = false;
    double from_m = 0.0;
    double to_m = 0.0;
  };

  [[nodiscard]] Seen look_at(std::size_t index, const KnownView& view) const noexcept;
  [[nodiscard]] bool in_sight(const Eigen::Vector2d& p_W, std::size_t index,
                              const KnownView& view) const noexcept;
  [[nodiscard]] bool should_be_seen(const Known& known, std::size_t index,
                                    const KnownView& view) const noexcept;
  void learn(Known& known, std::size_t index, const Seen& seen, const KnownView& view) noexcept;
  [[nodiscard]] double velocity_sigma(Duration watched) const noexcept;  // [m/s]
  void write(const KnownView& view, Tracks& out) noexcept;

  std::span<const MovingObstacle> world_;
  TrackOracleOptions options_;
  std::vector<RandomStream> random_;  // one an obstacle: its luck is not another's
  std::vector<Obstacle> now_;         // the scene as it is at the ping
  std::vector<Known> known_;
  std::vector<Near> nearest_;
  std::vector<Tracks> late_;  // a ring of what was known at the last pings
  std::uint64_t pings_ = 0;
};

}  // namespace lodesman
