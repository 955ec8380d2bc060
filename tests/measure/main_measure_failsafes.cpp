// SPDX-License-Identifier: Apache-2.0
// The real drivers against a bench whose devices are emulated to the byte, under way: each program
// killed and frozen, each cable pulled and put back, at random moments; how soon the propellers
// stand still, measured at the emulated box's output. Prints a table; status 1 where a bound is
// broken.
//   measure_failsafes [TIMES [maestro|roboclaw]]
// TIMES: of each kill and each pulled cable; of each freezing half as often.
#include <fcntl.h>
#include <fmt/format.h>

#include <cstdlib>
#include <random>

#include "deploy/boat/device_bench.h"
#include "tests/measure/kill_table.h"
#include "tests/system/boat.h"

namespace lodesman::measure {
namespace {

using namespace lodesman::testing;

constexpr double kSilentHigh_s = 0.5;
constexpr double kBox_s = 0.9;
constexpr double kLostHeading_s = 1.0;

void require(bool holds, const std::string& what) {
  if (!holds) {
    throw std::runtime_error(what);
  }
}

// Three programs: the bench, and the boat's two.
class BenchedBoat {
 public:
  explicit BenchedBoat(const std::string& box)
      : ports_{scratch_.file("ports")},
        control_{scratch_.file("control")},
        segment_{"lodesman-test-hil-" + std::to_string(getpid())} {
    CommonOptions options;
    options.sets = {"command_socket.port = 0",
                    "devices.heading=" + toml_string("nav440:" + (ports_ / "ahrs").string()),
                    "devices.thrusters=" + toml_string(box + ":" + (ports_ / "thrusters").string()),
                    "devices.position=none",
                    "estimator.position_source=dead_reckoning",
                    "simulation.vessel=estimate"};
    const auto config =
        scratch_.file("config.toml", load_configuration("default", options).to_text());
    const auto scenario = scratch_.file("scenario.toml", scenario_text(1900.0, 10'000.0));
    arguments_ = {"--segment",     segment_,     "--config",
                  config.string(), "--scenario", scenario.string()};
    start("lodesman-devices",
          {"--ports", ports_.string(), "--box", box, "--control", control_.string()}, bench);
    world_.emplace(SharedBlackboard::observe(world_segment_of(segment_), kPatience));
    truth_.emplace((*world_)->world_truth);
    start_low();
    start_high();
  }
  ~BenchedBoat() {
    high.reset();
    low.reset();
    bench.reset();
    remove_dead_segment(segment_);
    remove_dead_segment(world_segment_of(segment_));
  }
  void start_low() { start("lodesman-low", {}, low); }
  void start_high() { start("lodesman-high", {"--start", "--arm"}, high); }

  void order(const std::string& fault) const {
    const int pipe = open(control_.c_str(), O_WRONLY | O_CLOEXEC);
    require(pipe >= 0, "the bench has no control");
    const std::string line = fault + "\n";
    require(write(pipe, line.data(), line.size()) == static_cast<ssize_t>(line.size()),
            "the bench does not listen");
    close(pipe);
  }

  void await_drive() {
    require(eventually([&] {
              const auto* now = truth_->latest();
              return now != nullptr && now->value.thrust_left > 140 &&
                     now->value.thrust_right > 140;
            }),
            "the boat does not sail");
  }
  // How long after `event` the propellers stand still, and stay so for a while.
  [[nodiscard]] double still_after_s(Time event) {
    Time since{};
    require(eventually([&] {
              while (const auto* now = truth_->next()) {
                const bool still =
                    is_neutral(now->value.thrust_left) && is_neutral(now->value.thrust_right);
                if (now->stamp < event || !still) {
                  since = Time{};
                } else if (since == Time{}) {
                  since = now->stamp;
                }
              }
              return since != Time{} && SteadyClock{}.now() - since > milliseconds{150};
            }),
            "the propellers go on");
    return to_seconds(since - event);
  }

  std::unique_ptr<ChildProcess> bench;
  std::unique_ptr<ChildProcess> low;
  std::unique_ptr<ChildProcess> high;

 private:
  [[nodiscard]] static bool is_neutral(std::uint8_t thrust) {
    return thrust == 127 || thrust == 128;
  }
  void start(const char* program, const std::vector<std::string>& more,
             std::unique_ptr<ChildProcess>& process) {
    auto all = arguments_;
    all.insert(all.end(), more.begin(), more.end());
    process = std::make_unique<ChildProcess>(program, all);
  }

  Scratch scratch_{"failsafes"};
  fs::path ports_;
  fs::path control_;
  std::string segment_;
  std::vector<std::string> arguments_;
  std::optional<SharedBlackboard> world_;
  std::optional<Reader<WorldTruth>> truth_;
};

class Campaign {
 public:
  Campaign(int times, const std::string& box) : times_{times}, boat_{box} {
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
