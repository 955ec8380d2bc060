// SPDX-License-Identifier: Apache-2.0
// The real drivers against a bench whose devices are emulated to the byte, under way: each program
// killed and frozen, each cable pulled and put back, at random moments; how soon the propellers
// stand still, measured at the emulated box's output. Prints a table; status 1 where a bound is
// broken.
//   measure_failsafes [TIMES [maestro|roboclaw]]
// TIMES: of each kill and each pulled cable; of each freezing half as often.
#include <fmt/format.h>

#include <cstdlib>
#include <random>

#include "tests/measure/kill_table.h"
#include "tests/system/benched_boat.h"

namespace lodesman::measure {
namespace {

using namespace lodesman::testing;

constexpr double kSilentHigh_s = 0.5;
constexpr double kBox_s = 0.9;
constexpr double kLostHeading_s = 1.0;

class Campaign {
 public:
  Campaign(int times, const std::string& box) : times_{times}, boat_{box, {"--start", "--arm"}} {
    fmt::print("seed {}, {}\n", seed_, box);
  }

  [[nodiscard]] int run() {
    killed("lodesman-high killed", kSilentHigh_s, &BenchedBoat::high, &BenchedBoat::start_high);
    killed("lodesman-low killed", kBox_s, &BenchedBoat::low, &BenchedBoat::start_low);
    frozen("lodesman-high frozen", kSilentHigh_s, &BenchedBoat::high);
    frozen("lodesman-low frozen", kBox_s, &BenchedBoat::low);
    pulled("the thruster box's cable pulled", "thruster", kBox_s);
    pulled("the AHRS's cable pulled", "ahrs", kLostHeading_s);
    table_.print();
    return table_.keeps_all_bounds() ? EXIT_SUCCESS : EXIT_FAILURE;
  }

 private:
  using Process = std::unique_ptr<ChildProcess> BenchedBoat::*;

  void wait_a_random_while() { std::this_thread::sleep_for(milliseconds{random_() % 500}); }
  void say(const char* what, int done, int times) {
    fmt::print(stderr, "\r{}: {} of {}   ", what, done, times);
    if (done == times) {
      fmt::print(stderr, "\n");
    }
  }

  void killed(const char* what, double bound_s, Process which, void (BenchedBoat::*start)()) {
    table_.begin(what, "neutral at the box", bound_s);
    for (int i = 0; i < times_; ++i) {
      boat_.await_drive();
      wait_a_random_while();
      const Time event = clock_.now();
      require(kill((boat_.*which)->pid(), SIGKILL) == 0, "no such process");
      table_.add(boat_.still_after_s(event));
      require(eventually([&] { return (boat_.*which)->ended().has_value(); }), "it lives on");
      (boat_.*start)();
      say(what, i + 1, times_);
    }
  }

  void frozen(const char* what, double bound_s, Process which) {
    table_.begin(what, "neutral at the box", bound_s);
    const int times = (times_ + 1) / 2;
    for (int i = 0; i < times; ++i) {
      boat_.await_drive();
      wait_a_random_while();
      const Time event = clock_.now();
      require(kill((boat_.*which)->pid(), SIGSTOP) == 0, "no such process");
      table_.add(boat_.still_after_s(event));
      wait_a_random_while();
      require(kill((boat_.*which)->pid(), SIGCONT) == 0, "no such process");
      say(what, i + 1, times);
    }
  }

  // Put back it is another pty behind the same name.
  void pulled(const char* what, const std::string& device, double bound_s) {
    table_.begin(what, "neutral at the box", bound_s);
    for (int i = 0; i < times_; ++i) {
      boat_.await_drive();
      wait_a_random_while();
      const Time event = clock_.now();
      boat_.order(device + " disconnect for=1.5");
      table_.add(boat_.still_after_s(event));
      say(what, i + 1, times_);
    }
    boat_.await_drive();
  }

  int times_;
  unsigned seed_ = static_cast<unsigned>(SteadyClock{}.now().time_since_epoch().count());
  std::mt19937 random_{seed_};
  SteadyClock clock_;
  KillTable table_;
  BenchedBoat boat_;
};

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  const int times = argc > 1 ? std::atoi(argv[1]) : 100;
  try {
    return lodesman::measure::Campaign{times, argc > 2 ? argv[2] : "maestro"}.run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_failsafes: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
