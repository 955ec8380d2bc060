// SPDX-License-Identifier: Apache-2.0
// Each program killed and started again, or frozen and thawed, at random moments under way, with
// the real drivers against a bench whose devices are emulated to the byte, and fixes of 1 m. How
// soon the propellers stand still (at the box's output), how soon the boat is under control again,
// how far the estimate jumps against the truth, and what became of the mission. Prints a table;
// status 1 where propellers turn for longer than their bound, the estimate jumps by more than its
// own, or the mission did not go on. How soon control is back is told beside its aim, and not
// judged: other programs delay it.
//   measure_warm_restarts [TIMES [maestro|roboclaw]]
// TIMES: of each kill; of each freezing half as often.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <random>

#include "tests/system/benched_boat.h"

namespace lodesman::measure {
namespace {

using namespace lodesman::testing;
using Vec = Eigen::Vector2d;

// As lodesman run pauses after a first failure.
constexpr Duration kPause = milliseconds{100};
// After control is back, for what comes late.
constexpr Duration kAfterwards = milliseconds{500};

// Who is not under control after this is asked why.
constexpr Duration kSlow = milliseconds{800};

struct Bounds {
  double neutral_s = 0.0;
  double control_s = 0.0;
  double jump_m = 0.0;
};
constexpr Bounds kHigh{0.5, 2.0, 0.05};
constexpr Bounds kHighFrozen{0.5, 2.0, 0.2};  // for up to three seconds
constexpr Bounds kLow{0.9, 5.0, 0.5};
constexpr Bounds kNothing{0.0, 0.0, 0.05};

// One kill or freezing.
struct Event {
  double neutral_s = 0.0;  // 0: control was back before they had to stand still
  double control_s = 0.0;
  double odometry_jump_m = 0.0;
  double world_jump_m = 0.0;
  MissionState mission = MissionState::kIdle;
};

struct Row {
  std::string what;
  Bounds bounds;
  std::vector<Event> events;

  [[nodiscard]] bool keeps_its_bounds() const {
    return std::all_of(events.begin(), events.end(), [this](const Event& e) {
      return e.neutral_s <= bounds.neutral_s && e.odometry_jump_m <= bounds.jump_m &&
             e.mission == MissionState::kUnderWay;
    });
  }
};

// Median, p99 and worst.
[[nodiscard]] std::string spread(const std::vector<Event>& events, double Event::*what) {
  std::vector<double> sorted;
  for (const Event& event : events) {
    sorted.push_back(event.*what);
  }
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return n == 0 ? "-"
                : fmt::format("{:.2f} {:.2f} {:.2f}", sorted[n / 2],
                              sorted[std::min(n - 1, n * 99 / 100)], sorted[n - 1]);
}

void print(const std::vector<Row>& rows) {
  fmt::print(
      "| what happened | times | neutral s, p50 p99 worst | bound | control s | aim | odometry "
      "jump m | bound | world jump m | mission went on |\n|---|---|---|---|---|---|---|---|---|---|"
      "\n");
  for (const Row& row : rows) {
    const auto went_on = std::count_if(row.events.begin(), row.events.end(), [](const Event& e) {
      return e.mission == MissionState::kUnderWay;
    });
    fmt::print("| {} | {} | {} | {:.1f} | {} | {:.1f} | {} | {:.2f} | {} | {} |\n", row.what,
               row.events.size(), spread(row.events, &Event::neutral_s), row.bounds.neutral_s,
               spread(row.events, &Event::control_s), row.bounds.control_s,
               spread(row.events, &Event::odometry_jump_m), row.bounds.jump_m,
               spread(row.events, &Event::world_jump_m), went_on);
  }
  std::fflush(stdout);
}

// Where the boat was and where it was thought to be, of the last seconds.
class Trail {
 public:
  Trail(const SharedBlackboard& boat, const SharedBlackboard& world)
      : truth_{world->world_truth}, states_{boat->vehicle_state}, thrust_{boat->thrust_applied} {}

  void look() {
    while (const auto* truth = truth_.next()) {
      truths_.push_back(*truth);
    }
    while (const auto* state = states_.next()) {
      estimates_.push_back(state->value);
    }
    while (const auto* thrust = thrust_.next()) {
      applied_.push_back(*thrust);
    }
    forget(truths_);
    forget(estimates_);
    forget(applied_);
  }
  // When the propellers first stood still after that; 0: they did not.
  [[nodiscard]] Time still_since(Time event) const {
    const auto* found = first(truths_, [event](const Stamped<WorldTruth>& one) {
      return one.stamp >= event && is_neutral(one.value.thrust_left) &&
             is_neutral(one.value.thrust_right);
    });
    return found != nullptr ? found->stamp : Time{};
  }
  // When thrust was first applied by a command that was given after that; 0: not yet.
  [[nodiscard]] Time control_since(Time event, bool by_new_helm) const {
    const auto* found = first(applied_, [=](const Stamped<ThrustApplied>& one) {
      return (by_new_helm ? one.value.command_stamp : one.stamp) > event &&
             one.value.reason == ThrustReason::kCommanded && one.value.surge_ref > 0;
    });
    return found != nullptr ? found->stamp : Time{};
  }
  // How far a pose and the truth went apart at most from one estimate to the next, since then.
  [[nodiscard]] double jump_m(Time since, double VehicleState::*x, double VehicleState::*y) const {
    double most_m = 0.0;
    const VehicleState* before = nullptr;
    for (const VehicleState& state : estimates_) {
      if (before != nullptr && before->valid_at >= since && has_truth(before->valid_at) &&
          has_truth(state.valid_at)) {
        const Vec gone = Vec{state.*x, state.*y} - Vec{before->*x, before->*y};
        most_m = std::max(most_m, (gone - at(state.valid_at) + at(before->valid_at)).norm());
      }
      before = &state;
    }
    return most_m;
  }

 private:
  template <class T>
  static void forget(std::deque<T>& values) {
    constexpr std::size_t kKept = 1500;
    while (values.size() > kKept) {
      values.pop_front();
    }
  }
  template <class T, class Holds>
  static const T* first(const std::deque<T>& values, Holds holds) {
    const auto found = std::find_if(values.begin(), values.end(), holds);
    return found == values.end() ? nullptr : &*found;
  }
  [[nodiscard]] static bool is_neutral(std::uint8_t thrust) {
    return thrust == 127 || thrust == 128;
  }
  [[nodiscard]] bool has_truth(Time then) const {
    return !truths_.empty() && truths_.front().stamp < then && truths_.back().stamp >= then;
  }
  // The truth then, between two of its steps.
  [[nodiscard]] Vec at(Time then) const {
    const auto after = std::lower_bound(
        truths_.begin(), truths_.end(), then,
        [](const Stamped<WorldTruth>& one, Time time) { return one.stamp < time; });
    const auto before = std::prev(after);
    const double share =
        to_seconds(then - before->stamp) / to_seconds(after->stamp - before->stamp);
    return Vec{before->value.x_m, before->value.y_m} +
           share * Vec{after->value.x_m - before->value.x_m, after->value.y_m - before->value.y_m};
  }

  Reader<WorldTruth> truth_;
  Reader<VehicleState> states_;
  Reader<ThrustApplied> thrust_;
  std::deque<Stamped<WorldTruth>> truths_;
  std::deque<VehicleState> estimates_;
  std::deque<Stamped<ThrustApplied>> applied_;
};

class Campaign {
 public:
  Campaign(int times, const std::string& box)
      : times_{times}, boat_{box, {"--start", "--arm"}, Benched::kAll} {
    fmt::print("seed {}, {}\n", seed_, box);
  }

  [[nodiscard]] int run() {
    undisturbed("nothing, for comparison", kNothing);
    killed("lodesman-high killed", kHigh, &BenchedBoat::high, &BenchedBoat::start_high);
    killed("lodesman-low killed", kLow, &BenchedBoat::low, &BenchedBoat::start_low);
    frozen("lodesman-high frozen", kHighFrozen, &BenchedBoat::high);
    frozen("lodesman-low frozen", kLow, &BenchedBoat::low);
    print(rows_);
    return std::all_of(rows_.begin(), rows_.end(),
                       [](const Row& row) { return row.keeps_its_bounds(); })
               ? EXIT_SUCCESS
               : EXIT_FAILURE;
  }

 private:
  using Process = std::unique_ptr<ChildProcess> BenchedBoat::*;

  // Under way, with an estimate that has settled, and at a random moment of it.
  void await_moment() {
    const Duration settled = seconds{2} + milliseconds{random_() % 1000};
    boat_.await_drive();
    const Time until = clock_.now() + settled;
    while (clock_.now() < until) {
      pass();
    }
  }
  void pass() {
    trail_.look();
    std::this_thread::sleep_for(milliseconds{2});
  }
  // What came of it; `recovers_from`: control counts from then on, where that is later.
  [[nodiscard]] Event outcome(Time event, Time recovers_from, bool of_high) {
    Time control{};
    bool explained = false;
    require(eventually([&] {
              trail_.look();
              if (!explained && clock_.now() > std::max(event, recovers_from) + kSlow) {
                explained = true;
                explain();
              }
              control = trail_.control_since(std::max(event, recovers_from), of_high);
              return control != Time{};
            }),
            "the boat is not under control again");
    while (clock_.now() < control + kAfterwards) {
      pass();
    }
    Event result = seen_since(event - milliseconds{200});
    const Time still = trail_.still_since(event);
    result.neutral_s = still != Time{} && still < control ? to_seconds(still - event) : 0.0;
    result.control_s = to_seconds(control - std::max(event, recovers_from));
    return result;
  }
  // What the boat says while it takes its time.
  void explain() {
    const auto* plan = plan_.latest();
    const auto* state = state_.latest();
    const auto* mission = mission_.latest();
    fmt::print(stderr, "\nslow: helm {}, plan {} {}, mission {}, estimate {} ms old\n",
               to_string(await_first(helm_).value.reason),
               plan != nullptr ? to_string(plan->value.rung) : "-",
               plan != nullptr ? to_string(plan->value.reason) : "-",
               mission != nullptr ? to_string(mission->value.state) : "-",
               state != nullptr ? (clock_.now() - state->stamp) / milliseconds{1} : -1);
  }
  void note(const Event& event) {
    rows_.back().events.push_back(event);
    fmt::print(stderr, "\r{}: {}   ", rows_.back().what, rows_.back().events.size());
  }

  // The world pose moves by a step with each fix that comes, without anybody's death.
  void undisturbed(const char* what, const Bounds& bounds) {
    rows_.push_back({what, bounds, {}});
    for (int i = 0; i < times_; ++i) {
      await_moment();
      note(seen_since(clock_.now() - seconds{1}));
    }
  }
  [[nodiscard]] Event seen_since(Time from) {
    Event event;
    event.odometry_jump_m =
        trail_.jump_m(from, &VehicleState::odometry_x_m, &VehicleState::odometry_y_m);
    event.world_jump_m = trail_.jump_m(from, &VehicleState::x_m, &VehicleState::y_m);
    event.mission = await_first(mission_).value.state;
    return event;
  }

  void killed(const char* what, const Bounds& bounds, Process which, void (BenchedBoat::*start)()) {
    rows_.push_back({what, bounds, {}});
    for (int i = 0; i < times_; ++i) {
      await_moment();
      const Time event = clock_.now();
      require(kill((boat_.*which)->pid(), SIGKILL) == 0, "no such process");
      while (clock_.now() < event + kPause || !(boat_.*which)->ended()) {
        pass();
      }
      (boat_.*start)();
      note(outcome(event, event, which == &BenchedBoat::high));
    }
  }
  void frozen(const char* what, const Bounds& bounds, Process which) {
    rows_.push_back({what, bounds, {}});
    for (int i = 0; i < (times_ + 1) / 2; ++i) {
      await_moment();
      const Time event = clock_.now();
      require(kill((boat_.*which)->pid(), SIGSTOP) == 0, "no such process");
      const Time thaws = event + seconds{1} + milliseconds{random_() % 2000};
      while (clock_.now() < thaws) {
        pass();
      }
      require(kill((boat_.*which)->pid(), SIGCONT) == 0, "no such process");
      note(outcome(event, thaws, which == &BenchedBoat::high));
    }
  }

  int times_;
  unsigned seed_ = static_cast<unsigned>(SteadyClock{}.now().time_since_epoch().count());
  std::mt19937 random_{seed_};
  SteadyClock clock_;
  BenchedBoat boat_;
  SharedBlackboard board_ = SharedBlackboard::observe(boat_.segment(), kPatience);
  SharedBlackboard world_ = SharedBlackboard::observe(world_segment_of(boat_.segment()), kPatience);
  Trail trail_{board_, world_};
  Reader<MissionStatus> mission_{board_->mission_status};
  Reader<HelmCommand> helm_{board_->helm_command};
  Reader<Plan> plan_{board_->plan};
  Reader<VehicleState> state_{board_->vehicle_state};
  std::vector<Row> rows_;
};

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  const int times = argc > 1 ? std::atoi(argv[1]) : 50;
  try {
    return lodesman::measure::Campaign{times, argc > 2 ? argv[2] : "maestro"}.run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_warm_restarts: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
