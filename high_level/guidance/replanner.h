// SPDX-License-Identifier: Apache-2.0
// The re-planner of the paper's Fig. 1: asks PathFinder for a path in the newest sonar frame, takes
// the answer into the world at the pose of that frame, and keeps the previous waypoints when there
// is no path. It is handed everything it needs; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "high_level/guidance/pilot.h"
#include "high_level/guidance/sight.h"
#include "mid_level/base/frames.h"
#include "mid_level/base/time.h"
#include "mid_level/geometry/pose_history.h"
#include "mid_level/messages/command.h"
#include "mid_level/messages/path.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

struct ReplannerOptions {
  Duration replan_period{};    // at the earliest so long after the last request; the paper: 1.6 s
  Duration answer_patience{};  // a request unanswered for so long is given up
  Duration silence_limit{};    // without any answer for so long, nothing is followed
  double waypoint_interval_m = 0.0;   // [m] the paper's C
  Duration previous_path_max_age{};   // previous waypoints are dropped when their frame is older
  std::optional<PilotOptions> pilot;  // plans in the world from tracks; empty: in the sonar view
};

// What there is no plan without.
struct Missing {
  PathReason what = PathReason::kNoFrame;  // kNoFrame, kNoPosition or kNoHeading
  Time since{};                            // when the last of it was measured; 0: never
};

class Replanner {
 public:
  // first_id: above every id that an earlier program has used.
  explicit Replanner(const ReplannerOptions& options, std::uint64_t first_id = 1);

  // Forgets plans and goal: a mission starts.
  void start(Time now) noexcept;
  // For the pilot, where there is one.
  void keep_sides_of(const PathRequest& last) noexcept;
  void sail_at(const Cruise& cruise) noexcept;
  void tune(const Tunables& tunables) noexcept;

  // Steps 2-4 and 9: the request for this frame, if one is due, else nullptr. frame_captured
  // belongs to `frame`.
  [[nodiscard]] const PathRequest* request(Time now, std::uint64_t frame, Time frame_captured,
                                           const WorldPoint& goal,
                                           const PoseHistory& poses) noexcept;

  // The same in the world, for what is known at this frame, which came at `seen`. Where no other
  // has come for too long, again for what is remembered: slower at first, then to where it stops.
  // water: what was seen of it; null: all of it is known.
  [[nodiscard]] const PathRequest* request(Time now, const Tracks& tracks, Time seen,
                                           const VehicleState& state,
                                           const Destination& destination) noexcept;
  [[nodiscard]] const Plan* answer(Time now, const SonarPath& path, const Tracks& tracks,
                                   const Coverage* water, const VehicleState& state) noexcept;

  // Steps 11-12 for the answer to the pending request; nothing for any other answer.
  [[nodiscard]] const Plan* answer(Time now, const SonarPath& path) noexcept;

  // The plan once there was no answer for longer than the limit, because no sonar frame came, none
  // could be placed, or PathFinder is silent: nothing is known, so nothing is followed. Said once.
  [[nodiscard]] const Plan* silence(Time now, const Missing& missing) noexcept;

 private:
  struct Pending {
    std::uint64_t id = 0;
    std::uint64_t frame = 0;
    Time asked{};
    Time captured{};
    VehiclePose pose;
    WorldPoint goal;
    Sight sight = Sight::kNew;
  };
  [[nodiscard]] bool is_due(Time now, std::uint64_t frame) const noexcept;
  [[nodiscard]] bool is_due_again(Time now) const noexcept;
  // Where is made for by what is known.
  [[nodiscard]] Destination in_sight(Sight sight, const VehicleState& state,
                                     const Destination& destination) noexcept;
  void ask(const Pending& pending) noexcept;
  [[nodiscard]] Pending take_answer(Time now) noexcept;
  void take_way_off(const VehicleState& state) noexcept;
  // Step 12.4: the previous waypoints stand, as long as they are young enough.
  void keep_previous(Time now) noexcept;
  void describe(const Pending& pending, PathReason reason) noexcept;

  ReplannerOptions options_;
  std::optional<Pilot> pilot_;
  std::unique_ptr<PathRequest> request_ = std::make_unique<PathRequest>();
  std::optional<Pending> pending_;
  SightWatch sight_{options_.silence_limit - options_.replan_period};
  std::optional<WorldPoint> stops_at_;  // without sight
  std::optional<Time> asked_;
  Time heard_{};  // when the last answer came, or the mission started
  std::uint64_t planned_frame_ = 0;
  std::uint64_t next_id_;
  bool silence_said_ = false;
  Plan plan_;
};

}  // namespace lodesman
