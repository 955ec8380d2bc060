// SPDX-License-Identifier: Apache-2.0
// Each program killed and frozen at random moments under way, and both killed and started again by
// many at once: how soon the propellers stand still, measured at the box's output, and whether
// anything is left or has two owners. Prints a table; status 1 where a bound is broken.
//   measure_restarts [TIMES [UNCLEAN_RESTARTS]]
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "hal_sim/world/sim_link.h"
#include "tests/measure/kill_table.h"
#include "tests/system/boat.h"

namespace lodesman::measure {
namespace {

using namespace lodesman::testing;

constexpr double kStop_s = 0.5;

void require(bool holds, const std::string& what) {
  if (!holds) {
    throw std::runtime_error(what);
  }
}

// Far enough for hours.
std::string long_voyage() { return scenario_text(1900.0, 10'000.0); }

// The box's output, as the simulated world feels it.
class Propellers {
 public:
  explicit Propellers(const SharedBlackboard& board)
      : truth_{board->world_truth}, thrust_{board->thrust_applied} {}

  void await_drive(Time since = Time{}) {
    require(eventually([&] {
              const auto* truth = truth_.latest();
              return is_ahead(truth) && truth->stamp > since;
            }),
            "the boat does not sail");
  }
  // How long after `event` they stand still: as the world feels it, or, where the world ends first,
  // as the box was told.
  [[nodiscard]] double still_after_s(Time event) {
    Time at{};
    const auto is_still = [&] {
      while (const auto* truth = truth_.next()) {
        if (truth->stamp >= event &&
            is_neutral(truth->value.thrust_left, truth->value.thrust_right)) {
          at = truth->stamp;
          return true;
        }
      }
      const auto* told = thrust_.latest();
      const bool box_knows = told != nullptr && told->stamp >= event &&
                             told->value.reason != ThrustReason::kDeviceFailed &&
                             is_neutral(told->value.left, told->value.right);
      at = box_knows ? told->stamp : Time{};
      return box_knows;
    };
    require(eventually(is_still), "the propellers go on");
    return to_seconds(at - event);
  }
  // By the box's own time-out, where nothing can be seen because the simulated world died or stands
  // still with its low level.
  [[nodiscard]] double timed_out_after_s(Time event) {
    return to_seconds(await_first(thrust_).stamp + kBoxTimeOut - event);
  }
  // The last word of a world that is dead or frozen.
  [[nodiscard]] std::uint64_t last_seen() {
    while (truth_.next() != nullptr) {
    }
    return truth_.newest_sequence();
  }
  // What the next world, or the same one thawed, begins with.
  void require_still_after(std::uint64_t seen) {
    const Stamped<WorldTruth>* next = nullptr;
    require(eventually([&] {
              next = truth_.next();
              return next != nullptr && next->sequence > seen;
            }),
            "no world comes back");
    require(is_neutral(next->value.thrust_left, next->value.thrust_right),
            "the propellers still turn");
  }

 private:
  [[nodiscard]] static bool is_neutral(std::uint8_t left, std::uint8_t right) {
    return (left == 127 || left == 128) && (right == 127 || right == 128);
  }
  [[nodiscard]] static bool is_ahead(const Stamped<WorldTruth>* truth) {
    return truth != nullptr && truth->value.thrust_left > 128 && truth->value.thrust_right > 128;
  }

  Reader<WorldTruth> truth_;
  Reader<ThrustApplied> thrust_;
};

class Campaign {
 public:
  Campaign(int times, int restarts) : times_{times}, restarts_{restarts} {
    fmt::print("seed {}\n", seed_);
  }

  [[nodiscard]] int run() {
    high();
    low();
    launcher_killed();
    launcher_frozen();
    unclean_restarts();
    table_.print();
    require(!anything_left(), "a segment is left in /dev/shm");
    fmt::print("nothing was left in /dev/shm, and no segment had two owners\n");
    return table_.keeps_all_bounds() ? EXIT_SUCCESS : EXIT_FAILURE;
  }

 private:
  void high();
  void low();
  void launcher_killed();
  void launcher_frozen();
  void unclean_restarts();

  void wait_a_random_while() { std::this_thread::sleep_for(milliseconds{random_() % 500}); }
  static void signal(pid_t process, int number) {
    require(kill(process, number) == 0, "no such process");
  }
  static void kill_now(ChildProcess& child) {
    signal(child.pid(), SIGKILL);
    require(eventually([&] { return child.ended().has_value(); }), child.name() + " lives on");
  }
  static std::vector<std::string> launch(const Scratch& scratch) {
    return {"sim",     scratch.file("far.toml", long_voyage()).string(),
            "--out",   scratch.file("run").string(),
            "--quiet", "--no-images",
            "--set",   "command_socket.port=0"};
  }
  [[nodiscard]] bool anything_left() const {
    const std::string own = std::to_string(getpid());
    for (const auto& entry : fs::directory_iterator{"/dev/shm"}) {
      const std::string name = entry.path().filename().string();
      if (name == "lodesman-test-boat-" + own ||
          std::find(launched_.begin(), launched_.end(), name) != launched_.end()) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] SharedBlackboard board_of(const ChildProcess& launcher) {
    launched_.push_back("lodesman-sim-" + std::to_string(launcher.pid()));
    return SharedBlackboard::observe(launched_.back(), kPatience);
  }

  int times_;
  int restarts_;
  unsigned seed_ = static_cast<unsigned>(SteadyClock{}.now().time_since_epoch().count());
  std::mt19937 random_{seed_};
  std::vector<std::string> launched_;
  KillTable table_;
};

void Campaign::high() {
  const Scratch scratch{"measure-high"};
  Boat boat{scratch, "default", long_voyage()};
  const auto board = SharedBlackboard::observe(boat.segment, kPatience);
  Propellers propellers{board};
  const SteadyClock clock;
  table_.begin("lodesman-high killed", "neutral", kStop_s);
  for (int i = 0; i < times_; ++i) {
    propellers.await_drive();
    wait_a_random_while();
    const Time event = clock.now();
    signal(boat.high->pid(), SIGKILL);
    table_.add(propellers.still_after_s(event));
    kill_now(*boat.high);
    boat.start_high();
  }
  table_.begin("lodesman-high frozen", "neutral", kStop_s);
  for (int i = 0; i < times_; ++i) {
    propellers.await_drive();
    wait_a_random_while();
    const Time event = clock.now();
    signal(boat.high->pid(), SIGSTOP);
    table_.add(propellers.still_after_s(event));
    wait_a_random_while();
    signal(boat.high->pid(), SIGCONT);
  }
}

void Campaign::low() {
  const Scratch scratch{"measure-low"};
  Boat boat{scratch, "default", long_voyage()};
  const auto board = SharedBlackboard::observe(boat.segment, kPatience);
  Propellers propellers{board};
  const SteadyClock clock;
  table_.begin("lodesman-low killed", "the box's own time-out", to_seconds(kBoxTimeOut));
  for (int i = 0; i < times_; ++i) {
    propellers.await_drive();
    wait_a_random_while();
    kill_now(*boat.low);
    const Time event = clock.now();  // a command may still come before the signal does
    table_.add(propellers.timed_out_after_s(event));
    std::this_thread::sleep_for(kBoxTimeOut + milliseconds{20});
    const std::uint64_t seen = propellers.last_seen();
    boat.start_low();
    propellers.require_still_after(seen);
  }
  table_.begin("lodesman-low frozen", "the box's own time-out", to_seconds(kBoxTimeOut));
  for (int i = 0; i < times_; ++i) {
    propellers.await_drive();
    wait_a_random_while();
    signal(boat.low->pid(), SIGSTOP);
    siginfo_t stopped{};
    require(waitid(P_PID, static_cast<id_t>(boat.low->pid()), &stopped, WSTOPPED) == 0,
            "lodesman-low is not stopped");
    const Time event = clock.now();
    std::this_thread::sleep_for(kBoxTimeOut + milliseconds{20});
    table_.add(propellers.timed_out_after_s(event));
    const std::uint64_t seen = propellers.last_seen();
    signal(boat.low->pid(), SIGCONT);
    propellers.require_still_after(seen);
  }
  require(!boat.high->ended(), "lodesman-high did not outlive its low level");
}

void Campaign::launcher_killed() {
  const SteadyClock clock;
  std::vector<double> gone_s;
  table_.begin("the launcher killed", "neutral", kStop_s);
  for (int i = 0; i < times_; ++i) {
    const Scratch scratch{"measure-launcher"};
    ChildProcess launcher{"lodesman", launch(scratch)};
    const auto board = board_of(launcher);
    Propellers propellers{board};
    propellers.await_drive();
    wait_a_random_while();
    const Time event = clock.now();
    signal(launcher.pid(), SIGKILL);
    table_.add(propellers.still_after_s(event));
    require(eventually([&] { return !board.alive(Role::kLow) && !board.alive(Role::kHigh); }),
            "a process outlives its launcher");
    gone_s.push_back(to_seconds(clock.now() - event));
  }
  table_.begin("the launcher killed", "both processes are gone", std::nullopt);
  for (const double seconds : gone_s) {
    table_.add(seconds);
  }
}

void Campaign::launcher_frozen() {
  const Scratch scratch{"measure-frozen"};
  ChildProcess launcher{"lodesman", launch(scratch)};
  const auto board = board_of(launcher);
  Propellers propellers{board};
  const SteadyClock clock;
  table_.begin("the launcher frozen", "neutral", kStop_s);
  for (int i = 0; i < times_; ++i) {
    propellers.await_drive();
    wait_a_random_while();
    const Time event = clock.now();
    signal(launcher.pid(), SIGSTOP);
    table_.add(propellers.still_after_s(event));
    wait_a_random_while();
    signal(launcher.pid(), SIGCONT);
  }
}

// Both dead at once, and three low and two high levels started at once: one of each may stay.
void Campaign::unclean_restarts() {
  const Scratch scratch{"measure-unclean"};
  Boat boat{scratch, "default", long_voyage()};
  const SteadyClock clock;
  table_.begin("both killed, five started at once", "the boat sails on", std::nullopt);
  for (int i = 0; i < restarts_; ++i) {
    const auto board = SharedBlackboard::observe(boat.segment, kPatience);
    Propellers propellers{board};
    propellers.await_drive();
    wait_a_random_while();
    signal(boat.low->pid(), SIGKILL);
    signal(boat.high->pid(), SIGKILL);
    kill_now(*boat.low);
    kill_now(*boat.high);
    const Time event = clock.now();
    std::vector<std::unique_ptr<ChildProcess>> lows;
    std::vector<std::unique_ptr<ChildProcess>> highs;
    const auto start = [](auto& started, auto& one, auto begin) {
      begin();
      started.push_back(std::move(one));
    };
    for (int n = 0; n < 3; ++n) {
      start(lows, boat.low, [&] { boat.start_low(); });
    }
    for (int n = 0; n < 2; ++n) {
      start(highs, boat.high, [&] { boat.start_high(); });
    }
    const auto leave_one = [](auto& started) {
      std::size_t refused = 0;
      require(eventually([&] {
                refused = static_cast<std::size_t>(std::count_if(
                    started.begin(), started.end(), [](auto& one) { return one->ended(); }));
                return refused + 1 >= started.size();
              }),
              "a segment has two owners");
      require(refused + 1 == started.size(), "a segment has no owner");
      return std::move(
          *std::find_if(started.begin(), started.end(), [](auto& one) { return !one->ended(); }));
    };
    propellers.await_drive(event);
    table_.add(to_seconds(clock.now() - event));
    boat.low = leave_one(lows);
    boat.high = leave_one(highs);
  }
}

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  const int times = argc > 1 ? std::atoi(argv[1]) : 200;
  const int restarts = argc > 2 ? std::atoi(argv[2]) : times / 2;
  try {
    return lodesman::measure::Campaign{times, restarts}.run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_restarts: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
