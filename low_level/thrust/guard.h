// SPDX-License-Identifier: Apache-2.0
// The guard: an independent last resort that looks only at what the sonar shows and at how the
// thrust applied moves the boat. Where what is asked for would end, stopped as hard as can be,
// within a margin of something that was seen, it stops at once: full thrust against the way made,
// then neutral for as long as what is asked for would close in. It also takes the way off a boat
// that nobody steers. What rests is never touched as far as detections, speed and the thrust astern
// are what they are taken for. For what is seen to move, under a name of its own, it stops where
// that is met both by going on and by stopping: who finds a way past is left to it.
//
// It never acts on what one ping alone shows, never cuts what opens the distance, and never turns a
// propeller that nobody has armed, or after an abort. Without a sonar frame that is new enough it
// knows nothing and cuts nothing: no sonar is not free water, but that is for who plans to judge.
// Pure; part of the thruster task and so of its thread: no allocation, bounded work.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "low_level/thrust/edge_points.h"
#include "low_level/thrust/own_motion.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/guard.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

struct GuardOptions {
  bool is_on = false;
  double margin_m = 0.0;            // [m] >= 0 kept between the hull and what was seen
  double release_m = 0.0;           // [m] >= 0 beyond the margin before a stopped boat may close in
  Duration reaction{};              // [0, 2 s] from a command to the thrust that obeys it
  Duration brake_delay{};           // [0, 10 s] that the box takes to reverse its thrust
  Duration silence_neutral{};       // of a silent high level: at neutral before it brakes
  Duration brake_max{};             // no braking takes longer
  Duration frame_age_max{};         // older sonar frames tell nothing
  double hull_half_length_m = 0.0;  // [m] > 0
  double hull_half_beam_m = 0.0;    // [m] > 0
  HullResponse hull{};
};

// What there is to know at a step besides what is asked for.
struct GuardView {
  bool may_turn = false;       // the thrusters are armed, and no abort stands
  bool is_overridden = false;  // by the word of a stick
  bool is_silent = false;      // nobody steers: no command is heard, or none knows how to
};

class Guard {
 public:
  explicit Guard(const GuardOptions& options) noexcept : options_{options}, model_{options.hull} {}

  // Once a step, in this order: how far the boat has come, each new sonar frame, what is done about
  // what is asked for, and what the box has taken in the end.
  // `attitude`: the newest that is fresh, or nullptr.
  void advance(Time now, const Attitude* attitude) noexcept;
  void see(const SonarObstacles& seen) noexcept;
  // What is to be applied instead; nothing where that is what is asked for.
  [[nodiscard]] std::optional<SurgeAndHead> judge(const SurgeAndHead& asked, const GuardView& view,
                                                  Time now) noexcept;
  void applied(const SurgeAndHead& thrust, Time now) noexcept;

  [[nodiscard]] const GuardStatus& status() const noexcept { return status_; }

 private:
  static constexpr std::size_t kFrames = 3;  // two of them must agree
  static constexpr std::size_t kMaxWay = 160;
  static constexpr std::size_t kMaxPast = 128;

  // What is seen under a name of its own, and how it moves; in the frame of the reckoning.
  struct Thing {
    std::uint32_t id = 0;
    double x_m = 0.0;
    double y_m = 0.0;
    double x_m_s = 0.0;
    double y_m_s = 0.0;
    bool moves = false;
  };
  struct Frame {
    Time captured{};
    std::size_t count = 0;
    std::array<EdgePoint, EdgePoints::kMaxPoints> points{};  // in the frame of the reckoning
    std::array<Thing, kMaxObstacles> things{};
  };
  struct Spot {
    double x_m = 0.0;
    double y_m = 0.0;
  };
  struct Past {
    Time at{};
    ReckonedMotion motion{};
  };
  // The hull on its way: a place and the direction of its bow.
  struct Place {
    double x_m = 0.0;
    double y_m = 0.0;
    double sine = 0.0;
    double cosine = 1.0;
    double after_s = 0.0;
  };
  // What would be sailed.
  struct Way {
    std::array<Place, kMaxWay> places{};
    std::size_t count = 0;
    double reach_m = 0.0;  // no part of the hull comes farther from where it is now
  };

  [[nodiscard]] ReckonedMotion motion_at(Time at) const noexcept;
  [[nodiscard]] double sight_m() const noexcept;
  [[nodiscard]] Thing watched(Thing thing, Time captured) const noexcept;
  void begin(Way& way, ReckonedMotion& at) const noexcept;
  void add(Way& way, const ReckonedMotion& at) const noexcept;
  void sail(Way& way, ReckonedMotion& at, const SurgeAndHead& thrust, double for_s) const noexcept;
  void foresee(const SurgeAndHead& asked, Duration for_so_long, Way& way) const noexcept;
  void foresee_on(const SurgeAndHead& asked) noexcept;
  [[nodiscard]] double hull_distance_m(const Place& place, const Spot& spot) const noexcept;
  [[nodiscard]] bool is_within(double reach_m, const Spot& spot) const noexcept;
  [[nodiscard]] bool comes_near(const Way& way, const Thing& thing, const Spot& spot,
                                double too_near_m) const noexcept;
  [[nodiscard]] bool meets(const Thing& thing, const Spot& spot, double too_near_m) const noexcept;
  // [m] to what is nearest, by one frame; nothing where it shows nothing that is in the way.
  [[nodiscard]] std::optional<double> in_the_way_m(const Frame& frame) const noexcept;
  // The same by two of the last three; of those that are new enough where `fresh_only`.
  [[nodiscard]] std::optional<double> confirmed_m(bool fresh_only, Time now) const noexcept;
  [[nodiscard]] bool sees(Time now) const noexcept;
  [[nodiscard]] bool is_stopping() const noexcept;
  [[nodiscard]] GuardState next_state(const SurgeAndHead& asked, const GuardView& view,
                                      Time now) noexcept;
  [[nodiscard]] GuardState on_guard(const SurgeAndHead& asked, const GuardView& view,
                                    Time now) noexcept;
  [[nodiscard]] GuardState go_on_stopping(bool is_needed, Time now) const noexcept;
  void trip(GuardReason reason, double distance_m, Time now) noexcept;
  [[nodiscard]] double sense() const noexcept;
  [[nodiscard]] SurgeAndHead brake() const noexcept;

  GuardOptions options_;
  ReckoningModel model_;
  GuardStatus status_;
  ReckonedMotion motion_{};
  Time moved_to_{};
  std::optional<double> measured_rad_;  // the last heading
  SurgeAndHead thrust_{};
  Time thrust_acts_{};   // not before: the box reverses
  Time silent_since_{};  // 0: it is not
  std::array<Past, kMaxPast> past_{};
  std::size_t past_count_ = 0;  // ever added
  std::array<Frame, kFrames> frames_{};
  std::size_t frame_count_ = 0;  // ever seen
  EdgePoints edges_;
  Way soon_;   // of what is asked for until the next command acts
  Way later_;  // and if it goes on
  Way on_;     // and if nothing stops it, for as long as that takes
};

}  // namespace lodesman
