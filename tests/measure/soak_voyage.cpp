// SPDX-License-Identifier: Apache-2.0
#include "tests/measure/soak_voyage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hal_sim/scenario/fault_table.h"
#include "mid_level/base/random_stream.h"

namespace lodesman::measure {
namespace {

constexpr double kArena_m = 25.0;  // from the middle to each side
constexpr double kShortest_m = 8.0;
constexpr double kLongest_m = 20.0;
constexpr std::array kSpeeds_m_s{0.22, 0.42, 0.74};
constexpr double kFromGoal_m = 3.0;
constexpr int kTries_max = 200;
// What rests lies as long as so many legs take.
constexpr std::size_t kLegsOfScene = 24;
constexpr std::size_t kResting = 8;
constexpr double kFaulty = 0.5;  // share of legs
constexpr double kMoving = 0.5;
constexpr std::array kDevices{FaultDevice::kAhrs, FaultDevice::kThruster, FaultDevice::kSonar,
                              FaultDevice::kPosition};

[[nodiscard]] double distance_m(const Goal& a, const Goal& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

struct Kind {
  FaultDevice device;
  const FaultRow* row;
};

// Every fault that there is.
[[nodiscard]] std::vector<Kind> all_kinds() {
  std::vector<Kind> kinds;
  for (const auto& rows : {fault_rows(), further_fault_rows()}) {
    for (const FaultRow& row : rows) {
      for (const FaultDevice device : kDevices) {
        if (row.is_of(device)) {
          kinds.push_back({device, &row});
        }
      }
    }
  }
  return kinds;
}

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_{"soak", seed} {}

  void make_legs(std::size_t count, std::vector<SoakLeg>& legs) {
    Goal at;
    for (std::size_t i = 0; i < count; ++i) {
      SoakLeg leg;
      leg.goal = next_goal(at);
      leg.speed_m_s = kSpeeds_m_s[index(kSpeeds_m_s.size())];
      if (random_.uniform() < kFaulty) {
        leg.fault = fault(static_cast<double>(i) * kLeg_s);
      }
      at = leg.goal;
      legs.push_back(leg);
    }
  }

  void add_resting(const std::vector<SoakLeg>& legs, std::vector<MovingObstacle>& obstacles) {
    for (std::size_t first = 0; first < legs.size(); first += kLegsOfScene) {
      const std::size_t last = std::min(first + kLegsOfScene, legs.size());
      for (std::size_t i = 0; i < kResting; ++i) {
        MovingObstacle obstacle = ellipse();
        if (place(legs, first, last, obstacle)) {
          obstacle.appears_at_s = static_cast<double>(first) * kLeg_s;
          obstacle.vanishes_at_s = static_cast<double>(last) * kLeg_s;
          add(obstacle, obstacles);
        }
      }
    }
  }

  // Near the way when the vehicle may be.
  void add_moving(const std::vector<SoakLeg>& legs, std::vector<MovingObstacle>& obstacles) {
    Goal from;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const SoakLeg& leg = legs[i];
      if (random_.uniform() < kMoving) {
        const double begin_s = static_cast<double>(i) * kLeg_s;
        const double share = between(0.3, 0.9);
        const double meets_s = begin_s + share * distance_m(from, leg.goal) / leg.speed_m_s;
        const double speed_m_s = between(0.05, 0.5);
        const double course_rad = between(0.0, 2.0 * std::numbers::pi);
        MovingObstacle obstacle = ellipse();
        obstacle.velocity_x_m_s = speed_m_s * std::sin(course_rad);
        obstacle.velocity_y_m_s = speed_m_s * std::cos(course_rad);
        const Goal meets{from.x_m + share * (leg.goal.x_m - from.x_m) + between(-2.0, 2.0),
                         from.y_m + share * (leg.goal.y_m - from.y_m) + between(-2.0, 2.0)};
        const auto at = [&](double time_s) {
          return Goal{meets.x_m + (time_s - meets_s) * obstacle.velocity_x_m_s,
                      meets.y_m + (time_s - meets_s) * obstacle.velocity_y_m_s};
        };
        const Goal first = at(0.0);  // a course is told from scenario time 0
        obstacle.at_start.centre_x_m = first.x_m;
        obstacle.at_start.centre_y_m = first.y_m;
        obstacle.appears_at_s = begin_s;
        obstacle.vanishes_at_s = begin_s + kLeg_s;
        if (distance_m(at(begin_s), from) > kFromGoal_m + 1.5) {
          add(obstacle, obstacles);
        }
      }
      from = leg.goal;
    }
  }

 private:
  [[nodiscard]] double between(double low, double high) {
    return low + (high - low) * random_.uniform();
  }
  [[nodiscard]] std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(random_.uniform() * static_cast<double>(count));
  }

  [[nodiscard]] Goal next_goal(const Goal& from) {
    Goal goal;
    do {
      goal = {between(-kArena_m, kArena_m), between(-kArena_m, kArena_m)};
    } while (distance_m(goal, from) < kShortest_m || distance_m(goal, from) > kLongest_m);
    return goal;
  }

  [[nodiscard]] Fault fault(double begin_s) {
    const Kind kind = kinds_[index(kinds_.size())];
    Fault fault;
    fault.device = kind.device;
    fault.kind = kind.row->kind;
    fault.at_s = begin_s + between(3.0, 40.0);
    fault.duration_s = between(1.0, 30.0);
    fault.rate = kind.row->rate.otherwise;
    fault.value = kind.row->value.otherwise;
    return fault;
  }

  [[nodiscard]] MovingObstacle ellipse() {
    MovingObstacle obstacle;
    Obstacle& shape = obstacle.at_start;
    shape.semi_axis_first_m = between(0.2, 1.2);
    shape.semi_axis_second_m =
        random_.uniform() < 0.3 ? between(0.2, 1.2) : shape.semi_axis_first_m;
    shape.angle_rad = between(-1.5, 1.5);
    shape.protection_first_m = shape.semi_axis_first_m + 1.5;
    shape.protection_second_m = shape.semi_axis_second_m + 1.5;
    return obstacle;
  }

  // Clear of where the boat waits for its next mission, from the leg before on.
  [[nodiscard]] bool place(const std::vector<SoakLeg>& legs, std::size_t first, std::size_t last,
                           MovingObstacle& obstacle) {
    Obstacle& shape = obstacle.at_start;
    const double size_m = std::max(shape.semi_axis_first_m, shape.semi_axis_second_m);
    for (int attempt = 0; attempt < kTries_max; ++attempt) {
      const Goal at{between(-kArena_m, kArena_m), between(-kArena_m, kArena_m)};
      bool clear = first > 0 || distance_m(at, {}) - size_m >= kFromGoal_m;
      for (std::size_t i = first == 0 ? 0 : first - 1; i < last; ++i) {
        clear = clear && distance_m(at, legs[i].goal) - size_m >= kFromGoal_m;
      }
      if (clear) {
        shape.centre_x_m = at.x_m;
        shape.centre_y_m = at.y_m;
        return true;
      }
    }
    return false;
  }

  static void add(MovingObstacle obstacle, std::vector<MovingObstacle>& obstacles) {
    obstacle.at_start.id = static_cast<std::uint32_t>(obstacles.size() + 1);
    obstacles.push_back(obstacle);
  }

  RandomStream random_;
  std::vector<Kind> kinds_ = all_kinds();
};

[[nodiscard]] std::string base_text(std::uint64_t seed, const SoakLeg& first) {
  return fmt::format(
      "name = \"soak\"\nseed = {}\ntime_limit_s = 1000.0\n[mission]\nstart_m = [0.0, 0.0]\n"
      "start_heading_deg = 0.0\n{}[vehicle]\nspeed_m_s = {:.2f}\nradius_m = 0.5\n"
      "[position]\nsource = \"gps\"\n[sonar]\nscene = \"beams\"\n",
      seed,
      fmt::format("goal_m = [{:.3f}, {:.3f}]\ngoal_radius_m = 0.8\n", first.goal.x_m,
                  first.goal.y_m),
      first.speed_m_s);
}

}  // namespace

SoakVoyage make_soak_voyage(std::uint64_t seed, std::size_t legs, const SpeedTable& speeds) {
  std::vector<SoakLeg> made;
  Generator generator{seed};
  generator.make_legs(legs, made);
  SoakVoyage voyage{
      read_scenario(TomlDocument::from_text(base_text(seed, made.front()), "soak"), speeds),
      std::move(made)};
  generator.add_resting(voyage.legs, voyage.scenario.obstacles);
  generator.add_moving(voyage.legs, voyage.scenario.obstacles);
  for (const SoakLeg& leg : voyage.legs) {
    if (leg.fault) {
      voyage.scenario.faults.push_back(*leg.fault);
    }
  }
  return voyage;
}

std::string mission_text(const SoakLeg& leg) {
  return fmt::format("goal_m = [{:.3f}, {:.3f}]\ngoal_radius_m = 0.8\nspeed_m_s = {:.2f}\n",
                     leg.goal.x_m, leg.goal.y_m, leg.speed_m_s);
}

}  // namespace lodesman::measure
