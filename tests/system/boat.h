// SPDX-License-Identifier: Apache-2.0
// Two real processes on a segment of the test's own, and what the tests that kill them share.
#pragma once

#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "deploy/boat/configuration.h"
#include "deploy/operator/run/child_process.h"
#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::testing {

using namespace lodesman::cli;
using std::chrono::milliseconds;
using std::chrono::seconds;
namespace fs = std::filesystem;

// A directory of its own for each test, gone with it.
class Scratch {
 public:
  explicit Scratch(const std::string& name) {
    std::string pattern =
        (fs::temp_directory_path() / ("lodesman-test-" + name + "-XXXXXX")).string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw std::runtime_error(pattern + " cannot be made");
    }
    directory_ = pattern;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(directory_, ignored);
  }
  [[nodiscard]] fs::path file(const std::string& name, const std::string& text = "") const {
    if (!text.empty()) {
      std::ofstream{directory_ / name} << text;
    }
    return directory_ / name;
  }

 private:
  fs::path directory_;
};

// A goal that is far enough to be under way while things die, and a mission that is sailed on with
// unless told otherwise.
inline std::string scenario_text(double goal_y_m, double time_limit_s = 120.0,
                                 const std::string& on_restart = "resume") {
  return "name = \"short\"\nseed = 1\ntime_limit_s = " + std::to_string(time_limit_s) +
         "\n[mission]\nstart_m = [0.0, 0.0]\nstart_heading_deg = 0.0\ngoal_m = [0.0, " +
         std::to_string(goal_y_m) + "]\ngoal_radius_m = 0.5\non_restart = \"" + on_restart +
         "\"\n[vehicle]\nspeed_m_s = 0.74\nradius_m = 0.5\n";
}

// Patience for what a machine under load may take its time over; nothing is judged by it.
inline constexpr Duration kPatience = seconds{60};

template <class Condition>
bool eventually(Condition condition, Duration patience = kPatience) {
  const SteadyClock clock;
  const Time deadline = clock.now() + patience;
  while (!condition()) {
    if (clock.now() >= deadline) {
      return false;
    }
    std::this_thread::sleep_for(milliseconds{2});
  }
  return true;
}

// The newest value of a channel, once there is one.
template <class T>
const Stamped<T>& await_first(Reader<T>& reader) {
  const Stamped<T>* newest = nullptr;
  if (!eventually([&] { return (newest = reader.latest()) != nullptr; })) {
    throw std::runtime_error("nothing was published");
  }
  return *newest;
}

// A child of a process by its program's name; 0 when there is none.
inline pid_t child_of(pid_t parent, const std::string& program) {
  const std::string id = std::to_string(parent);
  std::ifstream children{"/proc/" + id + "/task/" + id + "/children"};
  for (pid_t child = 0; children >> child;) {
    std::string name;
    std::ifstream{"/proc/" + std::to_string(child) + "/comm"} >> name;
    if (name == program) {
      return child;
    }
  }
  return 0;
}

inline bool any_segment_of(pid_t launcher) {
  return fs::exists("/dev/shm/lodesman-sim-" + std::to_string(launcher));
}

// Both programs on a segment of this test's own.
struct Boat {
  explicit Boat(const Scratch& scratch, const std::string& profile = "paper",
                const std::string& scenario_toml = scenario_text(25.0))
      : segment{"lodesman-test-boat-" + std::to_string(getpid())} {
    CommonOptions options;
    options.sets = {"command_socket.port = 0"};
    const auto config = scratch.file("config.toml", load_configuration(profile, options).to_text());
    const auto scenario = scratch.file("scenario.toml", scenario_toml);
    arguments = {"--segment",     segment,      "--config",
                 config.string(), "--scenario", scenario.string()};
    start_low();
    start_high();
  }
  ~Boat() {
    high.reset();
    low.reset();
    remove_dead_segment(segment);
  }
  void start_low() { low = std::make_unique<ChildProcess>("lodesman-low", arguments); }
  void start_high() {
    auto with_start = arguments;
    with_start.push_back("--start");
    high = std::make_unique<ChildProcess>("lodesman-high", with_start);
  }

  std::string segment;
  std::vector<std::string> arguments;
  std::unique_ptr<ChildProcess> low;
  std::unique_ptr<ChildProcess> high;
};

inline bool drives(const Stamped<ThrustApplied>* thrust) {
  return thrust != nullptr && thrust->value.reason == ThrustReason::kCommanded &&
         thrust->value.left > 128;
}

}  // namespace lodesman::testing
