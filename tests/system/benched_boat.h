// SPDX-License-Identifier: Apache-2.0
// The boat's two programs with their real drivers, and the bench whose devices are emulated to the
// byte, on ptys: three real processes. For tests and for what is measured.
#pragma once

#include <fcntl.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "deploy/boat/device_bench.h"
#include "deploy/boat/free_port.h"
#include "tests/system/boat.h"

namespace lodesman::testing {

inline void require(bool holds, const std::string& what) {
  if (!holds) {
    throw std::runtime_error(what);
  }
}

// Which of the boat's devices are the bench's.
enum class Benched : std::uint8_t {
  kHeadingAndThrusters,  // its sonar is simulated, and it reckons where it is
  kAll,
};

// Three programs: the bench, and the boat's two.
class BenchedBoat {
 public:
  // `high_options`: of lodesman-high; `sets`: of the configuration, SECTION.KEY=VALUE. Throws where
  // a program cannot be started.
  explicit BenchedBoat(const std::string& box, std::vector<std::string> high_options = {},
                       Benched benched = Benched::kHeadingAndThrusters,
                       const std::vector<std::string>& sets = {})
      : high_options_{std::move(high_options)},
        ports_{scratch_.file("ports")},
        control_{scratch_.file("control")},
        segment_{"lodesman-test-hil-" + std::to_string(getpid())} {
    CommonOptions options;
    options.sets = {
        "command_socket.port = 0",
        "devices.heading=" + toml_string("nav440:" + (ports_ / "ahrs").string()),
        "devices.thrusters=" + toml_string(box + ":" + (ports_ / "thrusters").string())};
    const std::string sonar_port = std::to_string(free_udp_port());
    const std::vector<std::string> others =
        benched == Benched::kAll
            ? std::vector<std::string>{"devices.sonar=" +
                                           toml_string("delta_t:127.0.0.1?port=" + sonar_port),
                                       "devices.position=" +
                                           toml_string("nmea:" + (ports_ / "position").string() +
                                                       "?baud=38400"),
                                       "simulation.vessel=bench"}
            : std::vector<std::string>{"devices.position=none",
                                       "estimator.position_source=dead_reckoning",
                                       "simulation.vessel=estimate"};
    options.sets.insert(options.sets.end(), others.begin(), others.end());
    options.sets.insert(options.sets.end(), sets.begin(), sets.end());
    const auto config =
        scratch_.file("config.toml", load_configuration("default", options).to_text());
    const auto scenario = scratch_.file("scenario.toml", scenario_text(1900.0, 10'000.0));
    arguments_ = {"--segment",     segment_,     "--config",
                  config.string(), "--scenario", scenario.string()};
    start("lodesman-devices",
          {"--ports", ports_.string(), "--box", box, "--control", control_.string(), "--sonar-port",
           sonar_port},
          bench);
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
  void start_high() { start("lodesman-high", high_options_, high); }

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

  [[nodiscard]] const std::string& segment() const noexcept { return segment_; }
  [[nodiscard]] bool is_still() {
    const auto* now = truth_->latest();
    return now != nullptr && is_neutral(now->value.thrust_left) &&
           is_neutral(now->value.thrust_right);
  }
  // Whether both propellers have run astern since this was last read.
  [[nodiscard]] bool has_gone_astern() {
    return eventually([&] {
      const auto* next = truth_->next();
      return next != nullptr && next->value.thrust_left < 127 && next->value.thrust_right < 127;
    });
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

  Scratch scratch_{"benched"};
  std::vector<std::string> high_options_;
  fs::path ports_;
  fs::path control_;
  std::string segment_;
  std::vector<std::string> arguments_;
  std::optional<SharedBlackboard> world_;
  std::optional<Reader<WorldTruth>> truth_;
};

}  // namespace lodesman::testing
