// SPDX-License-Identifier: Apache-2.0
// What turns tracks into a way: asks for a path in the world round zones of our own making, keeps
// to the sides once taken, chooses the manoeuvre, and says why. Between its request and the answer
// the paper's loop (replanner.h) is what it always was. Plain values; one thread; it allocates when
// made and never after.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "high_level/guidance/line.h"
#include "high_level/guidance/manoeuvre.h"
#include "high_level/guidance/sight_speed.h"
#include "high_level/guidance/zones.h"
#include "mid_level/messages/command.h"
#include "mid_level/messages/coverage.h"
#include "mid_level/messages/mission.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

struct PilotOptions {
  ZoneOptions zones;
  VehicleResponse response;
  ManoeuvreOptions manoeuvres;
  SightSpeedOptions sight;
  double look_ahead_s = 0.0;        // [s] of the response's look-ahead, what comes with speed
  double side_gain_m = 0.0;         // [m] what another side must save
  double narrow_speed_share = 0.0;  // [-] (0, 1] in water that is too narrow for full zones
  Duration latency{};               // from a request to thrust that follows its plan
};

// What is made for.
struct Destination {
  WorldPoint goal;
  bool stay = false;       // a place to wait at, not one to arrive at
  std::optional<Leg> leg;  // that ends there and whose line is to be kept
  bool slowly = false;     // for the water is not known as it should be
};

class Pilot {
 public:
  explicit Pilot(const PilotOptions& options);

  // A mission starts: nothing is kept to.
  void start() noexcept;
  // Sails at that speed from here on, where nothing is in the way.
  void sail_at(const Cruise& cruise) noexcept;
  // After start(), of a mission that goes on: keeps to the sides that `last` was asked for by the
  // pilot that was here before.
  void keep_sides_of(const PathRequest& last) noexcept;
  // [-] of the mission's speed, what the vessel does at most.
  [[nodiscard]] double most_share() const noexcept { return chooser_.most_share(); }
  // Takes on what an operator changed.
  void tune(const Tunables& tunables) noexcept;

  // Fills in space, start, goal, zones and sides of a request.
  void ask(Time now, const Tracks& tracks, const VehicleState& state,
           const Destination& destination, PathRequest& request) noexcept;

  // The plan made of the answer to the last request; fills in what the pilot decides. water: what
  // was seen of it; null: all of it is known.
  void decide(Time now, const SonarPath& path, const Tracks& tracks, const Coverage* water,
              const VehicleState& state, Plan& plan) noexcept;

 private:
  static constexpr double kSlightly_m = 0.4;  // no deeper in a zone: beside the path, not astray
  static constexpr double kDrifted_m = 2.5;   // so far from a place to wait at is there no more

  enum class Side : std::uint8_t { kNone, kPort, kStarboard };
  struct KeptSide {
    std::uint32_t track = 0;
    Side side = Side::kNone;
  };

  struct KeptLine {
    Leg leg;
    LineToKeep line;
    bool rejoins = false;  // it is gone back to before its end
  };

  [[nodiscard]] OwnMotion when_it_takes_effect(Time now, const VehicleState& state) const noexcept;
  void ask_for_sides(PathRequest& request) const noexcept;
  void keep_line(const Destination& destination, bool start_is_free,
                 const PathRequest& request) noexcept;
  [[nodiscard]] Eigen::Vector2d end_of_ask(const Destination& destination,
                                           const Eigen::Vector2d& start,
                                           PathRequest& request) noexcept;
  void remember_sides(const Route& route) noexcept;
  // Gives the reason that is true of the route.
  [[nodiscard]] PathReason take_route(const SonarPath& path) noexcept;
  [[nodiscard]] PathReason make_for_the_end_of_the_line(PathReason reason) noexcept;
  void make_route(const SonarPath& path) noexcept;
  void wait_here(const Eigen::Vector2d& place) noexcept;
  [[nodiscard]] bool asks_for_best() noexcept;
  [[nodiscard]] bool keeps_best(const SonarPath& path) noexcept;
  // [m] of a way ahead; infinity: as much as the mission's speed needs.
  [[nodiscard]] double seen_along(const Coverage* water, const Route& way,
                                  RoutePlace from) const noexcept;
  [[nodiscard]] double share_by_sight(double seen_m) const noexcept;
  void explain(PathReason reason, const SonarPath& path, const ManoeuvreChooser::Choice& choice,
               Plan& plan) const noexcept;

  PilotOptions options_;
  double look_ahead_at_rest_m_;
  ManoeuvreChooser chooser_;
  // Of the request that is out.
  std::unique_ptr<PathRequest> asked_ = std::make_unique<PathRequest>();
  bool escaping_ = false;
  bool goal_moved_ = false;
  bool goal_is_close_ = false;  // to something: zones gave what it needs
  bool asked_for_best_ = false;
  bool stay_ = false;
  bool slowly_ = false;
  std::optional<KeptLine> line_;  // that is kept to
  LineToKeep last_line_;          // on this leg
  int free_asks_ = 0;             // to come, as the line could not be gone back to
  bool holding_ = false;          // in the last plan
  Eigen::Vector2d own_W_ = Eigen::Vector2d::Zero();
  Route route_;
  bool stay_at_end_ = false;      // the route's end is a place to wait at
  bool route_is_narrow_ = false;  // zones had to give what they may
  // Where nothing leads to the goal: the point that is made for instead, until another is better.
  std::optional<Eigen::Vector2d> best_;
  Eigen::Vector2d best_for_W_ = Eigen::Vector2d::Zero();  // the goal it stands for
  int asks_for_best_ = 0;                                 // since the goal itself was asked for
  std::array<KeptSide, kMaxObstacles> sides_{};
  std::size_t side_count_ = 0;
};

}  // namespace lodesman
