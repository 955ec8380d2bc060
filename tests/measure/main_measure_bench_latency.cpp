// SPDX-License-Identifier: Apache-2.0
// How long a heading takes through the boat: from the last byte of the first AHRS packet that shows
// a turn to the byte with which the thruster box is told something else. The boat's two programs
// with their real drivers, under way on a straight line; AHRS and box are emulated to the byte, on
// ptys, in this process, which looks every few microseconds. Prints a table.
//   measure_bench_latency [TIMES]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numbers>
#include <random>

#include "hal_sim/emulators/device_port.h"
#include "hal_sim/emulators/emulated_ahrs.h"
#include "hal_sim/emulators/emulated_thrusters.h"
#include "tests/system/boat.h"

namespace lodesman::measure {
namespace {

using namespace lodesman::testing;
using std::chrono::microseconds;

constexpr Duration kLook = microseconds{20};
// More than between two bytes of a packet, less than between two packets.
constexpr Duration kGap = milliseconds{5};
// More a packet shows of it than the helm's unit; no more than a hull can begin with.
constexpr double kTurn_rad_s = 10.0 / 180.0 * std::numbers::pi;
constexpr Duration kTurn = milliseconds{300};
constexpr Duration kRest = milliseconds{1500};
constexpr Duration kTooLong = seconds{1};

// A pty that remembers when the boat's bytes came and the device's went.
class TimedLine final : public HostLine {
 public:
  explicit TimedLine(const fs::path& name) : pty_{make_pty_line(name)} {}

  std::size_t read(std::span<std::uint8_t> into) override { return pty_->read(into); }
  std::size_t write(std::span<const std::uint8_t> bytes) override {
    const std::size_t written = pty_->write(bytes);
    if (written > 0) {
      last_write = SteadyClock{}.now();
    }
    return written;
  }
  bool has_host() override { return pty_->has_host(); }
  int host_baud(int device) override { return pty_->host_baud(device); }
  void unplug() override { pty_->unplug(); }
  void plug() override { pty_->plug(); }

  Time last_write{};

 private:
  std::unique_ptr<HostLine> pty_;
};

[[nodiscard]] std::string percentile(std::vector<double> sorted_ms, double share) {
  const auto last = static_cast<double>(sorted_ms.size() - 1);
  return fmt::format("{:.1f}", sorted_ms[static_cast<std::size_t>(share * last)]);
}

class Bench {
 public:
  Bench() {
    CommonOptions options;
    options.sets = {"command_socket.port = 0",
                    "devices.heading=" + toml_string("nav440:" + ahrs_name_.string()),
                    "devices.thrusters=" + toml_string("maestro:" + box_name_.string()),
                    "devices.position=none",
                    "estimator.position_source=dead_reckoning",
                    "simulation.vessel=estimate"};
    const auto config =
        scratch_.file("config.toml", load_configuration("default", options).to_text());
    const auto scenario = scratch_.file("scenario.toml", scenario_text(1900.0, 10'000.0));
    std::vector<std::string> arguments{"--segment",     segment_,     "--config",
                                       config.string(), "--scenario", scenario.string()};
    low_ = std::make_unique<ChildProcess>("lodesman-low", arguments);
    arguments.insert(arguments.end(), {"--start", "--arm"});
    high_ = std::make_unique<ChildProcess>("lodesman-high", arguments);
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  ~Bench() {
    high_.reset();
    low_.reset();
    remove_dead_segment(segment_);
  }

  void await_way() {
    const Time deadline = clock_.now() + kPatience;
    while (!sails()) {
      if (clock_.now() > deadline) {
        throw std::runtime_error("the boat does not sail");
      }
      pump();
    }
  }

  // [ms]
  [[nodiscard]] double turn_once(Duration phase) {
    run_for(kRest + phase);
    await_gap();
    const auto before = pulses();
    const Time begun = clock_.now();
    turn(0.0, kTurn_rad_s, begun);
    // The packet that shows it is the next to begin.
    pump_until([&] { return ahrs_line_->last_write > begun; });
    pump_until([&] { return clock_.now() - ahrs_line_->last_write > kGap || pulses() != before; });
    const Time in = ahrs_line_->last_write;
    pump_until([&] { return pulses() != before; });
    const Time out = clock_.now();
    while (clock_.now() < begun + kTurn) {
      pump();
    }
    const Time turned = clock_.now();
    turn(kTurn_rad_s * to_seconds(turned - begun), -kTurn_rad_s, turned);
    run_for(turned - begun);
    turn(0.0, 0.0, clock_.now());
    return to_seconds(out - in) * 1e3;
  }

 private:
  [[nodiscard]] std::array<std::uint16_t, 2> pulses() const {
    return {box_.pulse_quarter_us(0), box_.pulse_quarter_us(1)};
  }
  [[nodiscard]] bool sails() const {
    const auto now = pulses();
    return now[0] > kUnderWay_quarter_us && now[1] > kUnderWay_quarter_us;
  }
  // From that heading on at that rate.
  void turn(double heading_rad, double rate_rad_s, Time now) {
    EmulatedMotion motion;
    motion.heading_true_rad = heading_rad;
    motion.yaw_rate_rad_s = rate_rad_s;
    motion.measured = now;
    unit_.set_motion(motion);
  }
  void pump() {
    const Time now = clock_.now();
    ahrs_port_->pump(now);
    box_port_->pump(now);
    std::this_thread::sleep_for(kLook);
  }
  void run_for(Duration span) {
    const Time end = clock_.now() + span;
    while (clock_.now() < end) {
      pump();
    }
  }
  template <class Condition>
  void pump_until(Condition condition) {
    const Time deadline = clock_.now() + kTooLong;
    while (!condition()) {
      if (clock_.now() > deadline) {
        throw std::runtime_error("a turn changes nothing at the box");
      }
      pump();
    }
  }
  // Between two packets, so that the next one is measured after what happens now.
  void await_gap() {
    const Time last = ahrs_line_->last_write;
    pump_until([&] { return ahrs_line_->last_write != last; });
    pump_until([&] { return clock_.now() - ahrs_line_->last_write > kGap; });
  }

  // More than the box is tried with before it is armed.
  static constexpr std::uint16_t kUnderWay_quarter_us = 6100;

  [[nodiscard]] static MaestroBoxOptions box_options() {
    MaestroBoxOptions options;
    options.time_out_10ms = 50;
    for (std::size_t i = 0; i < 2; ++i) {
      options.channel[i].home = MaestroHome::kGoTo;
    }
    return options;
  }

  SteadyClock clock_;
  Scratch scratch_{"latency"};
  std::string segment_ = "lodesman-test-latency-" + std::to_string(getpid());
  fs::path ahrs_name_ = scratch_.file("ahrs");
  fs::path box_name_ = scratch_.file("thrusters");
  Nav440Unit unit_{{}, clock_.now(), std::chrono::minutes{10}};
  MaestroBox box_{box_options(), clock_.now()};
  EmulatedWire ahrs_wire_{"ahrs", 1};
  EmulatedWire box_wire_{"box", 2};
  TimedLine* ahrs_line_ = nullptr;
  std::unique_ptr<DevicePort> ahrs_port_ = [this] {
    auto line = std::make_unique<TimedLine>(ahrs_name_);
    ahrs_line_ = line.get();
    return std::make_unique<DevicePort>(unit_, ahrs_wire_, std::move(line));
  }();
  std::unique_ptr<DevicePort> box_port_ =
      std::make_unique<DevicePort>(box_, box_wire_, std::make_unique<TimedLine>(box_name_));
  std::unique_ptr<ChildProcess> low_;
  std::unique_ptr<ChildProcess> high_;
};

void measure(int times) {
  std::mt19937 random{1};
  Bench bench;
  bench.await_way();
  std::vector<double> took_ms;
  for (int i = 0; i < times; ++i) {
    took_ms.push_back(bench.turn_once(milliseconds{random() % 200}));
    fmt::print(stderr, "\r{} of {}   {}", i + 1, times, i + 1 == times ? "\n" : "");
  }
  std::sort(took_ms.begin(), took_ms.end());
  fmt::print("| default | {} | {} | {} | {} |\n", times, percentile(took_ms, 0.5),
             percentile(took_ms, 0.99), percentile(took_ms, 1.0));
}

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  const int times = argc > 1 ? std::max(1, std::atoi(argv[1])) : 200;
  try {
    fmt::print("| AHRS byte in to thruster byte out | turns | median ms | p99 ms | worst ms |\n");
    fmt::print("|---|---|---|---|---|\n");
    lodesman::measure::measure(times);
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_bench_latency: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
