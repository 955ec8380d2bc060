// SPDX-License-Identifier: Apache-2.0
// What stands in for the truth where no world tells it: the boat is where it takes itself to be,
// and the obstacles are those that are known, or else those that it tracks. On a blackboard of its
// own, for whoever counts a run. One thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "mid_level/base/frames.h"
#include "mid_level/blackboard/blackboard.h"
#include "mid_level/geometry/moving_obstacle.h"

namespace lodesman::cli {

class EstimatedTruth {
 public:
  // `board` must outlive it. `known`: at scenario times; empty: the boat's own tracks count.
  // `begins`: where times count from; empty: from the boat's first start.
  EstimatedTruth(const Blackboard& board, double vehicle_radius_m,
                 std::vector<MovingObstacle> known, std::optional<Time> begins = std::nullopt);

  // One publication of world_truth for each vehicle_state of the boat's. No hull is known: its
  // clearance is infinite.
  [[nodiscard]] const Blackboard& board() const noexcept { return *board_; }
  // Takes in what was published since the last call.
  void update();

  // Each obstacle that was tracked, from when it was first seen on, by its last track; at scenario
  // times. Of the same size as its zone.
  [[nodiscard]] std::vector<MovingObstacle> seen() const;

 private:
  struct Seen {
    Time first{};
    Track last{};
  };

  void publish(const Stamped<VehicleState>& state);
  [[nodiscard]] double inoffensive_distance_m(const WorldPoint& place, Time at) const;
  [[nodiscard]] double scenario_time_s(Time stamp) const noexcept;

  double vehicle_radius_m_;
  std::vector<MovingObstacle> known_;
  std::optional<Time> begins_;
  Reader<MissionStatus> mission_;
  Reader<VehicleState> state_;
  Reader<Tracks> tracks_;
  Reader<ThrustApplied> thrust_;
  std::unique_ptr<Blackboard> board_;
  Writer<WorldTruth> writer_;
  WorldTruth truth_;
  Time first_started_{};
  std::map<std::uint32_t, Seen> seen_;  // by the track's id
  Tracks newest_;
};

}  // namespace lodesman::cli
